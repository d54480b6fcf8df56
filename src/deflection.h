// SPDX-License-Identifier: Apache-2.0
//
// Deflection laws: how far does one static mass bend a ray?
//
// A law gives alpha(b), the angle in radians between a ray's two asymptotes, for impact parameter b and
// geometric mass m = G M / c^2 in the same unit of length.

#pragma once

namespace lensplane {

/// The weak law, equation (4) of the paper: alpha = 4 m/b. weak_deflection(1, 100) = 0.04.
/// Short of the exact angle by 10 % at b = 30 m, 1 % at 295 m, 0.1 % at 2946 m. Infinite at b = 0 for m > 0.
constexpr double weak_deflection(double m, double b) {
  return 4.0 * m / b;
}

}  // namespace lensplane
