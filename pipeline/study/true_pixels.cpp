// SPDX-License-Identifier: Apache-2.0

#include "pipeline/study/true_pixels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace lensplane {
namespace {

constexpr int kTile = 16;
constexpr float kLeast = 1e-4F;  // weights below this share of the largest do not count
constexpr int kReach = 2;        // pixels beyond a pixel's centre: 4.4 standard deviations of the filter

/// The weights of rays along a line, from kReach pixels before a pixel's centre to as many behind it.
std::vector<float> weights_along(int rays) {
  std::vector<float> weights;
  double sum = 0;
  for (int i = 0; i < 2 * kReach * rays; ++i) {
    const double off = (i + 0.5) / rays - kReach;
    weights.push_back(static_cast<float>(std::exp(-0.5 * off * off / (kPixelSigma * kPixelSigma))));
    sum += weights.back();
  }
  for (float& weight : weights) weight /= static_cast<float>(sum);
  return weights;
}

/// `count` rays side by side, from the film position (left, y), `step` pixels from one to the next: what they
/// meet, and what they show.
class LineOfSight {
 public:
  LineOfSight(const Tracer& tracer, const std::vector<SurfaceLook>& looks)
      : tracer_(tracer),
        viewer_(tracer.surfaces(), looks),
        batch_(tracer.make_batch()),
        each_(looks.size()) {}

  void trace(double left, double y, double step, int count) {
    points_.clear();
    for (int first = 0; first < count; first += kBatchSize) {
      const int rays = std::min(kBatchSize, count - first);
      for (int i = 0; i < kBatchSize; ++i) {
        batch_.x[i] = left + (first + std::min(i, rays - 1)) * step;
        batch_.y[i] = y;
      }
      tracer_.trace(batch_);
      for (std::size_t i = 0; i < static_cast<std::size_t>(rays); ++i) {
        for (std::size_t k = 0; k < each_; ++k) points_.push_back(seen_point(batch_.surfaces[k], i));
      }
    }
  }

  /// The colour in a point that ray `i` shows a pixel whose centre it lies `offset` away from.
  Rgba seen(int i, SampleOffset offset) {
    const auto ray = static_cast<std::size_t>(i);
    return viewer_.see(std::span(points_).subspan(ray * each_, each_), 0, offset);
  }

 private:
  const Tracer& tracer_;
  Viewer viewer_;
  TraceBatch batch_;
  std::size_t each_;               // surfaces
  std::vector<SeenPoint> points_;  // of every ray of the line
};

void add(float weight, const Rgba& colour, Rgba& sum) {
  for (std::size_t c = 0; c < 4; ++c) sum[c] += weight * colour[c];
}

/// Line by line: every ray for every pixel whose filter it lies in.
void fill(const std::vector<float>& weights, int rays, LineOfSight& sight, TrueTile& tile) {
  const int size = tile.size, wide = (size + 2 * kReach) * rays;
  const double step = 1.0 / rays;
  std::vector<float> total(static_cast<std::size_t>(size) * static_cast<std::size_t>(size), 0.0F);
  tile.pixels.assign(total.size(), Rgba{0, 0, 0, 0});
  const float least = kLeast * weights[weights.size() / 2] * weights[weights.size() / 2];
  // A pixel's window begins half a pixel right of, and below, the one of whole pixels around it.
  const int first_of_pixel = rays / 2, window = static_cast<int>(weights.size());
  const auto off = [&](int i) { return (i + 0.5) * step - kReach; };
  for (int line = 0; line < wide; ++line) {
    sight.trace(tile.left - kReach + 0.5 * step, tile.top - kReach + (line + 0.5) * step, step, wide);
    for (int y = 0; y < size; ++y) {
      const int j = line - (y * rays + first_of_pixel);
      if (j < 0 || j >= window) continue;
      for (int x = 0; x < size; ++x) {
        const auto at = static_cast<std::size_t>(y * size + x);
        for (int i = 0; i < window; ++i) {
          const float weight = weights[static_cast<std::size_t>(i)] * weights[static_cast<std::size_t>(j)];
          if (weight < least) continue;
          add(weight, sight.seen(x * rays + first_of_pixel + i, {off(i), off(j)}), tile.pixels[at]);
          total[at] += weight;
        }
      }
    }
  }
  for (std::size_t at = 0; at < total.size(); ++at) {
    for (float& channel : tile.pixels[at]) channel /= total[at];
  }
}

/// Where squares of `size` pixels begin that are spread over a side.
std::vector<int> places_along(int side, int size, int most) {
  const int count = std::clamp(side / size, 1, most);
  std::vector<int> places;
  for (int i = 0; i < count; ++i) {
    const double middle = (i + 0.5) * side / count;
    places.push_back(std::clamp(static_cast<int>(std::lround(middle - 0.5 * size)), 0, side - size));
  }
  return places;
}

}  // namespace

std::vector<TrueTile> true_tiles(const Tracer& tracer, const std::vector<SurfaceLook>& looks, int across,
                                 int rays) {
  const Camera& camera = tracer.camera();
  const int size = std::min({kTile, camera.width, camera.height});
  std::vector<TrueTile> tiles;
  for (const int top : places_along(camera.height, size, across)) {
    for (const int left : places_along(camera.width, size, across)) tiles.push_back({left, top, size, {}});
  }
  const std::vector<float> weights = weights_along(rays);
  tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t n) {
    LineOfSight sight(tracer, looks);
    fill(weights, rays, sight, tiles[n]);
  });
  return tiles;
}

double psnr_of(const Picture& picture, const std::vector<TrueTile>& truth) {
  double sum = 0, peak = 0;
  std::size_t count = 0;
  for (const TrueTile& tile : truth) {
    for (int i = 0; i < tile.size * tile.size; ++i) {
      const Rgba& should = tile.pixels[static_cast<std::size_t>(i)];
      const Rgba& is =
          picture.at(tile.left + i % tile.size - picture.x, tile.top + i / tile.size - picture.y);
      for (std::size_t c = 0; c < 3; ++c, ++count) {
        const double off = static_cast<double>(is[c]) - static_cast<double>(should[c]);
        sum += off * off;
        peak = std::max(peak, static_cast<double>(should[c]));
      }
    }
  }
  if (count == 0 || sum == 0) return kLargestPsnr;
  if (peak == 0 || !std::isfinite(sum)) return 0;
  return std::min(kLargestPsnr, 10 * std::log10(peak * peak * static_cast<double>(count) / sum));
}

}  // namespace lensplane
