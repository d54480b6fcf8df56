// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/thin_bodies.h"

#include <algorithm>
#include <cmath>

#include "pipeline/composite/sample_pattern.h"

namespace lensplane {
namespace {

/// Rays that meet a thin body this near to where its image is expected, in pixels, are on the image.
constexpr double kImageSlack = 0.1;

double gaussian(double off) {
  return std::exp(-off * off / (2 * kPixelSigma * kPixelSigma));
}

}  // namespace

double pixel_weight(double off) {
  if (!(std::abs(off) < kThinReach)) return 0;
  double sum = 0;
  for (double at = off - std::floor(off) - kThinReach; at < kThinReach; at += 1) sum += gaussian(at);
  return gaussian(off) / sum;
}

ThinBodies::ThinBodies(const Tracer& tracer)
    : tracer_(exact_enough_for_thin(tracer)), images_(find_thin_images(*tracer_, kThinReach)) {
  if (images_.empty()) return;
  const Camera& camera = tracer.camera();
  left_ = top_ = -camera.overscan - kThinReach;
  width_ = camera.full_width() + 2 * kThinReach;
  height_ = camera.full_height() + 2 * kThinReach;
  const auto pixel_of = [&](const ThinImage& image) {
    const auto column = static_cast<int>(std::floor(image.square.corner.x)) - left_;
    const auto row = static_cast<int>(std::floor(image.square.corner.y)) - top_;
    return column < width_ && row < height_ ? row * width_ + column : -1;
  };
  std::erase_if(images_, [&](const ThinImage& image) { return pixel_of(image) < 0; });
  first_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) + 1, 0);
  for (const ThinImage& image : images_) ++first_[static_cast<std::size_t>(pixel_of(image)) + 1];
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
}

std::span<const ThinImage> ThinBodies::in_pixel(int column, int row) const {
  if (column < left_ || column >= left_ + width_ || row < top_ || row >= top_ + height_) return {};
  const auto at = static_cast<std::size_t>(row - top_) * static_cast<std::size_t>(width_) +
                  static_cast<std::size_t>(column - left_);
  return std::span(images_).subspan(first_[at], first_[at + 1] - first_[at]);
}

std::vector<ThinRay> ThinBodies::rays_around(double left, double top, int width, int height) const {
  std::vector<ThinRay> rays;
  if (empty()) return rays;
  const int first_column = static_cast<int>(left) - kThinReach,
            first_row = static_cast<int>(top) - kThinReach;
  for (int row = first_row; row < first_row + height + 2 * kThinReach; ++row) {
    for (int column = first_column; column < first_column + width + 2 * kThinReach; ++column) {
      for (const ThinImage& thin : in_pixel(column, row)) {
        const auto number = static_cast<std::size_t>(&thin - images_.data());
        for (const ImageRay& ray : rays_over(thin.image, thin.square)) {
          rays.push_back({ray.film, ray.area, std::min(kSampleScale, ray.spread / kPixelSigma), number});
        }
      }
    }
  }
  return rays;
}

double ThinBodies::coverage(FilmPosition centre, std::size_t surface) const {
  double sum = 0;
  for (const ThinRay& ray : rays_around(centre.x - 0.5, centre.y - 0.5, 1, 1)) {
    if (images_[ray.image].surface == surface)
      sum += ray.area * pixel_weight(ray.film.x - centre.x) * pixel_weight(ray.film.y - centre.y);
  }
  return std::min(sum, 1.0);
}

std::ptrdiff_t ThinBodies::image_of(FilmPosition film, std::span<const SeenPoint> points) const {
  if (empty()) return -1;
  const auto column = static_cast<int>(std::floor(film.x)), row = static_cast<int>(std::floor(film.y));
  for (const ThinImage& thin : in_pixel(column, row)) {
    if (points[thin.surface].hit && thin.square.holds(film) && thin.image.holds(film, kImageSlack))
      return &thin - images_.data();
  }
  return -1;
}

}  // namespace lensplane
