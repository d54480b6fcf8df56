// SPDX-License-Identifier: Apache-2.0
//
// Hard cases: scenes in which tracers break. Each has its outcome, stated in docs/numerics.md; and by every
// method, with every effect, every value of every map is finite.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "src/march.h"
#include "src/planes_march.h"
#include "tests/src/hard_cases.h"

namespace lensplane {
namespace {

TEST(HardCases, PixelCentreExactlyOnASource) {
  const Scene scene = view_of({{1e4, {0, 0, -1e9}}});
  EXPECT_TRUE(probed(scene, kMiddle).captured);
  for (const MethodName& entry : kMethodNames) {
    EXPECT_TRUE(probe(scene, plan_trace(scene, entry.method), kMiddle).captured) << entry.name;
  }
  expect_finite_maps(scene);
}

TEST(HardCases, ImpactParametersFrom1em300To1e300) {
  for (const LawEntry& law : kLaws) {
    for (int exponent = -300; exponent <= 300; exponent += 4) {
      for (const double m_over_b : {1e-30, 1e-9, 1e-3, 0.1, 0.19, 0.2, 10.0}) {
        const double b = std::pow(10.0, exponent);
        const Deflector deflector{m_over_b * b, Vec3(0), law.law};
        if (deflector.m < std::numeric_limits<double>::min()) continue;  // lighter than numbers can be
        const auto bend = bend_by<double>(deflector, b, std::nullopt);
        ASSERT_EQ(bend.has_value(), m_over_b < 1.0 / kCriticalRatio) << b << " " << m_over_b;
        if (!bend) continue;
        const double expected = law.deflection(m_over_b, 1.0).alpha;
        ASSERT_NEAR(bend->alpha, expected, 1e-12 * expected) << b << " " << m_over_b;
      }
    }
  }
}

TEST(HardCases, AnglesFrom1em18ToManyTurns) {
  // The mass for each angle, at 1e9 m and sideways 1e7 m; the direction turns by just that.
  for (const double alpha : {1e-18, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 0.1}) {
    const double b = 1e7;
    Scene scene = view_of({{alpha * b / 4.0, {b, 0, -1e9}}}, 1e-3 * kDegree);
    TraceSettings weak;
    weak.law = Law::Weak;
    weak.finite_distance = Choice::Off;
    const Probe p = probe(scene, plan_trace(scene, weak), kMiddle);
    EXPECT_NEAR(std::atan2(p.last.x, -p.last.z), alpha, 1e-15 * alpha + 1e-4 * alpha * alpha) << alpha;
    expect_finite_maps(scene);
  }
  // Ever nearer to b_c light winds round the mass, up to the last bit: some six turns.
  double turns = 0.0;
  for (double above = 1e-1; above > 2e-16; above /= 10.0) {
    const Deflector deflector{1.0, Vec3(0), Law::Exact};
    const auto bend = bend_by<double>(deflector, kCriticalRatio * (1.0 + above), std::nullopt);
    ASSERT_TRUE(bend);
    EXPECT_GT(bend->alpha / (2.0 * kPi), turns) << above;
    turns = bend->alpha / (2.0 * kPi);
  }
  EXPECT_GT(turns, 5.0);
}

TEST(HardCases, WithinOneUlpOfTheCriticalImpactParameter) {
  const double m = 1.0;
  const double b_c = kCriticalRatio * m;
  for (const LawEntry& law : kLaws) {
    const Deflector deflector{m, Vec3(0), law.law};
    EXPECT_FALSE(bend_by<double>(deflector, b_c, std::nullopt));
    EXPECT_FALSE(bend_by<double>(deflector, std::nextafter(b_c, 0.0), std::nullopt));
    const auto above = bend_by<double>(deflector, std::nextafter(b_c, 10.0), std::nullopt);
    ASSERT_TRUE(above);
    EXPECT_TRUE(std::isfinite(above->alpha));
  }
  // On the film: positions on both sides of the shadow's edge, one ulp apart and more, all have an outcome.
  Scene scene = view_of({{1e4, {0, 0, -1e9}}});
  const double slope = slope_per_pixel(scene.camera);
  const double edge = 12.5 + std::tan(std::asin(kCriticalRatio * 1e4 / 1e9)) / slope;
  for (double x = edge - 20 * edge * 1e-16; x <= edge + 20 * edge * 1e-16; x = std::nextafter(x, 100.0)) {
    const Probe p = probed(scene, {x, 7.5});
    EXPECT_TRUE(std::isfinite(p.last.x + p.last.y + p.last.z));
  }
  EXPECT_TRUE(probed(scene, {edge * (1 - 1e-6), 7.5}).captured);
  EXPECT_FALSE(probed(scene, {edge * (1 + 1e-6), 7.5}).captured);
}

TEST(HardCases, RayParallelToThePlane) {
  // By the paper's method, and by `planes`, where the plane plays no part but for the order.
  const std::vector<LensPlane> planes{{{0, 0, -1}, 1e9, {{1e4, {1e9, 0, -1e9}}}}};
  const RayPath<double> paper = march(planes, Vec3(0), Vec3(1, 0, 0));
  EXPECT_EQ(paper.bends, 0);
  EXPECT_FALSE(paper.captured);
  Scene scene = view_of({{1e4, {1e9, 0, -1.0}}, {1e4, {-1e9, 1e8, -1e-3}}}, 179.9 * kDegree);
  expect_finite_maps(scene);
  const Probe p = probe(scene, planned(scene), {25.0, 7.5});
  EXPECT_TRUE(std::isfinite(p.last.x + p.last.y + p.last.z));
}

TEST(HardCases, FieldsOfViewFrom1em9To179_9Degrees) {
  for (const double fov : {1e-9, 1e-6, 1e-3, 1.0, 60.0, 120.0, 170.0, 179.0, 179.9}) {
    // A mass a fifth of the frame aside, its Einstein angle a tenth of the frame.
    const double half = std::tan(fov * kDegree / 2.0);
    const double width = std::min(half, 1.0);
    const double einstein = 0.2 * width;
    Scene scene =
        view_of({{einstein * einstein * 1e9 / 4.0 / 4.0, {0.2 * half * 1e9, 0, -1e9}}}, fov * kDegree);
    expect_finite_maps(scene);
    const Probe straight = probed(view_of({}, fov * kDegree), {3.25, 2.75});
    EXPECT_EQ(straight.surfaces[0].st.s, 3.25 / 25) << fov;
    EXPECT_EQ(straight.surfaces[0].st.t, 1.0 - 2.75 / 15) << fov;
  }
}

TEST(HardCases, CameraInsideThePhotonSphereAndInsideTheHorizon) {
  Scene scene;
  scene.camera.projection = Projection::LatLong;
  scene.camera.width = 36;
  scene.camera.height = 18;
  scene.surfaces = {LatLong{}};
  const auto seen_share = [&](double rho) {
    scene.lenses = {{1.0, {0, 0, -rho}}};
    const Tracer tracer(scene, planned(scene));
    const auto maps = trace_maps(tracer);
    double seen = 0.0;  // of the sphere
    for (int row = 0; row < 18; ++row) {
      const double top = std::cos(row * kPi / 18), bottom = std::cos((row + 1) * kPi / 18);
      for (int column = 0; column < 36; ++column) {
        seen += maps[0].valid[static_cast<std::size_t>(row * 36 + column)] * (top - bottom) / 72.0;
      }
    }
    expect_finite_maps(scene);
    return seen;
  };
  // Between photon sphere and horizon a static observer sees out through a cone of sin a = b_c/(n rho).
  for (const double rho : {1.5, 1.0, 0.7}) {
    const double sine = kCriticalRatio / (fermat_index(1.0, rho) * rho);
    EXPECT_NEAR(seen_share(rho), (1.0 - std::sqrt(1.0 - sine * sine)) / 2.0, 0.03) << rho;
  }
  for (const double rho : {0.5, 0.4, 1e-3, 0.0}) EXPECT_EQ(seen_share(rho), 0.0) << rho;
}

TEST(HardCases, MassesFrom1GramTo1e12SunsInOneScene) {
  std::vector<Lens> lenses;
  double z = -1e3;
  for (const double kg : {1e-3, 1.0, 1e12, 6e24, 2e30, 2e36, 2e42}) {
    lenses.push_back({geometric_mass_from_kg(kg), {z / 9, z / 11, z}});
    z *= 1e3;
  }
  const Scene scene = view_of(lenses);
  expect_finite_maps(scene);
  // All of so small a film is near masses. On a larger one the gram is culled, the galaxy is not.
  EXPECT_EQ(planned(scene).near_masses, 1.0);
  Scene large = scene;
  large.camera.width *= 32;
  large.camera.height *= 32;
  const Plan plan = planned(large);
  EXPECT_LT(plan.near_masses, 1.0);
  EXPECT_TRUE(plan.lenses.front().culled);
  EXPECT_FALSE(plan.lenses.back().culled);
}

TEST(HardCases, DistancesOf1em3And1e26Metres) {
  for (const double distance : {1e-3, 1.0, 1e9, 1e18, 1e26}) {
    Scene scene = view_of({{1e-5 * distance, {0.05 * distance, 0, -distance}}});
    scene.surfaces = {Plate{}, LatLong{}, Sphere{{0, 0, -2 * distance}, 0.3 * distance, {}}};
    expect_finite_maps(scene);
    // Scaling every length leaves every direction as it is.
    Scene unit = view_of({{1e-5, {0.05, 0, -1}}});
    EXPECT_LT(largest_difference(unit, scene), 1e-14) << distance;
  }
}

TEST(HardCases, TheWholeSceneDisplacedBy1e15Metres) {
  Scene here = view_of({{1e4, {2e7, 1e7, -1e9}}, {3e4, {-3e7, 0, -2e9}}});
  Scene there = here;
  const Vec3 far(1e15, -1e15, 1e15);  // whose last bit is an eighth of a metre
  there.camera.position += far;
  for (Lens& lens : there.lenses) lens.position += far;
  const double tolerance_px = TraceSettings{}.tolerance_px;
  EXPECT_LT(largest_difference(here, there), 1e-3 * tolerance_px * pixel_angle(here.camera));
}

TEST(HardCases, RotationMirrorScaleAndOrder) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Scene scene = view_of({});
  for (int i = 0; i < 6; ++i) {
    scene.lenses.push_back({1e4 * (2 + uniform(random)),
                            {1.5e8 * uniform(random), 1e8 * uniform(random), -1e9 * (2 + uniform(random))}});
  }
  scene.lenses.push_back({2e4, {1e8, 2e7, scene.lenses[0].position.z}});  // two share a plane

  Scene reversed = scene;
  std::reverse(reversed.lenses.begin(), reversed.lenses.end());
  EXPECT_EQ(largest_difference(scene, reversed), 0.0);

  const Basis turn = basis_from_zxy({0.3, -1.2, 2.2});
  Scene turned = scene;
  turned.camera.axes = parent_from_local(turn, scene.camera.axes);
  for (Lens& lens : turned.lenses) lens.position = turn.parent_from_local(lens.position);
  Scene mirrored = scene;
  for (Lens& lens : mirrored.lenses) lens.position.x = -lens.position.x;
  const Plan plan = planned(scene), plan_turned = planned(turned), plan_mirrored = planned(mirrored);
  for (double y = 0.5; y < 15; y += 1.0) {
    for (double x = 0.5; x < 25; x += 1.0) {
      const Probe p = probe(scene, plan, {x, y});
      const Probe q = probe(turned, plan_turned, {x, y});
      const Probe r = probe(mirrored, plan_mirrored, {25 - x, y});
      ASSERT_EQ(p.captured, q.captured);
      ASSERT_EQ(p.captured, r.captured);
      if (p.captured) continue;
      EXPECT_LT(angle_between(turn.parent_from_local(p.last), q.last), 1e-12);
      EXPECT_LT(angle_between(Vec3(-p.last.x, p.last.y, p.last.z), r.last), 1e-15);
    }
  }

  Scene scaled = scene;
  for (Lens& lens : scaled.lenses) lens.m *= 1024, lens.position *= 1024;
  scaled.surfaces = scene.surfaces = {Plate{}, LatLong{}};
  EXPECT_EQ(largest_difference(scene, scaled), 0.0);
}

TEST(HardCases, FloatsAreNeverInfinite) {
  // Depths at infinity, magnifications on a critical curve, plates almost along the screen.
  Scene scene = view_of({{1e6, {0, 0, -1e9}}}, 170 * kDegree);
  scene.surfaces.push_back(Sphere{{0, 0, -1e60}, 9e59, {}});
  expect_finite_maps(scene);
}

}  // namespace
}  // namespace lensplane
