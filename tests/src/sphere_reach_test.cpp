// SPDX-License-Identifier: Apache-2.0

#include "src/sphere_reach.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "src/bodies.h"
#include "src/finite_shift.h"
#include "src/single_ray.h"
#include "src/tracer.h"
#include "tests/src/planes_batches.h"

namespace lensplane {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Of stretches that meet no sphere: so many are to be spared, at least, of spheres a few times smaller than
// the scene.
constexpr double kSpared = 0.8;
// Of rays side by side one of which looks about for the sphere.
constexpr double kSparedOfPieces = 0.5;

/// The stretches of a batch of rays before, between and behind planes: of each ray its number `bends`.
template <class Number>
struct Stretched {
  LineBatch<Number> rays;
  Ends ends;
  std::array<bool, kBatchSize> there{};  // false where a ray has no such stretch
};

template <class Number>
std::unique_ptr<Stretched<Number>> stretches_of(const std::vector<RayPath<Number>>& paths, int bends) {
  auto result = std::make_unique<Stretched<Number>>();
  for (std::size_t i = 0; i < kBatchSize; ++i) {
    const auto n = static_cast<int>(i);
    const RaySegment<Number>* found = nullptr;
    for (const RaySegment<Number>& segment : paths[i].segments) {
      const std::size_t number = static_cast<std::size_t>(&segment - paths[i].segments.data());
      const bool chord = number % 2 == 1;  // as the path of `planes` has them
      if (!chord && segment.bends == bends) found = &segment;
    }
    result->there[i] = found && !paths[i].captured;
    const RaySegment<Number>& used = found ? *found : paths[i].segments.front();
    result->rays.start.set(n, used.start);
    result->rays.direction.set(n, used.direction);
    result->ends.at[i] = value_of(used.length);
  }
  return result;
}

struct Count {
  int hits = 0, misses = 0, flagged = 0;  // flagged: of the misses
};

bool enters(const RaySegment<double>& stretch, const Sphere& sphere, double length) {
  const double entry = sphere_entry(stretch.start, stretch.direction, sphere.centre, sphere.radius);
  return entry <= length && entry < kInfinity;
}

/// Holds find_near() against where every ray truly enters the sphere on its stretch.
void check_stretches(const Stretched<double>& stretched, int bends, const Deflectors* finite,
                     const Sphere& sphere, Count& count) {
  alignas(64) BatchArray near;
  find_near(Stretches<double>{stretched.rays, stretched.ends, bends, finite}, sphere, near);
  for (int i = 0; i < kBatchSize; ++i) {
    if (!stretched.there[static_cast<std::size_t>(i)]) continue;
    RaySegment<double> stretch{stretched.rays.start.get(i), stretched.rays.direction.get(i),
                               stretched.ends.at[i], bends};
    if (finite) stretch = shifted_to_ball(*finite, stretch, sphere);
    if (enters(stretch, sphere, stretched.ends.at[i])) {
      ++count.hits;
      ASSERT_EQ(near[i], 1.0) << "ray " << i << " after " << bends << " planes";
    } else {
      ++count.misses;
      count.flagged += near[i] != 0.0 ? 1 : 0;
    }
  }
}

/// The same for the chords from the stretches after `bends` planes to the next.
void check_chords(const Stretched<double>& before, const Stretched<double>& after, int bends,
                  const Deflectors* finite, const Sphere& sphere, Count& count) {
  alignas(64) BatchArray near = {};
  add_near_chords(Stretches<double>{before.rays, before.ends, bends, finite}, after.rays, sphere, near);
  for (int i = 0; i < kBatchSize; ++i) {
    const auto n = static_cast<std::size_t>(i);
    if (!before.there[n] || !after.there[n]) continue;
    const RaySegment<double> in{before.rays.start.get(i), before.rays.direction.get(i), before.ends.at[i],
                                bends};
    const RaySegment<double> out{after.rays.start.get(i), after.rays.direction.get(i), 0.0, bends + 1};
    const RaySegment<double> chord =
        finite ? chord_between(*finite, in, out)
               : straight_between(in.start + in.direction * in.length, out.start, in);
    if (enters(chord, sphere, chord.length)) {
      ++count.hits;
      ASSERT_EQ(near[i], 1.0) << "ray " << i << " after " << bends << " planes";
    } else {
      ++count.misses;
      count.flagged += near[i] != 0.0 ? 1 : 0;
    }
  }
}

/// A sphere somewhere about a stretch of a random ray.
Sphere random_sphere(std::mt19937& random, const std::vector<RayPath<double>>& paths, double largest) {
  std::uniform_real_distribution<double> share(0, 1);
  std::normal_distribution<double> normal;
  const RayPath<double>& path = paths[random() % paths.size()];
  const RaySegment<double>& segment = path.segments[random() % path.segments.size()];
  const double length = std::min(segment.length, 100.0);
  const double radius = largest * std::pow(10.0, -3 * share(random));
  const Vec3 aside = Vec3(normal(random), normal(random), normal(random)) * radius;
  return {segment.start + segment.direction * (length * share(random)) + aside, radius, {}};
}

/// `piece`: rays of two rows of a tile, which are far from a sphere as a whole or not, instead of rays from
/// all over the film.
void check_scene(std::mt19937& random, const Scene& scene, Choice finite_distance, bool piece,
                 Count& straight, Count& chords) {
  const Plan plan = plan_trace(scene, TraceSettings{Method::Planes, Law::Exact, 0.05, finite_distance, {}});
  const Deflectors& deflectors = plan.recipes.back();
  const Deflectors* finite = deflectors.finite_distance ? &deflectors : nullptr;
  Film film;
  random_film(random, scene.camera, film);
  if (piece) {
    for (int i = 0; i < kBatchSize; ++i) film.x[i] = film.x[0] + i % 64, film.y[i] = film.y[0] + i / 64;
  }
  std::vector<RayPath<double>> paths;
  for (int i = 0; i < kBatchSize; ++i) {
    paths.push_back(path_of_ray<double>(scene.camera, plan, plan.recipes.size() - 1, {film.x[i], film.y[i]}));
  }
  for (int bends = 0; bends <= static_cast<int>(deflectors.outward); ++bends) {
    const auto before = stretches_of(paths, bends), after = stretches_of(paths, bends + 1);
    for (int n = 0; n < 20; ++n) {
      const Sphere sphere = random_sphere(random, paths, 10.0);
      check_stretches(*before, bends, finite, sphere, straight);
      if (bends < static_cast<int>(deflectors.outward))
        check_chords(*before, *after, bends, finite, sphere, chords);
    }
  }
}

void check_scenes(std::mt19937& random, Projection projection, Choice finite_distance, bool piece,
                  double spared) {
  Count straight, chords;
  for (const double m : {1e-4, 1e-2, 0.3}) {
    for (int n = 0; n < 6; ++n) {
      check_scene(random, random_scene(random, projection, 1 + n % 3, 1 + n % 2, m), finite_distance, piece,
                  straight, chords);
    }
  }
  EXPECT_GT(straight.hits, 500);
  EXPECT_LT(straight.flagged, (1 - spared) * straight.misses);
  EXPECT_GT(chords.hits, 10);
  EXPECT_LT(chords.flagged, (1 - spared) * chords.misses);
}

TEST(SphereReach, EveryRayThatMeetsASphereIsNear) {
  std::mt19937 random(7);
  for (const Projection projection : {Projection::Perspective, Projection::LatLong}) {
    for (const Choice finite : {Choice::Off, Choice::On}) {
      if (projection == Projection::LatLong && finite == Choice::Off) continue;
      check_scenes(random, projection, finite, false, kSpared);
      check_scenes(random, projection, finite, true, kSparedOfPieces);
    }
  }
}

TEST(SphereReach, StretchesEndWhereTheyEnd) {
  // Along -z from the origin to z = -10, and a ball that begins at z = -11, or -9; beside it, and behind.
  auto rays = std::make_unique<LineBatch<double>>();
  Ends ends;
  for (int i = 0; i < kBatchSize; ++i) {
    rays->start.set(i, {0, 0, 0});
    rays->direction.set(i, {0, 0, -1});
    ends.at[i] = 10;
  }
  const struct {
    Sphere sphere;
    double near;
  } cases[] = {{{{0, 0, -13}, 2, {}}, 0},   {{{0, 0, -11}, 2, {}}, 1},    {{{2.01, 0, -5}, 2, {}}, 0},
               {{{1.99, 0, -5}, 2, {}}, 1}, {{{0, 0, 2.01}, 2, {}}, 0},   {{{0, 0, 1.99}, 2, {}}, 1},
               {{{0, 1.5, -11}, 2, {}}, 1}, {{{0, 1.9, -10.9}, 2, {}}, 0}};
  for (const auto& c : cases) {
    alignas(64) BatchArray near;
    find_near(Stretches<double>{*rays, ends, 0, nullptr}, c.sphere, near);
    for (const double flag : near) EXPECT_EQ(flag, c.near) << c.sphere.centre;
  }
}

/// The tracer sees what single rays see that look for the sphere on every stretch.
TEST(SphereReach, TracersFindWhatSingleRaysFind) {
  std::mt19937 random(11);
  int hits = 0;
  for (int n = 0; n < 12; ++n) {
    Scene scene = random_scene(random, n % 2 ? Projection::LatLong : Projection::Perspective, 2, 2, 0.2);
    for (int k = 0; k < 3; ++k) {
      const Vec3 lens = scene.lenses[random() % scene.lenses.size()].position;
      scene.surfaces.push_back(Sphere{lens * (0.9 + 0.2 * k), 3.0 + k, {}});
    }
    TraceSettings settings{Method::Planes, Law::Exact, 0.05, Choice::On, {}};
    settings.effects.jacobian = n % 4 >= 2;  // with derivatives or without
    const Plan plan = plan_trace(scene, settings);
    const Tracer tracer(scene, plan);
    TraceBatch batch = tracer.make_batch();
    Film film;
    random_film(random, scene.camera, film);
    std::copy_n(film.x, kBatchSize, batch.x);
    std::copy_n(film.y, kBatchSize, batch.y);
    tracer.trace(batch);
    const Sight sight{scene.camera, tracer.surfaces(), plan.effects, slope_per_pixel(scene.camera),
                      &plan.recipes.back()};
    for (std::size_t i = 0; i < kBatchSize; ++i) {
      const auto single =
          trace_ray<double>(sight, plan, plan.recipes.size() - 1, {film.x[i], film.y[i]}).hits;
      for (std::size_t k = 0; k < 3; ++k) {
        ASSERT_EQ(batch.surfaces[k].outcome[i], single[k].outcome) << n << " " << i << " " << k;
        hits += single[k].outcome == Outcome::Hit ? 1 : 0;
      }
    }
  }
  EXPECT_GT(hits, 100);
}

}  // namespace
}  // namespace lensplane
