// SPDX-License-Identifier: Apache-2.0

#include "tests/quality/truth.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lensplane {
namespace {

using Sum = std::array<double, 4>;

constexpr int kReach = 2;  // pixels on either side of a pixel's centre: 4.4 sigma
constexpr int kWindow = 2 * kReach * kTruthRays;
constexpr int kPixelsPerBatch = kBatchSize / kTruthRays;
static_assert(kBatchSize % kTruthRays == 0);

/// The weights of the pixel filter at the rays of a line around a pixel's centre; they add up to 1.
std::array<double, kWindow> filter_weights() {
  std::array<double, kWindow> weights{};
  double sum = 0;
  for (int i = 0; i < kWindow; ++i) {
    const double off = (i + 0.5) / kTruthRays - kReach;
    sum += weights[static_cast<std::size_t>(i)] = std::exp(-0.5 * off * off / (kPixelSigma * kPixelSigma));
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

/// What one line of rays adds to the pixels of a row, by either filter across it.
struct Line {
  std::vector<Sum> filtered, box;
};

/// The line of rays at film position `y`, from kReach pixels left of the frame to as many right of it.
Line trace_line(const Tracer& tracer, const Texture& plate, double y,
                const std::array<double, kWindow>& weights) {
  const int width = tracer.camera().width;
  std::vector<Rgba> seen;
  TraceBatch batch = tracer.make_batch();
  for (int column = -kReach; column < width + kReach; column += kPixelsPerBatch) {
    for (int i = 0; i < kBatchSize; ++i) {
      batch.x[i] = column + (i + 0.5) / kTruthRays;
      batch.y[i] = y;
    }
    tracer.trace(batch);
    const SurfaceBatch& surface = batch.surfaces.front();
    for (std::size_t i = 0; i < kBatchSize; ++i) {
      const bool hit = surface.outcome[i] == Outcome::Hit;
      seen.push_back(hit ? plate.lookup({surface.s[i], surface.t[i]}) : Rgba{0, 0, 0, 0});
    }
  }
  Line line{std::vector<Sum>(static_cast<std::size_t>(width), Sum{}), {}};
  line.box = line.filtered;
  for (int column = 0; column < width; ++column) {
    Sum& filtered = line.filtered[static_cast<std::size_t>(column)];
    Sum& box = line.box[static_cast<std::size_t>(column)];
    // The window is as wide as two kReach, half a pixel right of whole pixels.
    const int first = column * kTruthRays + kTruthRays / 2;
    for (int i = 0; i < kWindow; ++i) {
      const Rgba& ray = seen[static_cast<std::size_t>(first + i)];
      const bool inside = std::abs(i + 0.5 - kWindow / 2) < 0.5 * kTruthRays;
      for (std::size_t c = 0; c < 4; ++c) {
        filtered[c] += weights[static_cast<std::size_t>(i)] * static_cast<double>(ray[c]);
        if (inside) box[c] += static_cast<double>(ray[c]) / kTruthRays;
      }
    }
  }
  return line;
}

Rgba colour_from(const Sum& sum) {
  Rgba colour;
  for (std::size_t c = 0; c < 4; ++c) colour[c] = static_cast<float>(sum[c]);
  return colour;
}

}  // namespace

Truth true_picture(const Tracer& tracer, const Texture& plate) {
  const int width = tracer.camera().width, height = tracer.camera().height;
  const auto weights = filter_weights();
  const int lines = (height + 2 * kReach) * kTruthRays;
  Truth truth;
  truth.by_box = {width, height, 0, 0, width, height, {}};
  truth.by_box.pixels.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), {});
  truth.by_pixel_filter = truth.by_box;
  // Rows in blocks, so that the lines between them need not all be kept.
  constexpr int kBlock = 8;
  tbb::parallel_for(
      tbb::blocked_range<int>(0, (height + kBlock - 1) / kBlock, 1),
      [&](const tbb::blocked_range<int>& range) {
        for (int block = range.begin(); block != range.end(); ++block) {
          const int top = block * kBlock, bottom = std::min(height, top + kBlock);
          std::vector<Sum> filtered(static_cast<std::size_t>(width) * kBlock, Sum{}), box = filtered;
          const int first = top * kTruthRays + kTruthRays / 2;
          const int last = std::min(lines, (bottom - 1) * kTruthRays + kTruthRays / 2 + kWindow);
          for (int n = first; n < last; ++n) {
            const Line line = trace_line(tracer, plate, (n + 0.5) / kTruthRays - kReach, weights);
            for (int row = top; row < bottom; ++row) {
              const int i = n - (row * kTruthRays + kTruthRays / 2);
              if (i < 0 || i >= kWindow) continue;
              const double weight = weights[static_cast<std::size_t>(i)];
              const double in_box =
                  std::abs(i + 0.5 - kWindow / 2) < 0.5 * kTruthRays ? 1.0 / kTruthRays : 0.0;
              for (int column = 0; column < width; ++column) {
                const std::size_t at = static_cast<std::size_t>((row - top) * width + column);
                const auto from = static_cast<std::size_t>(column);
                for (std::size_t c = 0; c < 4; ++c) {
                  filtered[at][c] += weight * line.filtered[from][c];
                  box[at][c] += in_box * line.box[from][c];
                }
              }
            }
          }
          for (int row = top; row < bottom; ++row) {
            for (int column = 0; column < width; ++column) {
              const std::size_t at = static_cast<std::size_t>((row - top) * width + column);
              truth.by_pixel_filter.at(column, row) = colour_from(filtered[at]);
              truth.by_box.at(column, row) = colour_from(box[at]);
            }
          }
        }
      });
  return truth;
}

}  // namespace lensplane
