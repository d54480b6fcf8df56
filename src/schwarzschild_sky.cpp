// SPDX-License-Identifier: Apache-2.0

#include "src/schwarzschild_sky.h"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/special_functions/ellint_1.hpp>
#include <cmath>

namespace lensplane {
namespace {

using Real = long double;  // differences of nearly equal numbers near the shadow

/// phi(r) of the header, for m = 1, b > 3 sqrt(3), u = 1/r and the cosine of the light's angle to the radius
/// there. In f(u) = 1 - b^2 u^2 (1 - 2u) = cosine^2, which is 0 at 1/P, the factor 1/P - u is known from the
/// cosine with all its digits, however near to P the light is.
Real swept_from_nearest(Real b, Real u, Real cosine) {
  const Real p = 2 * b / std::sqrt(Real(3)) * std::cos(std::acos(-3 * std::sqrt(Real(3)) / b) / 3);
  const Real q = std::sqrt((p - 2) * (p + 6));
  const Real k = std::sqrt((q - p + 6) / (2 * q));
  const Real up = 1 / p;
  const Real from_nearest = cosine * cosine / (b * b * (up + u - 2 * (up * up + up * u + u * u)));
  const Real z = std::atan2(std::sqrt(q - p + 2 + 4 * p * u), std::sqrt(4 * p * from_nearest));
  return 2 * std::sqrt(p / q) * (boost::math::ellint_1(k) - boost::math::ellint_1(k, z));
}

/// The angle that light on its way out sweeps from u = 1/r to infinity, of b < 3 sqrt(3), which is nearest to
/// the mass nowhere.
Real swept_outward(Real b, Real u) {
  const auto slope = [b](Real v) { return b / std::sqrt(1 - b * b * v * v * (1 - 2 * v)); };
  return boost::math::quadrature::gauss_kronrod<Real, 31>::integrate(slope, Real(0), u, 15, Real(1e-17));
}

}  // namespace

std::optional<double> schwarzschild_sweep(double m, double rho, double chi) {
  const Real distance = static_cast<Real>(rho) / m;
  if (!(distance > 0.5L)) return std::nullopt;
  const Real r = distance * (1 + 0.5L / distance) * (1 + 0.5L / distance);
  if (!(r > 3)) return std::nullopt;
  const Real b = r * std::sin(static_cast<Real>(chi)) / std::sqrt(1 - 2 / r);
  const bool inward = std::cos(chi) > 0;
  if (b > 3 * std::sqrt(Real(3))) {
    const Real far = swept_from_nearest(b, 0, 1), near = swept_from_nearest(b, 1 / r, std::cos(Real(chi)));
    return static_cast<double>(inward ? far + near : far - near);
  }
  if (inward) return std::nullopt;
  return static_cast<double>(swept_outward(b, 1 / r));
}

std::optional<Vec3> sky_direction_past(double m, const Vec3& position, const Vec3& direction) {
  const Vec3 towards = position.normalized();
  const Vec3 across = direction - towards * direction.dot(towards);
  const double sine = across.length();
  const auto phi = schwarzschild_sweep(m, position.length(), std::atan2(sine, direction.dot(towards)));
  if (!phi) return std::nullopt;
  const Vec3 aside = sine > 0 ? across / sine : Vec3(0);
  return aside * std::sin(*phi) - towards * std::cos(*phi);
}

}  // namespace lensplane
