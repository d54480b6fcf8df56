// SPDX-License-Identifier: Apache-2.0
//
// Where rays meet surfaces, and which texture coordinates (s, t) that is.
//
// A numerical outcome is a value: a ray that meets nothing, or ends in a mass, has an Outcome, never a NaN.

#pragma once

#include <cstdint>

#include "src/march.h"
#include "src/projection.h"

namespace lensplane {

enum class Outcome : std::uint8_t {
  Hit,       // (s, t) says where
  Missed,    // the ray goes past the surface
  Behind,    // the ray runs where a plate has no picture: sideways or away from it
  Captured,  // the ray ended in a mass before it met the surface
};

struct TextureCoordinates {
  double s, t;
};

/// What a ray meets on one surface.
struct SurfaceHit {
  Outcome outcome = Outcome::Missed;
  TextureCoordinates st{0, 0};
  double distance = 0;  // metres along the bent ray; infinite for plates and skies
};

/// A ray that starts this share of the radius inside a ball still enters it: so a ball that reaches through a
/// lens plane has no seam there.
inline constexpr double kSurfaceTolerance = 1e-9;

/// Plate coordinates beyond this, in frames, have no picture: the ray runs along the screen.
inline constexpr double kPlateLimit = 1e9;

/// Distance at which a ray (unit `direction`) enters the ball; infinite when it does not.
double sphere_entry(const Vec3& start, const Vec3& direction, const Vec3& centre, double radius);

/// Texture coordinates of a lat-long sky for a direction in the world (any length).
TextureCoordinates st_from_sky_direction(const Vec3& direction);

/// Unit vector in the world. Inverse of st_from_sky_direction.
Vec3 sky_direction_from_st(TextureCoordinates st);

/// Texture coordinates of a sphere for a normal in its own axes (any length).
TextureCoordinates st_from_sphere_normal(const Vec3& normal);

/// Unit normal in the sphere's own axes. Inverse of st_from_sphere_normal.
Vec3 sphere_normal_from_st(TextureCoordinates st);

/// What the path of a ray that left the camera through `film` meets on `surface` (sphere: first entry).
/// `surface` and `path` are in camera axes.
SurfaceHit meet(const Surface& surface, const Camera& camera, FilmPosition film, const RayPath& path);

/// `surface` moved from the world to camera axes.
Surface camera_from_world(const Camera& camera, const Surface& surface);

}  // namespace lensplane
