// SPDX-License-Identifier: Apache-2.0
//
// What pictures are measured by: very many rays a pixel, each of which looks surfaces up in a point, weighed
// by the pixel filter.

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "pipeline/composite/compositor.h"

namespace lensplane {

/// Takes pixels by `density` x `density` rays a square pixel, up to 4 standard deviations of the pixel filter
/// from their centres.
class BruteForce {
 public:
  BruteForce(const Tracer& tracer, const std::vector<SurfaceLook>& looks, int density)
      : tracer_(tracer),
        viewer_(tracer.surfaces(), looks),
        batch_(tracer.make_batch()),
        points_(looks.size()),
        density_(density),
        reach_(static_cast<int>(4 * kPixelSigma * density)) {}

  Rgba pixel(int column, int row) {
    sum_ = {};
    weights_ = 0;
    for (int j = -reach_; j < reach_; ++j) {
      for (int first = -reach_; first < reach_; first += kBatchSize) {
        for (int i = 0; i < kBatchSize; ++i) {
          batch_.x[i] = column + 0.5 + off(first + i);
          batch_.y[i] = row + 0.5 + off(j);
        }
        tracer_.trace(batch_);
        for (int i = 0; i < std::min(kBatchSize, reach_ - first); ++i) {
          const double x = off(first + i), y = off(j);
          add(std::exp(-(x * x + y * y) / (2 * kPixelSigma * kPixelSigma)), static_cast<std::size_t>(i));
        }
      }
    }
    Rgba mean;
    for (std::size_t c = 0; c < 4; ++c) mean[c] = static_cast<float>(sum_[c] / weights_);
    return mean;
  }

 private:
  /// Of ray number n of a line from the pixel's centre.
  double off(int n) const { return (n + 0.5) / density_; }

  /// Adds what ray `i` of the batch sees.
  void add(double weight, std::size_t i) {
    for (std::size_t k = 0; k < points_.size(); ++k) points_[k] = seen_point(batch_.surfaces[k], i);
    const Rgba colour = viewer_.see(points_, 0);
    for (std::size_t c = 0; c < 4; ++c) sum_[c] += weight * static_cast<double>(colour[c]);
    weights_ += weight;
  }

  const Tracer& tracer_;
  Viewer viewer_;
  TraceBatch batch_;
  std::vector<SeenPoint> points_;
  int density_, reach_;
  std::array<double, 4> sum_{};
  double weights_ = 0;
};

/// The camera's picture without overscan.
inline Picture brute_force(const Tracer& tracer, const std::vector<SurfaceLook>& looks, int density) {
  const int width = tracer.camera().width, height = tracer.camera().height;
  BruteForce rays(tracer, looks, density);
  Picture picture{width, height, 0, 0, width, height, {}};
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) picture.pixels.push_back(rays.pixel(column, row));
  }
  return picture;
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
