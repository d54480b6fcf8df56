// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/polar_dot.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "src/constants.h"

namespace lensplane {
namespace {

constexpr double kReach = 4.5;  // standard deviations
constexpr int kPoints = 4;      // of a pixel along each axis, fewer across where it is narrow on the sky

/// A place on the sky by its latitude, and the longitude from a star's.
struct Latitude {
  double sine, cosine;
  explicit Latitude(double radians) : sine(std::sin(radians)), cosine(std::cos(radians)) {}
};

class PolarDot {
 public:
  PolarDot(const StarImage& image, const Camera& camera, const SkySpread& sky)
      : image_(image), camera_(camera), sky_(sky), star_(latitude_of(image.film.y)) {
    const double peak = sky.pixel / (2 * kPi * sky.sigma * sky.sigma);
    for (std::size_t c = 0; c < 3; ++c) peak_[c] = peak * image.light[c];
  }

  /// Whether any of a row of the film is near enough.
  bool reaches(int row) const {
    const double middle = asin_of(row + 0.5);
    return std::abs(middle - std::asin(star_.sine)) < kReach * sky_.sigma + kPi / camera_.height;
  }

  void draw_row(int row, Picture& picture) const {
    const Row points = points_of(row);
    const double half = half_width(row), width = camera_.width;
    // Where the star's longitude is in this row: rows beyond a pole look half a turn round.
    const double over = std::cos(latitude_of(row + 0.5)) < 0 ? 0.5 * width : 0;
    double middle = image_.film.x + over;
    middle -= std::ceil((middle + half - picture.x) / width - 1) * width;
    int next = picture.x;  // no pixel twice
    for (; middle - half < picture.x + picture.width; middle += width) {
      const int first = std::max(next, static_cast<int>(std::floor(middle - half)));
      const int end = std::min(picture.x + picture.width, static_cast<int>(std::floor(middle + half)) + 1);
      for (int column = first; column < end; ++column) {
        Rgba& pixel = picture.at(column - picture.x, row - picture.y);
        const double share = share_at(points, column - middle);
        for (std::size_t c = 0; c < 3; ++c) pixel[c] += static_cast<float>(share * peak_[c]);
      }
      next = std::max(next, end);
    }
  }

 private:
  double latitude_of(double y) const { return (0.5 - y / camera_.height) * kPi; }
  double asin_of(double y) const { return std::asin(std::clamp(std::sin(latitude_of(y)), -1.0, 1.0)); }

  /// How many columns on either side of the star's the dot may reach to in a row.
  double half_width(int row) const {
    const double reach = kReach * sky_.sigma;
    const double row_cosine = std::abs(std::cos(latitude_of(row + 0.5)));
    const double least = std::min(star_.cosine, row_cosine) - kPi / camera_.height;  // of the nearest circle
    const double all = 0.5 * camera_.width;
    if (least <= std::sin(reach)) return all;
    return std::min(all, std::asin(std::sin(reach) / least) / (2 * kPi) * camera_.width + 1);
  }

  /// Where a row's pixels are looked at.
  struct Row {
    std::vector<Latitude> down;
    double cosines;  // their sum: what the points are worth on the sky
    int across;
  };
  Row points_of(int row) const {
    Row points{};
    for (int j = 0; j < kPoints; ++j) points.down.emplace_back(asin_of(row + (j + 0.5) / kPoints));
    for (const Latitude& here : points.down) points.cosines += here.cosine;
    const double narrow = std::abs(std::cos(latitude_of(row + 0.5)));
    points.across = std::clamp(static_cast<int>(std::ceil(kPoints * narrow)), 1, kPoints);
    return points;
  }

  /// The Gaussian's mean over the piece of sky of a pixel that begins so many columns east of the star.
  double share_at(const Row& points, double columns) const {
    double sum = 0;
    for (int i = 0; i < points.across; ++i) {
      const double east = (columns + (i + 0.5) / points.across) / camera_.width * 2 * kPi;
      const double turn = std::sin(east / 2);
      for (const Latitude& here : points.down) {
        // The square of the chord, without cancellation.
        const double up = here.sine - star_.sine, out = here.cosine - star_.cosine;
        const double chord2 = up * up + out * out + 4 * here.cosine * star_.cosine * turn * turn;
        sum += here.cosine * std::exp(-chord2 / (2 * sky_.sigma * sky_.sigma));
      }
    }
    return sum / (points.across * points.cosines);
  }

  const StarImage& image_;
  const Camera& camera_;
  SkySpread sky_;
  Latitude star_;
  Rgb peak_{0, 0, 0};
};

}  // namespace

void draw_polar_dot(const StarImage& image, const Camera& camera, const SkySpread& sky, int top, int bottom,
                    Picture& picture) {
  const PolarDot dot(image, camera, sky);
  for (int row = top; row < bottom; ++row) {
    if (dot.reaches(picture.y + row)) dot.draw_row(picture.y + row, picture);
  }
}

}  // namespace lensplane
