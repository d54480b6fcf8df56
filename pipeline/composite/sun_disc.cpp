// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/sun_disc.h"

#include <algorithm>
#include <cmath>

#include "src/constants.h"

namespace lensplane {
namespace {

/// Suns smaller than this are points: of their area rounding would leave too little.
constexpr double kPoint = 1e-6;

double angle_of_cosine(double cosine) {
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

/// The solid angle within an angle of a direction.
double cap(double radius) {
  const double half = std::sin(radius / 2);
  return 4 * kPi * half * half;
}

/// The solid angle common to two caps whose edges cross: sectors of both less the two triangles between.
double common(double a, double b, double apart) {
  const double cos_a = std::cos(a), cos_b = std::cos(b), cos_d = std::cos(apart);
  const double sin_a = std::sin(a), sin_b = std::sin(b), sin_d = std::sin(apart);
  // Angles of the triangle of both middles and a point where the edges cross.
  const double at_crossing = angle_of_cosine((cos_d - cos_a * cos_b) / (sin_a * sin_b));
  const double at_a = angle_of_cosine((cos_b - cos_d * cos_a) / (sin_d * sin_a));
  const double at_b = angle_of_cosine((cos_a - cos_d * cos_b) / (sin_d * sin_b));
  return 2 * (kPi - at_crossing - at_a * cos_a - at_b * cos_b);
}

}  // namespace

double free_share(double sun, double ball, double apart) {
  if (sun < kPoint) return apart < ball ? 0.0 : 1.0;
  if (apart >= sun + ball) return 1.0;
  if (apart <= ball - sun) return 0.0;
  if (apart <= sun - ball) return 1.0 - cap(ball) / cap(sun);
  return std::clamp(1.0 - common(sun, ball, apart) / cap(sun), 0.0, 1.0);
}

/// Half the integral, along the boundary of what is seen, of the area that it sweeps about the zenith.
double lambert_share(double sun, double sine) {
  const double sin_sun = std::sin(sun), cos_sun = std::cos(sun);
  const double cosine = std::sqrt(std::max(0.0, 1.0 - sine * sine));
  if (sun < kPoint) return std::max(0.0, sine);
  if (sine <= -sin_sun) return 0.0;
  const double whole = kPi * sin_sun * sin_sun * sine;
  if (sine >= sin_sun) return whole / cap(sun);
  // From the top of the disc to where the horizon cuts it, about its middle; and along the horizon.
  const double round = angle_of_cosine(-cos_sun * sine / (sin_sun * cosine));
  const double along = angle_of_cosine(cos_sun / cosine);
  const double swept =
      sin_sun * sin_sun * sine * round - sin_sun * cos_sun * cosine * std::sin(round) + along;
  return std::max(0.0, swept) / cap(sun);
}

}  // namespace lensplane
