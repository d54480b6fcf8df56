// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/ring_shadow.h"

#include <cmath>

#include "pipeline/composite/normal_distribution.h"
#include "pipeline/composite/sun_disc.h"
#include "src/constants.h"

namespace lensplane {
namespace {

/// How a point of the ring moves on it, in its own axes, when s and t change by so much.
Vec3 moved(const Ring& ring, TextureCoordinates st, double ds, double dt) {
  const double wide = ring.outer - ring.inner, radius = ring.inner + st.s * wide;
  const double angle = (st.t - 0.5) * 2.0 * kPi, turn = 2.0 * kPi * dt;
  const Vec3 outward(std::sin(angle), 0.0, std::cos(angle)), onward(std::cos(angle), 0.0, -std::sin(angle));
  return outward * (wide * ds) + onward * (radius * turn);
}

/// What a ball leaves of a disc of light to a point that lies `off` the axis of its shadow, and `behind` it.
double free_of_ball(double radius, double sun, double off, double behind) {
  const double distance = std::hypot(off, behind);
  if (distance <= radius) return 0.0;
  return free_share(sun, std::asin(radius / distance), std::atan2(off, behind));
}

/// The same over what is seen at once: `width` is its standard deviation across the shadow.
double mean_free_of_ball(double radius, double sun, double off, double behind, double width) {
  constexpr int kPlaces = 16;
  if (!(width > 0.0)) return free_of_ball(radius, sun, off, behind);
  double sum = 0;
  for (int i = 0; i < kPlaces; ++i) {
    const double place = off + width * normal_quantile((i + 0.5) / kPlaces);
    sum += free_of_ball(radius, sun, std::abs(place), behind) / kPlaces;
  }
  return sum;
}

}  // namespace

double light_share(const Ring& ring, const ShadowCaster& caster, const Vec3& light, double sun,
                   TextureCoordinates st, const Footprint& footprint) {
  const Vec3 point = ring.axes.local_from_parent(ring_point_from_st(ring, st) - ring.centre);
  const Vec3 from_centre = point - caster.centre;
  const double towards = from_centre.dot(light);
  if (sun == 0.0 && towards >= 0.0) return 1.0;  // between the caster and the light
  const Vec3 from_axis = from_centre - light * towards;
  const double off = from_axis.length();
  // Metres away from the axis that are seen at once, as a standard deviation.
  const double x = from_axis.dot(moved(ring, st, footprint.ds_dx, footprint.dt_dx));
  const double y = from_axis.dot(moved(ring, st, footprint.ds_dy, footprint.dt_dy));
  const double width = off > 0.0 ? kPixelSigma * footprint.scale * std::hypot(x, y) / off : 0.0;
  if (sun > 0.0) return mean_free_of_ball(caster.radius, sun, off, -towards, width);
  if (!(width > 0.0)) return off < caster.radius ? 0.0 : 1.0;
  // Both edges: the shadow may be narrower than a pixel.
  return normal_share((off - caster.radius) / width) + normal_share((-caster.radius - off) / width);
}

}  // namespace lensplane
