// SPDX-License-Identifier: Apache-2.0

#include "src/thin_coverage.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace lensplane {
namespace {

/// Rays count for pixels whose centres are nearer than this along either axis, in pixels.
constexpr int kReach = 2;

/// Rays that meet a thin body this near to where its image is expected, in pixels, are on the image.
constexpr double kImageSlack = 0.1;

std::int64_t pixel_of(FilmPosition film) {
  const auto column = static_cast<std::int64_t>(std::floor(film.x));
  const auto row = static_cast<std::int64_t>(std::floor(film.y));
  return row * (std::int64_t{1} << 32) + column;
}

/// A ray over a thin image.
struct ThinRay {
  std::size_t surface;
  FilmPosition film;
  double area;  // square pixels
  bool hit = false;
  TexturePoint<double> st{0, 0};
};

std::vector<ThinRay> rays_of(const std::vector<ThinImage>& images) {
  std::vector<ThinRay> rays;
  for (const ThinImage& thin : images) {
    for (const ImageRay& ray : rays_over(thin.image, thin.square))
      rays.push_back({thin.surface, ray.film, ray.area});
  }
  return rays;
}

void trace(const Tracer& tracer, std::vector<ThinRay>& rays) {
  const Tracer plain = tracer.without_passes();
  const std::size_t batches = (rays.size() + kBatchSize - 1) / kBatchSize;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, batches), [&](const auto& range) {
    TraceBatch batch = plain.make_batch();
    for (std::size_t b = range.begin(); b != range.end(); ++b) {
      const std::size_t first = b * kBatchSize,
                        count = std::min<std::size_t>(kBatchSize, rays.size() - first);
      for (std::size_t i = 0; i < kBatchSize; ++i) {
        const FilmPosition& film = rays[first + std::min(i, count - 1)].film;
        batch.x[i] = film.x, batch.y[i] = film.y;
      }
      plain.trace(batch);
      for (std::size_t i = 0; i < count; ++i) {
        ThinRay& ray = rays[first + i];
        const SurfaceBatch& surface = batch.surfaces[ray.surface];
        ray.hit = surface.outcome[i] == Outcome::Hit;
        ray.st = {surface.s[i], surface.t[i]};
      }
    }
  });
}

/// The pixel filter's weights of 2 kReach pixels side by side for light that lies `share` of the way from the
/// centre number kReach - 1 to the next.
std::vector<double> weights(double share, double sigma) {
  std::vector<double> result;
  double sum = 0;
  for (int i = 0; i < 2 * kReach; ++i) {
    const double off = i - (kReach - 1) - share;
    result.push_back(std::exp(-off * off / (2 * sigma * sigma)));
    sum += result.back();
  }
  for (double& weight : result) weight /= sum;
  return result;
}

}  // namespace

ThinCoverage::ThinCoverage(const Tracer& tracer, double sigma) {
  const Tracer exact = exact_enough_for_thin(tracer);
  images_ = find_thin_images(exact, kReach);
  if (images_.empty()) return;
  for (std::size_t i = 0; i < images_.size(); ++i)
    in_pixel_[pixel_of(images_[i].square.centre())].push_back(i);
  std::vector<ThinRay> rays = rays_of(images_);
  trace(exact, rays);
  rays_ = static_cast<std::int64_t>(rays.size());

  const Camera& camera = tracer.camera();
  std::map<std::tuple<int, int, std::size_t>, ThinShare> shares;
  std::map<std::tuple<int, int, std::size_t>, double> most;
  for (const ThinRay& ray : rays) {
    if (!ray.hit) continue;
    const double x = ray.film.x + camera.overscan - 0.5, y = ray.film.y + camera.overscan - 0.5;
    const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
    const std::vector<double> across = weights(x - left, sigma), down = weights(y - top, sigma);
    for (int j = 0; j < 2 * kReach; ++j) {
      for (int i = 0; i < 2 * kReach; ++i) {
        const int row = top + j - kReach + 1, column = left + i - kReach + 1;
        if (row < 0 || row >= camera.full_height() || column < 0 || column >= camera.full_width()) continue;
        const double share =
            ray.area * across[static_cast<std::size_t>(i)] * down[static_cast<std::size_t>(j)];
        const std::tuple key{row, column, ray.surface};
        ThinShare& sum = shares[key];
        sum.share += share;
        if (share > most[key]) {
          most[key] = share;
          sum = {{row, column}, ray.surface, sum.share, ray.film, ray.st};
        }
      }
    }
  }
  for (const auto& entry : shares) shares_.push_back(entry.second);
}

bool ThinCoverage::holds(FilmPosition film, std::size_t surface) const {
  const auto found = in_pixel_.find(pixel_of(film));
  if (found == in_pixel_.end()) return false;
  return std::any_of(found->second.begin(), found->second.end(), [&](std::size_t i) {
    return images_[i].surface == surface && images_[i].square.holds(film) &&
           images_[i].image.holds(film, kImageSlack);
  });
}

}  // namespace lensplane
