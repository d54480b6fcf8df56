// SPDX-License-Identifier: Apache-2.0

#include "pipeline/cli/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "src/constants.h"

namespace lensplane {
namespace {

struct Unit {
  double size;  // metres
  double from;  // used from so many metres on
  const char* name;
};

constexpr std::array kUnits = {
    Unit{1e9 * kParsec, 1e9 * kParsec, "Gpc"},
    Unit{1e6 * kParsec, 1e6 * kParsec, "Mpc"},
    Unit{1e3 * kParsec, 1e3 * kParsec, "kpc"},
    Unit{kParsec, 0.1 * kParsec, "pc"},
    Unit{kAstronomicalUnit, 0.1 * kAstronomicalUnit, "AU"},
    Unit{1e3, 1e3, "km"},
};

}  // namespace

std::string text_from_rows(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) line += fmt::format("  {:<{}}", row[i], widths[i]);
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

std::string readable_length(double metres) {
  for (const Unit& unit : kUnits) {
    if (metres >= unit.from) return fmt::format("{:.4g} {}", metres / unit.size, unit.name);
  }
  return fmt::format("{:.4g} m", metres);
}

std::string readable_mass(double m) {
  const double suns = m / geometric_mass_from_gm(kSunGM);
  if (suns >= 1e-3) return fmt::format("{:.4g} Msun", suns);
  return fmt::format("{:.4g} kg", m / geometric_mass_from_kg(1.0));
}

}  // namespace lensplane
