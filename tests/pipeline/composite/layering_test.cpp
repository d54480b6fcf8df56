// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/layering.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "src/bodies.h"
#include "src/constants.h"

namespace lensplane {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr float kRounding = 2e-6F;

std::shared_ptr<const Texture> flat(const Rgba& colour) {
  return std::make_shared<const Texture>(Picture{1, 1, 0, 0, 1, 1, {colour}}, Wrap::Clamp);
}

void expect_colour(const Rgba& got, const Rgba& expected) {
  for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(got[c], expected[c], kRounding) << "channel " << c;
}

/// (s, t) of a sphere's equator where the cosine to a light along +z is `cosine`.
TextureCoordinates on_equator(double cosine) {
  return {0.5 + std::acos(cosine) / (2 * kPi), 0.5};
}

const Rgba kDay{0.8F, 0.4F, 0.2F, 1}, kNight{0.1F, 0.2F, 0.3F, 1};

TEST(Layering, SpheresAreLitByLambertsLaw) {
  const SurfaceLook look{flat(kDay), Vec3(0, 0, 1)};
  for (const double cosine : {1.0, 0.5, 0.1, 0.0, -0.1, -1.0}) {
    const auto lit = static_cast<float>(std::max(0.0, cosine));
    expect_colour(shade(Sphere{}, look, on_equator(cosine), {}), {0.8F * lit, 0.4F * lit, 0.2F * lit, 1});
  }
  // Light from the north: the sine of the latitude.
  const SurfaceLook north{flat(kDay), Vec3(0, 1, 0)};
  expect_colour(shade(Sphere{}, north, {0.123, 0.5 + 30.0 / 180}, {}), {0.4F, 0.2F, 0.1F, 1});
  // Without light the texture as it is; plates and skies are not lit.
  expect_colour(shade(Sphere{}, {flat(kDay)}, on_equator(-1), {}), kDay);
  expect_colour(shade(Plate{}, look, on_equator(-1), {}), kDay);
  expect_colour(shade(LatLong{}, look, on_equator(-1), {}), kDay);
}

TEST(Layering, TheGainMultipliesAllLightAndNoAlpha) {
  SurfaceLook look{flat({0.4F, 0.2F, 0.1F, 0.5F}), Vec3(0, 0, 1), flat(kNight)};
  look.gain = 4;
  expect_colour(shade(Plate{}, look, {0.5, 0.5}, {}), {1.6F, 0.8F, 0.4F, 0.5F});
  expect_colour(shade(Sphere{}, look, on_equator(0.5), {}), {0.8F, 0.4F, 0.2F, 0.5F});
  expect_colour(shade(Sphere{}, look, on_equator(-1), {}), {0.4F, 0.8F, 1.2F, 0.5F});
}

TEST(Layering, NightFadesInOverTheTwilight) {
  const SurfaceLook look{flat(kDay), Vec3(0, 0, 1), flat(kNight)};
  // The share of the night: 3 x^2 - 2 x^3 of x = (kTwilight - cosine)/(2 kTwilight), by hand.
  const struct {
    double cosine;
    float night;
  } cases[] = {
      {1, 0},          {kTwilight, 0}, {kTwilight / 2, 0.15625F}, {0, 0.5F}, {-kTwilight / 2, 0.84375F},
      {-kTwilight, 1}, {-1, 1}};
  for (const auto& c : cases) {
    const auto lit = static_cast<float>(std::max(0.0, c.cosine));
    expect_colour(shade(Sphere{}, look, on_equator(c.cosine), {}),
                  {0.8F * lit + 0.1F * c.night, 0.4F * lit + 0.2F * c.night, 0.2F * lit + 0.3F * c.night, 1});
  }
}

const Ring kRing{{3, -7, 11}, basis_from_zxy({0.3, -1.1, 0.7}), 10, 30};

/// Of a ring's point in its own axes, relative to its centre, in its plane y = 0.
TextureCoordinates on_ring(double x, double z) {
  return {(std::hypot(x, z) - 10) / 20, 0.5 + std::atan2(x, z) / (2 * kPi)};
}

/// How much light falls on a white ring at a point, seen by so many metres of the ring at once.
float light_at(const SurfaceLook& look, double x, double z, double width) {
  return shade(kRing, look, on_ring(x, z), {.ds_dx = 0.6 * width / 20, .ds_dy = 0.8 * width / 20})[0];
}

TEST(Layering, RingsAreDarkWhereTheCasterStandsBeforeTheLight) {
  const Rgba white{1, 1, 1, 1};
  const SurfaceLook look{flat(white), Vec3(1, 0, 0), {}, ShadowCaster{{2, 0, 1}, 5}};
  constexpr double kNarrow = 1e-3;
  EXPECT_EQ(light_at(look, -20, 1, kNarrow), 0);     // behind the caster's middle
  EXPECT_EQ(light_at(look, -20, 5.9, kNarrow), 0);   // within its cylinder
  EXPECT_EQ(light_at(look, -20, 6.1, kNarrow), 1);   // beside it
  EXPECT_EQ(light_at(look, -20, -3.9, kNarrow), 0);  // and on the other side
  EXPECT_EQ(light_at(look, -20, -4.1, kNarrow), 1);
  EXPECT_EQ(light_at(look, 20, 1, kNarrow), 1);  // on the light's side
  // Its alpha stays, and without a caster there is no shadow.
  EXPECT_EQ(shade(kRing, look, on_ring(-20, 1), {})[3], 1);
  EXPECT_EQ(light_at({flat(white), Vec3(1, 0, 0)}, -20, 1, kNarrow), 1);
}

TEST(Layering, PointsOnTheEdgeOfAShadowWithoutWidthAreLitOrDark) {
  const SurfaceLook look{flat({1, 1, 1, 1}), Vec3(0, 0, 1), {}, ShadowCaster{{0, 0, 0}, 10}};
  // Points on the cylinder's edge, but for rounding.
  for (const double t : {0.0, 0.25, 0.75, 0.9}) {
    const float light = shade(Ring{Vec3(0), {}, 10, 30}, look, {0, t}, {})[0];
    EXPECT_TRUE(light >= 0 && light <= 1) << t;
  }
  // A caster without size, on whose axis the point lies: exactly on the edge.
  const SurfaceLook point{flat({1, 1, 1, 1}), Vec3(0, 0, 1), {}, ShadowCaster{{0, 0, 20}, 0}};
  EXPECT_EQ(shade(Ring{Vec3(0), {}, 10, 30}, point, {0, 0.5}, {})[0], 1);
}

// Of the light of a pixel whose edge is straight but for a hundredth of its width.
constexpr double kShadowError = 0.01;

/// The light of a white ring under a footprint, by very many points of the pixel filter.
double light_by_points(const SurfaceLook& look, TextureCoordinates st, const Footprint& f,
                       double step = 0.05) {  // in standard deviations
  constexpr double kReach = 4;
  double sum = 0, weights = 0;
  for (double y = -kReach; y <= kReach; y += step) {
    for (double x = -kReach; x <= kReach; x += step) {
      const double weight = std::exp(-(x * x + y * y) / 2), film = kPixelSigma * f.scale;
      const TextureCoordinates at{st.s + film * (f.ds_dx * x + f.ds_dy * y),
                                  st.t + film * (f.dt_dx * x + f.dt_dy * y)};
      sum += weight * double(shade(kRing, look, at, {})[0]);
      weights += weight;
    }
  }
  return sum / weights;
}

TEST(Layering, ShadowsEdgeHasThePixelFiltersShareWhateverWayTheFootprintLies) {
  const SurfaceLook look{flat({1, 1, 1, 1}), Vec3(1, 0, 0), {}, ShadowCaster{{0, 0, 0}, 5}};
  const Footprint footprints[] = {{.ds_dx = 0.02, .dt_dy = 0.002},  // along the radius
                                  {.ds_dx = 1e-4, .dt_dy = 0.004},  // round the ring, across the edge
                                  {.dt_dx = 0.004, .scale = 0.3},   // one dimension, part of a pixel
                                  {0.01, 0.015, -0.002, 0.003}};    // aslant
  for (const Footprint& footprint : footprints) {
    for (const double aside : {4.0, 4.7, 5.0, 5.1, 5.5}) {
      const TextureCoordinates st = on_ring(-20, aside);
      const double truth = light_by_points(look, st, footprint);
      EXPECT_NEAR(shade(kRing, look, st, footprint)[0], truth, kShadowError) << aside;
    }
  }
}

TEST(Layering, ADiscOfLightLeavesAPenumbraOnRings) {
  constexpr double kSun = 0.05;
  SurfaceLook look{flat({1, 1, 1, 1}), Vec3(1, 0, 0), {}, ShadowCaster{{0, 0, 0}, 5}};
  look.sun = kSun;
  // At x = -20 the disc's middle is on the ball's limb 5 m beside the axis, where the limb, which is round,
  // leaves 0.5216 of it free: the area of two circles. The penumbra is 1 m on either side.
  EXPECT_EQ(shade(kRing, look, on_ring(-20, 3.5), {})[0], 0);
  EXPECT_NEAR(shade(kRing, look, on_ring(-20, 5), {})[0], 0.5216, 0.005);
  EXPECT_EQ(shade(kRing, look, on_ring(-20, 6.5), {})[0], 1);
  for (const double width : {0.002, 0.02}) {
    const Footprint across{.ds_dx = 1e-4, .dt_dy = width};
    for (const double aside : {4.2, 4.9, 5.3, 6.0}) {
      const double truth = light_by_points(look, on_ring(-20, aside), across);
      EXPECT_NEAR(shade(kRing, look, on_ring(-20, aside), across)[0], truth, kShadowError) << aside;
    }
  }
  // A ball smaller than the disc has no umbra.
  look.caster->radius = 0.5;
  EXPECT_NEAR(shade(kRing, look, on_ring(-20, 0), {})[0], 0.75, 0.01);
}

TEST(Layering, ADiscOfLightReachesOverTheTerminator) {
  SurfaceLook look{flat({1, 1, 1, 1}), Vec3(0, 0, 1)};
  look.sun = 0.1;
  EXPECT_NEAR(shade(Sphere{}, look, on_equator(0), {})[0], 0.2 / (3 * kPi), 1e-4);  // 2 a/(3 pi)
  EXPECT_GT(shade(Sphere{}, look, on_equator(-0.05), {})[0], 0);
  EXPECT_EQ(shade(Sphere{}, look, on_equator(-0.11), {})[0], 0);
  EXPECT_NEAR(shade(Sphere{}, look, on_equator(0.5), {})[0], 0.5 * (1 + std::cos(0.1)) / 2, 1e-6);
}

TEST(Layering, AShadowThinnerThanAPixelTakesItsShareOfLight) {
  const SurfaceLook look{flat({1, 1, 1, 1}), Vec3(1, 0, 0), {}, ShadowCaster{{0, 0, 0}, 0.05}};
  const Footprint across{.dt_dx = 0.004};  // 0.23 m standard deviation
  const TextureCoordinates st = on_ring(-20, 0.04);
  const double truth = light_by_points(look, st, across, 0.013);
  EXPECT_LT(truth, 0.9);
  EXPECT_NEAR(shade(kRing, look, st, across)[0], truth, kShadowError);
}

TEST(Layering, ShadowsAreWhereRaysTowardsTheLightMeetTheCaster) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  int dark = 0, lit = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 light = Vec3(any(random), any(random), any(random)).normalized();
    const Vec3 centre(8 * any(random), 8 * any(random), 8 * any(random));
    const SurfaceLook look{flat({1, 1, 1, 1}), light, {}, ShadowCaster{centre, 6}};
    const double angle = kPi * any(random), radius = 20 + 9.9 * any(random);
    const Vec3 point(radius * std::sin(angle), 0, radius * std::cos(angle));
    const double nearest = (point - centre - light * (point - centre).dot(light)).length();
    if (std::abs(nearest - 6) < 1e-3 || (point - centre).length() < 6) continue;
    const bool behind = sphere_entry(point, light, centre, 6.0) < kInfinity;
    ASSERT_EQ(light_at(look, point.x, point.z, 1e-4), behind ? 0 : 1) << i;
    ++(behind ? dark : lit);
  }
  EXPECT_GT(dark, 300);
  EXPECT_GT(lit, 3000);
}

TEST(Layering, SkiesStandBehindAllElseAtInfinity) {
  using Order = std::vector<std::size_t>;
  EXPECT_EQ(order_at_infinity({Plate{}, LatLong{}, Sphere{}, LatLong{}, Plate{}}), (Order{1, 3, 0, 2, 4}));
  EXPECT_EQ(order_at_infinity({Plate{}, Sphere{}}), (Order{0, 1}));
  EXPECT_EQ(order_at_infinity({}), Order{});
}

SeenPoint seen_at(double distance) {
  return {true, distance, {0.5, 0.5}, {}};
}

TEST(Layering, SeesNearerSurfacesOverFartherOnes) {
  const std::vector<Surface> surfaces = {Card{1}, LatLong{}, Card{2}, Plate{}};
  const std::vector<SurfaceLook> looks = {{flat({0.5F, 0, 0, 0.5F})},
                                          {flat({0, 0, 1, 1})},
                                          {flat({0, 0.25F, 0, 0.25F})},
                                          {flat({0.2F, 0.2F, 0, 0.2F})}};
  Viewer viewer(surfaces, looks);
  const SeenPoint sky = seen_at(kInfinity);
  // Red over green over the plate over the sky: 0.5, 0.5 x 0.25, 0.375 x 0.2, 0.3.
  expect_colour(viewer.see(std::vector{seen_at(1), sky, seen_at(2), sky}, 1),
                {0.5F + 0.075F, 0.125F + 0.075F, 0.3F, 1});
  // Green over red.
  expect_colour(viewer.see(std::vector{seen_at(2), sky, seen_at(1), sky}, 1),
                {0.375F + 0.075F, 0.25F + 0.075F, 0.3F, 1});
  // What is not met is not seen.
  expect_colour(viewer.see(std::vector{SeenPoint{}, SeenPoint{}, seen_at(2), SeenPoint{}}, 1),
                {0, 0.25F, 0, 0.25F});
  expect_colour(viewer.see(std::vector<SeenPoint>(4), 1), {0, 0, 0, 0});
}

TEST(Layering, ClearnessIsWhatAllButSkiesLetThrough) {
  const std::vector<Surface> surfaces = {Card{1}, Sphere{}, LatLong{}, Plate{}};
  const std::vector<SurfaceLook> looks = {
      {flat({0.5F, 0, 0, 0.5F})}, {flat({0, 0.25F, 0, 0.25F})}, {flat({0, 0, 1, 1})}, {flat({1, 1, 1, 1})}};
  const Viewer viewer(surfaces, looks);
  const SeenPoint met = seen_at(1), not_met;
  EXPECT_FLOAT_EQ(viewer.clearness(std::vector{met, met, met, not_met}), 0.375F);
  EXPECT_FLOAT_EQ(viewer.clearness(std::vector{met, not_met, met, not_met}), 0.5F);
  EXPECT_FLOAT_EQ(viewer.clearness(std::vector{not_met, met, met, not_met}), 0.75F);
  EXPECT_EQ(viewer.clearness(std::vector{not_met, not_met, met, not_met}), 1);
  EXPECT_EQ(viewer.clearness(std::vector{met, met, met, met}), 0);
}

}  // namespace
}  // namespace lensplane
