// SPDX-License-Identifier: Apache-2.0

#include "pipeline/shot/shot_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "src/constants.h"
#include "tests/pipeline/expect_failure.h"
#include "tests/pipeline/shot/example_shot.h"

namespace lensplane {
namespace {

constexpr double kDegree = kPi / 180.0;

TEST(ShotScene, IsTheShotAtItsFrame) {
  const Shot shot = example_shot(
      {"lenses.near.position={keys: {1001: [0 m, 0 m, -1 m], 1003: [2 m, 0 m, -1 m]}}", "camera.overscan=4"});
  const Scene scene = scene_at(shot, 1002);
  EXPECT_EQ(scene.camera.width, 40);
  EXPECT_EQ(scene.camera.overscan, 4);
  EXPECT_EQ(scene.lenses[0].position, Vec3(1, 0, -1));
  ASSERT_EQ(scene.surfaces.size(), 2U);
  EXPECT_TRUE(std::holds_alternative<Sphere>(scene.surfaces[0]));
  EXPECT_TRUE(std::holds_alternative<Plate>(scene.surfaces[1]));
}

/// The example with a ring in the place of its plate.
Shot with_ring(const std::vector<std::string>& more = {}) {
  std::vector<std::string> settings = {
      "layers.earth.light=[0, 0, 2]",
      "layers.background={name: ring, type: ring, centre: earth, normal: [0, 3, 4], inner: 8e6 m, outer: "
      "1e7 m, image: r.png, shadow_of: earth}"};
  settings.insert(settings.end(), more.begin(), more.end());
  return example_shot(settings);
}

TEST(ShotScene, RingsStandAroundTheirSphere) {
  const Scene scene = scene_at(with_ring(), 1001);
  const auto& ring = std::get<Ring>(scene.surfaces[1]);
  EXPECT_EQ(ring.centre, std::get<Sphere>(scene.surfaces[0]).centre);
  EXPECT_LT((ring.axes.y - Vec3(0, 0.6, 0.8)).length(), 1e-15);
  EXPECT_LT((ring.axes.x.cross(ring.axes.y) - ring.axes.z).length(), 1e-15);
  EXPECT_EQ(ring.inner, 8e6);
  EXPECT_EQ(ring.outer, 1e7);
  EXPECT_TRUE(
      is_valid(std::get<Ring>(scene_at(with_ring({"layers.ring.normal=[0, 0, 1]"}), 1001).surfaces[1]).axes));
  const Vec3 towards =
      -scene_at(with_ring({"camera.look_at=ring", "camera.position=[1 m, 0 m, 0 m]"}), 1001).camera.axes.z;
  EXPECT_LT((towards - Vec3(-1, 0, -1.09e9).normalized()).length(), 1e-15);
}

TEST(ShotScene, DirectionsTurnBetweenOppositeKeys) {
  const Shot shot = with_ring({"layers.earth.light={keys: {1001: [0, 1, 0], 1003: [0, -9, 0]}}",
                               "layers.ring.normal={keys: {1001: [0, 1, 1], 1003: [0, -1, -1]}}",
                               "camera.up={keys: {1001: [0, 1, 1], 1003: [0, -1, -1]}, interpolate: smooth}",
                               "camera.look_at=[1 m, 0 m, 0 m]"});
  EXPECT_LT((*light_at(shot.layers[0], 1002) - Vec3(0, 0, 1)).length(), 1e-15);
  EXPECT_LT((shadow_at(shot, 1, 1002)->light - Vec3(0, 0, 1)).length(), 1e-15);
  EXPECT_NEAR(light_at(shot.layers[0], 1001.5)->dot(Vec3(0, 1, 0)), std::sqrt(0.5), 1e-15);
  const Vec3 normal = std::get<Ring>(scene_at(shot, 1002).surfaces[1]).axes.y;
  EXPECT_LT((normal - Vec3(0, -1, 1).normalized()).length(), 1e-15);
  const Vec3 up = scene_at(shot, 1002).camera.axes.y;
  EXPECT_LT((up - Vec3(0, -1, 1).normalized()).length(), 1e-15);
}

TEST(ShotScene, LayersThatLightCrossesAgainHaveFurtherSurfaces) {
  const auto listed = [](const Shot& shot) {
    std::string text;
    for (const LayerSurface& s : surfaces_of(shot)) {
      text += std::to_string(s.layer) + "." + std::to_string(s.crossing) + " ";
    }
    EXPECT_EQ(scene_at(shot, 1001).surfaces.size(), surfaces_of(shot).size());
    return text;
  };
  EXPECT_EQ(listed(example_shot()), "0.0 1.0 ");
  EXPECT_EQ(listed(with_ring()), "0.0 1.0 1.1 1.2 ");
  EXPECT_EQ(std::get<Ring>(scene_at(with_ring(), 1001).surfaces[3]).crossing, 2);
  EXPECT_EQ(listed(with_ring({"lenses=[]"})), "0.0 1.0 ");
  const Shot card = example_shot({"layers.background.distance={keys: {1001: 1 m, 1003: 3 m}}"});
  EXPECT_EQ(listed(card), "0.0 1.0 1.1 ");
  EXPECT_EQ(std::get<Card>(scene_at(card, 1002).surfaces[1]).distance, 2);
  EXPECT_EQ(std::get<Card>(scene_at(card, 1002).surfaces[2]).crossing, 1);
}

TEST(ShotScene, StarsHaveNoSurface) {
  const Shot shot = example_shot({"layers.earth={name: s, type: stars, catalogue: c.csv}"});
  const std::vector<LayerSurface> surfaces = surfaces_of(shot);
  ASSERT_EQ(surfaces.size(), 1U);
  EXPECT_EQ(surfaces[0].layer, 1U);
  EXPECT_TRUE(std::holds_alternative<Plate>(scene_at(shot, 1001).surfaces[0]));
  EXPECT_EQ(map_surfaces_of(shot), (std::vector<std::optional<std::size_t>>{std::nullopt, 0U}));
}

TEST(ShotScene, ShadowsFallFromTheirSphereAwayFromTheLight) {
  const auto shadow = shadow_at(with_ring(), 1, 1001);
  ASSERT_TRUE(shadow);
  EXPECT_EQ(shadow->light, Vec3(0, 0, 1));
  EXPECT_EQ(shadow->sphere.radius, 6.371e6);
  EXPECT_EQ(shadow_at(with_ring({"layers.ring.light=[0, 5, 0]"}), 1, 1001)->light, Vec3(0, 1, 0));
  EXPECT_FALSE(shadow_at(with_ring({"layers.ring.shadow_of=null"}), 1, 1001));
  // A disc of light, keyed, of the sphere or the ring itself.
  const Shot disc =
      with_ring({"layers.earth.light={direction: [1, 0, 0], diameter: {keys: {1001: 1 deg, 1003: 3 deg}}}"});
  EXPECT_NEAR(sun_at(disc.layers[0], 1002), kDegree, 1e-15);
  EXPECT_NEAR(shadow_at(disc, 1, 1001)->sun, kDegree / 2, 1e-15);
  EXPECT_EQ(sun_at(with_ring().layers[0], 1001), 0);
  const Shot own = with_ring({"layers.ring.light={direction: {keys: {1001: [0, 1, 0]}}, diameter: 2 deg}"});
  EXPECT_NEAR(shadow_at(own, 1, 1001)->sun, kDegree, 1e-15);
  EXPECT_EQ(shadow_at(own, 1, 1001)->light, Vec3(0, 1, 0));
  EXPECT_FALSE(shadow_at(with_ring(), 0, 1001));
}

TEST(ShotScene, FocalLengthAndFilmWidthMakeTheFieldOfView) {
  Shot shot = example_shot();
  shot.camera.fov = FocalLength{Keyed<double>::constant(0.018), Keyed<double>::constant(0.036), {}};
  EXPECT_DOUBLE_EQ(scene_at(shot, 1001).camera.fov_rad, kPi / 2);
}

TEST(ShotScene, CameraHasTheProjectionOfTheShot) {
  EXPECT_EQ(scene_at(example_shot(), 1001).camera.projection, Projection::Perspective);
  const Camera fisheye =
      scene_at(
          example_shot({"camera.projection=fisheye", "camera.fov={keys: {1001: 100 deg, 1003: 300 deg}}"}),
          1002)
          .camera;
  EXPECT_EQ(fisheye.projection, Projection::Fisheye);
  EXPECT_DOUBLE_EQ(fisheye.fov_rad, 200 * kPi / 180);
  const Shot latlong = example_shot({"camera.projection=latlong", "camera.fov=null"});
  EXPECT_EQ(scene_at(latlong, 1001).camera.projection, Projection::LatLong);
}

TEST(ShotScene, TraceKeepsToTheShotAtItsFrame) {
  const Shot shot =
      example_shot({"trace={method: planes, law: second-order, tolerance: {keys: {1001: 0.1 px, 1003: "
                    "0.3 px}}, effects: {finite_distance: on}}",
                    "output.data=[delay]"});
  const TraceSettings settings = trace_at(shot, 1002);
  EXPECT_EQ(settings.method, Method::Planes);
  EXPECT_EQ(settings.law, Law::SecondOrder);
  EXPECT_DOUBLE_EQ(settings.tolerance_px, 0.2);
  EXPECT_EQ(settings.finite_distance, Choice::On);
  EXPECT_TRUE(settings.effects.delay);
  EXPECT_FALSE(settings.effects.derivatives());
}

TEST(ShotScene, CameraLooksAtPointsLensesAndLayers) {
  const auto forward = [](const std::string& target) {
    return -scene_at(example_shot({"camera.position=[0 m, 3e8 m, 0 m]", "camera.look_at=" + target}), 1001)
                .camera.axes.z;
  };
  const Vec3 to_lens = Vec3(0, -3e8, -4.36e8).normalized();
  const Vec3 to_earth = Vec3(0, -3e8, -1.09e9).normalized();
  EXPECT_LT((forward("near") - to_lens).length(), 1e-14);
  EXPECT_LT((forward("earth") - to_earth).length(), 1e-14);
  EXPECT_LT((forward("[0 m, 0 m, -1.09e9 m]") - to_earth).length(), 1e-14);
}

TEST(ShotScene, CameraThatLooksNowhereIsRefusedWithItsPlace) {
  for (const char* target : {"[0 m, 0 m, 0 m]", "[0 m, 5 m, 0 m]"}) {
    const Shot shot = example_shot({std::string("camera.look_at=") + target});
    const Refusal refusal = refusal_of([&] { scene_at(shot, 1002); });
    EXPECT_EQ(refusal.line,
              "--set camera.look_at:1:1: camera.look_at: at frame 1002 the camera looks at its own position "
              "or straight "
              "along up");
  }
}

TEST(ShotScene, ProxyKeepsTheViewAndEvenOverscan) {
  const Shot shot = proxy_of(example_shot({"camera.resolution=[1920, 1080]", "camera.overscan=100"}), 4);
  EXPECT_EQ(shot.camera.width, 480);
  EXPECT_EQ(shot.camera.height, 270);
  EXPECT_EQ(shot.camera.overscan, 24);
  EXPECT_EQ(*proxy_of(shot, 64).camera.overscan % 2, 0);
  EXPECT_EQ(proxy_of(example_shot({"camera.overscan=auto"}), 4).camera.overscan, std::nullopt);
  EXPECT_EQ(proxy_of(example_shot(), 64).camera.width, 1);
}

}  // namespace
}  // namespace lensplane
