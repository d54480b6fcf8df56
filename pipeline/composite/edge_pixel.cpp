// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/edge_pixel.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace lensplane {
namespace {

Rgba mean_of(std::span<const Rgba> colours) {
  Rgba sum{0, 0, 0, 0};
  for (const Rgba& colour : colours) {
    for (std::size_t c = 0; c < 4; ++c) sum[c] += colour[c];
  }
  for (float& channel : sum) channel /= static_cast<float>(colours.size());
  return sum;
}

}  // namespace

float seen_brightness(float light) {
  return light / (std::abs(light) + kMiddleGrey);
}

EdgePixel::EdgePixel(int column, int row, PixelKind kind, std::size_t surfaces)
    : column_(column), row_(row), kind_(kind), hits_(surfaces, 0) {}

void EdgePixel::add(std::span<const SeenPoint> points, const Rgba& colour, float shadow, bool counts) {
  assert(rays_ < kMostSamples && points.size() == hits_.size());
  if (rays_ == 0) first_.assign(points.begin(), points.end());
  alike_ = alike_ && meet_alike(first_, points);
  for (std::size_t k = 0; k < points.size(); ++k) hits_[k] += counts && points[k].hit ? 1 : 0;
  counts_[static_cast<std::size_t>(rays_)] = counts;
  seen_[static_cast<std::size_t>(rays_++)] = colour;
  shadow_ += counts ? shadow : 0;
}

Rgba EdgePixel::mean() const {
  std::array<Rgba, kMostSamples> counted;
  std::size_t count = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(rays_); ++i) {
    if (counts_[i]) counted[count++] = seen_[i];
  }
  return count > 0 ? mean_of({counted.data(), count})
                   : mean_of({seen_.data(), static_cast<std::size_t>(rays_)});
}

float EdgePixel::shadow() const {
  return shadow_ / static_cast<float>(std::max(1, counted()));
}

double EdgePixel::share_of(std::size_t surface) const {
  return static_cast<double>(hits_[surface]) / std::max(1, counted());
}

int EdgePixel::counted() const {
  return static_cast<int>(std::count(counts_.begin(), counts_.end(), true));
}

float EdgePixel::error() const {
  const auto floor = static_cast<float>(kFirstEdgeError * std::sqrt(double(kFirstSamples) / rays_));
  return rays_ < 8 ? 0 : std::max(spread_of_groups(), floor * jump());
}

/// The standard error of the mean from the means of the rays four by four.
float EdgePixel::spread_of_groups() const {
  const int groups = rays_ / 4;
  const Rgba all = mean();
  Rgba variances{0, 0, 0, 0};
  for (int g = 0; g < groups; ++g) {
    const Rgba group = mean_of({&seen_[static_cast<std::size_t>(4 * g)], 4});
    for (std::size_t c = 0; c < 4; ++c) {
      const float off = seen_brightness(group[c]) - seen_brightness(all[c]);
      variances[c] += off * off / static_cast<float>(groups * (groups - 1));
    }
  }
  return std::sqrt(*std::max_element(variances.begin(), variances.end()));
}

/// By how much the rays jump: as far as they are apart where they meet different things; else by the widest
/// gap that no ray's brightness lies in, since what is smooth has none. As far as light goes where a
/// silhouette is near and no ray has found it.
float EdgePixel::jump() const {
  if (kind_ == PixelKind::Silhouette && alike_) return 1;
  float most = 0;
  std::array<float, kMostSamples> sorted;
  for (std::size_t c = 0; c < 4; ++c) {
    const auto end = std::transform(seen_.begin(), seen_.begin() + rays_, sorted.begin(),
                                    [c](const Rgba& colour) { return seen_brightness(colour[c]); });
    std::sort(sorted.begin(), end);
    if (!alike_) most = std::max(most, *(end - 1) - sorted.front());
    for (auto value = sorted.begin() + 1; alike_ && value != end; ++value) {
      most = std::max(most, *value - *(value - 1));
    }
  }
  return most;
}

}  // namespace lensplane
