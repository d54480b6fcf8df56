// SPDX-License-Identifier: Apache-2.0
//
// Star catalogues: CSV files with the header ra_deg,dec_deg,v_mag,b_minus_v and a star on every line.
//
// On the sky stars are where textures/make_star_sky.py draws them: right ascension 0 on the equator lies
// along the world's -z (s = .5 of a lat-long sky) and falls to the right, the celestial north pole is +y (t =
// 1).

#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "src/basis.h"

namespace lensplane {

struct Star {
  Vec3 direction{0};     // unit vector in the world
  double v_mag = 0;      // apparent magnitude V
  double b_minus_v = 0;  // colour index
};

/// The colour of stars whose B - V the catalogue leaves empty: that of the sun, about, as
/// textures/make_star_sky.py has it.
inline constexpr double kUnknownBMinusV = 0.6;

/// Allowed values.
inline constexpr double kLargestMagnitude = 50;  // of V, of either sign
inline constexpr double kLeastBMinusV = -0.6, kLargestBMinusV = 10;

/// Longer catalogues are refused.
inline constexpr std::size_t kMaxStars = std::size_t{1} << 22;

/// Unit vector in the world for right ascension and declination.
Vec3 direction_from_equatorial(double ra_deg, double dec_deg);

/// Reads a catalogue; lines that start with # are comments. Throws Failure (BadInput) with the file, and the
/// line where one is not as it has to be: no star is left out.
std::vector<Star> read_star_catalogue(const std::filesystem::path& path);

}  // namespace lensplane
