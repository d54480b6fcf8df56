// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/polar_footprints.h"

#include <algorithm>
#include <numbers>

namespace lensplane {
namespace {

constexpr double kPi = std::numbers::pi;

// An ellipse does for footprints whose standard deviation is at most this much longitude, in radians.
constexpr double kMostLongitude = 0.15;
// Footprints that reach farther from the pole see the globe as a whole.
constexpr double kMostLatitude = 0.7;

}  // namespace

bool bends_around_pole(TextureCoordinates st, const Footprint& footprint) {
  const double sigma = kPixelSigma * footprint.scale;
  const auto length = [](double x, double y) { return std::sqrt(x * x + y * y); };
  const double longitude = 2 * kPi * sigma * length(footprint.ds_dx, footprint.ds_dy);
  const double latitude = kPi * sigma * length(footprint.dt_dx, footprint.dt_dy);
  const double colatitude = kPi * std::min(st.t, 1 - st.t);
  return longitude > kMostLongitude && latitude < kMostLatitude && colatitude < kPi / 4 && colatitude >= 0 &&
         longitude * colatitude < kMostLatitude;
}

PolarPart polar_part(TextureCoordinates st, const Footprint& footprint, double x, double y) {
  const bool north = st.t > 0.5;
  const double from_pole = kPi * (north ? 1 - st.t : st.t);
  const double outward = north ? -kPi : kPi;  // d colatitude / dt
  const double longitude = 2 * kPi * st.s;
  const double cosine = std::cos(longitude), sine = std::sin(longitude);
  // The plane's coordinates u = colatitude cos(longitude), v = colatitude sin(longitude), and their
  // derivatives by the film.
  const double around_x = from_pole * 2 * kPi * footprint.ds_dx, out_x = outward * footprint.dt_dx;
  const double around_y = from_pole * 2 * kPi * footprint.ds_dy, out_y = outward * footprint.dt_dy;
  const double du_dx = cosine * out_x - sine * around_x, dv_dx = sine * out_x + cosine * around_x;
  const double du_dy = cosine * out_y - sine * around_y, dv_dy = sine * out_y + cosine * around_y;
  const double sigma = kPixelSigma * footprint.scale;
  const double u = from_pole * cosine + sigma * (du_dx * x + du_dy * y);
  const double v = from_pole * sine + sigma * (dv_dx * x + dv_dy * y);
  const double size = std::hypot(du_dx, dv_dx) + std::hypot(du_dy, dv_dy);
  const double distance = std::max(std::hypot(u, v), 1e-3 * sigma * size);
  // And back: d longitude = (u dv - v du) / distance^2, d colatitude = (u du + v dv) / distance.
  const double per_area = distance > 0 ? 1 / (distance * distance) : 0;
  const auto ds = [&](double du, double dv) { return (u * dv - v * du) * per_area / (2 * kPi); };
  const auto dt = [&](double du, double dv) { return (u * du + v * dv) * per_area * distance / outward; };
  return {{std::atan2(v, u) / (2 * kPi), north ? 1 - distance / kPi : distance / kPi},
          {.ds_dx = ds(du_dx, dv_dx),
           .ds_dy = ds(du_dy, dv_dy),
           .dt_dx = dt(du_dx, dv_dx),
           .dt_dy = dt(du_dy, dv_dy),
           .scale = footprint.scale * kPolarPartSigma,
           .x = footprint.x + sigma * x,
           .y = footprint.y + sigma * y}};
}

}  // namespace lensplane
