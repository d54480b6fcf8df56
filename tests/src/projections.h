// SPDX-License-Identifier: Apache-2.0
//
// Cameras of every projection, random positions on their films, and their definitions written down in 50
// digits: the reference for projection.h.

#pragma once

#include <algorithm>
#include <array>
#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "src/constants.h"
#include "src/projection.h"

namespace lensplane {

inline Camera camera_of(Projection projection, int width, int height, double fov_deg = 0) {
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.projection = projection;
  camera.fov_rad = fov_deg * kPi / 180.0;
  return camera;
}

/// Every projection, with fields of view from the narrowest to the widest.
inline std::vector<Camera> cameras_of_every_kind() {
  std::vector<Camera> cameras = {camera_of(Projection::LatLong, 2000, 1000),
                                 camera_of(Projection::LatLong, 777, 1081)};
  for (const double fov : {1e-9, 0.5, 45.0, 120.0, 179.9})
    cameras.push_back(camera_of(Projection::Perspective, 1920, 1080, fov));
  for (const double fov : {1e-9, 0.5, 90.0, 180.0, 270.0, 360.0})
    cameras.push_back(camera_of(Projection::Fisheye, 1920, 1081, fov));
  return cameras;
}

/// A position in the frame where the camera sees, not within half a pixel of a pole or of straight backwards.
inline FilmPosition random_position(const Camera& camera, std::mt19937& random) {
  std::uniform_real_distribution<double> share(0, 1);
  if (camera.projection == Projection::Fisheye) {
    const double radius = (std::min(camera.width, camera.height) / 2.0 - 0.5) * share(random);
    const double angle = 2 * kPi * share(random);
    return {camera.width / 2.0 + radius * std::cos(angle), camera.height / 2.0 + radius * std::sin(angle)};
  }
  return {camera.width * share(random), 0.5 + (camera.height - 1) * share(random)};
}

using Real = boost::multiprecision::cpp_bin_float_50;
using RealVec3 = std::array<Real, 3>;
using RealFilm = std::array<Real, 2>;  // x, y

inline RealVec3 reference_direction(const Camera& camera, const RealFilm& film) {
  const Real pi = boost::math::constants::pi<Real>(), fov = camera.fov_rad;
  const Real right = film[0] - Real(camera.width) / 2, up = Real(camera.height) / 2 - film[1];
  if (camera.projection == Projection::LatLong) {
    const Real longitude = right / camera.width * 2 * pi, latitude = up / camera.height * pi;
    return {sin(longitude) * cos(latitude), sin(latitude), -cos(longitude) * cos(latitude)};
  }
  const Real radius = sqrt(right * right + up * up);
  const Real theta = camera.projection == Projection::Fisheye
                         ? radius * fov / std::min(camera.width, camera.height)
                         : atan(radius * 2 * tan(fov / 2) / camera.width);
  if (radius == 0) return {0, 0, -1};
  return {sin(theta) * right / radius, sin(theta) * up / radius, -cos(theta)};
}

inline RealFilm reference_film(const Camera& camera, const RealVec3& direction) {
  const auto& [x, y, z] = direction;
  const Real pi = boost::math::constants::pi<Real>(), fov = camera.fov_rad;
  const Real middle_x = Real(camera.width) / 2, middle_y = Real(camera.height) / 2;
  if (camera.projection == Projection::LatLong) {
    return {middle_x + atan2(x, Real(-z)) / (2 * pi) * camera.width,
            middle_y - atan2(y, Real(sqrt(x * x + z * z))) / pi * camera.height};
  }
  const Real away = sqrt(x * x + y * y);
  if (away == 0) return {middle_x, middle_y};
  const Real radius = camera.projection == Projection::Fisheye
                          ? Real(atan2(away, Real(-z)) / fov * std::min(camera.width, camera.height))
                          : Real(away / -z / (2 * tan(fov / 2)) * camera.width);
  return {middle_x + radius * x / away, middle_y - radius * y / away};
}

inline RealVec3 in_reference(const Vec3& v) {
  return {v.x, v.y, v.z};
}

}  // namespace lensplane
