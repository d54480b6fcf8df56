// SPDX-License-Identifier: Apache-2.0
//
// What captured light shows: what stands before the mass that captures it, and nothing behind. Curved rays
// are the yardstick.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "src/constants.h"
#include "src/tracer.h"

namespace lensplane {
namespace {

constexpr int kRings = 0, kCards = 1;

/// Near a mass `planes` knows light to first order: this near to a body's outline, in m, it may miss it, or
/// meet it in vain.
constexpr double kOutline = 0.5;

/// A hole of m = 1 m before a perspective camera, a body near it, and rays that pass it within its shadow.
struct Shot {
  Scene scene;
  Vec3 hole;
  int kind = 0;

  /// The body with its outline moved outwards, or inwards.
  Surface with_outline(double by) const {
    Surface body = scene.surfaces.front();
    if (auto* ring = std::get_if<Ring>(&body)) {
      ring->inner = std::max(0.0, ring->inner - by);
      ring->outer = std::max(ring->inner + 1e-3, ring->outer + by);
    } else if (auto* sphere = std::get_if<Sphere>(&body)) {
      sphere->radius = std::max(1e-3, sphere->radius + by);
    }
    return body;
  }
};

class Shots {
 public:
  explicit Shots(unsigned seed) : random_(seed) {}

  double from(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  Vec3 vector(double size) { return {from(-size, size), from(-size, size), from(-size, size)}; }

  /// The camera stands 30 to 1e5 m away, 1 to 10 degrees over the plane of a ring that lies round the hole;
  /// other bodies stand anywhere near it. `inclined`: the hole may be far from the camera's axis.
  Shot next(int kind, bool inclined) {
    const double distance = std::exp(from(std::log(30), std::log(1e5)));
    const double tilt = inclined ? from(0, 0.9) : 0.0;
    Shot shot{{}, Vec3(std::sin(tilt), 0, -std::cos(tilt)) * distance, kind};
    shot.scene.camera.width = shot.scene.camera.height = 64;
    shot.scene.camera.fov_rad = inclined ? 2.0 : 2 * std::atan(8 / distance);
    shot.scene.lenses = {{1, shot.hole}};
    const bool round = from(0, 1) < 0.5;
    const Vec3 centre = round ? shot.hole : shot.hole + vector(10);
    if (kind == kRings) {
      const double elevation = from(1, 10) * kPi / 180, inner = round ? from(2, 6) : from(0, 4);
      const Vec3 angles = round ? Vec3(elevation, 0, 0) : Vec3(from(0, 3), 0, from(0, 6));
      shot.scene.surfaces = {Ring{centre, basis_from_zxy(angles), inner, inner + from(1, 10)}};
    } else if (kind == kCards) {
      shot.scene.surfaces = {Card{-centre.z}};
    } else {
      shot.scene.surfaces = {Sphere{centre + (round ? vector(10) : Vec3(0)), from(1, 8), Basis{}}};
    }
    return shot;
  }

  /// Rays whose lines pass the hole within `most`.
  TraceBatch rays(const Shot& shot, double most, const Tracer& tracer) {
    TraceBatch batch = tracer.make_batch();
    const Vec3 ahead = shot.hole.normalized(), right(-ahead.z, 0, ahead.x);
    const Vec3 up = right.cross(ahead);
    for (int i = 0; i < kBatchSize; ++i) {
      const double b = from(0, most), turn = from(0, 2 * kPi);
      const Vec3 aim = shot.hole + (right * std::cos(turn) + up * std::sin(turn)) * b;
      const auto film = *film_from_direction<double>(shot.scene.camera, aim);
      batch.x[i] = film.x, batch.y[i] = film.y;
    }
    return batch;
  }

 private:
  std::mt19937 random_;
};

Tracer planes_tracer(const Scene& scene) {
  return {scene, plan_trace(scene, TraceSettings{Method::Planes, Law::Exact, 1e-3, Choice::On, {}})};
}

/// How far beyond the hole the ray that `seen` tells of meets the body, metres.
double beyond_hole(const Shot& shot, const SurfaceBatch& seen, std::size_t i) {
  const auto* card = std::get_if<Card>(&shot.scene.surfaces.front());
  return card ? card->distance + shot.hole.z : seen.distance[i] - shot.hole.length();
}

/// The same rays, by another tracer.
TraceBatch retraced(const TraceBatch& batch, const Tracer& tracer) {
  TraceBatch result = tracer.make_batch();
  std::copy_n(batch.x, kBatchSize, result.x);
  std::copy_n(batch.y, kBatchSize, result.y);
  tracer.trace(result);
  return result;
}

TEST(CapturedLight, ShowsNothingBehindItsMassAndWhatStandsBeforeIt) {
  Shots shots(1);
  int captured = 0, before = 0;
  for (int n = 0; n < 300; ++n) {
    Shot shot = shots.next(n % 3, false);
    shot.scene.surfaces.push_back(LatLong{});
    const Tracer planes = planes_tracer(shot.scene);
    TraceBatch by_planes = shots.rays(shot, 5.5, planes);
    planes.trace(by_planes);
    Scene outlines = shot.scene;
    outlines.surfaces = {shot.with_outline(kOutline), shot.with_outline(-kOutline)};
    const Tracer curved(outlines, plan_trace(outlines, Method::Geodesic));
    const TraceBatch by_curves = retraced(by_planes, curved);
    for (std::size_t i = 0; i < kBatchSize; ++i) {
      const bool hit = by_planes.surfaces[0].outcome[i] == Outcome::Hit;
      const SurfaceBatch &larger = by_curves.surfaces[0], &smaller = by_curves.surfaces[1];
      captured += larger.outcome[i] == Outcome::Captured;
      if (larger.outcome[i] == Outcome::Captured) {
        EXPECT_FALSE(hit) << "shot " << n << " ray " << i;
      }
      const bool stands_before =
          smaller.outcome[i] == Outcome::Hit && smaller.distance[i] < shot.hole.length() - 3;
      if (!stands_before || by_planes.surfaces[1].outcome[i] != Outcome::Captured) continue;
      ++before;
      EXPECT_TRUE(hit) << "shot " << n << " ray " << i;
    }
  }
  EXPECT_GT(captured, 10000);
  EXPECT_GT(before, 3000);
}

TEST(CapturedLight, ShowsNothingBehindItsMassAmongOthers) {
  // To an inclined ray they may stand in another order than their planes do.
  Shots shots(2);
  int captured = 0;
  for (int n = 0; n < 300; ++n) {
    Shot shot = shots.next(n % 3, true);
    for (int other = 0; other < n % 4; ++other) {
      const Vec3 there = shot.hole + shots.vector(1).normalized() * shots.from(20, 200);
      shot.scene.lenses.push_back({shots.from(0.05, 1.5), there});
    }
    shot.scene.surfaces.push_back(LatLong{});
    const Tracer planes = planes_tracer(shot.scene);
    const Tracer curved(shot.scene, plan_trace(shot.scene, Method::Geodesic));
    TraceBatch by_planes = shots.rays(shot, 4.3, planes);
    planes.trace(by_planes);
    const TraceBatch by_curves = retraced(by_planes, curved);
    for (std::size_t i = 0; i < kBatchSize; ++i) {
      const bool by_both = by_planes.surfaces[1].outcome[i] == Outcome::Captured &&
                           by_curves.surfaces[0].outcome[i] == Outcome::Captured;
      if (!by_both) continue;
      ++captured;
      if (by_planes.surfaces[0].outcome[i] != Outcome::Hit) continue;
      EXPECT_LT(beyond_hole(shot, by_planes.surfaces[0], i), kPhotonSphere) << "shot " << n << " ray " << i;
    }
  }
  EXPECT_GT(captured, 10000);
}

}  // namespace
}  // namespace lensplane
