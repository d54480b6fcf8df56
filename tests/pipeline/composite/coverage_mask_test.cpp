// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/coverage_mask.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "pipeline/composite/sample_pattern.h"

namespace lensplane {
namespace {

/// A map of 3 x 3 pixels of which the filter sees the half of the film that lies more than `edge` pixels from
/// its middle in a direction.
StMap half_plane(double edge, double angle, double sigma = kPixelSigma) {
  StMap map{{3, 3, 0, 0, 3, 3}, false, {}, {}, {}};
  map.s.assign(9, 0.5F), map.t.assign(9, 0.5F);
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      const double inside = x * std::cos(angle) + y * std::sin(angle) - edge;
      map.coverage.push_back(static_cast<float>(std::erfc(-inside / sigma / std::numbers::sqrt2) / 2));
    }
  }
  return map;
}

double sum_of(const CoverageMask& mask) {
  return std::accumulate(mask.begin(), mask.end(), 0.0);
}

TEST(CoverageMask, IsTheHalfThatTheEdgeLeaves) {
  for (const double angle : {0.0, 0.7, 2.0, -1.5, 3.1}) {
    for (const double edge : {-0.8, -0.3, 0.0, 0.2, 0.6}) {
      const StMap map = half_plane(edge, angle);
      const CoverageMask mask = coverage_mask(map, 1, 1);
      EXPECT_NEAR(sum_of(mask) / 64, map.coverage[4], 1e-6);
      const FilmFilter filter = coverage_filter();
      double wrong = 0;
      for (std::size_t i = 0; i < mask.size(); ++i) {
        const FilmOffset& p = filter.points[i];
        wrong += std::abs(mask[i] - (p.x * std::cos(angle) + p.y * std::sin(angle) > edge ? 1 : 0));
      }
      EXPECT_LT(wrong / 64, 0.05) << angle << ' ' << edge;
    }
  }
}

TEST(CoverageMask, WhereNothingTellsTheEdgeAllPartsAreCoveredAlike) {
  StMap thin = half_plane(0, 0);
  thin.coverage = {0, 0.3F, 0, 0, 0.3F, 0, 0, 0.3F, 0};  // a thread
  EXPECT_EQ(coverage_mask(thin, 1, 1), CoverageMask(64, 0.3F));
  const StMap soft = half_plane(0, 0.3, 4);  // somebody's gradient
  EXPECT_EQ(coverage_mask(soft, 1, 1), CoverageMask(64, soft.coverage[4]));
  EXPECT_EQ(coverage_mask(half_plane(-9, 0), 1, 1), CoverageMask(64, 1));
  EXPECT_EQ(coverage_mask(half_plane(9, 0), 1, 1), CoverageMask(64, 0));
}

/// The middle and the width of a Gaussian cut by an edge have closed forms.
TEST(CoverageMask, TheCoveredPartIsWhereTheCutFilterIs) {
  const MapPlace pixel{{0.5, 0.5}, {.ds_dx = 0.01, .ds_dy = 0.002, .dt_dx = -0.001, .dt_dy = -0.02}};
  for (const double edge : {-0.7, -0.2, 0.0, 0.4}) {
    const StMap map = half_plane(edge, 0);
    const MapPlace part = covered_part(pixel, coverage_mask(map, 1, 1), map.coverage[4]);
    const double z = edge / kPixelSigma;
    const double hazard = std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi) / map.coverage[4];
    const double narrower = std::sqrt(1 + z * hazard - hazard * hazard);
    const bool at_centre = edge < 0 && map.coverage[4] > 0.5F;
    EXPECT_NEAR(part.st.s - 0.5, at_centre ? 0.01 * kPixelSigma * hazard : 0, 0.0005) << edge;
    EXPECT_NEAR(part.st.t - 0.5, at_centre ? -0.001 * kPixelSigma * hazard : 0, 0.001) << edge;
    EXPECT_NEAR(part.footprint.ds_dx / 0.01, narrower, 0.08) << edge;
    EXPECT_NEAR(part.footprint.dt_dy / -0.02, 1, 0.02) << edge;
  }
}

TEST(CoverageMask, PartsThatAreCoveredAlikeAreThePixel) {
  const MapPlace pixel{{0.5, 0.5}, {.ds_dx = 0.01, .dt_dy = -0.02}};
  const MapPlace part = covered_part(pixel, CoverageMask(64, 0.7F), 0.7F);
  EXPECT_NEAR(part.st.s, 0.5, 1e-9);
  EXPECT_NEAR(part.footprint.ds_dx, 0.01, 1e-9);
}

}  // namespace
}  // namespace lensplane
