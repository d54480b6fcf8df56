// SPDX-License-Identifier: Apache-2.0
//
// Physical constants, each with its unit and source. Everything else in lensplane is derived from these.
//
// Masses are carried as geometric masses m = G M / c^2, in metres, from the moment they are read: the only
// form in which they enter a formula.

#pragma once

#include <numbers>

namespace lensplane {

inline constexpr double kPi = std::numbers::pi;

inline constexpr double kGravitation = 6.67430e-11;  // G, m^3 kg^-1 s^-2 (CODATA 2018)
inline constexpr double kLightSpeed = 299792458.0;   // c, m/s (exact)

inline constexpr double kSunGM = 1.3271244e20;      // m^3 s^-2 (IAU 2015 B3, nominal)
inline constexpr double kEarthGM = 3.986004e14;     // m^3 s^-2 (IAU 2015 B3, nominal)
inline constexpr double kJupiterGM = 1.2668653e17;  // m^3 s^-2 (IAU 2015 B3, nominal)

inline constexpr double kSunRadius = 6.957e8;     // m (IAU 2015 B3, nominal)
inline constexpr double kEarthRadius = 6.3781e6;  // m, equatorial (IAU 2015 B3, nominal)

inline constexpr double kAstronomicalUnit = 149597870700.0;            // m (exact, IAU 2012 B2)
inline constexpr double kParsec = 648000.0 / kPi * kAstronomicalUnit;  // m (IAU 2015 B2)
inline constexpr double kLightYear = kLightSpeed * 365.25 * 86400.0;   // m (Julian year)

/// m = GM/c^2 in metres, for a gravitational parameter `gm` in m^3 s^-2.
constexpr double geometric_mass_from_gm(double gm) {
  return gm / (kLightSpeed * kLightSpeed);
}

/// m = G M / c^2 in metres, for a mass in kilograms.
constexpr double geometric_mass_from_kg(double kg) {
  return geometric_mass_from_gm(kGravitation * kg);
}

}  // namespace lensplane
