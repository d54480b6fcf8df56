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

/// `way`, which is a place on the stretch, brought within its ends: they bound it as numbers, without
/// derivatives.
template <class Number>
Number within(const RaySegment<Number>& stretch, const Number& way) {
  return way + Number(std::clamp(value_of(way), 0.0, value_of(stretch.length)) - value_of(way));
}

/// Where a stretch goes through the plane.
template <class Number>
StretchHit<Number> cross_straight(const Disc& disc, const RaySegment<Number>& stretch) {
  const Number way = within(stretch, way_to_plane(disc, stretch.start, stretch.direction));
  return {stretch.start + stretch.direction * way, value_of(stretch.direction), value_of(way)};
}

/// The same beside the masses: where the light would be at the plane it is shifted; from there it is a little
/// way to the plane, where the shift is another, and again a much smaller one.
template <class Number>
StretchHit<Number> cross_shifted(const Disc& disc, const RaySegment<Number>& stretch,
                                 const Deflectors& finite) {
  const auto light_at = [&](const Number& way) {
    return stretch.start + stretch.direction * way + finite_shift(finite, stretch, way);
  };
  Number way = within(stretch, way_to_plane(disc, stretch.start, stretch.direction));
  way = within(stretch, way + way_to_plane(disc, light_at(way), stretch.direction));
  const Vector<Number> near = light_at(way);
  const Number rest = way_to_plane(disc, near, stretch.direction);
  return {near + stretch.direction * rest, shifted(finite, values_of(stretch), value_of(way)).direction,
          value_of(way) + value_of(rest)};
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
  const auto crossing = finite ? cross_shifted(disc, stretch, *finite) : cross_straight(disc, stretch);
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
