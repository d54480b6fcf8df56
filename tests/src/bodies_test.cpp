// SPDX-License-Identifier: Apache-2.0
//
// Rings and cards: closed forms, edges, several crossings, and curved rays as the yardstick.

#include "src/bodies.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "src/constants.h"
#include "src/probe.h"
#include "tests/src/deflector_scenes.h"

namespace lensplane {
namespace {

constexpr Effects kAll{true, true, true, true, true, true, true};

Scene view_of(const std::vector<Lens>& lenses, const std::vector<Surface>& surfaces, double fov_rad = 1.0) {
  Scene scene = scene_of(Projection::Perspective, lenses);
  scene.camera.height = 60;
  scene.camera.fov_rad = fov_rad;
  scene.surfaces = surfaces;
  return scene;
}

TraceSettings settings_of(Method method, Choice finite, Law law = Law::Exact) {
  return {method, law, 1e-9, finite, kAll};
}

std::vector<ProbedSurface> look(const Scene& scene, FilmPosition film, Method method = Method::Planes,
                                Choice finite = Choice::On) {
  return probe(scene, plan_trace(scene, settings_of(method, finite)), film).surfaces;
}

/// The film position at these slopes from the axis.
FilmPosition film_at(const Scene& scene, double right, double up) {
  return pixel_from_slopes(scene.camera, {right, up});
}

/// A ring whose normal points to the camera.
Ring facing_ring(double distance, double inner, double outer) {
  return {{0, 0, -distance}, basis_from_zxy({kPi / 2, 0, 0}), inner, outer};
}

TEST(Cards, WithoutMassesFillTheFrame) {
  const Scene scene = view_of({}, {Card{3}, Card{2e20}});
  for (const MethodName& method : kMethodNames) {
    for (const FilmPosition film : {FilmPosition{50, 30}, {0.5, 0.5}, {99.5, 17}, {-300, 200}}) {
      for (const ProbedSurface& card : look(scene, film, method.method)) {
        ASSERT_EQ(card.outcome, Outcome::Hit);
        EXPECT_NEAR(card.st.s, film.x / 100, 1e-14);
        EXPECT_NEAR(card.st.t, 1 - film.y / 60, 1e-14);
        EXPECT_NEAR(card.ds_dx, 0.01, 1e-15);
        EXPECT_NEAR(card.dt_dy, -1.0 / 60, 1e-15);
        EXPECT_NEAR(card.ds_dy, 0, 1e-15);
        EXPECT_NEAR(card.dt_dx, 0, 1e-15);
      }
      const double along = -direction_from_pixel(scene.camera, film).z;
      EXPECT_NEAR(look(scene, film, method.method)[0].distance, 3 / along, 1e-14 * 3 / along);
    }
  }
}

TEST(Cards, AreLensedByWhatIsInFrontOfThemOnly) {
  const double m = 1e-6, b = 0.01, to_lens = 1.5;
  const std::vector<Surface> card = {Card{2}};
  const Scene front = view_of({{m, {0, 0, -to_lens}}}, card), behind = view_of({{m, {0, 0, -2.5}}}, card);
  const FilmPosition film = film_at(front, b / to_lens, 0);
  const double slope = slope_per_pixel(front.camera);
  for (const Method method : {Method::Kishi, Method::ShinotsukaMakino, Method::Planes}) {
    const ProbedSurface seen = look(front, film, method, Choice::Off)[0];
    const double moved = (seen.st.s * 100 - film.x) * slope * 2;  // metres on the card
    EXPECT_NEAR(moved / (-4 * m / b * (2 - to_lens)), 1, 1e-3);
    EXPECT_NEAR(look(behind, film, method, Choice::Off)[0].st.s * 100, film.x, 1e-12);
  }
  // Of a mass far behind light knows next to nothing: m b/(2 z^2) and less.
  const double rest = (look(behind, film)[0].st.s * 100 - film.x) * slope * 2;
  EXPECT_LT(std::abs(rest), 2 * m * b / 0.5);
  EXPECT_NE(rest, 0);
}

TEST(Cards, AMassThatPassesThroughMakesNoJump) {
  // From behind the card to its front: the shift grows from nothing by way of 2 m to the whole bend.
  const double m = 1e-6;
  for (const Method method : {Method::Planes, Method::Geodesic}) {
    const auto shift = [&](double depth) {
      const Scene scene = view_of({{m, {0.02, 0, -depth}}}, {Card{1}});
      return (look(scene, {50, 30}, method)[0].st.s - 0.5) * 100 * slope_per_pixel(scene.camera) / m;
    };
    EXPECT_LT(shift(1.5), 0.1);
    EXPECT_NEAR(shift(1), 2, 0.05);
    EXPECT_NEAR(shift(0.5) / (4 / 0.02 * 0.5), 1, 0.01);
    double last = shift(1.06);
    for (double depth = 1.06; depth > 0.94; depth -= 1e-3) {
      const double next = shift(depth);
      EXPECT_LT(std::abs(next - last), 0.25) << depth;
      last = next;
    }
  }
}

TEST(Cards, AtTheDepthOfAMassAreMetByAllLightBeforeItBends) {
  for (const double depth : {1.0, 4.36e8, 0.1 * 3}) {
    const Scene scene = view_of(
        {{1e-5 * depth, {0.1 * depth, 0, -depth}}, {1e-5 * depth, {0, 0.1 * depth, -depth}}}, {Card{depth}});
    for (const Method method : {Method::ShinotsukaMakino, Method::Planes}) {
      const Tracer tracer(scene, plan_trace(scene, settings_of(method, Choice::Off)));
      TraceBatch batch = tracer.make_batch();
      for (int i = 0; i < kBatchSize; ++i) batch.x[i] = 0.7 * i, batch.y[i] = 0.4 * i + 1;
      tracer.trace(batch);
      const SurfaceBatch& card = batch.surfaces[0];
      for (int i = 0; i < kBatchSize; ++i) {
        ASSERT_EQ(card.outcome[static_cast<std::size_t>(i)], Outcome::Hit);
        if (method == Method::ShinotsukaMakino) {  // whose planes are just there
          EXPECT_EQ(card.passes->bends[i], 0);
          EXPECT_NEAR(card.s[i], batch.x[i] / 100, 1e-14);
        }
        EXPECT_NEAR(card.s[i], batch.x[i] / 100, 1e-3);
        EXPECT_GT(card.passes->ds_dx[i], 0.009);
      }
    }
  }
}

TEST(Cards, AreSeenFromBehindByLightThatComesBack) {
  // b = 4m/pi would be a half turn by the weak law; a little farther out light comes back past the camera.
  const std::vector<Surface> cards = {Card{50}, Card{50, 1}, Card{50, 2}};
  const Scene scene = view_of({{1, {0, 0, -100}}}, cards);
  const double b = 4 / 2.9;
  const auto seen = look(scene, film_at(scene, b / 100, 0), Method::ShinotsukaMakino);
  ASSERT_EQ(seen[0].outcome, Outcome::Hit);
  ASSERT_EQ(seen[1].outcome, Outcome::Hit);
  EXPECT_EQ(seen[2].outcome, Outcome::Missed);
  EXPECT_NEAR(seen[0].distance, 50, 0.1);
  EXPECT_NEAR(seen[1].distance, 150, 3);
  EXPECT_LT(seen[1].st.s, 0.4);  // on the other side of the axis
  EXPECT_GT(seen[0].st.s, 0.5);
}

TEST(Rings, CoordinatesAreThoseOfTheContract) {
  const Ring ring{{1, 2, 3}, basis_from_zxy({0.4, 1, 0.2}), 2, 6};
  const auto st = [&](const Vec3& p) { return st_from_ring_point<double>(ring, p); };
  EXPECT_NEAR(st({0, 0, 2}).s, 0, 1e-15);
  EXPECT_NEAR(st({0, 0, 6}).s, 1, 1e-15);
  EXPECT_NEAR(st({0, 0, 3}).s, 0.25, 1e-15);
  EXPECT_NEAR(st({0, 0, 3}).t, 0.5, 1e-15);
  EXPECT_NEAR(st({3, 0, 0}).t, 0.75, 1e-15);
  EXPECT_NEAR(st({-1e-9, 0, -3}).t, 0, 1e-9);  // the seam
  EXPECT_NEAR(st({1e-9, 0, -3}).t, 1, 1e-9);
  for (const TextureCoordinates at : {TextureCoordinates{0.1, 0.2}, {0.7, 0.9}, {1, 0.5}}) {
    const Vec3 point = ring_point_from_st(ring, at);
    const TextureCoordinates back = st(ring.axes.local_from_parent(point - ring.centre));
    EXPECT_NEAR(back.s, at.s, 1e-14);
    EXPECT_NEAR(back.t, at.t, 1e-14);
  }
}

TEST(Rings, ReachFromTheirInnerToTheirOuterEdge) {
  const Scene scene = view_of({}, {facing_ring(10, 1, 3)});
  for (const MethodName& method : kMethodNames) {
    const auto seen = [&](double r, double angle) {
      return look(scene, film_at(scene, r / 10 * std::cos(angle), r / 10 * std::sin(angle)),
                  method.method)[0];
    };
    for (const double angle : {0.0, 1.0, 3.0, 5.0}) {
      EXPECT_EQ(seen(1 - 1e-9, angle).outcome, Outcome::Missed);
      EXPECT_EQ(seen(1 + 1e-9, angle).outcome, Outcome::Hit);
      EXPECT_EQ(seen(3 - 1e-9, angle).outcome, Outcome::Hit);
      EXPECT_EQ(seen(3 + 1e-9, angle).outcome, Outcome::Missed);
      EXPECT_NEAR(seen(2, angle).st.s, 0.5, 1e-14);
    }
  }
}

TEST(Rings, EdgeOnAreNotSeen) {
  for (const MethodName& method : kMethodNames) {
    // Seen along its plane from outside, from within its hole and from within the ring.
    for (const Vec3& centre : {Vec3(0, 0, -10), Vec3(0.2, 0, -0.5), Vec3(0, 0, -2)}) {
      const Scene scene = view_of({}, {Ring{centre, {}, 1, 3}});
      for (const double up : {0.0, 1e-9, -1e-9, 0.1, -0.1}) {
        EXPECT_EQ(look(scene, film_at(scene, 0.05, up), method.method)[0].outcome, Outcome::Missed) << up;
      }
    }
    // A little from above it is a line.
    const Scene above = view_of({}, {Ring{{0, -1e-6, -10}, {}, 1, 3}});
    EXPECT_EQ(look(above, film_at(above, 0, -1e-6 / 8), method.method)[0].outcome, Outcome::Hit);
    EXPECT_EQ(look(above, film_at(above, 0, 1e-6 / 8), method.method)[0].outcome, Outcome::Missed);
  }
}

TEST(Rings, BothSidesShowTheSamePlaces) {
  const Ring ring{{0, 0, -10}, basis_from_zxy({0.6, 0, 0}), 1, 3};
  Ring turned = ring;
  turned.axes = {-ring.axes.x, -ring.axes.y, ring.axes.z};
  const Scene scene = view_of({}, {ring, turned});
  const auto seen = look(scene, film_at(scene, 0.15, 0.02));
  ASSERT_EQ(seen[0].outcome, Outcome::Hit);
  EXPECT_NEAR(seen[0].st.s, seen[1].st.s, 1e-15);
  EXPECT_NEAR(seen[0].st.t, 1 - seen[1].st.t, 1e-14);
}

/// What a ray by `planes` and a curved one meet on a body.
struct Pair {
  ProbedSurface planes, curved;
};
Pair both_ways(const Surface& body, std::vector<Lens> lenses, double k, FilmPosition film) {
  for (Lens& lens : lenses) lens.m *= k;
  const Scene scene = view_of(lenses, {body});
  return {look(scene, film)[0], look(scene, film, Method::Geodesic)[0]};
}

TEST(FiniteDistance, RingsAndCardsAreSeenAsByCurvedRaysToFirstOrder) {
  // Before, between and behind masses, one of them beside and one behind the camera, and just on a mass.
  const std::vector<Lens> masses = {
      {1, {0.1, 0.2, -1}}, {2, {-0.3, 0.5, -2}}, {0.5, {1, 0.5, 0.1}}, {1, {0.2, 0.2, 1.5}}};
  const std::vector<Surface> bodies = {Card{0.5},
                                       Card{1},
                                       Card{1.3},
                                       Card{2},
                                       Card{6},
                                       Ring{{0.1, 0.2, -1}, basis_from_zxy({0.5, 0, 0.2}), 0.1, 9},
                                       Ring{{0, -0.1, -2}, basis_from_zxy({-0.3, 0, 0.2}), 0.1, 9}};
  for (const FilmPosition film : {FilmPosition{52, 33}, {20, 50}, {70, 12}}) {
    for (const Surface& body : bodies) {
      const auto error = [&](double k) {
        const auto [planes, curved] = both_ways(body, masses, k, film);
        EXPECT_EQ(planes.outcome, curved.outcome);
        return std::array{std::hypot(planes.st.s - curved.st.s, planes.st.t - curved.st.t),
                          std::abs(planes.delay - curved.delay) * kLightSpeed,
                          std::abs(planes.ds_dx - curved.ds_dx) * 100};
      };
      const auto at_1e4 = error(1e-4), at_1e5 = error(1e-5);
      for (std::size_t i = 0; i < at_1e4.size(); ++i) {
        EXPECT_LT(at_1e4[i], 2e-5) << i << " body " << body.index() << " film " << film.x;
        EXPECT_LT(at_1e5[i], 0.02 * at_1e4[i] + 1e-12) << i << " body " << body.index() << " film " << film.x;
      }
    }
  }
}

TEST(Rings, RoundABlackHoleAreSeenThroughThemselves) {
  // From a little above its plane: light that passes under the hole comes up again behind it.
  std::vector<Surface> rings;
  for (const int crossing : {0, 1, 2}) {
    rings.push_back(Ring{{0, 0, -100}, basis_from_zxy({0.2, 0, 0}), 6, 25, crossing});
  }
  const Scene scene = view_of({{1, {0, 0, -100}}}, rings);
  const Plan by_planes = plan_trace(scene, settings_of(Method::Planes, Choice::On));
  const Plan by_curves = plan_trace(scene, settings_of(Method::Geodesic, Choice::On));
  int crossings[3] = {}, agree = 0, twice = 0;
  for (double y = -0.2; y < 0.2; y += 0.0041) {
    for (double x = -0.2; x < 0.2; x += 0.0203) {
      const FilmPosition film = film_at(scene, x, y);
      const auto planes = probe(scene, by_planes, film).surfaces;
      const auto curved = probe(scene, by_curves, film).surfaces;
      for (std::size_t k = 0; k < 3; ++k) {
        crossings[k] += curved[k].outcome == Outcome::Hit;
        if (k == 0 || curved[k].outcome != Outcome::Hit) continue;
        ASSERT_EQ(curved[k - 1].outcome, Outcome::Hit);
        EXPECT_GT(curved[k].distance, curved[k - 1].distance);
      }
      if (curved[1].outcome != Outcome::Hit) continue;
      ++twice;
      agree += planes[1].outcome == Outcome::Hit && std::abs(planes[1].st.s - curved[1].st.s) < 0.1;
    }
  }
  EXPECT_GT(crossings[0], 300);
  EXPECT_GT(crossings[1], 20);
  EXPECT_GT(agree, 0.8 * twice);
}

TEST(Rings, AreSeenAsOftenAsLightWindsRoundAHole) {
  // Down to the photon sphere: next to the shadow there are images of both sides without end.
  std::vector<Surface> rings;
  for (const int crossing : {0, 1, 2}) {
    rings.push_back(Ring{{0, 0, -100}, basis_from_zxy({0.2, 0, 0}), 1.5, 25, crossing});
  }
  const Scene scene = view_of({{1, {0, 0, -100}}}, rings);
  const Plan plan = plan_trace(scene, settings_of(Method::Geodesic, Choice::On));
  int hits[3] = {};
  for (double b = 5.1; b < 5.4; b += 1e-3) {
    const auto seen = probe(scene, plan, film_at(scene, 0, b / 100)).surfaces;
    for (std::size_t k = 0; k < 3; ++k) hits[k] += seen[k].outcome == Outcome::Hit;
  }
  EXPECT_GT(hits[0], hits[1]);
  EXPECT_GT(hits[1], hits[2]);
  EXPECT_GT(hits[2], 0);
}

TEST(Rings, WithinThePhotonSphereAreMetByLightThatFallsIn) {
  const Ring ring = facing_ring(30, 0.6, 1.8);
  const Scene scene = view_of({{1, {0, 0, -30}}}, {ring, LatLong{}});
  const auto seen = look(scene, film_at(scene, 0, 3.4 / 30), Method::Geodesic);
  EXPECT_EQ(seen[1].outcome, Outcome::Captured);
  EXPECT_EQ(seen[0].outcome, Outcome::Hit);
  EXPECT_EQ(look(scene, film_at(scene, 0, 2.0 / 30), Method::Geodesic)[0].outcome, Outcome::Captured);
}

TEST(Bodies, JacobianIsThatOfDifferences) {
  const std::vector<Lens> lenses = {{1e-3, {0.1, 0.2, -1}}, {2e-3, {-0.3, 0.5, -2}}};
  const Scene scene =
      view_of(lenses, {Card{1.5}, Card{4}, Ring{{0, -0.1, -2}, basis_from_zxy({-0.3, 0.5, 0.2}), 0.1, 9}});
  for (const Method method : {Method::Planes, Method::Geodesic, Method::ShinotsukaMakino}) {
    for (const FilmPosition film : {FilmPosition{52, 23}, {20, 50}}) {
      constexpr double h = 1e-3;
      const auto at = look(scene, film, method);
      const auto left = look(scene, {film.x - h, film.y}, method);
      const auto right = look(scene, {film.x + h, film.y}, method);
      const auto up = look(scene, {film.x, film.y - h}, method);
      const auto down = look(scene, {film.x, film.y + h}, method);
      for (std::size_t k = 0; k < at.size(); ++k) {
        ASSERT_EQ(at[k].outcome, Outcome::Hit);
        EXPECT_NEAR(at[k].ds_dx, (right[k].st.s - left[k].st.s) / (2 * h), 1e-8) << k;
        EXPECT_NEAR(at[k].dt_dx, (right[k].st.t - left[k].st.t) / (2 * h), 1e-8) << k;
        EXPECT_NEAR(at[k].ds_dy, (down[k].st.s - up[k].st.s) / (2 * h), 1e-8) << k;
        EXPECT_NEAR(at[k].dt_dy, (down[k].st.t - up[k].st.t) / (2 * h), 1e-8) << k;
      }
    }
  }
}

}  // namespace
}  // namespace lensplane
