// SPDX-License-Identifier: Apache-2.0

#include "src/disc.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/finite_shift.h"

namespace lensplane {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Disc facing_camera(Disc disc) {
  if (disc.normal.dot(disc.centre) > 0.0) disc.normal = -disc.normal;
  return disc;
}

RaySegment<double> values_of(const RaySegment<double>& stretch) {
  return stretch;
}
RaySegment<double> values_of(const RaySegment<Dual>& stretch) {
  return {value_of(stretch.start), value_of(stretch.direction), value_of(stretch.length), stretch.bends};
}

/// The side on which a stretch ends; far away that towards which it runs. One that runs backwards, between
/// planes whose masses lie the other way round along the ray, is none of the light's way.
std::int8_t last_side(const Disc& disc, const RaySegment<double>& stretch, const Deflectors* finite,
                      std::int8_t first) {
  if (!(stretch.length < kInfinity)) {
    const double rate = disc.normal.dot(stretch.direction);
    return rate == 0.0 ? first : static_cast<std::int8_t>(rate > 0.0 ? 1 : -1);
  }
  if (!(stretch.length > 0.0)) return first;
  Vec3 end = stretch.start + stretch.direction * stretch.length;
  if (finite) end += finite_shift(*finite, stretch, stretch.length);
  return side_at(disc, height_over(disc, end));
}

/// Metres along the ray from `point` to the plane.
template <class Number>
Number way_to_plane(const Disc& disc, const Vector<Number>& point, const Vector<Number>& direction) {
  return -height_over(disc, point) / constant<Number>(disc.normal).dot(direction);
}

/// `way`, which is a place on a stretch of this length, brought within its ends: they bound it as numbers,
/// without derivatives.
template <class Number>
Number within(double length, const Number& way) {
  return way + Number(std::clamp(value_of(way), 0.0, length) - value_of(way));
}

/// Where a stretch goes through the plane.
template <class Number>
StretchHit<Number> cross_straight(const Disc& disc, const RaySegment<Number>& stretch) {
  const Number way = within(value_of(stretch.length), way_to_plane(disc, stretch.start, stretch.direction));
  return {stretch.start + stretch.direction * way, value_of(stretch.direction), value_of(way)};
}

/// A place of the light on a stretch.
struct LightPlace {
  double way;     // metres from the stretch's start
  Vec3 point;     // metres
  double height;  // over the disc's plane, metres
};

/// Light beside the masses, by its way along a stretch.
struct ShiftedLight {
  const Disc& disc;
  const RaySegment<double>& stretch;
  const Deflectors& finite;

  double rate() const { return disc.normal.dot(stretch.direction); }
  LightPlace at(double way) const {
    const Vec3 point = stretch.start + stretch.direction * way + finite_shift(finite, stretch, way);
    return {way, point, height_over(disc, point)};
  }
  bool is_at(std::int8_t side, const LightPlace& place) const { return side_at(disc, place.height) == side; }

  /// How fast it moves.
  Vec3 velocity(double way) const {
    const RaySegment<Dual> fixed{constant<Dual>(stretch.start), constant<Dual>(stretch.direction),
                                 Dual(stretch.length), stretch.bends};
    return stretch.direction + derivative_by_x(finite_shift(finite, fixed, Dual(way, 1.0, 0.0)));
  }
};

constexpr int kMaxTries = 60;

/// A place by which the light has come to `side`. The straight stretch is there in the end.
LightPlace place_beyond(const ShiftedLight& light, double height_at_start, std::int8_t side) {
  if (light.stretch.length < kInfinity) return light.at(light.stretch.length);
  LightPlace place =
      light.at(std::max(std::abs(height_at_start), light.disc.tolerance) / std::abs(light.rate()));
  for (int tries = 0; tries < kMaxTries && !light.is_at(side, place); ++tries)
    place = light.at(2.0 * place.way);
  return place;
}

/// Has the light reached the plane? Then it is led on to it, if that is still on the stretch.
bool reach_plane(const ShiftedLight& light, LightPlace& place) {
  if (!(std::abs(place.height) <= light.disc.tolerance)) return false;
  const double step = within(light.stretch.length, place.way - place.height / light.rate()) - place.way;
  place = {place.way + step, place.point + light.stretch.direction * step,
           place.height + light.rate() * step};
  return true;
}

/// The zero of the height on the line through two places, metres along the stretch.
double secant(const LightPlace& a, const LightPlace& b) {
  return b.way - b.height * ((b.way - a.way) / (b.height - a.height));
}

/// Where the light comes to `side` of the disc: on the plane, or at an end of the stretch. By the secant's
/// zero, for which an end that stays counts half each time (the Illinois rule).
LightPlace find_within(const ShiftedLight& light, std::int8_t side) {
  LightPlace low = light.at(0.0);
  if (light.is_at(side, low)) return low;
  LightPlace high = place_beyond(light, low.height, side);
  int stayed = 0;  // 1: the low end moved last, -1: the high one
  for (int tries = 0; tries < kMaxTries; ++tries) {
    const double way = secant(low, high);
    if (!(way > low.way && way < high.way)) break;
    LightPlace place = light.at(way);
    if (reach_plane(light, place)) return place;
    if (light.is_at(side, place)) {
      high = place;
      if (stayed == -1) low.height *= 0.5;
      stayed = -1;
    } else {
      low = place;
      if (stayed == 1) high.height *= 0.5;
      stayed = 1;
    }
  }
  return light.at(high.way);
}

/// The same, first from where the stretch itself crosses the plane: from where the light is then it is a
/// little way to the plane.
LightPlace find_crossing(const ShiftedLight& light, std::int8_t side) {
  const auto on_stretch = [&](double way) { return way >= 0.0 && way <= light.stretch.length; };
  const double straight = way_to_plane(light.disc, light.stretch.start, light.stretch.direction);
  if (!on_stretch(straight)) return find_within(light, side);
  LightPlace before = light.at(straight);
  double way = straight - before.height / light.rate();
  for (int tries = 0; tries < 4 && on_stretch(way); ++tries) {
    LightPlace place = light.at(way);
    if (reach_plane(light, place)) return place;
    way = secant(before, place);
    before = place;
  }
  return find_within(light, side);
}

/// A place with the derivatives of where the ray meets the plane, or of the light there where it does not.
Vec3 with_derivatives(const ShiftedLight&, const RaySegment<double>&, const LightPlace& place) {
  return place.point;
}
DualVec3 with_derivatives(const ShiftedLight& light, const RaySegment<Dual>& stretch,
                          const LightPlace& place) {
  DualVec3 point = stretch.start + stretch.direction * Dual(place.way) +
                   finite_shift(light.finite, stretch, Dual(place.way));
  point += constant<Dual>(place.point - value_of(point));
  const Vec3 velocity = light.velocity(place.way);
  const double slope = light.disc.normal.dot(velocity);
  if (slope == 0.0 || !(std::abs(place.height) <= light.disc.tolerance)) return point;
  const Dual height = height_over(light.disc, point);
  return point + constant<Dual>(velocity) * Dual(0.0, -height.dx / slope, -height.dy / slope);
}

/// Where the light beside a stretch comes to `side` of the disc; where it is there as the stretch begins, or
/// only as it ends, there.
template <class Number>
StretchHit<Number> cross_shifted(const Disc& disc, const RaySegment<Number>& stretch,
                                 const Deflectors& finite, std::int8_t side) {
  const RaySegment<double> seen = values_of(stretch);
  const ShiftedLight light{disc, seen, finite};
  const LightPlace place = find_crossing(light, side);
  const Vec3 start = seen.start + finite_shift(finite, seen, 0.0);
  return {with_derivatives(light, stretch, place), straight_between(start, place.point, seen).direction,
          place.way};
}

}  // namespace

std::optional<Disc> disc_of(const Surface& surface) {
  if (const auto* ring = std::get_if<Ring>(&surface)) {
    return facing_camera(
        {ring->centre, ring->axes.y, ring->inner, ring->outer, ring->crossing, kDiscTolerance * ring->outer});
  }
  if (const auto* card = std::get_if<Card>(&surface)) {
    return Disc{{0, 0, -card->distance},    {0, 0, 1},      0.0,
                kCardSize * card->distance, card->crossing, kDiscTolerance * card->distance};
  }
  return std::nullopt;
}

template <class Number>
Number height_over(const Disc& disc, const Vector<Number>& point) {
  return constant<Number>(disc.normal).dot(point - constant<Number>(disc.centre));
}

bool lies_on(const Disc& disc, const Vec3& point) {
  const Vec3 q = point - disc.centre;
  const double radius = length(q - disc.normal * q.dot(disc.normal));
  return radius >= disc.inner && radius <= disc.outer;
}

double gap_to(const Disc& disc, const Vec3& point) {
  const Vec3 q = point - disc.centre;
  const double height = q.dot(disc.normal);
  const double radius = length(q - disc.normal * height);
  return std::hypot(height, std::max({0.0, disc.inner - radius, radius - disc.outer}));
}

std::int8_t side_at(const Disc& disc, double height) {
  return height > disc.tolerance ? 1 : -1;
}

std::int8_t first_side(const Disc& disc, const Vec3& start, const Vec3& direction) {
  const double height = height_over(disc, start);
  if (std::abs(height) > disc.tolerance) return side_at(disc, height);
  return disc.normal.dot(direction) > 0.0 ? 1 : -1;
}

bool count_crossing(const Disc& disc, const Vec3& point, DiscPassage& passage) {
  return lies_on(disc, point) && passage.crossings++ == disc.crossing;
}

template <class Number>
std::optional<StretchHit<Number>> meet_disc(const Disc& disc, const RaySegment<Number>& stretch,
                                            const Deflectors* finite, DiscPassage& passage) {
  const RaySegment<double> seen = values_of(stretch);
  if (passage.side == 0) passage.side = first_side(disc, seen.start, seen.direction);
  const std::int8_t side = last_side(disc, seen, finite, passage.side);
  if (side == passage.side) return std::nullopt;
  passage.side = side;
  const auto crossing = finite ? cross_shifted(disc, stretch, *finite, side) : cross_straight(disc, stretch);
  if (!count_crossing(disc, value_of(crossing.point), passage)) return std::nullopt;
  return crossing;
}

template double height_over(const Disc&, const Vec3&);
template Dual height_over(const Disc&, const DualVec3&);
template std::optional<StretchHit<double>> meet_disc(const Disc&, const RaySegment<double>&,
                                                     const Deflectors*, DiscPassage&);
template std::optional<StretchHit<Dual>> meet_disc(const Disc&, const RaySegment<Dual>&, const Deflectors*,
                                                   DiscPassage&);

}  // namespace lensplane
