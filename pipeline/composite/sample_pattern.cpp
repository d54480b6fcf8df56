// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/sample_pattern.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "pipeline/composite/footprint.h"
#include "pipeline/composite/normal_distribution.h"

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

/// Owen's scrambling keeps every stratum of the points and moves them within. Of each number's bits some are
/// turned over, which ones depends on the bits before: bit 2^n + p of the word is for the n-th bit of those
/// numbers that begin with the n bits p. These two words are found by annealing, for the least error at
/// straight edges of any slope, and by a small weight also for that of every sixteen and every four.
constexpr std::uint64_t kTurnedFirst = 0x66f9b27f5555a7cc, kTurnedSecond = 0x6f46a32a72aa1832;

std::uint32_t scrambled(std::uint32_t number, std::uint64_t turned) {
  std::uint32_t result = 0;
  for (int n = 0; n < kBits; ++n) {
    const std::uint32_t before = number >> (kBits - n);
    const auto turn = static_cast<std::uint32_t>(turned >> ((1U << n) + before)) & 1U;
    result = result << 1 | (((number >> (kBits - 1 - n)) & 1U) ^ turn);
  }
  return result;
}

/// The normal distribution's quantile in the middle of stratum `k`.
double quantile(std::uint32_t k) {
  return normal_quantile((k + 0.5) / kMostSamples);
}

std::array<SampleOffset, kMostSamples> make_offsets() {
  std::array<SampleOffset, kMostSamples> offsets{};
  double variance = 0;
  for (std::uint32_t k = 0; k < kMostSamples; ++k) variance += quantile(k) * quantile(k) / kMostSamples;
  // Points and the rays' own filters add up to the pixel filter in their variances.
  const double sigma = kPixelSigma * std::sqrt((1.0 - kSampleScale * kSampleScale) / variance);
  for (std::uint32_t i = 0; i < kMostSamples; ++i) {
    offsets[i] = {sigma * quantile(scrambled(first_dimension(i), kTurnedFirst)),
                  sigma * quantile(scrambled(second_dimension(i), kTurnedSecond))};
  }
  return offsets;
}

}  // namespace

const std::array<SampleOffset, kMostSamples>& sample_offsets() {
  static const std::array<SampleOffset, kMostSamples> offsets = make_offsets();
  return offsets;
}

FilmFilter coverage_filter() {
  FilmFilter filter;
  filter.sigma = kPixelSigma;
  filter.first = kMostSamples / 4;
  const double wider = 1.0 / std::sqrt(1.0 - kSampleScale * kSampleScale);
  for (const SampleOffset& offset : sample_offsets())
    filter.points.push_back({offset.x * wider, offset.y * wider});
  std::stable_sort(filter.points.begin(), filter.points.end(), [](const FilmOffset& a, const FilmOffset& b) {
    return a.x * a.x + a.y * a.y > b.x * b.x + b.y * b.y;
  });
  return filter;
}

}  // namespace lensplane
