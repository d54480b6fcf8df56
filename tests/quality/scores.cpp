// SPDX-License-Identifier: Apache-2.0

#include "tests/quality/scores.h"

#include <algorithm>
#include <cmath>

namespace lensplane {

std::vector<double> squares(const Picture& a, const Picture& b) {
  std::vector<double> result;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double off = static_cast<double>(a.pixels[i][c]) - static_cast<double>(b.pixels[i][c]);
      sum += off * off / 3.0;
    }
    result.push_back(sum);
  }
  return result;
}

double psnr(const std::vector<double>& squares, double peak, const std::vector<bool>& counts) {
  double sum = 0;
  std::size_t pixels = 0;
  for (std::size_t i = 0; i < squares.size(); ++i) {
    if (!counts.empty() && !counts[i]) continue;
    sum += squares[i];
    ++pixels;
  }
  return -10.0 * std::log10(std::max(sum / static_cast<double>(pixels) / (peak * peak), 1e-15));
}

double largest_difference(const Picture& a, const Picture& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    for (std::size_t c = 0; c < 4; ++c) {
      most =
          std::max(most, std::abs(static_cast<double>(a.pixels[i][c]) - static_cast<double>(b.pixels[i][c])));
    }
  }
  return most;
}

double brightest(const Picture& picture) {
  float most = 0;
  for (const Rgba& pixel : picture.pixels) most = std::max({most, pixel[0], pixel[1], pixel[2]});
  return static_cast<double>(most);
}

Picture clipped(Picture picture) {
  for (Rgba& pixel : picture.pixels) {
    for (float& channel : pixel) channel = std::min(channel, 1.0F);
  }
  return picture;
}

double total(const Picture& picture, std::size_t channel) {
  double sum = 0;
  for (const Rgba& pixel : picture.pixels) sum += static_cast<double>(pixel[channel]);
  return sum;
}

std::vector<bool> magnified(const LensMap& map, double times) {
  std::vector<bool> result(map.s.size(), false);
  for (const Pass& pass : map.passes) {
    if (pass.channel != "lensing.magnification") continue;
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = std::abs(pass.values[i]) > times;
  }
  return result;
}

double sharpness(const Picture& picture, const std::vector<bool>& counts) {
  double sum = 0;
  for (int row = 0; row < picture.height; ++row) {
    for (int column = 1; column < picture.width; ++column) {
      if (!counts[picture.index(column, row)]) continue;
      const float off = picture.at(column, row)[1] - picture.at(column - 1, row)[1];
      sum += static_cast<double>(off) * static_cast<double>(off);
    }
  }
  return sum;
}

void Flicker::add(const Picture& before, const Picture& after, const Picture& true_before,
                  const Picture& true_after) {
  for (std::size_t i = 0; i < before.pixels.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      const float change = after.pixels[i][c] - before.pixels[i][c];
      const float true_change = true_after.pixels[i][c] - true_before.pixels[i][c];
      const auto off = static_cast<double>(change - true_change);
      sum_ += off * off;
      ++count_;
    }
  }
}

double Flicker::rms() const {
  return std::sqrt(sum_ / static_cast<double>(count_));
}

}  // namespace lensplane
