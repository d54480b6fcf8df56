// SPDX-License-Identifier: Apache-2.0
//
// The tracer by the method `planes`: what its batches write, against single rays.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "src/single_ray.h"
#include "tests/src/film.h"
#include "tests/src/scenes.h"

namespace lensplane {
namespace {

/// Masses of 1 m and what they hide, some behind others and one behind the camera.
Scene strong_scene(Projection projection) {
  Scene scene;
  scene.camera.width = 400;
  scene.camera.height = 200;
  scene.camera.fov_rad = 1.5;
  scene.camera.projection = projection;
  scene.camera.position = Vec3(1e3, -4e2, 7e2);
  scene.camera.axes = basis_from_zxy({0.3, -0.8, 0.1});
  const auto at = [&](const Vec3& p) {
    return scene.camera.position + scene.camera.axes.parent_from_local(p);
  };
  scene.lenses = {{1.0, at({3, 2, -40})},
                  {0.5, at({-12, 4, -40})},
                  {1.0, at({14, -6, -60})},
                  {0.2, at({-10, -9, -30})},
                  {0.6, at({5, 5, 50})}};
  scene.surfaces = {
      Plate{}, LatLong{}, Sphere{at({4, 0, -90}), 12, basis_from_zxy({0.4, 1, 0})},
      Sphere{at({-11, 5, -35}), 3, {}}, Sphere{at({0, 0, 60}), 15, {}},
      // Before the masses, on a plane of theirs and behind them; in front of and behind the camera.
      Card{30}, Card{40}, Card{200}, Card{30, 1}};
  for (const int crossing : {0, 1}) {
    scene.surfaces.push_back(Ring{at({3, 2, -41}), basis_from_zxy({0.9, 0.2, 0.1}), 8, 30, crossing});
    scene.surfaces.push_back(Ring{at({2, 1, -3}), basis_from_zxy({0.1, 0.6, 0.4}), 10, 90, crossing});
  }
  return scene;
}

/// s on a sky and on a ball jumps from 1 to 0.
double apart_on_circle(double a, double b) {
  const double d = std::abs(a - b);
  return std::min(d, std::abs(1 - d));
}

struct Tally {
  int hits = 0, captured = 0, missed = 0, behind = 0, disagreeing = 0;
};

/// Derivatives say how far a rounding of the film position carries.
double steepness(const SurfaceHit<Dual>& hit) {
  return 1 + std::abs(hit.st.s.dx) + std::abs(hit.st.s.dy) + std::abs(hit.st.t.dx) + std::abs(hit.st.t.dy);
}

void expect_same_passes(const PassBatch& passes, int i, const SurfaceHit<Dual>& expected,
                        const Effects& effects, const Basis& axes) {
  const double steep = steepness(expected);
  if (effects.derivatives()) {
    EXPECT_NEAR(passes.ds_dx[i], expected.st.s.dx, 1e-9 * steep * steep);
    EXPECT_NEAR(passes.ds_dy[i], expected.st.s.dy, 1e-9 * steep * steep);
    EXPECT_NEAR(passes.dt_dx[i], expected.st.t.dx, 1e-9 * steep * steep);
    EXPECT_NEAR(passes.dt_dy[i], expected.st.t.dy, 1e-9 * steep * steep);
    const double mu = expected.magnification;
    EXPECT_NEAR(passes.magnification[i], mu, 1e-9 * std::abs(mu) * (1 + std::abs(mu)) * steep);
  }
  if (effects.delay) {
    EXPECT_NEAR(passes.delay[i], expected.delay / kLightSpeed, 1e-9 / kLightSpeed * steep);
  }
  if (effects.direction) {
    const Vec3 direction = axes.parent_from_local(expected.direction);
    const Vec3 ours(passes.dir_x[i], passes.dir_y[i], passes.dir_z[i]);
    EXPECT_NEAR((ours - direction).length(), 0, 1e-11 * steep);
  }
  if (effects.bends) {
    EXPECT_EQ(passes.bends[i], expected.bends);
  }
}

/// Compares everything that the batch says of ray `i` with `expected`.
void expect_same(const SurfaceBatch& ours, int i, const SurfaceHit<Dual>& expected, const Effects& effects,
                 const Basis& axes, Tally& tally) {
  if (ours.outcome[static_cast<std::size_t>(i)] != expected.outcome) {
    ++tally.disagreeing;  // at a silhouette rounding decides
    return;
  }
  tally.hits += expected.outcome == Outcome::Hit;
  tally.captured += expected.outcome == Outcome::Captured;
  tally.missed += expected.outcome == Outcome::Missed;
  tally.behind += expected.outcome == Outcome::Behind;
  const double steep = steepness(expected);
  const double near = 1e-11 * steep;
  EXPECT_LT(apart_on_circle(ours.s[i], expected.st.s.v), near);
  EXPECT_NEAR(ours.t[i], expected.st.t.v, near);
  if (std::isfinite(expected.distance)) {
    EXPECT_NEAR(ours.distance[i], expected.distance, 1e-8 * steep + 1e-11 * expected.distance);
  } else {
    EXPECT_TRUE(std::isinf(ours.distance[i]));
  }
  if (effects.any()) expect_same_passes(*ours.passes, i, expected, effects, axes);
}

Tally compare(const Scene& scene, const TraceSettings& settings) {
  const Tracer tracer(scene, plan_trace(scene, settings));
  const Plan& plan = tracer.plan();
  const Sight sight{tracer.camera(), tracer.surfaces(), plan.effects};
  TraceBatch batch = tracer.make_batch();
  std::mt19937 random(12);
  Film film;
  Tally tally;
  for (int round = 0; round < 12; ++round) {
    random_film(random, scene.camera, film);
    std::copy_n(film.x, kBatchSize, batch.x);
    std::copy_n(film.y, kBatchSize, batch.y);
    tracer.trace(batch);
    for (int i = 0; i < kBatchSize; ++i) {
      const FilmPosition at{film.x[i], film.y[i]};
      if (!sees(scene.camera, at)) continue;
      const auto [expected, captured] = trace_ray<Dual>(sight, plan, plan.recipes.size() - 1, at);
      EXPECT_EQ(batch.captured[i], captured ? 1.0 : 0.0);
      for (std::size_t k = 0; k < expected.size(); ++k) {
        SCOPED_TRACE(testing::Message() << "surface " << k << " at " << at.x << ", " << at.y);
        expect_same(batch.surfaces[k], i, expected[k], plan.effects, scene.camera.axes, tally);
      }
    }
  }
  return tally;
}

TEST(TracerByPlanes, BatchesWriteWhatSingleRaysSee) {
  const Effects everything{true, true, true, true, true, true, true};
  const Effects derivatives{true, true, false, false, false, false, false};
  for (const Projection projection : {Projection::Perspective, Projection::LatLong, Projection::Fisheye}) {
    for (const Law law : {Law::Weak, Law::SecondOrder, Law::Exact}) {
      for (const Choice finite : {Choice::Off, Choice::On}) {
        for (const Effects& effects : {everything, derivatives, Effects{}}) {
          SCOPED_TRACE(testing::Message() << "projection " << static_cast<int>(projection) << ", "
                                          << name_of(law) << ", finite " << (finite == Choice::On));
          const Tally tally =
              compare(strong_scene(projection), TraceSettings{Method::Planes, law, 0.05, finite, effects});
          EXPECT_GT(tally.hits, 1000);
          EXPECT_GT(tally.captured, 10);
          EXPECT_GT(tally.missed, 1000);
          EXPECT_LE(tally.disagreeing, 2);
        }
      }
    }
  }
}

}  // namespace
}  // namespace lensplane
