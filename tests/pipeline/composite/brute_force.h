// SPDX-License-Identifier: Apache-2.0
//
// What pictures are measured by: very many rays a pixel, each of which looks surfaces up in a point, weighed
// by the pixel filter.

#pragma once

#include <cmath>
#include <vector>

#include "pipeline/composite/compositor.h"

namespace lensplane {

/// The camera's picture without overscan, by `density` x `density` rays a square pixel, up to 4 standard
/// deviations of the pixel filter from its centre.
inline Picture brute_force(const Tracer& tracer, const std::vector<SurfaceLook>& looks, int density) {
  const int width = tracer.camera().width, height = tracer.camera().height;
  const int reach = static_cast<int>(4 * kPixelSigma * density);
  Viewer viewer(tracer.surfaces(), looks);
  TraceBatch batch = tracer.make_batch();
  std::vector<SeenPoint> points(looks.size());
  Picture picture{width, height, 0, 0, width, height, {}};
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      std::array<double, 4> sum{};
      double weights = 0;
      for (int j = -reach; j < reach; ++j) {
        for (int first = -reach; first < reach; first += kBatchSize) {
          for (int i = 0; i < kBatchSize; ++i) {
            batch.x[i] = column + 0.5 + (first + i + 0.5) / density;
            batch.y[i] = row + 0.5 + (j + 0.5) / density;
          }
          tracer.trace(batch);
          for (int i = 0; i < std::min(kBatchSize, reach - first); ++i) {
            const double x = (first + i + 0.5) / density, y = (j + 0.5) / density;
            const double weight = std::exp(-(x * x + y * y) / (2 * kPixelSigma * kPixelSigma));
            for (std::size_t k = 0; k < points.size(); ++k) {
              points[k] = seen_point(batch.surfaces[k], static_cast<std::size_t>(i));
            }
            const Rgba colour = viewer.see(points, 0);
            for (std::size_t c = 0; c < 4; ++c) sum[c] += weight * static_cast<double>(colour[c]);
            weights += weight;
          }
        }
      }
      Rgba mean;
      for (std::size_t c = 0; c < 4; ++c) mean[c] = static_cast<float>(sum[c] / weights);
      picture.pixels.push_back(mean);
    }
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
