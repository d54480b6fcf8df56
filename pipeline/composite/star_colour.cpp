// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/star_colour.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lensplane {
namespace {

/// h c / k, in nm K (CODATA 2018).
constexpr double kSecondRadiation = 1.438776877e7;

/// Wavelengths in nm.
constexpr double kShortest = 360, kStep = 5;
constexpr int kWavelengths = 95;

/// ACEScg (AP1) from XYZ with white D65: Bradford's adaptation to the white of ACES (x .32168, y .33767),
/// then the inverse of AP1's primaries.
constexpr std::array<Rgb, 3> kAcescgFromXyz = {
    {{1.660585326491183, -0.31529556082587074, -0.24150932760837673},
     {-0.6599260632241544, 1.6083914695660544, 0.017298594705445463},
     {0.009002569137834142, -0.0035668763903373354, 0.913643312763104}}};

/// Luminance of ACEScg's red, green and blue.
constexpr Rgb kLuminance = {0.272228716781, 0.674081765811, 0.053689517408};

double dot(const Rgb& a, const Rgb& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// A Gaussian with different widths (1/nm) on both sides.
double lobe(double nm, double middle, double below, double above) {
  const double t = (nm - middle) * (nm < middle ? below : above);
  return std::exp(-0.5 * t * t);
}

/// x, y and z of the colour matching functions.
Rgb colour_matching(double nm) {
  return {0.362 * lobe(nm, 442.0, 0.0624, 0.0374) + 1.056 * lobe(nm, 599.8, 0.0264, 0.0323) -
              0.065 * lobe(nm, 501.1, 0.0490, 0.0382),
          0.821 * lobe(nm, 568.8, 0.0213, 0.0247) + 0.286 * lobe(nm, 530.9, 0.0613, 0.0322),
          1.217 * lobe(nm, 437.0, 0.0845, 0.0278) + 0.681 * lobe(nm, 459.0, 0.0385, 0.0725)};
}

const std::vector<Rgb>& colour_matching_table() {
  static const std::vector<Rgb> table = [] {
    std::vector<Rgb> values;
    for (int i = 0; i < kWavelengths; ++i) values.push_back(colour_matching(kShortest + i * kStep));
    return values;
  }();
  return table;
}

}  // namespace

double temperature_from_b_minus_v(double b_minus_v) {
  return 4600.0 * (1.0 / (0.92 * b_minus_v + 1.7) + 1.0 / (0.92 * b_minus_v + 0.62));
}

Chromaticity blackbody_chromaticity(double kelvin) {
  Rgb xyz{0, 0, 0};
  for (int i = 0; i < kWavelengths; ++i) {
    const double nm = kShortest + i * kStep, metres = nm / 550.0;  // in 550 nm: about 1
    const double planck = 1.0 / (std::pow(metres, 5.0) * std::expm1(kSecondRadiation / (nm * kelvin)));
    const Rgb& weights = colour_matching_table()[static_cast<std::size_t>(i)];
    for (std::size_t c = 0; c < 3; ++c) xyz[c] += weights[c] * planck;
  }
  const double sum = xyz[0] + xyz[1] + xyz[2];
  return {xyz[0] / sum, xyz[1] / sum};
}

Rgb acescg_from_chromaticity(Chromaticity c) {
  const Rgb xyz{c.x / c.y, 1.0, (1.0 - c.x - c.y) / c.y};
  Rgb rgb{};
  for (std::size_t i = 0; i < 3; ++i) rgb[i] = std::max(0.0, dot(kAcescgFromXyz[i], xyz));
  const double luminance = dot(kLuminance, rgb);
  for (double& channel : rgb) channel /= luminance;
  return rgb;
}

Rgb star_colour(double b_minus_v) {
  return acescg_from_chromaticity(blackbody_chromaticity(temperature_from_b_minus_v(b_minus_v)));
}

}  // namespace lensplane
