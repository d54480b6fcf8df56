// SPDX-License-Identifier: Apache-2.0
//
// Which rays the kernels of `planes` capture, and which they leave to others.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/src/planes_batches.h"

namespace lensplane {
namespace {

/// Rays straight ahead past a mass `b` aside, 1000 m away.
template <class Number>
std::unique_ptr<LineBatch<Number>> ahead_past(double m, double b, const LawEntry& law, bool finite,
                                              const PlanesWork& work) {
  Camera camera = test_camera(0.5);
  Film film;
  std::fill_n(film.x, kBatchSize, camera.width / 2.0);
  std::fill_n(film.y, kBatchSize, camera.height / 2.0);
  return passed<Number>(camera, flat_deflectors({{m, {b, 0, -1000}}}, law.law, finite), work, film);
}

/// b_c as the camera sees it 1000 m away: n b = b_c.
double critical_b(double m, bool finite) {
  double b = kCriticalRatio * m;
  for (int i = 0; finite && i < 10; ++i) b = kCriticalRatio * m / fermat_index(m, std::hypot(1000, b));
  return b;
}

TEST(PlanesBatch, CapturesUpToTheCriticalImpactParameter) {
  for (const LawEntry& law : kLaws) {
    for (const bool finite : {false, true}) {
      for (const double m : {1.0, 1e-7, 3.0}) {
        const auto captured = [&](double b) {
          const bool plain = ahead_past<double>(m, b, law, finite, kNearWork)->captured[0] != 0;
          EXPECT_EQ(ahead_past<Dual>(m, b, law, finite, kNearWork)->captured[0] != 0, plain);
          return plain;
        };
        EXPECT_TRUE(captured(critical_b(m, finite) * (1 - 1e-12))) << law.name << " " << finite;
        EXPECT_FALSE(captured(critical_b(m, finite) * (1 + 1e-12))) << law.name << " " << finite;
      }
    }
  }
}

TEST(PlanesBatch, LeavesToOthersWhatItCannotDo) {
  const auto irregular = [](double m, double b, const PlanesWork& work) {
    return ahead_past<double>(m, b, kLaws.back(), false, work)->irregular[0] != 0;
  };
  // Far: up to b_c/kFarRatio. Its bend there, 0.040, is below kShortTurn.
  const double nearest = kCriticalRatio / kFarRatio;
  EXPECT_FALSE(irregular(1, nearest * (1 + 1e-12), kFarWork));
  EXPECT_TRUE(irregular(1, nearest * (1 - 1e-12), kFarWork));
  // Near: everything, but for squares of which nothing is left.
  EXPECT_FALSE(irregular(1, kCriticalRatio * (1 + 1e-15), kNearWork));
  EXPECT_FALSE(irregular(1, 5.2, kNearWork));
  EXPECT_FALSE(irregular(1e-130, 1e-120, kNearWork));
  EXPECT_TRUE(irregular(1e-160, 1e-150, kNearWork));
  EXPECT_TRUE(irregular(1, 1e150, kNearWork));
  EXPECT_TRUE(irregular(0.1, 0, kFarWork));
}

TEST(PlanesBatch, LeavesLightThatTurnsBackToOthersOnlyIfItMayMeetMore) {
  const Camera camera = test_camera(0.5);
  Film film;
  std::fill_n(film.x, kBatchSize, camera.width / 2.0);
  std::fill_n(film.y, kBatchSize, camera.height / 2.0);
  const Lens strong{1, {5.4, 0, -100}}, other{1, {0, 50, -200}};
  EXPECT_EQ(passed<double>(camera, flat_deflectors({strong}, Law::Exact), kNearWork, film)->irregular[0], 0);
  EXPECT_NE(
      passed<double>(camera, flat_deflectors({strong, other}, Law::Exact), kNearWork, film)->irregular[0], 0);
}

TEST(PlanesBatch, ARayDoesNotDependOnItsNeighbours) {
  std::mt19937 random(5);
  const Scene scene = random_scene(random, Projection::Perspective, 2, 3, 0.1);
  const Deflectors deflectors = deflectors_of(scene, Law::Exact, true);
  Film film, reversed;
  random_film(random, scene.camera, film);
  std::reverse_copy(film.x, film.x + kBatchSize, reversed.x);
  std::reverse_copy(film.y, film.y + kBatchSize, reversed.y);
  const auto a = passed<Dual>(scene.camera, deflectors, kNearWork, film);
  const auto b = passed<Dual>(scene.camera, deflectors, kNearWork, reversed);
  for (int i = 0; i < kBatchSize; ++i) {
    const int k = kBatchSize - 1 - i;
    ASSERT_EQ(a->irregular[i], b->irregular[k]);
    if (a->irregular[i] + a->captured[i] != 0) continue;
    EXPECT_EQ(value_of(a->direction.get(i)), value_of(b->direction.get(k)));
    EXPECT_EQ(derivative_by_x(a->direction.get(i)), derivative_by_x(b->direction.get(k)));
    EXPECT_EQ(value_of(a->start.get(i)), value_of(b->start.get(k)));
  }
}

}  // namespace
}  // namespace lensplane
