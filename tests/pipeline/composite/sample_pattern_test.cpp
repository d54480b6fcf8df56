// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/sample_pattern.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "pipeline/composite/footprint.h"

namespace lensplane {
namespace {

// The points are computed by sums of 64 doubles.
constexpr double kRounding = 1e-12;

// How far the 64 points are from being round: their correlation.
constexpr double kSlant = 0.05;

/// The standard deviation of the normal distribution whose quantiles the points are: their quantiles stand in
/// the middles of 64 equal shares, so the outermost lies at that of 1/128, which is 2.417559016 sigma out.
double sigma_of_points() {
  double farthest = 0;
  for (const SampleOffset& offset : sample_offsets()) farthest = std::max(farthest, offset.x);
  return farthest / 2.417559016236505;
}

/// Which of `count` equal shares of the normal distribution a coordinate lies in.
int stratum(double coordinate, double sigma, int count) {
  const double share = 0.5 * std::erfc(-coordinate / (sigma * std::sqrt(2.0)));
  return static_cast<int>(share * count);
}

/// The cells of a lattice of `columns` x `rows` strata that the points `first` and on, `count` of them, meet.
std::size_t cells_met(int first, int count, int columns, int rows) {
  const double sigma = sigma_of_points();
  std::set<std::pair<int, int>> cells;
  for (int i = first; i < first + count; ++i) {
    const SampleOffset& offset = sample_offsets()[static_cast<std::size_t>(i)];
    cells.insert({stratum(offset.x, sigma, columns), stratum(offset.y, sigma, rows)});
  }
  return cells.size();
}

TEST(SamplePattern, EveryPartIsStratifiedInBothDimensionsAndInCells) {
  for (const int count : {4, 16, 64}) {
    for (int first = 0; first < kMostSamples; first += count) {
      const auto all = static_cast<std::size_t>(count);
      EXPECT_EQ(cells_met(first, count, count, 1), all) << count << " from " << first;
      EXPECT_EQ(cells_met(first, count, 1, count), all) << count << " from " << first;
      // Powers of two along both: Sobol's points are a (0, m, 2)-net.
      for (int columns = 2; columns < count; columns *= 2) {
        EXPECT_EQ(cells_met(first, count, columns, count / columns), all) << count << " from " << first;
      }
    }
  }
  // What does not begin at a multiple is not.
  EXPECT_LT(cells_met(2, 16, 4, 4), 16U);
  EXPECT_LT(cells_met(1, 4, 1, 4), 4U);
}

TEST(SamplePattern, IsAsWideAsThePixelFilterTogetherWithTheRays) {
  double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  for (const SampleOffset& offset : sample_offsets()) {
    x += offset.x / kMostSamples, y += offset.y / kMostSamples;
    xx += offset.x * offset.x / kMostSamples, yy += offset.y * offset.y / kMostSamples;
    xy += offset.x * offset.y / kMostSamples;
  }
  EXPECT_NEAR(x, 0, kRounding);
  EXPECT_NEAR(y, 0, kRounding);
  const double filter = kPixelSigma * kPixelSigma, of_a_ray = kSampleScale * kSampleScale * filter;
  EXPECT_NEAR(xx + of_a_ray, filter, kRounding);
  EXPECT_NEAR(yy + of_a_ray, filter, kRounding);
  EXPECT_NEAR(xy / filter, 0, kSlant);
}

struct EdgeErrors {
  double worst, rms;
};

/// How far the share of `count` points from `first` on, on one side of a straight edge, is from the pixel
/// filter's: at most, and root mean square over the filter's light, over all slopes and places.
EdgeErrors edge_errors(int first, int count) {
  EdgeErrors errors{0, 0};
  constexpr int kSlopes = 720;
  for (int slope = 0; slope < kSlopes; ++slope) {
    const double angle = (slope + 0.5) * std::numbers::pi / kSlopes;
    std::vector<double> shares;  // of the filter, up to each point
    for (int i = first; i < first + count; ++i) {
      const SampleOffset& p = sample_offsets()[static_cast<std::size_t>(i)];
      const double along = p.x * std::cos(angle) + p.y * std::sin(angle);
      shares.push_back(0.5 * std::erfc(-along / (kPixelSigma * std::sqrt(2.0))));
    }
    std::sort(shares.begin(), shares.end());
    shares.push_back(1);
    double from = 0;
    for (int passed = 0; passed <= count; ++passed) {
      const double share = static_cast<double>(passed) / count;
      const double to = shares[static_cast<std::size_t>(passed)];
      errors.worst = std::max({errors.worst, std::abs(from - share), std::abs(to - share)});
      errors.rms += (std::pow(to - share, 3) - std::pow(from - share, 3)) / (3 * kSlopes);
      from = to;
    }
  }
  errors.rms = std::sqrt(errors.rms);
  return errors;
}

TEST(SamplePattern, SharesOutStraightEdgesOfAnySlope) {
  const EdgeErrors all = edge_errors(0, kMostSamples);
  EXPECT_LT(all.worst, kWorstEdgeError);
  EXPECT_GT(all.worst, 0.9 * kWorstEdgeError);
  EXPECT_LT(all.rms, 0.015);
  for (int first = 0; first < kMostSamples; first += kFirstSamples) {
    EXPECT_LT(edge_errors(first, kFirstSamples).rms, kFirstEdgeError) << first;
  }
  // In the shutter's instants edges get four points each.
  for (int first = 0; first < kMostSamples; first += 4) EXPECT_LT(edge_errors(first, 4).worst, 0.46) << first;
}

}  // namespace
}  // namespace lensplane
