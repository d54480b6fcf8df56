// SPDX-License-Identifier: Apache-2.0

#include "tests/quality/truth.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace lensplane {
namespace {

using Sum = std::array<double, 5>;  // four channels and the weight

constexpr int kReach = 2;             // pixels on either side of a pixel's centre: 4.4 sigma
constexpr int kStripRows = 8;         // rows of pixels whose rays are added up together
constexpr int kPlaces = 64;           // of a ray within its cell, along each axis
constexpr int kTouched = 2 * kReach;  // pixels along an axis whose filters see a ray

/// Where a ray lies along an axis, and what it counts for the pixels around it.
struct Place {
  int first = 0;  // the first pixel that sees it, as seen from the ray's own
  std::array<double, kTouched> weights{};
};

/// Every place that a ray can have along an axis of its pixel.
std::vector<Place> places_in_pixel(int rays) {
  std::vector<Place> places;
  for (int i = 0; i < rays * kPlaces; ++i) {
    const double at = (i + 0.5) / (rays * kPlaces);
    Place place{at < 0.5 ? -kReach : 1 - kReach, {}};
    for (int k = 0; k < kTouched; ++k) {
      const double off = (at - (place.first + k + 0.5)) / kPixelSigma;
      place.weights[static_cast<std::size_t>(k)] = std::exp(-0.5 * off * off);
    }
    places.push_back(place);
  }
  return places;
}

/// Numbers that look random, the same for the same seed (splitmix64).
class Chance {
 public:
  explicit Chance(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }

 private:
  std::uint64_t state_;
};

/// What the rays of some rows of pixels add to the pixels around them.
struct Strip {
  int top, rows;                     // of the pixels
  std::vector<Sum> filtered, boxed;  // row by row
};

void add(double weight, const Rgba& colour, Sum& sum) {
  for (std::size_t c = 0; c < 4; ++c) sum[c] += weight * static_cast<double>(colour[c]);
  sum[4] += weight;
}

/// Takes the rays of one strip after another; one for each thread.
class StripTaker {
 public:
  StripTaker(const Tracer& tracer, const std::vector<SurfaceLook>& looks, int rays)
      : tracer_(tracer),
        viewer_(tracer.surfaces(), looks),
        batch_(tracer.make_batch()),
        points_(looks.size()),
        rays_(rays),
        places_(places_in_pixel(rays)) {}

  /// The rays of the rows from `top` to `bottom`, which may lie beyond the frame.
  Strip take(int top, int bottom) {
    const int width = tracer_.camera().width;
    Strip strip{top - kReach, bottom - top + 2 * kReach, {}, {}};
    strip.filtered.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(strip.rows), Sum{});
    strip.boxed = strip.filtered;
    for (int row = top; row < bottom; ++row) {
      for (int column = -kReach; column < width + kReach; ++column) take_pixel(column, row, strip);
    }
    take_batch(strip);
    return strip;
  }

 private:
  struct Ray {
    int column, row, x, y;  // its pixel, and its place in there along either axis
  };

  void take_pixel(int column, int row, Strip& strip) {
    Chance chance((static_cast<std::uint64_t>(row + 1000) << 32) + static_cast<std::uint64_t>(column + 1000));
    for (int j = 0; j < rays_; ++j) {
      for (int i = 0; i < rays_; ++i) {
        const std::uint64_t drawn = chance.next();
        add_ray({column, row, i * kPlaces + static_cast<int>(drawn % kPlaces),
                 j * kPlaces + static_cast<int>(drawn / kPlaces % kPlaces)},
                strip);
      }
    }
  }

  void add_ray(const Ray& ray, Strip& strip) {
    const double all = static_cast<double>(rays_) * kPlaces;
    batch_.x[waiting_.size()] = ray.column + (ray.x + 0.5) / all;
    batch_.y[waiting_.size()] = ray.row + (ray.y + 0.5) / all;
    waiting_.push_back(ray);
    if (waiting_.size() == kBatchSize) take_batch(strip);
  }

  void take_batch(Strip& strip) {
    if (waiting_.empty()) return;
    for (std::size_t i = waiting_.size(); i < kBatchSize; ++i) {
      batch_.x[i] = batch_.x[0];
      batch_.y[i] = batch_.y[0];
    }
    tracer_.trace(batch_);
    for (std::size_t i = 0; i < waiting_.size(); ++i) {
      for (std::size_t k = 0; k < points_.size(); ++k) points_[k] = seen_point(batch_.surfaces[k], i);
      splat(waiting_[i], strip);
    }
    waiting_.clear();
  }

  /// What the ray shows a pixel whose centre it lies (x, y) away from: a point.
  Rgba seen(double x, double y) { return viewer_.see(points_, 0, {x, y}); }

  void splat(const Ray& ray, Strip& strip) {
    constexpr double kLeastWeight = 1e-3;  // of the filter's in its middle
    const int width = tracer_.camera().width;
    const Place &x = places_[static_cast<std::size_t>(ray.x)], &y = places_[static_cast<std::size_t>(ray.y)];
    const double all = static_cast<double>(rays_) * kPlaces;
    const double right = (ray.x + 0.5) / all - 0.5, down = (ray.y + 0.5) / all - 0.5;
    const auto at = [&](int column, int row) {
      return static_cast<std::size_t>((row - strip.top) * width + column);
    };
    for (int j = 0; j < kTouched; ++j) {
      for (int i = 0; i < kTouched; ++i) {
        const int column = ray.column + x.first + i;
        const double weight = x.weights[static_cast<std::size_t>(i)] * y.weights[static_cast<std::size_t>(j)];
        if (column < 0 || column >= width || weight < kLeastWeight) continue;
        add(weight, seen(right - (x.first + i), down - (y.first + j)),
            strip.filtered[at(column, ray.row + y.first + j)]);
      }
    }
    if (ray.column >= 0 && ray.column < width) add(1, seen(0, 0), strip.boxed[at(ray.column, ray.row)]);
  }

  const Tracer& tracer_;
  Viewer viewer_;
  TraceBatch batch_;
  std::vector<SeenPoint> points_;  // of one ray
  int rays_;
  std::vector<Place> places_;
  std::vector<Ray> waiting_;  // those of the batch
};

Picture mean_of(const std::vector<Sum>& sums, int width, int height) {
  Picture picture{width, height, 0, 0, width, height, {}};
  for (const Sum& sum : sums) {
    Rgba colour{};
    for (std::size_t c = 0; c < 4; ++c) colour[c] = static_cast<float>(sum[c] / sum[4]);
    picture.pixels.push_back(colour);
  }
  return picture;
}

}  // namespace

Truth true_picture(const Tracer& tracer, const std::vector<SurfaceLook>& looks, int rays) {
  const int width = tracer.camera().width, height = tracer.camera().height;
  const int count = (height + 2 * kReach + kStripRows - 1) / kStripRows;
  std::vector<Strip> strips(static_cast<std::size_t>(count));
  tbb::parallel_for(0, count, [&](int n) {
    const int top = n * kStripRows - kReach;
    strips[static_cast<std::size_t>(n)] =
        StripTaker(tracer, looks, rays).take(top, std::min(top + kStripRows, height + kReach));
  });
  std::vector<Sum> filtered(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
      boxed = filtered;
  for (const Strip& strip : strips) {
    for (std::size_t i = 0; i < strip.filtered.size(); ++i) {
      const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(i) + std::ptrdiff_t{strip.top} * width;
      if (at < 0 || at >= std::ptrdiff_t{height} * width) continue;
      for (std::size_t c = 0; c < 5; ++c) {
        filtered[static_cast<std::size_t>(at)][c] += strip.filtered[i][c];
        boxed[static_cast<std::size_t>(at)][c] += strip.boxed[i][c];
      }
    }
  }
  return {mean_of(filtered, width, height), mean_of(boxed, width, height)};
}

}  // namespace lensplane
