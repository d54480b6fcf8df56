// SPDX-License-Identifier: Apache-2.0
//
// What pictures are measured by: very many rays a pixel, each of which looks surfaces up in a point, weighed
// by the pixel filter less the pictures' own.

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "pipeline/composite/compositor.h"

namespace lensplane {

/// Takes pictures by `density` x `density` rays a square pixel: lines of rays go over the whole film, and
/// each ray counts for every pixel whose centre is within 4 standard deviations of the pixel filter.
class BruteForce {
 public:
  BruteForce(const Tracer& tracer, const std::vector<SurfaceLook>& looks, int density)
      : tracer_(tracer),
        viewer_(tracer.surfaces(), looks),
        batch_(tracer.make_batch()),
        surfaces_(looks.size()),
        density_(density),
        reach_(static_cast<int>(4 * kPixelSigma * density)) {}

  /// The camera's picture without overscan.
  Picture picture() {
    const int width = tracer_.camera().width, height = tracer_.camera().height;
    std::vector<Sum> sums(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (int line = first_line(0); line < first_line(height - 1) + 2 * reach_; ++line) {
      trace_line(line, width);
      for (int row = 0; row < height; ++row) {
        if (weight_of(line, row) == 0) continue;
        for (int column = 0; column < width; ++column) {
          add_rays(line, row, column,
                   sums[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                        static_cast<std::size_t>(column)]);
        }
      }
    }
    Picture picture{width, height, 0, 0, width, height, {}};
    for (const Sum& sum : sums) {
      picture.pixels.emplace_back();
      for (std::size_t c = 0; c < 4; ++c) {
        picture.pixels.back()[c] = static_cast<float>(sum[c] / sum[4]);
      }
    }
    return picture;
  }

 private:
  /// Colour times weight, and the weight.
  using Sum = std::array<double, 5>;

  /// Where line or column number n of rays is on the film, in pixels.
  double place(int n) const { return 0.5 + (n + 0.5) / density_; }

  /// The first line that counts for a row of pixels: 2 reach_ of them do.
  int first_line(int row) const { return row * density_ - reach_; }

  /// Of a line or column of rays for a row or column of pixels.
  double weight_of(int line, int row) const {
    const int n = line - first_line(row);
    const double off = place(line) - (row + 0.5);
    return n >= 0 && n < 2 * reach_ ? std::exp(-off * off / (2 * kPixelSigma * kPixelSigma)) : 0;
  }

  /// What the rays of a line meet, from the first column's first to the last one's last.
  void trace_line(int line, int width) {
    const int first = first_line(0), end = first_line(width - 1) + 2 * reach_;
    points_.clear();
    for (int start = first; start < end; start += kBatchSize) {
      for (int i = 0; i < kBatchSize; ++i) {
        batch_.x[i] = place(start + i);
        batch_.y[i] = place(line);
      }
      tracer_.trace(batch_);
      for (int i = 0; i < std::min(kBatchSize, end - start); ++i) {
        for (std::size_t k = 0; k < surfaces_; ++k) {
          points_.push_back(seen_point(batch_.surfaces[k], static_cast<std::size_t>(i)));
        }
      }
    }
  }

  /// A line's rays for a pixel, each as the pixel sees it: less the pictures' own filter.
  void add_rays(int line, int row, int column, Sum& sum) {
    for (int n = first_line(column); n < first_line(column) + 2 * reach_; ++n) {
      const double weight = weight_of(line, row) * weight_of(n, column);
      const auto ray = static_cast<std::size_t>(n - first_line(0));
      const Rgba colour = viewer_.see(std::span(points_).subspan(ray * surfaces_, surfaces_), 0,
                                      {place(n) - (column + 0.5), place(line) - (row + 0.5)});
      for (std::size_t c = 0; c < 4; ++c) sum[c] += weight * static_cast<double>(colour[c]);
      sum[4] += weight;
    }
  }

  const Tracer& tracer_;
  Viewer viewer_;
  TraceBatch batch_;
  std::size_t surfaces_;
  std::vector<SeenPoint> points_;  // of the rays of a line, surface by surface
  int density_, reach_;
};

inline Picture brute_force(const Tracer& tracer, const std::vector<SurfaceLook>& looks, int density) {
  return BruteForce(tracer, looks, density).picture();
}

/// How far two pictures of one size are apart, over all channels.
struct Difference {
  double rms = 0, most = 0;
};
inline Difference difference(const Picture& a, const Picture& b) {
  Difference found;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    for (std::size_t c = 0; c < 4; ++c) {
      const double off = std::abs(static_cast<double>(a.pixels[i][c]) - static_cast<double>(b.pixels[i][c]));
      found.rms += off * off;
      found.most = std::max(found.most, off);
    }
  }
  found.rms = std::sqrt(found.rms / (4.0 * static_cast<double>(a.pixels.size())));
  return found;
}

}  // namespace lensplane
