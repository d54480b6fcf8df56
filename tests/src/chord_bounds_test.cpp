// SPDX-License-Identifier: Apache-2.0
//
// What chords misplace, by the plan's own bounds, against curved rays.

#include "src/chord_bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "src/constants.h"
#include "src/probe.h"
#include "src/tracer.h"

namespace lensplane {
namespace {

/// A mass of 1 m in view, 40 to 1e5 m away, and a body before, beside or behind it. Rings are whole planes,
/// so that light which runs beside its place meets them all the same.
class RandomScenes {
 public:
  explicit RandomScenes(unsigned seed) : random_(seed) {}

  double uniform(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }
  double spread(double from, double to) { return std::exp(uniform(std::log(from), std::log(to))); }
  Vec3 direction() { return Vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)).normalized(); }

  Scene next(int kind) {
    Scene scene;
    const double distance = spread(40, 1e5), width = distance * uniform(0.05, 0.9);
    scene.camera.width = 192;
    scene.camera.height = 128;
    scene.camera.fov_rad = 2 * std::atan(std::min(width, spread(20, 1e4)) / distance);
    const double half = std::tan(scene.camera.fov_rad / 2) * distance;
    const Vec3 mass(uniform(-1, 1) * half, uniform(-0.6, 0.6) * half, -distance);
    scene.lenses = {{1, mass}};
    const Vec3 centre = mass + direction() * std::min(spread(3, 1e5), distance * uniform(0.5, 3));
    if (kind == 0) {
      scene.surfaces = {Ring{centre, basis_from_zxy({uniform(0, 3), 0, uniform(0, 3)}), 0, 30 * distance}};
    } else if (kind == 1) {
      scene.surfaces = {Card{std::max(0.1 * distance, -centre.z)}};
    } else {
      const double away = (centre - mass).length(), radius = away * uniform(0.1, 0.8);
      scene.surfaces = {Sphere{centre, std::min(radius, 0.8 * centre.length()), {}}};
    }
    return scene;
  }

 private:
  std::mt19937 random_;
};

Vec3 point_on(const Scene& scene, const SurfaceBatch& seen, std::size_t i) {
  const TextureCoordinates st{seen.s[i], seen.t[i]};
  const Surface& body = scene.surfaces.front();
  if (const auto* ring = std::get_if<Ring>(&body)) return ring_point_from_st(*ring, st);
  if (const auto* sphere = std::get_if<Sphere>(&body))
    return sphere->centre + sphere->axes.parent_from_local(sphere_normal_from_st(st)) * sphere->radius;
  const Camera& camera = scene.camera;
  const Vec3 d = direction_from_film<double>(camera, {st.s * camera.width, (1 - st.t) * camera.height});
  return d * (std::get<Card>(body).distance / -d.z);
}

/// How far one ray passes from where the other meets the body, as an angle at the camera, in pixels. At a
/// grazing angle a ball is met elsewhere by a longer way, along which the rays part: by so much more.
double pixels_aside(const Scene& scene, const SurfaceBatch& planes, const SurfaceBatch& curved,
                    std::size_t i) {
  const Vec3 there = point_on(scene, curved, i), off = point_on(scene, planes, i) - there;
  const PassBatch& p = *curved.passes;
  const Vec3 along(p.dir_x[i], p.dir_y[i], p.dir_z[i]);
  const auto* sphere = std::get_if<Sphere>(&scene.surfaces.front());
  const double steepness = sphere ? std::abs((there - sphere->centre).normalized().dot(along)) : 1.0;
  const double aside = (off - along * off.dot(along)).length() * steepness;
  return aside / there.length() / pixel_angle(scene.camera);
}

TEST(ChordBounds, ChordsMisplaceBodiesByNoMore) {
  RandomScenes random(11);
  Effects direction;
  direction.direction = true;
  int bounded = 0, unbounded = 0, left_alone = 0;
  double nearest = 0;
  for (int n = 0; n < 600; ++n) {
    const Scene scene = random.next(n % 3);
    TraceSettings settings{Method::Planes, Law::Exact, 1e-6, Choice::On, direction};
    const Tracer planes(scene, plan_trace(scene, settings));
    settings.method = Method::Geodesic;
    const Tracer curves(scene, plan_trace(scene, settings));
    TraceBatch a = planes.make_batch(), b = curves.make_batch();
    for (int i = 0; i < kBatchSize; ++i) {
      a.x[i] = b.x[i] = random.uniform(0, scene.camera.width);
      a.y[i] = b.y[i] = random.uniform(0, scene.camera.height);
    }
    planes.trace(a);
    curves.trace(b);
    for (std::size_t i = 0; i < kBatchSize; ++i) {
      const FilmPosition film{a.x[i], a.y[i]};
      const double bound = chords_px_at(planes.plan(), scene.camera, film);
      const bool hit_a = a.surfaces[0].outcome[i] == Outcome::Hit,
                 hit_b = b.surfaces[0].outcome[i] == Outcome::Hit;
      if (bound == 0.0) {  // no ray of the tile can meet the body
        ++left_alone;
        ASSERT_FALSE(hit_a || hit_b) << "scene " << n << " film " << film.x << ' ' << film.y;
      }
      unbounded += !std::isfinite(bound);
      if (!hit_a || !hit_b || !std::isfinite(bound)) continue;
      // Next to its shadow a mass lets errors grow without limit.
      const auto crossings = probe(scene, planes.plan(), film).crossings;
      const bool winds = !crossings.empty() && crossings[0].b_over_m < 1.1 * kCriticalRatio;
      if (winds) continue;
      ++bounded;
      const double off = pixels_aside(scene, a.surfaces[0], b.surfaces[0], i);
      EXPECT_LE(off, bound * (1 + 1e-6) + 2e-4) << "scene " << n << " film " << film.x << ' ' << film.y;
      nearest = std::max(nearest, off / (bound + 1e-3));
    }
  }
  EXPECT_GT(bounded, 8000);
  EXPECT_GT(unbounded, 200);
  EXPECT_GT(left_alone, 1000);
  EXPECT_GT(nearest, 0.1);  // a bound that is met
}

TEST(ChordBounds, WhereTheyAreTooFarOffBodiesAreMetByCurvedRays) {
  RandomScenes random(12);
  Effects direction;
  direction.direction = true;
  int curved = 0, by_chords = 0;
  for (int n = 0; n < 300; ++n) {
    Scene scene = random.next(n % 3);
    scene.surfaces.push_back(LatLong{});
    const double tolerance = random.spread(0.01, 1);
    const TraceSettings settings{Method::Planes, std::nullopt, tolerance, Choice::Auto, direction};
    const Tracer planned(scene, plan_trace(scene, settings));
    Plan plan = planned.plan();
    EXPECT_LE(plan.bound_px, tolerance);
    plan.tiles.curved.clear();
    const Tracer chords(scene, plan);
    const Tracer curves(
        scene, plan_trace(scene, TraceSettings{Method::Geodesic, {}, tolerance, Choice::On, direction}));
    TraceBatch a = planned.make_batch(), b = curves.make_batch(), c = chords.make_batch();
    for (int i = 0; i < kBatchSize; ++i) {
      a.x[i] = b.x[i] = c.x[i] = random.uniform(0, scene.camera.width);
      a.y[i] = b.y[i] = c.y[i] = random.uniform(0, scene.camera.height);
    }
    planned.trace(a);
    curves.trace(b);
    chords.trace(c);
    for (std::size_t i = 0; i < kBatchSize; ++i) {
      const bool curves_here = curves_at(planned.plan(), scene.camera, {a.x[i], a.y[i]});
      ++(curves_here ? curved : by_chords);
      // Bit for bit: bodies by curved rays or by chords, what lies at infinity always by the recipe.
      const SurfaceBatch& body = curves_here ? b.surfaces[0] : c.surfaces[0];
      ASSERT_EQ(a.surfaces[0].outcome[i], body.outcome[i]);
      ASSERT_EQ(a.surfaces[0].s[i], body.s[i]);
      ASSERT_EQ(a.surfaces[0].t[i], body.t[i]);
      ASSERT_EQ(a.surfaces[0].passes->dir_x[i], body.passes->dir_x[i]);
      ASSERT_EQ(a.surfaces[1].s[i], c.surfaces[1].s[i]);
      ASSERT_EQ(a.surfaces[1].outcome[i], c.surfaces[1].outcome[i]);
      const Probe single = probe(scene, planned.plan(), {a.x[i], a.y[i]});
      EXPECT_EQ(single.curved, curves_here);
      EXPECT_EQ(single.surfaces[0].outcome, a.surfaces[0].outcome[i]);
      if (std::abs(a.surfaces[0].s[i]) < 2) {
        EXPECT_NEAR(single.surfaces[0].st.s, a.surfaces[0].s[i], 1e-3);  // within the tolerance
      }
    }
  }
  EXPECT_GT(curved, 3000);
  EXPECT_GT(by_chords, 3000);
}

TEST(ChordBounds, TheUsersWordStandsAndTheBoundIsSaid) {
  Scene scene;
  scene.camera.width = 192;
  scene.camera.height = 128;
  scene.camera.fov_rad = 0.5;
  scene.lenses = {{1, {0, 0, -60}}};
  scene.surfaces = {Sphere{{20, 0, -60}, 5, {}}};
  for (const TraceSettings& settings : {TraceSettings{Method::Planes, Law::Exact, 0.05, Choice::Auto, {}},
                                        TraceSettings{Method::Planes, std::nullopt, 0.05, Choice::Off, {}}}) {
    const Plan plan = plan_trace(scene, settings);
    EXPECT_TRUE(plan.tiles.curved.empty());
    EXPECT_FALSE(plan.choices[2].on);
    EXPECT_EQ(plan.choices[2].name, kCurvedEffect);
    EXPECT_TRUE(std::isinf(plan.choices[2].bound_px) || plan.choices[2].bound_px > 0.05);
  }
  const Plan plan = plan_trace(scene, TraceSettings{});
  EXPECT_GT(plan.choices[2].share, 0.0);
  EXPECT_LE(plan.bound_px, 0.05);
  scene.surfaces = {LatLong{}};
  EXPECT_TRUE(plan_trace(scene, TraceSettings{}).tiles.curved.empty());
}

}  // namespace
}  // namespace lensplane
