// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/close_filter.h"

#include <algorithm>

#include "pipeline/composite/long_filter.h"
#include "pipeline/composite/short_filter.h"

namespace lensplane {
namespace {

/// How far the long filter has taken over from the short one, 0 to 1.
double long_share(const Covariance& pixel) {
  if (std::max(pixel.xx, pixel.yy) > kLargestShortVariance) return 1;
  constexpr double kStarts = 0.9;
  static_assert(kStarts / 2 >= kSmallestLongVariance);
  if (pixel.xx + pixel.yy < kStarts) return 0;  // it cannot lean more
  return std::clamp((leaning(pixel) - kStarts) / (kLargestLeaning - kStarts), 0.0, 1.0);
}

}  // namespace

Rgba close_mean(Texels& texels, double x, double y, const Covariance& pixel) {
  const double share = long_share(pixel);
  if (share == 0) return short_mean(texels, x, y, pixel);
  const Rgba by_long = long_mean(texels, x, y, pixel);
  if (share == 1) return by_long;
  Rgba mean = short_mean(texels, x, y, pixel);
  for (std::size_t c = 0; c < 4; ++c) mean[c] += static_cast<float>(share) * (by_long[c] - mean[c]);
  return mean;
}

}  // namespace lensplane
