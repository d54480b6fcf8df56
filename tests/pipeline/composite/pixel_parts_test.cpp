// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/pixel_parts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace lensplane {
namespace {

constexpr int kTexels = 512;

/// A map of the film around (0, 0), and its Jacobian.
struct QuadraticMap {
  double s, t;
  Footprint slope;
  Bend bend;

  SeenPoint at(double x, double y) const {
    SeenPoint point{true, 1, {s, t}, slope};
    Footprint& f = point.footprint;
    point.st.s +=
        slope.ds_dx * x + slope.ds_dy * y + 0.5 * (bend.s_xx * x * x + bend.s_yy * y * y) + bend.s_xy * x * y;
    point.st.t +=
        slope.dt_dx * x + slope.dt_dy * y + 0.5 * (bend.t_xx * x * x + bend.t_yy * y * y) + bend.t_xy * x * y;
    f.ds_dx += bend.s_xx * x + bend.s_xy * y;
    f.ds_dy += bend.s_xy * x + bend.s_yy * y;
    f.dt_dx += bend.t_xx * x + bend.t_xy * y;
    f.dt_dy += bend.t_xy * x + bend.t_yy * y;
    return point;
  }
};

/// `per_pixel` texels to the pixel, bent by `share` of that from pixel to pixel.
QuadraticMap map_of(double s, double per_pixel, double share) {
  const double slope = per_pixel / kTexels, bend = share * slope;
  return {s, 0.5, {slope, 0, 0, -slope}, {bend, 0, -0.3 * bend, 0, 0.2 * bend, 0}};
}

std::shared_ptr<const Texture> texture_of(const std::function<Rgba(int column, int row)>& colour) {
  Picture picture{kTexels, kTexels, 0, 0, kTexels, kTexels, {}};
  for (int row = 0; row < kTexels; ++row) {
    for (int column = 0; column < kTexels; ++column) picture.pixels.push_back(colour(column, row));
  }
  return std::make_shared<const Texture>(std::move(picture), Wrap::Clamp);
}

/// Surfaces under maps, the first the farthest.
struct Pixel {
  std::vector<QuadraticMap> maps;
  std::vector<SurfaceLook> looks;
  std::vector<Surface> surfaces = std::vector<Surface>(maps.size(), Plate{});

  std::vector<SeenPoint> points(double x, double y) const {
    std::vector<SeenPoint> points;
    for (std::size_t k = 0; k < maps.size(); ++k) {
      points.push_back(maps[k].at(x, y));
      points.back().distance = 10.0 - static_cast<double>(k);
    }
    return points;
  }

  CentreGrid grid() const {
    CentreGrid grid(surfaces, 1, 1);
    for (int row = -1; row <= 1; ++row) {
      for (int column = -1; column <= 1; ++column) {
        const std::vector<SeenPoint> seen = points(column, row);
        std::copy(seen.begin(), seen.end(), grid.points(grid.place(column, row)).begin());
      }
    }
    return grid;
  }

  PixelKind kind() const {
    const CentreGrid centres = grid();
    return centres.kinds()[centres.place(0, 0)];
  }

  Rgba by_parts() const {
    Viewer viewer(surfaces, looks);
    return see_pixel(grid(), surfaces, 0, 0, kind(), viewer);
  }

  Rgba by_one_footprint() const {
    Viewer viewer(surfaces, looks);
    return viewer.see(points(0, 0), 1);
  }

  /// By very many points.
  Rgba reference() const {
    Viewer viewer(surfaces, looks);
    constexpr int kSteps = 150;
    constexpr double kReach = 4.5 * kPixelSigma;
    std::array<double, 4> sum{};
    double weights = 0;
    for (int j = -kSteps; j <= kSteps; ++j) {
      for (int i = -kSteps; i <= kSteps; ++i) {
        const double x = kReach * i / kSteps, y = kReach * j / kSteps;
        const double weight = std::exp(-0.5 * (x * x + y * y) / (kPixelSigma * kPixelSigma));
        const Rgba seen = viewer.see(points(x, y), 0);
        for (std::size_t c = 0; c < 4; ++c) sum[c] += weight * static_cast<double>(seen[c]);
        weights += weight;
      }
    }
    Rgba mean{};
    for (std::size_t c = 0; c < 4; ++c) mean[c] = static_cast<float>(sum[c] / weights);
    return mean;
  }
};

double off(const Rgba& a, const Rgba& b) {
  return std::abs(static_cast<double>(a[0]) - static_cast<double>(b[0]));
}

std::shared_ptr<const Texture> stripes() {
  return texture_of([](int column, int) {
    const float value = column / 8 % 2 == 0 ? 1.0F : 0.0F;
    return Rgba{value, value, value, 1};
  });
}

TEST(PixelParts, TogetherTheyAreThePixelFilter) {
  for (const std::span<const PixelPart> parts : {bent_parts(), veil_parts()}) {
    double sum = 0, mean = 0, variance = 0, fourth = 0;
    for (const PixelPart& part : parts) {
      const double x = part.x / kPixelSigma, own = part.scale * part.scale;
      sum += part.weight;
      mean += part.weight * x;
      variance += part.weight * (x * x + own);
      fourth += part.weight * (std::pow(x, 4) + 6 * x * x * own + 3 * own * own);
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_NEAR(mean, 0, 1e-12);
    EXPECT_NEAR(variance, 1, 1e-9);
    EXPECT_NEAR(fourth, 3, 0.25);
  }
}

TEST(PixelParts, DifferencesOfJacobiansAreSecondDerivatives) {
  const QuadraticMap map{0.3, 0.6, {0.01, 0.002, -0.003, 0.02}, {1e-3, 2e-3, -3e-3, 4e-3, -5e-3, 6e-3}};
  const Bend bend = bend_between(map.at(-1, 0).footprint, map.at(1, 0).footprint, map.at(0, -1).footprint,
                                 map.at(0, 1).footprint);
  EXPECT_NEAR(bend.s_xx, 1e-3, 1e-15);
  EXPECT_NEAR(bend.s_xy, 2e-3, 1e-15);
  EXPECT_NEAR(bend.s_yy, -3e-3, 1e-15);
  EXPECT_NEAR(bend.t_xx, 4e-3, 1e-15);
  EXPECT_NEAR(bend.t_xy, -5e-3, 1e-15);
  EXPECT_NEAR(bend.t_yy, 6e-3, 1e-15);
}

TEST(PixelParts, BentFootprintsSeeWhatManyRaysSee) {
  double worst = 0, worst_by_one = 0;
  for (int i = 0; i < 24; ++i) {
    const Pixel pixel{{map_of(0.4 + 0.0023 * i, 8, 0.5)}, {{stripes(), {}, {}, {}}}};
    const Rgba right = pixel.reference();
    worst = std::max(worst, off(pixel.by_parts(), right));
    worst_by_one = std::max(worst_by_one, off(pixel.by_one_footprint(), right));
  }
  EXPECT_LT(worst, 0.012);
  EXPECT_GT(worst_by_one, 0.04);  // what it is for
}

TEST(PixelParts, StraightFootprintsStayOne) {
  const Pixel straight{{map_of(0.41, 5, 0.8 * kMostBent)}, {{stripes(), {}, {}, {}}}};
  EXPECT_EQ(straight.kind(), PixelKind::Smooth);
  EXPECT_EQ(straight.by_parts(), straight.by_one_footprint());
  const Pixel bent{{map_of(0.41, 5, 1.5 * kMostBent)}, {{stripes(), {}, {}, {}}}};
  EXPECT_EQ(bent.kind(), PixelKind::Bent);
  EXPECT_NE(bent.by_parts(), bent.by_one_footprint());
}

TEST(PixelParts, ALineMayHideJustWhatLiesBehindIt) {
  // White lines on black, behind black lines on nothing that lie just before them, or beside them.
  const auto lines = texture_of([](int column, int) {
    const float value = column % 16 < 4 ? 1.0F : 0.0F;
    return Rgba{value, value, value, 1};
  });
  for (const int aside : {0, 4, 8}) {
    const auto veil = texture_of([&](int column, int) {
      return Rgba{0, 0, 0, (column + aside) % 16 < 4 ? 1.0F : 0.0F};
    });
    const Pixel pixel{{map_of(0.5, 5, 0), map_of(0.5, 5, 0)}, {{lines, {}, {}, {}}, {veil, {}, {}, {}}}};
    EXPECT_LT(off(pixel.by_parts(), pixel.reference()), 0.06) << aside;
    if (aside == 0) {
      EXPECT_GT(off(pixel.by_one_footprint(), pixel.reference()), 0.15);
    }
  }
}

TEST(PixelParts, EvenVeilsCostNothing) {
  const auto glass = texture_of([](int, int) { return Rgba{0.1F, 0.1F, 0.1F, 0.5F}; });
  const Pixel pixel{{map_of(0.5, 5, 0), map_of(0.5, 5, 0)}, {{stripes(), {}, {}, {}}, {glass, {}, {}, {}}}};
  EXPECT_EQ(pixel.by_parts(), pixel.by_one_footprint());
}

}  // namespace
}  // namespace lensplane
