// SPDX-License-Identifier: Apache-2.0

#include "pipeline/image/star_catalogue.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string>
#include <string_view>

#include "pipeline/image/failure.h"
#include "src/constants.h"

namespace lensplane {
namespace {

constexpr std::string_view kHeader = "ra_deg,dec_deg,v_mag,b_minus_v";

/// A column: its name, and which values are allowed.
struct Column {
  std::string_view name;
  double least, largest;
};
constexpr std::array kColumns = {Column{"ra_deg", 0, 360}, Column{"dec_deg", -90, 90},
                                 Column{"v_mag", -kLargestMagnitude, kLargestMagnitude},
                                 Column{"b_minus_v", kLeastBMinusV, kLargestBMinusV}};

/// Longer pieces of a broken file are not shown.
constexpr std::size_t kShown = 40;

struct Line {
  const std::filesystem::path& path;
  std::size_t number;
  std::string_view text;
};

[[noreturn]] void refuse(const Line& line, const std::string& what) {
  throw Failure(ExitCode::BadInput, fmt::format("{}:{}: {}", line.path.string(), line.number, what));
}

std::string in_quotes(std::string_view text) {
  return fmt::format("'{}{}'", text.substr(0, kShown), text.size() > kShown ? "..." : "");
}

std::array<std::string_view, kColumns.size()> split(const Line& line) {
  std::array<std::string_view, kColumns.size()> fields;
  std::string_view rest = line.text;
  std::size_t count = 1;
  for (; true; ++count) {
    const std::size_t comma = rest.find(',');
    if (count <= fields.size()) fields[count - 1] = rest.substr(0, comma);
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  if (count != fields.size()) {
    refuse(line, fmt::format("{} is not a star; needed: {}", in_quotes(line.text), kHeader));
  }
  return fields;
}

double number(const Line& line, std::string_view text, const Column& column) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  if (!whole || !(value >= column.least && value <= column.largest)) {
    refuse(line, fmt::format("{}: {} is not allowed; allowed: a number from {} to {}", column.name,
                             in_quotes(text), column.least, column.largest));
  }
  return value;
}

Star star_from(const Line& line) {
  const auto fields = split(line);
  const double ra_deg = number(line, fields[0], kColumns[0]), dec_deg = number(line, fields[1], kColumns[1]);
  const double v_mag = number(line, fields[2], kColumns[2]);
  const double b_minus_v = fields[3].empty() ? kUnknownBMinusV : number(line, fields[3], kColumns[3]);
  return {direction_from_equatorial(ra_deg, dec_deg), v_mag, b_minus_v};
}

}  // namespace

Vec3 direction_from_equatorial(double ra_deg, double dec_deg) {
  const double ra = ra_deg * kPi / 180.0, dec = dec_deg * kPi / 180.0;
  return {-std::sin(ra) * std::cos(dec), std::sin(dec), -std::cos(ra) * std::cos(dec)};
}

std::vector<Star> read_star_catalogue(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path)) {
    throw Failure(ExitCode::BadInput, fmt::format("{}: no such star catalogue", path.string()));
  }
  std::vector<Star> stars;
  bool header = false;
  std::string text;
  for (std::size_t number = 1; std::getline(file, text); ++number) {
    if (text.ends_with('\r')) text.pop_back();
    if (text.starts_with('#')) continue;
    const Line line{path, number, text};
    if (header) {
      if (stars.size() == kMaxStars) refuse(line, fmt::format("too many stars; allowed: {}", kMaxStars));
      stars.push_back(star_from(line));
    } else if (text != kHeader) {
      refuse(line,
             fmt::format("{} is not the header of a star catalogue; needed: {}", in_quotes(text), kHeader));
    }
    header = true;
  }
  if (file.bad()) throw Failure(ExitCode::BadInput, fmt::format("{}: cannot be read", path.string()));
  if (stars.empty()) throw Failure(ExitCode::BadInput, fmt::format("{}: holds no stars", path.string()));
  return stars;
}

}  // namespace lensplane
