// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/short_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "pipeline/composite/local_range.h"
#include "pipeline/composite/surface_kernel.h"
#include "pipeline/composite/weighted_sum.h"
#include "src/batch.h"
#include "src/inlining.h"

namespace lensplane {
namespace {

/// A place on a line, in standard deviations, and what it weighs.
struct Node {
  double place, weight;
};
constexpr std::array kOne = {Node{0, 1}};
constexpr std::array kThree = {Node{-1.732050807568877, 1.0 / 6}, Node{0, 2.0 / 3},
                               Node{1.732050807568877, 1.0 / 6}};
constexpr std::array kFour = {
    Node{-2.334414218338977, 0.045875854768068}, Node{-0.741963784302725, 0.454124145231932},
    Node{0.741963784302725, 0.454124145231932}, Node{2.334414218338977, 0.045875854768068}};
constexpr std::array kEight = {
    Node{-4.144547186125894, 0.000112614538375}, Node{-2.802485861287542, 0.009635220120788},
    Node{-1.636519042435108, 0.117239907661759}, Node{-0.539079811351375, 0.373012257679077},
    Node{0.539079811351375, 0.373012257679077},  Node{1.636519042435108, 0.117239907661759},
    Node{2.802485861287542, 0.009635220120788},  Node{4.144547186125894, 0.000112614538375}};

// Up to these leanings one, three and four nodes do.
constexpr double kLeaningOfOne = 1e-7, kLeaningOfThree = 0.08, kLeaningOfFour = 0.2;

/// |correlation|.
double correlation(const Covariance& pixel) {
  const double both = pixel.xx * pixel.yy;
  return both > 0 ? std::min(1.0, std::abs(pixel.xy) / std::sqrt(both)) : 0.0;
}

int by_eights(int count) {
  return (count + Taps::kCount - 1) / Taps::kCount * Taps::kCount;
}

/// Along one axis: the texels that count, and what each weighs about every node.
template <std::size_t kNodes>
class NodeTaps {
 public:
  int first, last;
  int around, end;  // of those that limit the colour

  /// `step`: from the middle to a place of 1. `weighs`: whether the nodes' weights are in the texels' ones.
  LENSPLANE_ALWAYS_INLINE NodeTaps(const SurfaceKernel& kernel, double variance, double middle, double step,
                                   const std::array<Node, kNodes>& nodes, bool weighs) {
    const double reach = kernel.reach() + std::abs(step) * nodes.back().place;
    const LocalRange::Width width = LocalRange::width(variance);
    around = static_cast<int>(std::floor(middle)) - width.before;
    end = around + 2 * width.pairs;
    first = std::min(around, static_cast<int>(std::ceil(middle - reach)));
    last = std::max(end - 1, static_cast<int>(std::floor(middle + reach)));
    for (std::size_t q = 0; q < kNodes; ++q) {
      const double place = middle + step * nodes[q].place, before = std::floor(place);
      const Taps taps = kernel.taps(static_cast<float>(place - before));
      const int start = static_cast<int>(before) + SurfaceKernel::kFirstTap - first + kPad;
      std::fill_n(&weights_[q][kPad], kMost, 0.0F);
      const auto by = static_cast<float>(weighs ? nodes[q].weight : 1.0);
      for (int n = 0; n < Taps::kCount; ++n) weights_[q][start + n] = by * taps.weight[n];
    }
  }

  LENSPLANE_ALWAYS_INLINE const float* from(std::size_t q, int texel) const {
    return &weights_[q][texel - first + kPad];
  }
  LENSPLANE_ALWAYS_INLINE Float8 eight_from(std::size_t q, int texel) const {
    Float8 eight;
    std::memcpy(&eight, from(q, texel), sizeof eight);
    return eight;
  }

 private:
  static constexpr int kPad = Taps::kCount, kMost = 2 * Taps::kCount;
  float weights_[kNodes][kPad + kMost + Taps::kCount];
};

template <std::size_t kNodes>
LENSPLANE_ALWAYS_INLINE inline Rgba mean_over(Texels& texels, double x, double y, const Covariance& pixel,
                                              double leaning_share, const std::array<Node, kNodes>& nodes) {
  const double straight = 1 - leaning_share;
  const NodeTaps<kNodes> columns(SurfaceKernel(straight * pixel.xx), pixel.xx, x,
                                 std::sqrt(leaning_share * pixel.xx), nodes, false);
  const NodeTaps<kNodes> rows(SurfaceKernel(straight * pixel.yy), pixel.yy, y,
                              std::copysign(std::sqrt(leaning_share * pixel.yy), pixel.xy), nodes, true);
  const int count = by_eights(columns.last - columns.first + 1);
  const int pairs = (columns.end - columns.around) / 2;
  EightsSum sum;
  LocalRange range;
  for (int row = rows.first; row <= rows.last; ++row) {
    const Rgba* texel = texels.row(0, columns.first, row, count);
    for (int n = 0; n < count; n += Taps::kCount) {
      Float8 weights{};
      for (std::size_t q = 0; q < kNodes; ++q) {
        weights += *rows.from(q, row) * columns.eight_from(q, columns.first + n);
      }
      sum.add(weights, texel + n);
    }
    if (row >= rows.around && row < rows.end) range.add(texel + (columns.around - columns.first), pairs);
  }
  const Rgba mean = sum.sum().mean_or([&] { return texels.nearest(0, x, y); });
  return range.limited(mean);
}

}  // namespace

double leaning(const Covariance& pixel) {
  return correlation(pixel) * (pixel.xx + pixel.yy);
}

LENSPLANE_KERNEL Rgba short_mean(Texels& texels, double x, double y, const Covariance& pixel) {
  const double share = correlation(pixel), leans = share * (pixel.xx + pixel.yy);
  if (leans < kLeaningOfOne) return mean_over(texels, x, y, pixel, 0, kOne);
  if (leans < kLeaningOfThree) return mean_over(texels, x, y, pixel, share, kThree);
  return leans < kLeaningOfFour ? mean_over(texels, x, y, pixel, share, kFour)
                                : mean_over(texels, x, y, pixel, share, kEight);
}

}  // namespace lensplane
