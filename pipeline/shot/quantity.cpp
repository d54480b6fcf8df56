// SPDX-License-Identifier: Apache-2.0

#include "pipeline/shot/quantity.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>

#include "pipeline/shot/location.h"
#include "src/constants.h"

namespace lensplane {
namespace {

struct Unit {
  std::string_view name;
  Dimension dimension;
  double factor;
};

constexpr double kDegree = kPi / 180.0;

constexpr std::array kUnits = {
    Unit{"mm", Dimension::Length, 1e-3},
    Unit{"cm", Dimension::Length, 1e-2},
    Unit{"m", Dimension::Length, 1.0},
    Unit{"km", Dimension::Length, 1e3},
    Unit{"AU", Dimension::Length, kAstronomicalUnit},
    Unit{"ly", Dimension::Length, kLightYear},
    Unit{"pc", Dimension::Length, kParsec},
    Unit{"kpc", Dimension::Length, 1e3 * kParsec},
    Unit{"Mpc", Dimension::Length, 1e6 * kParsec},
    Unit{"Gpc", Dimension::Length, 1e9 * kParsec},
    Unit{"Rearth", Dimension::Length, kEarthRadius},
    Unit{"Rsun", Dimension::Length, kSunRadius},
    Unit{"deg", Dimension::Angle, kDegree},
    Unit{"rad", Dimension::Angle, 1.0},
    Unit{"arcmin", Dimension::Angle, kDegree / 60.0},
    Unit{"arcsec", Dimension::Angle, kDegree / 3600.0},
    Unit{"mas", Dimension::Angle, kDegree / 3.6e6},
    Unit{"g", Dimension::Mass, geometric_mass_from_kg(1e-3)},
    Unit{"kg", Dimension::Mass, geometric_mass_from_kg(1.0)},
    Unit{"Msun", Dimension::Mass, geometric_mass_from_gm(kSunGM)},
    Unit{"Mearth", Dimension::Mass, geometric_mass_from_gm(kEarthGM)},
    Unit{"Mjup", Dimension::Mass, geometric_mass_from_gm(kJupiterGM)},
    Unit{"px", Dimension::Pixels, 1.0},
    Unit{"%", Dimension::Share, 0.01},
    Unit{"s", Dimension::Time, 1.0},
    Unit{"min", Dimension::Time, 60.0},
    Unit{"h", Dimension::Time, 3600.0},
};

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") + 1 - first);
}

ParsedQuantity wrong(std::string error) {
  return {0, std::move(error)};
}

std::string needed(Dimension dimension) {
  if (dimension == Dimension::Number) return "a plain number is needed";
  return fmt::format("{} is needed, in {}", noun_of(dimension), units_of(dimension));
}

/// Applies `unit` to the value, or says why it is the wrong one.
ParsedQuantity with_unit(double number, std::string_view text, std::string_view unit, Dimension dimension) {
  if (unit.empty() && dimension == Dimension::Number) return {number, {}};
  if (unit.empty()) return wrong(fmt::format("{} has no unit; {}", in_quotes(text), needed(dimension)));
  for (const Unit& known : kUnits) {
    if (known.name != unit) continue;
    if (known.dimension == dimension) return {number * known.factor, {}};
    return wrong(fmt::format("{} is {}; {}", in_quotes(text), noun_of(known.dimension), needed(dimension)));
  }
  return wrong(fmt::format("{} is not a unit; {}", in_quotes(unit), needed(dimension)));
}

}  // namespace

std::string_view noun_of(Dimension dimension) {
  switch (dimension) {
    case Dimension::Number:
      return "a number";
    case Dimension::Length:
      return "a length";
    case Dimension::Angle:
      return "an angle";
    case Dimension::Mass:
      return "a mass";
    case Dimension::Pixels:
      return "a number of pixels";
    case Dimension::Share:
      return "a share";
    case Dimension::Time:
      return "a time";
  }
  return {};
}

std::string units_of(Dimension dimension) {
  std::string list;
  for (const Unit& unit : kUnits) {
    if (unit.dimension == dimension) list += (list.empty() ? "" : ", ") + std::string(unit.name);
  }
  return list;
}

ParsedQuantity parse_quantity(std::string_view text, Dimension dimension) {
  text = trimmed(text);
  std::string_view digits = text;
  if (digits.starts_with('+') && !digits.starts_with("+-"))
    digits.remove_prefix(1);  // from_chars knows minus only
  double number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error == std::errc::invalid_argument) {
    return wrong(fmt::format("{} is not a number; {}", in_quotes(text), needed(dimension)));
  }
  if (error == std::errc::result_out_of_range) {
    return wrong(fmt::format("{} is out of the range of numbers; {}", in_quotes(text), needed(dimension)));
  }
  const std::string_view rest = digits.substr(static_cast<std::size_t>(end - digits.data()));
  const ParsedQuantity result = with_unit(number, text, trimmed(rest), dimension);
  if (!result.error.empty()) return result;
  if (!std::isfinite(result.value))
    return wrong(fmt::format("{} is not finite; {}", in_quotes(text), needed(dimension)));
  if (std::abs(result.value) > kLargestQuantity) {
    return wrong(
        fmt::format("{} is too large; {}, up to 1e100 in SI units", in_quotes(text), needed(dimension)));
  }
  // As it is written, too: a large unit does not bring back digits that are lost.
  if (number != 0 && !(std::isnormal(number) && std::isnormal(result.value))) {
    return wrong(fmt::format("{} is too small to be told from zero; {}", in_quotes(text), needed(dimension)));
  }
  return result;
}

}  // namespace lensplane
