// SPDX-License-Identifier: Apache-2.0

#include "src/accuracy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "src/constants.h"
#include "tests/src/film.h"

namespace lensplane {
namespace {

/// Two traces of the same rays, of which the second is seen by a camera that looks `shift_px` pixels aside.
struct TwoTraces {
  Scene scene;
  Tracer tracer;
  TraceBatch a, b;
};

TwoTraces two_traces(const Surface& surface, double shift_px) {
  Scene scene;
  scene.camera = test_camera(0.1);
  scene.camera.axes = basis_from_zxy({0.3, 1, 0.2});  // not along the world's axes
  scene.camera.position = {5, 6, 7};
  scene.surfaces = {surface};
  TraceSettings settings;
  settings.effects.direction = true;
  TwoTraces traces{scene, Tracer(scene, plan_trace(scene, settings)), {}, {}};
  traces.a = traces.tracer.make_batch();
  traces.b = traces.tracer.make_batch();
  for (int i = 0; i < kBatchSize; ++i) {
    traces.a.x[i] = 960 + 0.3 * i;
    traces.b.x[i] = traces.a.x[i] + shift_px;
    traces.a.y[i] = traces.b.y[i] = 540 - 0.2 * i;
  }
  traces.tracer.trace(traces.a);
  traces.tracer.trace(traces.b);
  return traces;
}

Vec3 ahead(double distance) {
  return Vec3(5, 6, 7) - basis_from_zxy({0.3, 1, 0.2}).z * distance;
}

TEST(Accuracy, APixelAsideIsAPixelOnEverySurface) {
  const Basis turned = basis_from_zxy({0.7, -0.4, 0.1});
  const Basis facing = parent_from_local(basis_from_zxy({0.3, 1, 0.2}), basis_from_zxy({kPi / 2, 0, 0}));
  for (const Surface& surface :
       {Surface(LatLong{}), Surface(Plate{}), Surface(Card{50}), Surface(Sphere{ahead(100), 30, turned}),
        Surface(Ring{ahead(100), facing, 0, 90})}) {
    const TwoTraces traces = two_traces(surface, 1.0);
    for (std::size_t i = 0; i < kBatchSize; ++i) {
      const RayError error = error_of_ray(traces.tracer, traces.a, traces.b, i);
      ASSERT_TRUE(error.compared) << surface.index();
      ASSERT_FALSE(error.validity_differs);
      // Off the axis of a flat film a pixel is a little less of an angle.
      EXPECT_NEAR(error.px, 1.0, 1e-3) << surface.index() << " " << i;
    }
  }
}

TEST(Accuracy, FarApartItIsStillTheAngle) {
  Scene scene;
  scene.camera.projection = Projection::LatLong;
  scene.camera.width = 360;  // a pixel is a degree
  scene.camera.height = 180;
  scene.surfaces = {LatLong{}};
  const Tracer tracer(scene, plan_trace(scene, TraceSettings{}));
  TraceBatch a = tracer.make_batch(), b = tracer.make_batch();
  for (int i = 0; i < kBatchSize; ++i) {
    a.x[i] = 100, b.x[i] = 100 + 1.25 * i;
    a.y[i] = b.y[i] = 90;
  }
  tracer.trace(a);
  tracer.trace(b);
  for (std::size_t i = 0; i < kBatchSize; ++i)
    EXPECT_NEAR(error_of_ray(tracer, a, b, i).px, 1.25 * static_cast<double>(i), 1e-9);
  b.surfaces[0].s[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error_of_ray(tracer, a, b, 3).px, std::numeric_limits<double>::infinity());
}

TEST(Accuracy, SaysWhereOnlyOneIsValid) {
  const TwoTraces traces = two_traces(Sphere{ahead(100), 0.2, {}}, 500);
  const RayError error = error_of_ray(traces.tracer, traces.a, traces.b, 0);
  EXPECT_FALSE(error.compared);
  EXPECT_TRUE(error.validity_differs);
  EXPECT_FALSE(error.captured_differs);
}

TEST(Accuracy, SummaryCountsByRank) {
  std::vector<RayError> errors;
  for (int i = 0; i < 200; ++i) errors.push_back({true, false, false, 0.001 * (199 - i)});
  errors.push_back({false, true, true, 0});
  errors.push_back({false, false, false, 0});
  const ErrorSummary summary = summary_of(errors);
  EXPECT_EQ(summary.rays, 201U);  // without the one that sees nothing
  EXPECT_EQ(summary.compared, 200U);
  EXPECT_DOUBLE_EQ(summary.median_px, 0.099);
  EXPECT_DOUBLE_EQ(summary.p99_px, 0.197);
  EXPECT_DOUBLE_EQ(summary.most_px, 0.199);
  EXPECT_EQ(summary.worst, 0U);
  EXPECT_DOUBLE_EQ(summary.share_seen, 99.0 / 201);
  EXPECT_DOUBLE_EQ(summary.share_validity_differs, 1.0 / 201);
  EXPECT_EQ(summary.captured_differs, 1U);
  EXPECT_EQ(summary.judged_px(), summary.p99_px);
}

TEST(Accuracy, WhatCannotBeComparedCountsAsWrong) {
  std::vector<RayError> errors(98, {true, false, false, 0.01});
  errors.push_back({false, true, false, 0});
  EXPECT_EQ(summary_of(errors).judged_px(), std::numeric_limits<double>::infinity());
  errors.resize(98);
  errors.insert(errors.end(), 2, {true, true, false, 0.02});  // of one of several layers
  EXPECT_EQ(summary_of(errors).judged_px(), std::numeric_limits<double>::infinity());
  errors.back().validity_differs = false;
  EXPECT_EQ(summary_of(errors).judged_px(), 0.02);
}

TEST(Accuracy, SummaryOfNothingIsNothing) {
  const ErrorSummary summary = summary_of({{false, true, false, 0}});
  EXPECT_EQ(summary.compared, 0U);
  EXPECT_EQ(summary.most_px, 0);
  EXPECT_EQ(summary.share_validity_differs, 1);
  EXPECT_EQ(summary.judged_px(), std::numeric_limits<double>::infinity());
  EXPECT_EQ(summary_of({}).share_seen, 0);
}

}  // namespace
}  // namespace lensplane
