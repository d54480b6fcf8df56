// SPDX-License-Identifier: Apache-2.0

#include "src/image_rays.h"

#include <algorithm>
#include <cmath>

#include "src/constants.h"

namespace lensplane {
namespace {

/// Annuli narrower than this everywhere, in pixels, are followed along rings that are this wide.
constexpr double kNarrow = 1.0, kRingWidth = 0.15;

/// Pixels between the rays of a ring, and between chords; each ring or image has so many at least.
constexpr double kAlongRing = 0.125, kBetweenChords = 1.0 / 16.0, kAlongChord = 0.25;
constexpr int kLeastOfRing = 16, kLeastChords = 8, kMostChords = 16, kLeastOfChord = 2;

const double kEvenSpread = 1.0 / std::sqrt(12.0);  // standard deviation of an even distribution of width 1

int pieces(double length, double longest, int least) {
  return std::max(least, static_cast<int>(std::ceil(std::min(length / longest, 1e4))));
}

/// The rays of one circle round the origin of the image's plane, as an ellipse on the film.
class Ellipse {
 public:
  Ellipse(const BodyImage& image, double radius) {
    const FilmJacobian& j = image.by_film;
    const FilmPosition by_u = film_shift(j, radius, 0.0), by_v = film_shift(j, 0.0, radius);
    const FilmPosition back = film_shift(j, -image.u, -image.v);
    centre_ = {image.at.x + back.x, image.at.y + back.y};
    x_ = {by_u.x, by_v.x}, y_ = {by_u.y, by_v.y};
  }

  FilmPosition at(double angle) const {
    const double c = std::cos(angle), s = std::sin(angle);
    return {centre_.x + x_.cosine * c + x_.sine * s, centre_.y + y_.cosine * c + y_.sine * s};
  }

  double length(double from, double to) const {
    const double c = std::cos((from + to) / 2), s = std::sin((from + to) / 2);
    return (to - from) * std::hypot(x_.sine * c - x_.cosine * s, y_.sine * c - y_.cosine * s);
  }

  /// Where it is within the square: pairs of angles, from and to.
  std::vector<std::pair<double, double>> within(const FilmSquare& square) const {
    std::vector<double> cuts;
    for (const double side : {0.0, square.size}) {
      add_cuts(x_, square.corner.x + side - centre_.x, cuts);
      add_cuts(y_, square.corner.y + side - centre_.y, cuts);
    }
    std::sort(cuts.begin(), cuts.end());
    if (cuts.empty()) cuts.push_back(0.0);
    cuts.push_back(cuts.front() + 2.0 * kPi);
    std::vector<std::pair<double, double>> parts;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      if (square.holds(at((cuts[i] + cuts[i + 1]) / 2))) parts.emplace_back(cuts[i], cuts[i + 1]);
    }
    return parts;
  }

 private:
  struct Wave {
    double cosine, sine;
  };

  static void add_cuts(const Wave& wave, double value, std::vector<double>& cuts) {
    const double size = std::hypot(wave.cosine, wave.sine);
    if (!(std::abs(value) < size)) return;
    const double middle = std::atan2(wave.sine, wave.cosine), off = std::acos(value / size);
    for (const double cut : {middle - off, middle + off}) {
      cuts.push_back(cut - 2.0 * kPi * std::floor(cut / (2.0 * kPi)));
    }
  }

  FilmPosition centre_;
  Wave x_, y_;
};

std::vector<ImageRay> along_rings(const BodyImage& image, double width, const FilmSquare& square) {
  const int rings = pieces(width, kRingWidth, 1);
  const double step = (image.outer * image.outer - image.inner * image.inner) / rings;  // equal areas
  const double per_radian = step / 2 / std::abs(image.by_film.determinant());
  std::vector<ImageRay> rays;
  for (int ring = 0; ring < rings; ++ring) {
    const Ellipse ellipse(image, std::sqrt(image.inner * image.inner + (ring + 0.5) * step));
    for (const auto& [from, to] : ellipse.within(square)) {
      const double length = ellipse.length(from, to), turn = (to - from) / (2.0 * kPi);
      const int count = pieces(length, kAlongRing, 1 + static_cast<int>(turn * kLeastOfRing));
      const double each = (to - from) / count;
      for (int n = 0; n < count; ++n) {
        rays.push_back({ellipse.at(from + (n + 0.5) * each), each * per_radian,
                        kEvenSpread * std::max(length / count, width / rings)});
      }
    }
  }
  return rays;
}

/// Chords run along one direction of the film, `along`, and lie side by side in the other.
class Chords {
 public:
  /// `horizontal`: along x.
  Chords(const BodyImage& image, const FilmSquare& square, bool horizontal)
      : image_(image), horizontal_(horizontal) {
    const FilmJacobian& j = image.by_film;
    const double x = square.corner.x - image.at.x, y = square.corner.y - image.at.y;
    along_u_ = horizontal ? j.u_x : j.u_y, along_v_ = horizontal ? j.v_x : j.v_y;
    beside_u_ = horizontal ? j.u_y : j.u_x, beside_v_ = horizontal ? j.v_y : j.v_x;
    first_ = horizontal ? x : y, last_ = first_ + square.size;
    top_ = horizontal ? y : x, bottom_ = top_ + square.size;
  }

  void add_rays(std::vector<ImageRay>& rays) const {
    const double size = std::hypot(along_u_, along_v_);
    const double by_step = along_u_ * beside_v_ - along_v_ * beside_u_;
    if (by_step == 0.0 || size == 0.0) return;
    // On the chord number b the line passes the origin at (k0 + by_step b)/size.
    const double middle = -(along_u_ * image_.v - along_v_ * image_.u) / by_step;
    const double half = image_.outer * size / std::abs(by_step);
    const double from = std::asin(std::clamp((top_ - middle) / half, -1.0, 1.0)),
                 to = std::asin(std::clamp((bottom_ - middle) / half, -1.0, 1.0));
    if (!(to > from)) return;
    const double range = half * (std::sin(to) - std::sin(from));
    const int count = std::min(pieces(range, kBetweenChords, kLeastChords), kMostChords);
    const double each = (to - from) / count;
    for (int n = 0; n < count; ++n) {
      const double angle = from + (n + 0.5) * each;
      add_chord(middle + half * std::sin(angle), half * std::cos(angle) * each, rays);
    }
  }

 private:
  /// Where the chord at `beside` is within a circle; to <= from where it is not.
  struct Part {
    double from, to;
  };
  Part within(double beside, double radius) const {
    const double u = image_.u + beside_u_ * beside, v = image_.v + beside_v_ * beside;
    const double a = along_u_ * along_u_ + along_v_ * along_v_, b = along_u_ * u + along_v_ * v;
    const double cross = along_u_ * v - along_v_ * u, root2 = a * radius * radius - cross * cross;
    if (!(root2 > 0.0)) return {0, 0};
    return {(-b - std::sqrt(root2)) / a, (-b + std::sqrt(root2)) / a};
  }

  void add_chord(double beside, double width, std::vector<ImageRay>& rays) const {
    const Part all = within(beside, image_.outer), hole = within(beside, image_.inner);
    if (hole.to > hole.from) {
      add_part(beside, width, {all.from, hole.from}, rays);
      add_part(beside, width, {hole.to, all.to}, rays);
    } else {
      add_part(beside, width, all, rays);
    }
  }

  void add_part(double beside, double width, Part part, std::vector<ImageRay>& rays) const {
    part = {std::max(part.from, first_), std::min(part.to, last_)};
    const double length = part.to - part.from;
    if (!(length > 0.0)) return;
    const int count = pieces(length, kAlongChord, kLeastOfChord);
    for (int n = 0; n < count; ++n) {
      const double along = part.from + (n + 0.5) * length / count;
      const FilmPosition at = image_.at;
      const FilmPosition film =
          horizontal_ ? FilmPosition{at.x + along, at.y + beside} : FilmPosition{at.x + beside, at.y + along};
      rays.push_back({film, width * length / count, kEvenSpread * std::max(width, length / count)});
    }
  }

  const BodyImage& image_;
  bool horizontal_;
  double along_u_, along_v_, beside_u_, beside_v_;  // metres per pixel
  double first_, last_, top_, bottom_;              // the square's sides, pixels from image_.at
};

/// Are chords along x shorter than along y?
bool are_horizontal(const BodyImage& image, const Stretching& stretching) {
  const FilmJacobian& j = image.by_film;
  double x = stretching.x, y = stretching.y;
  if (image.inner > 0.0 && stretching.most < 1.5 * stretching.least) {  // across the annulus
    x = j.u_x * image.u + j.v_x * image.v;
    y = j.u_y * image.u + j.v_y * image.v;
  }
  return std::abs(x) > std::abs(y);
}

}  // namespace

std::vector<ImageRay> rays_over(const BodyImage& image, const FilmSquare& square) {
  std::vector<ImageRay> rays;
  const Stretching stretching = stretching_of(image.by_film);
  if (!(stretching.least > 0.0)) return rays;
  const double width = (image.outer - image.inner) / stretching.least;
  if (image.inner > 0.0 && width < kNarrow) return along_rings(image, width, square);
  Chords(image, square, are_horizontal(image, stretching)).add_rays(rays);
  return rays;
}

}  // namespace lensplane
