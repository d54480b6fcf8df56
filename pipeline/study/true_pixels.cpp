// SPDX-License-Identifier: Apache-2.0

#include "pipeline/study/true_pixels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace lensplane {
namespace {

constexpr int kTile = 16;
constexpr double kPoint =
    1e-3;                  // a ray's filter in pixel filters: a point, but of the surface that the pixel sees
constexpr int kReach = 2;  // pixels beyond a pixel's centre: 4.4 standard deviations of the filter

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

/// What `count` rays side by side see, from the film position (left, y), `step` pixels from one to the next.
class LineOfSight {
 public:
  LineOfSight(const Tracer& tracer, const std::vector<SurfaceLook>& looks)
      : tracer_(tracer),
        viewer_(tracer.surfaces(), looks),
        batch_(tracer.make_batch()),
        points_(looks.size()) {}

  void look(double left, double y, double step, int count, std::vector<Rgba>& seen) {
    seen.clear();
    for (int first = 0; first < count; first += kBatchSize) {
      const int rays = std::min(kBatchSize, count - first);
      for (int i = 0; i < kBatchSize; ++i) {
        batch_.x[i] = left + (first + std::min(i, rays - 1)) * step;
        batch_.y[i] = y;
      }
      tracer_.trace(batch_);
      for (std::size_t i = 0; i < static_cast<std::size_t>(rays); ++i) seen.push_back(seen_by(i));
    }
  }

 private:
  Rgba seen_by(std::size_t i) {
    for (std::size_t k = 0; k < points_.size(); ++k) points_[k] = seen_point(batch_.surfaces[k], i);
    return viewer_.see(points_, kPoint);
  }

  const Tracer& tracer_;
  Viewer viewer_;
  TraceBatch batch_;
  std::vector<SeenPoint> points_;
};

void add(float weight, const Rgba& colour, Rgba& sum) {
  for (std::size_t c = 0; c < 4; ++c) sum[c] += weight * colour[c];
}

/// Filters line by line, first along it and then across.
void fill(const std::vector<float>& weights, int rays, LineOfSight& sight, TrueTile& tile) {
  const int size = tile.size, wide = (size + 2 * kReach) * rays;
  const double step = 1.0 / rays;
  tile.pixels.assign(static_cast<std::size_t>(size) * static_cast<std::size_t>(size), Rgba{0, 0, 0, 0});
  std::vector<Rgba> seen, row(static_cast<std::size_t>(size));
  // A pixel's window begins half a pixel right of, and below, the one of whole pixels around it.
  const int first_of_pixel = rays / 2, window = static_cast<int>(weights.size());
  for (int line = 0; line < wide; ++line) {
    sight.look(tile.left - kReach + 0.5 * step, tile.top - kReach + (line + 0.5) * step, step, wide, seen);
    for (int column = 0; column < size; ++column) {
      Rgba& sum = row[static_cast<std::size_t>(column)] = {0, 0, 0, 0};
      for (int i = 0; i < window; ++i)
        add(weights[static_cast<std::size_t>(i)],
            seen[static_cast<std::size_t>(column * rays + first_of_pixel + i)], sum);
    }
    for (int y = 0; y < size; ++y) {
      const int i = line - (y * rays + first_of_pixel);
      if (i < 0 || i >= window) continue;
      for (int x = 0; x < size; ++x)
        add(weights[static_cast<std::size_t>(i)], row[static_cast<std::size_t>(x)],
            tile.pixels[static_cast<std::size_t>(y * size + x)]);
    }
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
