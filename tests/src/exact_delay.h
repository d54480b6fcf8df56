// SPDX-License-Identifier: Apache-2.0
//
// The delay of light past one mass, in a hundred digits: what all methods are measured by.
//
// With the closest approach at the Schwarzschild radius P, r = P cosh^2 v takes the roots out of the time
// and the angle that light of impact parameter b sweeps (m = 1):
//
//   dt = 2 sqrt(P) cosh v r^(3/2)/((1 - 2/r) sqrt(r^2 + P r + P^2 - b^2)) dv,   dphi = b (1 - 2/r)/r^2 dt.

#pragma once

#include <boost/math/quadrature/gauss.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>

namespace lensplane {

using Precise = boost::multiprecision::cpp_bin_float_100;

/// The integral from `from` to `to`, by panels so short that nothing is left out.
template <class Integrand>
Precise panels(const Integrand& f, const Precise& from, const Precise& to) {
  const int count = 1 + static_cast<int>((to - from) / 0.5);
  const Precise width = (to - from) / count;
  Precise sum = 0;
  for (int i = 0; i < count; ++i) {
    sum += boost::math::quadrature::gauss<Precise, 30>::integrate(f, Precise(from + i * width),
                                                                  Precise(from + (i + 1) * width));
  }
  return sum;
}

struct ExactDelay {
  double delay;  // metres, as GeodesicRay::delay
  double turn;   // by which the light is bent on its way from the observer, radians
};

/// Of the ray that leaves an observer at the isotropic distance `rho` from the mass `m` at the angle `chi` <
/// 90 deg from it. Given as numbers without rounding: sine and cosine of chi.
inline ExactDelay exact_delay(double m, double rho, double sine, double cosine) {
  const Precise rho_o = Precise(rho) / m, s = 1 / (2 * rho_o);
  const Precise size = sqrt(Precise(sine) * sine + Precise(cosine) * cosine);
  const Precise r_o = rho_o * (1 + s) * (1 + s);
  const Precise b = pow(1 + s, 3) / (1 - s) * rho_o * (sine / size);
  const Precise closest = 2 * b / sqrt(Precise(3)) * cos(acos(-3 * sqrt(Precise(3)) / b) / 3);
  const auto radius = [&](const Precise& v) -> Precise { return closest * pow(cosh(v), 2); };
  const auto time = [&](const Precise& v) -> Precise {
    const Precise r = radius(v), q = r * r + closest * r + closest * closest - b * b;
    return 2 * sqrt(closest) * cosh(v) * r * sqrt(r) / ((1 - 2 / r) * sqrt(q));
  };
  const auto angle = [&](const Precise& v) -> Precise {
    const Precise r = radius(v);
    return time(v) * b * (1 - 2 / r) / (r * r);
  };
  const auto beyond = [&](const Precise& v) -> Precise {  // less what flat space and 2 ln(r) would take
    const Precise r = radius(v);
    return time(v) - (1 + 2 / r) * 2 * closest * cosh(v) * sinh(v);
  };
  const Precise v_o = acosh(sqrt(r_o / closest)), v_far = v_o + 35;
  const Precise swept = 2 * panels(angle, 0, v_o) + panels(angle, v_o, v_far) + b / radius(v_far);
  const Precise rest = panels(beyond, v_o, v_far) + (4 + b * b / 2) / radius(v_far);
  const Precise delay = 2 * panels(time, 0, v_o) + rest + 1 - r_o + 2 * log(rho_o / r_o) + rho_o * cos(swept);
  const Precise chi = atan2(Precise(sine), Precise(cosine));
  const Precise pi = boost::math::constants::pi<Precise>();
  return {static_cast<double>(delay * m), static_cast<double>(swept - (pi - chi))};
}

}  // namespace lensplane
