// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/sample_pattern.h"

#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "pipeline/composite/footprint.h"

namespace lensplane {
namespace {

constexpr int kBits = 6;  // kMostSamples = 2^kBits
static_assert(kMostSamples == 1 << kBits);

/// Van der Corput's sequence: the bits of i mirrored at the binary point.
std::uint32_t first_dimension(std::uint32_t i) {
  std::uint32_t mirrored = 0;
  for (int bit = 0; bit < kBits; ++bit) mirrored |= ((i >> bit) & 1U) << (kBits - 1 - bit);
  return mirrored;
}

/// Sobol's second dimension: its direction numbers are the rows of Pascal's triangle modulo 2.
std::uint32_t second_dimension(std::uint32_t i) {
  std::uint32_t sum = 0;
  for (std::uint32_t direction = 1U << (kBits - 1); i != 0; i >>= 1, direction ^= direction >> 1) {
    if (i & 1U) sum ^= direction;
  }
  return sum;
}

/// The normal distribution's quantile in the middle of stratum `k`.
double quantile(std::uint32_t k) {
  const double share = (k + 0.5) / kMostSamples;
  return std::sqrt(2.0) * boost::math::erf_inv(2.0 * share - 1.0);
}

std::array<SampleOffset, kMostSamples> make_offsets() {
  std::array<SampleOffset, kMostSamples> offsets{};
  double variance = 0;
  for (std::uint32_t k = 0; k < kMostSamples; ++k) variance += quantile(k) * quantile(k) / kMostSamples;
  // Points and the rays' own filters add up to the pixel filter in their variances.
  const double sigma = kPixelSigma * std::sqrt((1.0 - kSampleScale * kSampleScale) / variance);
  for (std::uint32_t i = 0; i < kMostSamples; ++i) {
    offsets[i] = {sigma * quantile(first_dimension(i)), sigma * quantile(second_dimension(i))};
  }
  return offsets;
}

}  // namespace

const std::array<SampleOffset, kMostSamples>& sample_offsets() {
  static const std::array<SampleOffset, kMostSamples> offsets = make_offsets();
  return offsets;
}

}  // namespace lensplane
