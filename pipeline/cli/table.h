// SPDX-License-Identifier: Apache-2.0
//
// Numbers and tables as people read them.

#pragma once

#include <string>
#include <vector>

namespace lensplane {

/// Rows of cells under one another, every column as wide as its widest cell, each line indented by two.
std::string text_from_rows(const std::vector<std::vector<std::string>>& rows);

/// A length in metres with the unit that fits it: "4.36e+05 km", "8 kpc".
std::string readable_length(double metres);

/// A geometric mass in metres as a mass: "10 Msun", "5.972e+24 kg".
std::string readable_mass(double m);

}  // namespace lensplane
