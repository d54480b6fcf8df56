// SPDX-License-Identifier: Apache-2.0

#include "pipeline/study/error_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "pipeline/image/image_library.h"

namespace lensplane {
namespace {

// Anchors of "inferno" (S. van der Walt and N. Smith, CC0), whose lightness rises evenly.
constexpr std::array<std::array<float, 3>, 9> kInferno = {{{0.001F, 0.000F, 0.014F},
                                                           {0.122F, 0.047F, 0.282F},
                                                           {0.333F, 0.059F, 0.427F},
                                                           {0.533F, 0.133F, 0.416F},
                                                           {0.729F, 0.212F, 0.333F},
                                                           {0.890F, 0.349F, 0.200F},
                                                           {0.976F, 0.549F, 0.039F},
                                                           {0.976F, 0.788F, 0.196F},
                                                           {0.988F, 1.000F, 0.643F}}};
constexpr Rgba kNothing = {0.45F, 0.45F, 0.45F, 1};
constexpr Rgba kDiffers = {0, 0.9F, 0.9F, 1};

std::string base64(std::span<const unsigned char> bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (i + k < bytes.size() ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? kDigits[group >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

std::string css(const Rgba& colour) {
  const auto code = [](float v) { return static_cast<int>(std::lround(255 * v)); };
  return fmt::format("rgb({},{},{})", code(colour[0]), code(colour[1]), code(colour[2]));
}

}  // namespace

Rgba error_colour(double px) {
  const double share =
      std::log(std::max(px, kLeastShownPx) / kLeastShownPx) / std::log(kMostShownPx / kLeastShownPx);
  const double place = std::min(share, 1.0) * (kInferno.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(place), kInferno.size() - 2);
  const auto rest = static_cast<float>(place - static_cast<double>(i));
  Rgba colour{0, 0, 0, 1};
  for (std::size_t c = 0; c < 3; ++c)
    colour[c] = kInferno[i][c] + rest * (kInferno[i + 1][c] - kInferno[i][c]);
  return colour;
}

Picture error_map(const FilmGrid& grid, const std::vector<RayError>& errors) {
  Picture picture{grid.columns, grid.rows, 0, 0, grid.columns, grid.rows, {}};
  for (const RayError& error : errors)
    picture.pixels.push_back(error.validity_differs ? kDiffers
                             : error.compared       ? error_colour(error.px)
                                                    : kNothing);
  return picture;
}

std::string data_uri_of(const Picture& picture) {
  return "data:image/png;base64," + base64(image_library().png_bytes("error map", picture, 8, {}));
}

std::string error_legend() {
  constexpr int kWidth = 540;
  const int decades = static_cast<int>(std::lround(std::log10(kMostShownPx / kLeastShownPx)));
  std::string stops, ticks;
  for (std::size_t i = 0; i < kInferno.size(); ++i) {
    const double share = static_cast<double>(i) / (kInferno.size() - 1);
    const double px = kLeastShownPx * std::pow(kMostShownPx / kLeastShownPx, share);
    stops += fmt::format(R"(<stop offset="{}" stop-color="{}"/>)", share, css(error_colour(px)));
  }
  for (int d = 0; d <= decades; ++d) {
    const double px = kLeastShownPx * std::pow(10.0, d);
    const double x = 30.0 + d * static_cast<double>(kWidth) / decades;
    ticks += fmt::format(R"(<text x="{:.0f}" y="40" text-anchor="middle">{:g}{}</text>)", x, px,
                         d == decades ? " px" : "");
  }
  return fmt::format(
      R"svg(<svg id="legend" viewBox="0 0 1080 48" width="1080"><defs><linearGradient id="inferno">{}</linearGradient></defs><rect x="30" y="4" width="{}" height="18" fill="url(#inferno)"/>{}<rect x="640" y="4" width="18" height="18" fill="{}"/><text x="664" y="18">only one sees something</text><rect x="850" y="4" width="18" height="18" fill="{}"/><text x="874" y="18">nothing to compare</text></svg>)svg",
      stops, kWidth, ticks, css(kDiffers), css(kNothing));
}

}  // namespace lensplane
