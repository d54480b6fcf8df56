// SPDX-License-Identifier: Apache-2.0
//
// Hard cases of where masses stand: at and behind the camera, at one point, in line. See hard_cases_test.cpp.

#include <gtest/gtest.h>

#include <cmath>

#include "src/planes_march.h"
#include "tests/src/hard_cases.h"

namespace lensplane {
namespace {

TEST(HardCases, SourceAtTheCameraAndBehindIt) {
  EXPECT_TRUE(probed(view_of({{1e4, {0, 0, 0}}}), kMiddle).captured);
  EXPECT_TRUE(probed(view_of({{1e-20, {0, 0, 0}}}), {1, 1}).captured);
  expect_finite_maps(view_of({{1e4, {0, 0, 0}}}));
  expect_finite_maps(view_of({{1e4, {0, 0, 1e9}}}));
  // Straight behind, what little it bends (2 m b/r^2) widens the view.
  Scene behind = view_of({{1e4, {0, 0, 1e9}}});
  TraceSettings on;
  on.finite_distance = Choice::On;
  const Probe p = probe(behind, plan_trace(behind, on), {25.0, 7.5});
  EXPECT_FALSE(p.captured);
  const double theta = std::atan(12.5 * slope_per_pixel(behind.camera));
  EXPECT_NEAR(angle_between(p.first, p.last), 1e4 / 1e9 * std::sin(theta), 1e-2 * 1e-5);
}

TEST(HardCases, SourceCrossesTheCamerasPlaneFrameByFrame) {
  // With finite distance the picture goes on without a jump: neighbouring frames differ no more than their
  // neighbours do.
  TraceSettings on;
  on.finite_distance = Choice::On;
  const auto frame = [&](double z) {
    Scene scene = view_of({{1e4, {3e7, 1e6, z}}}, 100 * kDegree);
    return probe(scene, plan_trace(scene, on), {20.3, 6.1}).last;
  };
  const double step = 1e5;
  double before = angle_between(frame(-3 * step), frame(-2 * step));
  for (int k = -2; k < 3; ++k) {
    const double moved = angle_between(frame(k * step), frame((k + 1) * step));
    EXPECT_NEAR(moved, before, 0.05 * before) << k;
    before = moved;
  }
  EXPECT_LT(angle_between(frame(-1e-6), frame(1e-6)), 1e-12);
  for (const double z : {-1e-300, 0.0, 1e-300, -1.0, 1.0}) {
    expect_finite_maps(view_of({{1e4, {3e7, 1e6, z}}}, 100 * kDegree));
  }
}

TEST(HardCases, PlanesZeroOneUlpAnd1em15Apart) {
  const auto pair = [](double z) { return view_of({{1e4, {1e8, 0, -1e9}}, {2e4, {-1e8, 5e7, z}}}); };
  const Scene same = pair(-1e9);
  EXPECT_LT(largest_difference(same, pair(std::nextafter(-1e9, 0.0))), 1e-13);
  EXPECT_LT(largest_difference(same, pair(-1e9 * (1 + 1e-15))), 1e-13);
  // Two planes that are no longer one: the order of the bends begins to count, at second order in the bends.
  EXPECT_LT(largest_difference(same, pair(-1e9 * (1 + 1e-11))), 1e-5);
}

TEST(HardCases, ManyEqualSourcesAtOnePointAreOneOfTheirMass) {
  const Vec3 place(2e7, 1e7, -1e9);
  const Scene one = view_of({{1e4, place}});
  for (const int count : {1, 1000, 100000}) {
    const Scene many = view_of(std::vector<Lens>(static_cast<std::size_t>(count), Lens{1e4 / count, place}));
    EXPECT_LT(largest_difference(one, many), 1e-15) << count;
  }
#ifdef LENSPLANE_SANITIZE
  constexpr std::size_t kMany = 50;  // through the same code, in less than half a minute
#else
  constexpr std::size_t kMany = 1000;
#endif
  expect_finite_maps(view_of(std::vector<Lens>(kMany, Lens{10.0, place})));
}

TEST(HardCases, TwoSourcesOneBitApartAreOneOfTheirMass) {
  const Vec3 place(3.0, -2.0, -40.0);
  for (const Projection projection : {Projection::Perspective, Projection::LatLong, Projection::Fisheye}) {
    Scene one = view_of({{2.0, place}}, 60 * kDegree);
    one.camera.projection = projection;
    one.surfaces = {LatLong{}};
    for (const double towards : {0.0, 100.0, -100.0}) {
      const Vec3 near(std::nextafter(place.x, towards), std::nextafter(place.y, towards),
                      std::nextafter(place.z, towards));
      Scene two = one, turned = one;
      two.lenses = {{1.0, place}, {1.0, near}};
      turned.lenses = {{1.0, near}, {1.0, place}};
      EXPECT_EQ(largest_difference(two, turned), 0.0);
      // Close to the shadow, on both sides of the mass, as everywhere on the film.
      const Deflectors body = deflectors_of(one, Law::Exact, true),
                       pair = deflectors_of(two, Law::Exact, true);
      for (const double b_over_m : {-20.0, -6.0, -5.3, -4.0, 4.0, 5.3, 6.0, 20.0}) {
        const Vec3 aim = (place + Vec3(0.0, b_over_m * 2.0, 0.0)).normalized();
        const RayPath<double> a = march_planes<double>(body, aim), b = march_planes<double>(pair, aim);
        ASSERT_EQ(a.captured, b.captured) << b_over_m;
        EXPECT_LT(angle_between(a.segments.back().direction, b.segments.back().direction), 1e-13) << b_over_m;
      }
      EXPECT_LT(largest_difference(one, two), 1e-12);
    }
  }
}

TEST(HardCases, TwoSources1em9MetresApart) {
  const Scene one = view_of({{1e4, {0, 0, -1e9}}});
  const Scene two = view_of({{5e3, {0, 0, -1e9}}, {5e3, {1e-9, 0, -1e9}}});
  EXPECT_LT(largest_difference(one, two), 1e-15);
  expect_finite_maps(two);
  // Too light for their horizons to touch, they stay two; seen from afar there is no difference.
  const Scene light = view_of({{1e-12, {0, 0, -1e3}}, {1e-12, {1e-9, 0, -1e3}}});
  EXPECT_LT(largest_difference(view_of({{2e-12, {0, 0, -1e3}}}), light), 1e-15);
  expect_finite_maps(light);
}

TEST(HardCases, PerfectAlignmentGivesAnEvenRing) {
  // A sky point straight behind the mass: on the ring of the Einstein angle, at all angles, light comes from
  // there, equally magnified.
  const double m = 1e4, distance = 1e9;
  Scene scene = view_of({{m, {0, 0, -distance}}}, 3 * kDegree);
  scene.camera.width = scene.camera.height = 401;
  const Plan plan = planned(scene);
  const double theta = std::sqrt(4 * m / distance);  // near the ring of infinite magnification
  const double slope = slope_per_pixel(scene.camera);
  const auto at = [&](double angle) {
    const double radius = std::tan(theta) * 1.1 / slope;
    return probe(scene, plan, {200.5 + radius * std::cos(angle), 200.5 + radius * std::sin(angle)});
  };
  const Probe first = at(0.0);
  const double off_axis = angle_between(first.last, Vec3(0, 0, -1));
  for (double angle = 0.1; angle < 2 * kPi; angle += 0.1) {
    const Probe p = at(angle);
    EXPECT_NEAR(angle_between(p.last, Vec3(0, 0, -1)), off_axis, 1e-9 * theta) << angle;
    const double mu = first.surfaces[1].magnification;
    EXPECT_NEAR(p.surfaces[1].magnification, mu, 1e-9 * std::abs(mu)) << angle;
  }
  expect_finite_maps(view_of({{m, {0, 0, -distance}}}));
}

TEST(HardCases, BetweenTwoMassesInLineLightWindsAndIsSentBackAndForth) {
  // Light that all but winds round the far mass comes back to the camera, and the mass behind it.
  Scene scene = view_of({{1.0, {0, 0, -1000}}, {1.0, {0, 0, 15}}});
  scene.camera.projection = Projection::LatLong;
  scene.surfaces = {LatLong{}, Sphere{{0, 0, 40}, 5, {}}, Sphere{{300, 0, 0}, 100, {}}};
  constexpr double kAngle = 0.0049056575377135628;
  const Deflectors exact = deflectors_of(scene, Law::Exact, true);
  const RayPath<double> path = march_planes<double>(exact, Vec3(std::sin(kAngle), 0, -std::cos(kAngle)));
  EXPECT_TRUE(path.captured);  // one and a half turns round the far mass, then straight into the near one
  EXPECT_EQ(path.bends, 2);
  for (const RaySegment<double>& segment : path.segments) {
    for (const Vec3& v : {segment.start, segment.direction}) EXPECT_TRUE(std::isfinite(v.x + v.y + v.z));
  }
  for (const Passage<double>& p : path.passages) EXPECT_TRUE(std::isfinite(p.b + p.alpha + p.path));

  // The same on the film, bit by bit around it, and in batches.
  TraceSettings settings = with_everything(Method::Planes);
  settings.law = Law::Exact;
  const Tracer tracer(scene, plan_trace(scene, settings));
  TraceBatch batch = tracer.make_batch();
  const double x = scene.camera.width * (0.5 + kAngle / (2 * kPi));
  for (int i = 0; i < kBatchSize; ++i) {
    batch.x[i] = x * (1 + (i - 64) * 2.3e-16);
    batch.y[i] = 7.5;
  }
  tracer.trace(batch);
  for (const SurfaceBatch& surface : batch.surfaces) {
    const PassBatch& p = *surface.passes;
    for (int i = 0; i < kBatchSize; ++i) {
      EXPECT_TRUE(std::isfinite(surface.s[i] + surface.t[i] + p.ds_dx[i] + p.ds_dy[i] + p.dt_dx[i] +
                                p.dt_dy[i] + p.magnification[i] + p.delay[i] + p.dir_x[i] + p.dir_y[i] +
                                p.dir_z[i]))
          << batch.x[i];
    }
  }
  expect_finite_maps(scene);
}

}  // namespace
}  // namespace lensplane
