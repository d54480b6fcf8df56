// SPDX-License-Identifier: Apache-2.0
//
// Magnification and arrival time of a point mass's two images, through the tracer's own surfaces.

#include <gtest/gtest.h>

#include <cmath>

#include "src/probe.h"
#include "tests/src/deflector_scenes.h"
#include "tests/src/scenes.h"

namespace lensplane {
namespace {

/// A point lens's images of a source u Einstein angles away: positions, amplification, and the time between
/// them in 4GM/c^3.
struct PointLens {
  double u, plus, minus, amplification, between;
};
constexpr PointLens kPublished[] = {
    {0.1, 1.05124921972503929, -0.951249219725039286, 10.037461005722339, 0.200083302111201259},
    {0.5, 1.28077640640441514, -0.780776406404415137, 2.18282062532699676, 1.01032112629673447},
    {1, 1.61803398874989485, -0.618033988749894848, 1.34164078649987382, 2.08045763886910174},
    {2, 2.41421356237309505, -0.414213562373095049, 1.06066017977182129, 4.59117429878527615}};

constexpr double kDistance = 1e9;
constexpr Effects kAll{true, true, true, true, true, true, true};

/// A mass on the axis whose Einstein angle for light from infinity is `einstein`, a sky and a plate.
Scene lens_scene(double einstein) {
  Scene scene;
  scene.camera.width = 1000;
  scene.camera.height = 500;
  scene.camera.fov_rad = 10 * einstein;
  scene.lenses = {{einstein * einstein * kDistance / 4, {0, 0, -kDistance}}};
  scene.surfaces = {LatLong{}, Plate{}};
  return scene;
}

/// The film position that sees the angle `theta`, towards +x and a third of it towards +y.
FilmPosition film_at(const Scene& scene, double theta) {
  const double slope = slope_per_pixel(scene.camera);
  const double along = theta / slope / std::sqrt(10.0);
  return {scene.camera.width / 2.0 + 3 * along, scene.camera.height / 2.0 - along};
}

Probe look(const Scene& scene, double theta, Choice finite = Choice::Off) {
  const Plan plan = plan_trace(scene, TraceSettings{Method::Planes, Law::Weak, 1, finite, kAll});
  return probe(scene, plan, film_at(scene, theta));
}

TEST(Magnification, OfAPointMassIsThePublishedOne) {
  const double einstein = 1e-5;
  const Scene scene = lens_scene(einstein);
  for (const PointLens& lens : kPublished) {
    const Probe plus = look(scene, lens.plus * einstein), minus = look(scene, lens.minus * einstein);
    for (const std::size_t surface : {0U, 1U}) {
      const double mu_plus = plus.surfaces[surface].magnification;
      const double mu_minus = minus.surfaces[surface].magnification;
      EXPECT_GT(mu_plus, 0);
      EXPECT_LT(mu_minus, 0);  // mirrored
      EXPECT_NEAR(mu_plus - std::abs(mu_minus), 1, 1e-8) << lens.u;
      EXPECT_NEAR(mu_plus + std::abs(mu_minus), lens.amplification, 1e-8 * lens.amplification) << lens.u;
    }
    // Both see the same place.
    EXPECT_NEAR(angle_between(plus.last, minus.last), 0, 1e-8 * einstein);
    EXPECT_NEAR(angle_between(plus.last, Vec3(0, 0, -1)), lens.u * einstein, 1e-8 * einstein);
  }
}

TEST(Magnification, OnABallBehindAPointMassIsThePublishedOne) {
  // A ball whose front is as far behind the mass as the camera is before it; theta_E^2 = 4m/(2 D).
  const double einstein = 1e-5;
  Scene scene = lens_scene(einstein * std::sqrt(2.0));
  scene.surfaces = {Sphere{{0, 0, -2.5 * kDistance}, 0.5 * kDistance, {}}};
  for (const PointLens& lens : kPublished) {
    const ProbedSurface plus = look(scene, lens.plus * einstein).surfaces[0];
    const ProbedSurface minus = look(scene, lens.minus * einstein).surfaces[0];
    ASSERT_EQ(plus.outcome, Outcome::Hit);
    EXPECT_GT(plus.magnification, 0);
    EXPECT_LT(minus.magnification, 0);
    EXPECT_NEAR(plus.magnification + minus.magnification, 1, 1e-7) << lens.u;
    EXPECT_NEAR(plus.magnification - minus.magnification, lens.amplification, 1e-7 * lens.amplification);
    EXPECT_NEAR(plus.st.s, minus.st.s, 1e-7 * einstein);
    EXPECT_NEAR(plus.st.t, minus.st.t, 1e-7 * einstein);
  }
}

TEST(Magnification, WithoutMassesIsOneOnEverySurface) {
  Scene scene = lens_scene(0.1);
  scene.lenses.clear();
  scene.surfaces.push_back(Sphere{{0.5, 0, -5}, 3, basis_from_zxy({0.4, 1, 0})});
  scene.surfaces.push_back(Card{7});
  for (const double tilt : {0.5, 2.0}) {  // both sides
    scene.surfaces.push_back(Ring{{0.5, 0, -5}, basis_from_zxy({tilt, 0.1, 0.2}), 0, 4});
  }
  for (const Projection projection : {Projection::Perspective, Projection::LatLong, Projection::Fisheye}) {
    scene.camera.projection = projection;
    for (const double theta : {-0.03, 0.01, 0.05}) {
      for (const ProbedSurface& surface : look(scene, theta).surfaces) {
        ASSERT_EQ(surface.outcome, Outcome::Hit) << static_cast<int>(projection);
        EXPECT_NEAR(surface.magnification, 1, 1e-13);
      }
    }
  }
}

TEST(ArrivalTime, BetweenTheImagesOfAPointMassIsThePublishedOne) {
  for (const double einstein : {1e-2, 1e-3}) {
    const Scene scene = lens_scene(einstein);
    const double unit = 4 * scene.lenses[0].m / kLightSpeed;
    for (const PointLens& lens : kPublished) {
      for (const std::size_t surface : {0U, 1U}) {
        const double plus = look(scene, lens.plus * einstein).surfaces[surface].delay;
        const double minus = look(scene, lens.minus * einstein).surfaces[surface].delay;
        // What finite angles change, and what is left of 16 digits of the path.
        EXPECT_NEAR((minus - plus) / unit, lens.between,
                    3 * einstein * einstein + 1e-15 / (einstein * einstein))
            << lens.u;
      }
    }
  }
}

TEST(ArrivalTime, OfLightFromABallIsThePublishedOne) {
  for (const double einstein : {1e-2, 1e-3}) {
    Scene scene = lens_scene(einstein * std::sqrt(2.0));
    scene.surfaces = {Sphere{{0, 0, -2.5 * kDistance}, 0.5 * kDistance, {}}};
    const double unit = 4 * scene.lenses[0].m / kLightSpeed;
    for (const PointLens& lens : kPublished) {
      const double plus = look(scene, lens.plus * einstein).surfaces[0].delay;
      const double minus = look(scene, lens.minus * einstein).surfaces[0].delay;
      EXPECT_NEAR((minus - plus) / unit, lens.between, 40 * einstein * einstein) << lens.u;
    }
  }
}

TEST(ArrivalTime, WithoutMassesIsThatOfEmptySpace) {
  Scene scene = lens_scene(0.1);
  scene.lenses.clear();
  scene.surfaces.push_back(Sphere{{0.5, 0, -5e8}, 3e8, {}});
  for (const ProbedSurface& surface : look(scene, 0.2).surfaces) {
    EXPECT_NEAR(surface.delay * kLightSpeed, 0, 1e-15 * kDistance);
  }
}

}  // namespace
}  // namespace lensplane
