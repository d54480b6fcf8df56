// SPDX-License-Identifier: Apache-2.0

#include "src/map_coverage.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

#include "src/map_bands.h"
#include "tests/src/scenes.h"

namespace lensplane {
namespace {

constexpr double kSigma = 0.45;  // pixels

/// A square lattice of points weighted by how often it has them: 16 x 16 equal shares of a Gaussian.
FilmFilter gaussian() {
  constexpr int kSteps = 16;
  std::vector<double> quantiles;
  for (int i = 0; i < kSteps; ++i) {
    double low = -4, high = 4;  // by bisection of the normal distribution
    for (int n = 0; n < 50; ++n) {
      const double middle = (low + high) / 2;
      (std::erfc(-middle / std::sqrt(2.0)) / 2 < (i + 0.5) / kSteps ? low : high) = middle;
    }
    quantiles.push_back(low * kSigma);
  }
  FilmFilter filter;
  filter.sigma = kSigma;
  for (const double y : quantiles) {
    for (const double x : quantiles) filter.points.push_back({x, y});
  }
  std::stable_sort(filter.points.begin(), filter.points.end(), [](const FilmOffset& a, const FilmOffset& b) {
    return a.x * a.x + a.y * a.y > b.x * b.x + b.y * b.y;
  });
  filter.first = 16;
  return filter;
}

Scene one_surface(const Surface& surface, int width, int height) {
  Scene scene;
  scene.camera.width = width;
  scene.camera.height = height;
  scene.camera.fov_rad = 0.2;
  scene.surfaces = {surface};
  return scene;
}

Tracer tracer_of(const Scene& scene, const Effects& effects = {}) {
  TraceSettings settings;
  settings.effects = effects;
  return {scene, plan_trace(scene, settings)};
}

std::vector<LensMap> filtered(const Tracer& tracer) {
  std::vector<LensMap> maps = trace_maps(tracer);
  filter_coverage(tracer, gaussian(), ThinCoverage(tracer, kSigma), {0, tracer.camera().full_height()}, maps);
  return maps;
}

/// A ball of `radius` pixels before a camera of 60 x 60, its middle at `film` pixels.
Scene ball(double radius, FilmPosition film) {
  Scene scene = one_surface(Plate{}, 60, 60);
  const double per_pixel = 2 * std::tan(scene.camera.fov_rad / 2) / 60;
  const Vec3 towards = Vec3((film.x - 30) * per_pixel, (30 - film.y) * per_pixel, -1).normalized();
  scene.surfaces = {Sphere{towards * 1000.0, 1000.0 * std::sin(std::atan(radius * per_pixel)), {}}};
  return scene;
}

TEST(MapCoverage, OfABallIsItsShareOfThePixelFilter) {
  const FilmPosition middle{29.7, 30.4};
  constexpr double kRadius = 20;
  const LensMap map = filtered(tracer_of(ball(kRadius, middle))).front();
  double worst = 0, sum = 0;
  for (int row = 0; row < 60; ++row) {
    for (int column = 0; column < 60; ++column) {
      // Perspective draws balls off the axis a little out of round: far less than what is asked for.
      double right = 0, weights = 0;
      for (double y = -2; y <= 2; y += 0.05) {
        for (double x = -2; x <= 2; x += 0.05) {
          const double weight = std::exp(-(x * x + y * y) / (2 * kSigma * kSigma));
          weights += weight;
          if (std::hypot(column + 0.5 + x - middle.x, row + 0.5 + y - middle.y) < kRadius) right += weight;
        }
      }
      const double coverage = map.valid[static_cast<std::size_t>(row * 60 + column)];
      worst = std::max(worst, std::abs(coverage - right / weights));
      sum += coverage;
    }
  }
  EXPECT_LT(worst, 0.035);  // an upright edge is off by up to half of a column of points
  EXPECT_NEAR(sum / (kPi * kRadius * kRadius), 1, 0.002);
}

TEST(MapCoverage, LeavesWhatCentresSeeToTheLastBit) {
  Effects effects;
  effects.jacobian = effects.depth = effects.bends = true;
  const Tracer tracer = tracer_of(seed_fig6(80), effects);
  const LensMap before = trace_maps(tracer).front(), after = filtered(tracer).front();
  int fractional = 0;
  for (std::size_t i = 0; i < before.s.size(); ++i) {
    fractional += after.valid[i] > 0 && after.valid[i] < 1 ? 1 : 0;
    if (before.valid[i] == 0) continue;
    ASSERT_EQ(before.s[i], after.s[i]);
    ASSERT_EQ(before.t[i], after.t[i]);
    ASSERT_GT(after.valid[i], 0);
    for (std::size_t pass = 0; pass < before.passes.size(); ++pass)
      ASSERT_EQ(before.passes[pass].values[i], after.passes[pass].values[i]);
  }
  EXPECT_GT(fractional, 100);
}

TEST(MapCoverage, AMapWithoutEdgesTakesNoFurtherRays) {
  Scene scene = seed_fig6(80);
  scene.surfaces = {Plate{}, LatLong{}};
  for (Lens& lens : scene.lenses) lens.m /= 1e4;  // shadows between pixel centres
  const Tracer tracer = tracer_of(scene);
  std::vector<LensMap> maps = trace_maps(tracer);
  const std::vector<LensMap> before = maps;
  EXPECT_EQ(filter_coverage(tracer, gaussian(), {}, {0, 80}, maps), 4 * 80 + 4);  // just beyond the film
  for (std::size_t k = 0; k < maps.size(); ++k) EXPECT_EQ(maps[k].s, before[k].s);
}

/// Beyond the edge a map shows points that are seen at the edge: the ball's limb, whose picture is turned so
/// that the seam s = 0 = 1 and a pole lie on it.
TEST(MapCoverage, CoordinatesGoOnBeyondTheEdgeUnmixed) {
  Scene scene = ball(20, {30, 30});
  std::get<Sphere>(scene.surfaces[0]).axes = {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}};
  Effects effects;
  effects.jacobian = effects.depth = true;
  const Tracer tracer = tracer_of(scene, effects);
  const LensMap before = trace_maps(tracer).front(), after = filtered(tracer).front();
  const Sphere& sphere = std::get<Sphere>(scene.surfaces[0]);
  int extended = 0;
  for (int row = 0; row < 60; ++row) {
    for (int column = 0; column < 60; ++column) {
      const auto at = static_cast<std::size_t>(row * 60 + column);
      const double outside = std::hypot(column - 29.5, row - 29.5) - 20;
      if (outside > 5) {
        EXPECT_EQ(after.s[at] + after.t[at], 0) << column << ' ' << row;
      }
      if (before.valid[at] != 0 || outside > 1.9) continue;
      ++extended;
      const Vec3 point =
          sphere.centre +
          sphere.axes.parent_from_local(sphere_normal_from_st({after.s[at], after.t[at]})) * sphere.radius;
      const double per_pixel = 2 * std::tan(scene.camera.fov_rad / 2) / 60;
      const double x = 30 - point.x / point.z / per_pixel, y = 30 + point.y / point.z / per_pixel;
      EXPECT_LT(std::hypot(x - column - 0.5, y - row - 0.5), outside + 1.6) << column << ' ' << row;
      EXPECT_GT(std::hypot(x - 30, y - 30), 18.4) << column << ' ' << row;
      for (const Pass& pass : after.passes) {
        if (pass.channel != "depth.z") continue;
        EXPECT_NEAR(pass.values[at], point.length(), 0.2);
      }
    }
  }
  EXPECT_GT(extended, 200);
}

TEST(MapCoverage, SkyAndShadowShareThePixelsOfARim) {
  Scene scene = one_surface(LatLong{}, 60, 60);
  scene.lenses = {{1, {0, 0, -200}}};
  Effects effects;
  effects.shadow = true;
  const LensMap map = filtered(tracer_of(scene, effects)).front();
  int fractional = 0;
  for (std::size_t i = 0; i < map.valid.size(); ++i) {
    EXPECT_NEAR(map.valid[i] + map.passes[0].values[i], 1, 1e-6);
    fractional += map.valid[i] > 0.1F && map.valid[i] < 0.9F ? 1 : 0;
  }
  EXPECT_GT(fractional, 20);
}

TEST(MapCoverage, AFisheyesCircleHasASoftRim) {
  Scene scene = one_surface(LatLong{}, 60, 60);
  scene.camera.projection = Projection::Fisheye;
  scene.camera.fov_rad = 3.5;
  const LensMap map = filtered(tracer_of(scene)).front();
  double sum = 0;
  for (const float coverage : map.valid) sum += coverage;
  EXPECT_NEAR(sum / (kPi * 30 * 30), 1, 0.003);
  // Where the circle touches the film's border its neighbours lie outside: 30 - 30 cos(arcsin(4.5 / 30)) =
  // 0.34 pixels are left of column 25, whose centre sees the sky.
  EXPECT_NEAR(map.valid[59 * 60 + 25], std::erfc(-(0.5 - 0.34) / kSigma / std::sqrt(2.0)) / 2, 0.05);
}

/// The sum over all pixels is the ball's area on the film, wherever between pixels it stands.
TEST(MapCoverage, WhatIsThinnerThanAPixelKeepsItsArea) {
  for (const double radius : {0.05, 0.3, 0.45, 1.2}) {
    for (const double step : {0.0, 0.13, 0.5, 0.77}) {
      const LensMap map = filtered(tracer_of(ball(radius, {30 + step, 29.6 - step / 2}))).front();
      double sum = 0;
      for (std::size_t i = 0; i < map.valid.size(); ++i) {
        sum += map.valid[i];
        EXPECT_TRUE(map.valid[i] == 0 || map.s[i] + map.t[i] != 0);
      }
      EXPECT_NEAR(sum / (kPi * radius * radius), 1, 0.02) << radius << ' ' << step;
    }
  }
}

TEST(MapCoverage, ARingThinnerThanAPixelIsNoRowOfDashes) {
  Scene scene = one_surface(Plate{}, 60, 60);
  const double pixel = 2 * std::tan(scene.camera.fov_rad / 2) / 60 * 1000;
  const double inner = 19.6 * pixel, outer = 19.9 * pixel;
  // Its normal looks at the camera.
  scene.surfaces = {Ring{{0, 0, -1000}, {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}, inner, outer, 0}};
  const LensMap map = filtered(tracer_of(scene)).front();
  double sum = 0;
  for (const float coverage : map.valid) sum += coverage;
  EXPECT_NEAR(sum / (kPi * (19.9 * 19.9 - 19.6 * 19.6)), 1, 0.02);
  for (int column = 20; column < 40;
       ++column) {  // across the upper part each column sees as much as the slope says
    double seen = 0;
    for (int row = 0; row < 25; ++row) seen += map.valid[static_cast<std::size_t>(row * 60 + column)];
    const double x = column + 0.5 - 30;
    EXPECT_NEAR(seen / (std::sqrt(19.9 * 19.9 - x * x) - std::sqrt(19.6 * 19.6 - x * x)), 1, 0.06) << column;
  }
}

TEST(MapCoverage, DoesNotDependOnThreads) {
  const Tracer tracer = tracer_of(seed_fig6(100));
  const auto with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return std::move(filtered(tracer).front());
  };
  const LensMap one = with(1), many = with(5);
  EXPECT_EQ(one.s, many.s);
  EXPECT_EQ(one.t, many.t);
  EXPECT_EQ(one.valid, many.valid);
}

}  // namespace
}  // namespace lensplane
