// SPDX-License-Identifier: Apache-2.0
//
// Light where it passes by a body that it may miss: as a straight line that moves with the film position.
//
// What a ray meets says nothing of what lies beside it. From the line of the light near a body follows where
// on the film the body is seen, though no ray meets it; see body_image.h. Single rays, through the readable
// references: for the few film positions near bodies that are smaller than a pixel.

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "src/geodesic.h"
#include "src/tracer.h"

namespace lensplane {

/// The line on which light runs where it is nearest to a body, away from the camera, in camera axes, with
/// derivatives by the film position. Near the body it is right to second order in the body's size.
struct LightLine {
  DualVec3 start;      // a point of it, metres
  DualVec3 direction;  // unit vector
};

/// Light that passes this near to a mass, in geometric masses, is bent by so much that every body has images
/// without end there.
inline constexpr double kStrongField = 7.0;

/// The light of film positions on its way past the bodies of a tracer.
class PassingLight {
 public:
  PassingLight(const Tracer& tracer, std::span<const FilmPosition> films);

  /// Where the light of film position number `i` is nearest to the surface number `k`, a sphere or a ring.
  /// Nothing when it does not come that way, or for other surfaces.
  std::optional<LightLine> past(std::size_t i, std::size_t k) const;

  /// Radians at the camera between the light of film position number `i` and the nearest mass that bends it
  /// by more than `least` radians; infinite when none does. Within a small part of that angle the bends are
  /// all but linear.
  double clear_of_masses(std::size_t i, double least) const;

  /// By how many radians film position number `i` looks within kStrongField of a mass; negative outside.
  double deep_in_field(std::size_t i) const;

  bool is_captured(std::size_t i) const;

 private:
  /// The light of one film position: a path by the plane methods, or a curved ray.
  struct Way {
    bool curved;
    std::size_t number;  // among its like
  };

  void trace_curved(std::span<const FilmPosition> films);
  std::optional<LightLine> past_on_curve(const GeodesicRay<Dual>& ray, std::size_t k) const;

  const Tracer& tracer_;
  std::vector<PointMass> masses_;          // all that bend light
  std::vector<Vec3> first_;                // directions at the camera
  std::vector<Way> ways_;                  // of each film position
  std::vector<RayPath<Dual>> paths_;       // by the plane methods
  std::vector<const Deflectors*> finite_;  // of each path: the masses, where their finite distance counts
  std::vector<GeodesicRay<Dual>> curved_;  // the curved rays
  std::vector<std::size_t> first_disc_;    // of each surface, where there are curved rays
};

/// The point of a ring nearest to `point`.
Vec3 nearest_on_ring(const Ring& ring, const Vec3& point);

/// The point of a body nearest to a straight stretch of light from `start` along the unit vector `direction`,
/// and how far along the stretch, of that length, that is.
struct NearestPoint {
  Vec3 of_body;
  double way;
};
NearestPoint nearest_point(const Surface& body, const Vec3& start, const Vec3& direction, double length);

}  // namespace lensplane
