// SPDX-License-Identifier: Apache-2.0

#include "src/planes_batch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "src/planes_march.h"
#include "tests/src/planes_batches.h"

namespace lensplane {
namespace {

/// How far the last digits carry in the end, in units of kPlanesBatchError: radians, and metres.
struct Carried {
  double direction = 1, position = 0;
};

/// Each bend adds its own error, and what its steepness makes of those in the ray's position so far.
template <class Number>
Carried carried(const Deflectors& deflectors, const RayPath<Number>& path) {
  constexpr double kNearB = (kFarError + kExactLawError) / kPlanesBatchError;
  Carried sum;
  std::size_t passage = 0;
  for (std::size_t k = 0; k < deflectors.outward; ++k) {
    double steepness = 0, own = 0, distance = 0;
    for (const Deflector& deflector : deflectors.planes[k].deflectors) {
      const Passage<Number>& p = path.passages[passage++];
      const double b = std::max(deflector.index * value_of(p.b), (1 + 1e-15) * kCriticalRatio * deflector.m);
      const double slope = -exact_law(deflector.m, b).dalpha_db;
      own += 1 + value_of(p.alpha) + slope * b * kNearB;
      steepness += slope;
      distance = std::max(distance, p.distance);
    }
    sum.position += distance * (1 + sum.direction);
    sum.direction += own + steepness * sum.position;
    sum.position += distance * sum.direction;
  }
  return sum;
}

/// Two ways to the same derivatives agree to this share of them, enlarged as directions are: measured.
constexpr double kTangentError = 5e-14;

double tangent_apart(const LineBatch<Dual>& rays, int i, const RayPath<Dual>& path) {
  const DualVec3 ours = rays.direction.get(i), theirs = path.segments.back().direction;
  return std::max(
      (derivative_by_x(ours) - derivative_by_x(theirs)).length() / derivative_by_x(theirs).length(),
      (derivative_by_y(ours) - derivative_by_y(theirs)).length() / derivative_by_y(theirs).length());
}
double tangent_apart(const LineBatch<double>&, int, const RayPath<double>&) {
  return 0;
}

struct Tally {
  int regular = 0, irregular = 0, captured = 0;
};

template <class Number>
void compare(const Scene& scene, const Deflectors& deflectors, const PlanesWork& work, const Film& film,
             Tally& tally) {
  const auto rays = passed<Number>(scene.camera, deflectors, work, film);
  for (int i = 0; i < kBatchSize; ++i) {
    if (rays->irregular[i] != 0) {
      ++tally.irregular;
      continue;
    }
    const auto first = direction_from_film<Number>(scene.camera, {film.x[i], film.y[i]});
    const auto path = march_planes<Number>(deflectors, first);
    ASSERT_EQ(rays->captured[i] != 0, path.captured);
    if (path.captured) {
      ++tally.captured;
      continue;
    }
    ++tally.regular;
    ASSERT_EQ(path.bends, static_cast<int>(deflectors.outward));
    const Carried most = carried(deflectors, path);
    const RaySegment<Number>& last = path.segments.back();
    const Vec3 direction = value_of(rays->direction.get(i)), start = value_of(rays->start.get(i));
    EXPECT_NEAR((direction - value_of(last.direction)).length(), 0, kPlanesBatchError * most.direction);
    EXPECT_NEAR((start - value_of(last.start)).length(), 0, kPlanesBatchError * most.position);
    EXPECT_NEAR(rays->path.v[i], value_of(path.lengths.back()), kPlanesBatchError * most.position);
    EXPECT_LE(tangent_apart(*rays, i, path), kTangentError * most.direction);
  }
}

/// Compares kernels and reference in 30 scenes, from weak bends to strong ones.
Tally tally_of(std::mt19937& random, Projection projection, Law law, bool finite, bool company,
               const PlanesWork& work) {
  Tally tally;
  for (int trial = 0; trial < 30; ++trial) {
    const double m = std::pow(10.0, -5 + 4.5 * trial / 30);
    const Scene scene = random_scene(random, projection, trial % 4 / 2 * 2 + 1, trial % 2 * 2 + 1, m);
    const Deflectors alone = deflectors_of(scene, law, finite);
    const Deflectors deflectors = company ? in_company(alone) : alone;
    Film film;
    random_film(random, scene.camera, film);
    compare<double>(scene, deflectors, work, film, tally);
    compare<Dual>(scene, deflectors, work, film, tally);
  }
  return tally;
}

TEST(PlanesBatch, AgreesWithTheReferenceInEveryKernel) {
  std::mt19937 random(3);
  int captured = 0;
  for (const Projection projection : {Projection::Perspective, Projection::LatLong}) {
    for (const LawEntry& law : kLaws) {
      for (const bool finite : {false, true}) {
        for (const bool company : {false, true}) {
          const Tally far = tally_of(random, projection, law.law, finite, company, kFarWork);
          EXPECT_GT(far.regular, 0.9 * 30 * 2 * kBatchSize);
          EXPECT_EQ(far.captured, 0);
          const Tally near = tally_of(random, projection, law.law, finite, company, kNearWork);
          EXPECT_GT(near.regular, 0.99 * 30 * 2 * kBatchSize);
          captured += near.captured;
        }
      }
    }
  }
  EXPECT_GT(captured, 50);
}

TEST(PlanesBatch, DerivativesAreThoseOfDifferences) {
  std::mt19937 random(4);
  int compared = 0;
  for (int trial = 0; trial < 24; ++trial) {
    const Projection projection = trial % 2 ? Projection::LatLong : Projection::Perspective;
    const Scene scene = random_scene(random, projection, 1 + trial % 3, 1 + trial % 4 / 2 * 2, 0.05);
    const Deflectors deflectors =
        in_company(deflectors_of(scene, kLaws[static_cast<std::size_t>(trial % 3)].law, trial % 8 < 4));
    Film film;
    random_film(random, scene.camera, film);
    const auto rays = passed<Dual>(scene.camera, deflectors, kNearWork, film);
    const auto last = [&](int i, double right, double down) {
      const FilmPosition at{film.x[i] + right, film.y[i] + down};
      return march_planes<double>(deflectors, direction_from_film<double>(scene.camera, at)).segments.back();
    };
    for (int i = 0; i < kBatchSize; ++i) {
      if (rays->irregular[i] + rays->captured[i] != 0) continue;
      const DualVec3 first = direction_from_film<Dual>(scene.camera, {film.x[i], film.y[i]});
      const double growth = carried(deflectors, march_planes<Dual>(deflectors, first)).direction;
      // Too curved for differences; or between a mass ahead and behind, where second derivatives jump.
      const bool beside = std::any_of(scene.lenses.begin(), scene.lenses.end(), [&](const Lens& lens) {
        return std::abs(lens.position.dot(value_of(first))) < 0.01 * lens.position.length();
      });
      if (growth > 50 || beside) continue;
      ++compared;
      constexpr double kStep = 0.02;
      const auto slope = [&](auto member, double right, double down) {  // of fourth order in the step
        const auto at = [&](double steps) {
          return last(i, steps * kStep * right, steps * kStep * down).*member;
        };
        return ((at(1) - at(-1)) * 8.0 - (at(2) - at(-2))) / (12 * kStep);
      };
      const auto expect_near = [&](const Vec3& ours, const Vec3& differences) {
        EXPECT_NEAR((ours - differences).length(), 0, 3e-8 * differences.length()) << trial << " " << i;
      };
      using Stretch = RaySegment<double>;
      expect_near(derivative_by_x(rays->direction.get(i)), slope(&Stretch::direction, 1, 0));
      expect_near(derivative_by_y(rays->direction.get(i)), slope(&Stretch::direction, 0, 1));
      // Where on the line a stretch starts is of no account: across it.
      const Vec3 along = value_of(rays->direction.get(i));
      const auto across = [&](const Vec3& v) { return v - along * v.dot(along); };
      expect_near(across(derivative_by_x(rays->start.get(i))), across(slope(&Stretch::start, 1, 0)));
      expect_near(across(derivative_by_y(rays->start.get(i))), across(slope(&Stretch::start, 0, 1)));
    }
  }
  EXPECT_GT(compared, 2000);
}

}  // namespace
}  // namespace lensplane
