// SPDX-License-Identifier: Apache-2.0
//
// Where rays meet surfaces, which texture coordinates (s, t) that is, and what comes with it.
//
// A numerical outcome is a value: a ray that meets nothing, or ends in a mass, has an Outcome, never a NaN.
// Here is what lies at infinity; bodies.h has what stands nearer. Surfaces and rays are in camera axes.
// Templates over the number type are instantiated for `double` and for `Dual`; what needs derivatives
// (Jacobian, magnification) is there with `Dual` only.

#pragma once

#include <cstdint>

#include "src/deflectors.h"
#include "src/projection.h"
#include "src/ray_path.h"

namespace lensplane {

/// A vector of the frame that holds `axes`, in those axes.
template <class Number>
Vector<Number> local_from_parent(const Basis& axes, const Vector<Number>& v) {
  return {constant<Number>(axes.x).dot(v), constant<Number>(axes.y).dot(v), constant<Number>(axes.z).dot(v)};
}

enum class Outcome : std::uint8_t {
  Hit,         // (s, t) says where
  Missed,      // the ray goes past the surface, or meets it less often than is asked for
  Behind,      // the ray runs where a plate has no picture: sideways or away from it
  Captured,    // the ray ended in a mass before it met the surface
  Unseen,      // no ray: the film position lies outside a fisheye's circle
  Unresolved,  // the ray was given up before it met the surface: nobody knows what it would have met
};

template <class Number>
struct TexturePoint {
  Number s, t;
};
using TextureCoordinates = TexturePoint<double>;

/// What a ray meets on one surface.
template <class Number>
struct SurfaceHit {
  Outcome outcome = Outcome::Missed;
  TexturePoint<Number> st{Number(0.0), Number(0.0)};
  double distance = 0;       // metres along the bent ray; infinite for plates at infinity and skies
  double magnification = 0;  // see below; 0 where not computed
  double delay = 0;          // metres of light travel, arrival_time.h
  Vec3 direction{0};         // the ray's, after its last bend before the surface
  int bends = 0;             // planes that bent it until there
};

/// A ray that starts this share of the radius inside a ball still enters it: so a ball that reaches through a
/// lens plane has no seam there.
inline constexpr double kSurfaceTolerance = 1e-9;

/// Plate coordinates beyond this, in frames, have no picture: the ray runs along the screen.
inline constexpr double kPlateLimit = 1e9;

/// Magnifications are cut off here: on a critical curve there is no limit.
inline constexpr double kLargestMagnification = 1e30;

/// Texture coordinates of a lat-long sky for a direction in the world (any length).
template <class Number>
TexturePoint<Number> st_from_sky_direction(const Vector<Number>& direction);

/// Unit vector in the world. Inverse of st_from_sky_direction.
Vec3 sky_direction_from_st(TextureCoordinates st);

/// Texture coordinates of a sphere for a normal in its own axes (any length).
template <class Number>
TexturePoint<Number> st_from_sphere_normal(const Vector<Number>& normal);

/// Unit normal in the sphere's own axes. Inverse of st_from_sphere_normal.
Vec3 sphere_normal_from_st(TextureCoordinates st);

/// Texture coordinates of a ring for a point of its plane in its own axes, relative to its centre. At the
/// centre itself t is .5 and has no derivatives.
template <class Number>
TexturePoint<Number> st_from_ring_point(const Ring& ring, const Vector<Number>& point);

/// A point of the ring in the axes in which the ring is given, metres. Inverse of st_from_ring_point.
Vec3 ring_point_from_st(const Ring& ring, TextureCoordinates st);

/// Solid angle in which the camera sees a piece of sky over the solid angle of that piece, negative when it
/// is mirrored. `first` is the direction at the camera, `last` where the light comes from.
double magnification_at_infinity(const DualVec3& first, const DualVec3& last);

/// The same for a piece of a body at `point`, against its solid angle at the camera without lensing; negative
/// when the picture on the body (whose normal there is `normal`) appears mirrored. Of what is seen from both
/// sides that is against how the camera would see it: its normal is taken towards the camera.
double magnification_of_point(const DualVec3& first, const DualVec3& point, const Vec3& normal);

/// What a ray that left through `film` along `first` and comes from infinity along `last` meets there.
template <class Number>
SurfaceHit<Number> meet_plate(const Camera& camera, FilmPosition film, const Vector<Number>& first,
                              const Vector<Number>& last);
template <class Number>
SurfaceHit<Number> meet_sky(const Camera& camera, const Vector<Number>& first, const Vector<Number>& last);

/// Is it a plate whose light was bent already?
inline bool is_bent(const Surface& surface) {
  const auto* plate = std::get_if<Plate>(&surface);
  return plate && plate->bent;
}

/// What the path of a ray that left the camera through `film` meets on `surface`.
/// `finite` holds the masses when their finite distances count, otherwise null.
template <class Number>
SurfaceHit<Number> meet(const Surface& surface, const Camera& camera, FilmPosition film,
                        const RayPath<Number>& path, const Deflectors* finite = nullptr);

/// `surface` moved from the world to camera axes.
Surface camera_from_world(const Camera& camera, const Surface& surface);

}  // namespace lensplane
