// SPDX-License-Identifier: Apache-2.0
//
// What is thinner than a pixel, in pictures: how much light it has, wherever between pixels it is, against
// the areas of discs and annuli.

#include "pipeline/composite/thin_bodies.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "pipeline/composite/compositor.h"
#include "pipeline/composite/sphere_coverage.h"
#include "tests/src/scenes.h"

namespace lensplane {
namespace {

// Of the light of a body, from place to place.
constexpr double kLightError = 0.02;

std::shared_ptr<const Texture> flat(const Rgba& colour) {
  return std::make_shared<const Texture>(Picture{1, 1, 0, 0, 1, 1, {colour}}, Wrap::Clamp);
}

const Rgba kWhite{1, 1, 1, 1}, kRed{1, 0, 0, 1}, kGreen{0, 1, 0, 1}, kHalf{0.5F, 0.5F, 0.5F, 0.5F};

constexpr int kPlaces = 24;
constexpr double kFar = 1e6;  // metres

/// A narrow view whose pixels are all of one size, and places between them, in pixels from its middle.
class View {
 public:
  View(int width, int height) {
    scene.camera.width = width;
    scene.camera.height = height;
    scene.camera.fov_rad = 1e-3;
  }

  double metres(double pixels) const { return pixels * slope_per_pixel(scene.camera) * kFar; }
  Vec3 at(double right, double up) const { return {metres(right), metres(up), -kFar}; }
  static Vec3 place(int n) { return {std::fmod(n * 0.618, 1.0), (n + 0.5) / kPlaces, 0}; }
  Sphere sphere(const Vec3& pixels, double radius) const {
    return {at(pixels.x, pixels.y), metres(radius), {}};
  }
  /// `tilt`: radians from edge-on.
  Ring ring(const Vec3& pixels, double inner, double outer, double tilt) const {
    const Vec3 normal(0, std::cos(tilt), std::sin(tilt));
    const Basis axes{{1, 0, 0}, normal, Vec3(1, 0, 0).cross(normal)};
    return {at(pixels.x, pixels.y), axes, metres(inner), metres(outer)};
  }

  Scene scene;
};

Composite take(const Scene& scene, const std::vector<SurfaceLook>& looks, const Sampling& sampling = {}) {
  TraceSettings settings;
  settings.effects.jacobian = true;
  return composite(Tracer(scene, plan_trace(scene, settings)), looks, sampling);
}

double sum_of(const Picture& picture, std::size_t channel) {
  double sum = 0;
  for (const Rgba& pixel : picture.pixels) sum += static_cast<double>(pixel[channel]);
  return sum;
}

double disc(double radius) {
  return kPi * radius * radius;
}

TEST(ThinBodies, ASphereHasItsLightFromATinyOneToALargeOne) {
  for (const double radius : {0.02, 0.05, 0.2, 0.45, 0.8, 1.2, 1.9, 2.5, 2.99, 3.01, 3.5, 5.0}) {
    for (int n = 0; n < kPlaces; ++n) {
      View view(18, 18);
      view.scene.surfaces = {view.sphere(View::place(n), radius)};
      const Composite taken = take(view.scene, {{flat(kWhite)}});
      ASSERT_NEAR(sum_of(taken.picture, 3) / disc(radius), 1, kLightError) << radius << ' ' << n;
      ASSERT_NEAR(taken.hits[0] / disc(radius), 1, kLightError) << radius << ' ' << n;
    }
  }
}

TEST(ThinBodies, ARingHasItsLightHoweverThinItIsAndFromWhereverItIsSeen) {
  for (const double tilt : {kPi / 2, 0.8, 0.2, 0.02, 0.002}) {
    for (const double width : {0.05, 0.3, 1.0, 1.99, 2.01, 5.0}) {
      for (int n = 0; n < kPlaces; n += 5) {
        View view(56, 56);
        view.scene.surfaces = {view.ring(View::place(n), 20 - width, 20, tilt)};
        const double expected = (disc(20) - disc(20 - width)) * std::sin(tilt);
        EXPECT_NEAR(sum_of(take(view.scene, {{flat(kWhite)}}).picture, 3) / expected, 1, kLightError)
            << tilt << ' ' << width << ' ' << n;
      }
    }
  }
}

TEST(ThinBodies, AThinRingIsUnbroken) {
  View view(56, 56);
  view.scene.surfaces = {view.ring({0.3, 0.1, 0}, 19.7, 20, kPi / 2)};
  const Picture picture = take(view.scene, {{flat(kWhite)}}).picture;
  for (int n = 0; n < 300; ++n) {  // the light across it, all the way round
    const double x = 28.3 + 19.85 * std::cos(n * 0.021), y = 27.9 + 19.85 * std::sin(n * 0.021);
    double most = 0;
    for (int row = -1; row <= 1; ++row) {
      for (int column = -1; column <= 1; ++column)
        most = std::max<double>(most, picture.at(static_cast<int>(x) + column, static_cast<int>(y) + row)[3]);
    }
    ASSERT_GT(most, 0.13) << n;
    ASSERT_LT(most, 0.35) << n;
  }
}

TEST(ThinBodies, AnnuliSmallerThanAPixelHaveTheirLight) {
  for (int n = 0; n < kPlaces; ++n) {
    for (const double tilt : {kPi / 2, 0.3}) {
      View view(12, 12);
      view.scene.surfaces = {view.ring(View::place(n), 0.2, 0.4, tilt)};
      const double expected = (disc(0.4) - disc(0.2)) * std::sin(tilt);
      EXPECT_NEAR(sum_of(take(view.scene, {{flat(kWhite)}}).picture, 3) / expected, 1, kLightError);
    }
  }
}

TEST(ThinBodies, LieOverWhatIsBehindThem) {
  // A half transparent white sphere before a green sky: as much of the sky is left as it lets through.
  for (int n = 0; n < kPlaces; ++n) {
    View view(14, 14);
    view.scene.surfaces = {view.sphere(View::place(n), 0.45), LatLong{}};
    const Picture picture = take(view.scene, {{flat(kHalf)}, {flat(kGreen)}}).picture;
    EXPECT_NEAR(sum_of(picture, 0) / (0.5 * disc(0.45)), 1, kLightError);
    for (const Rgba& pixel : picture.pixels) {
      ASSERT_NEAR(pixel[3], 1, 1e-5);
      ASSERT_NEAR(pixel[1], 1, 1e-5);  // 0.5 of its own, and 0.5 of the sky's
    }
  }
}

TEST(ThinBodies, AreSeenBeforeALargeOneAndHiddenBehindIt) {
  for (int n = 0; n < kPlaces; ++n) {
    View view(56, 56);
    const Vec3 large(0.2, -0.3, 0), middle(0.2 + 9 * std::cos(n), -0.3 + 9 * std::sin(n), 0);
    const Vec3 limb(0.2 + 20 * std::cos(n), -0.3 + 20 * std::sin(n), 0);
    Sphere before = view.sphere(middle, 0.4), behind = before, grazing = view.sphere(limb, 0.4);
    for (Sphere* sphere : {&before, &grazing}) sphere->centre *= 0.5, sphere->radius *= 0.5;
    behind.centre *= 2, behind.radius *= 2;
    const auto red_of = [&](const Sphere& sphere) {
      view.scene.surfaces = {view.sphere(large, 20), sphere};
      const Picture picture = take(view.scene, {{flat(kGreen)}, {flat(kRed)}}).picture;
      EXPECT_NEAR(sum_of(picture, 1) + sum_of(picture, 0), disc(20), 0.005 * disc(20));
      return sum_of(picture, 0);
    };
    EXPECT_NEAR(red_of(before) / disc(0.4), 1, kLightError) << n;
    EXPECT_NEAR(red_of(grazing) / disc(0.4), 1, kLightError) << n;
    EXPECT_EQ(red_of(behind), 0);
  }
}

TEST(ThinBodies, ManySmallSpheresHaveTheLightOfAll) {
  View view(140, 30);  // over the border between tiles, too
  for (int n = 0; n < 30; ++n) {
    view.scene.surfaces.push_back(view.sphere({-60.5 + 4 * n + 0.13 * (n % 8), -10 + 5.3 * (n % 5), 0}, 0.3));
  }
  const std::vector<SurfaceLook> looks(30, {flat(kWhite)});
  EXPECT_NEAR(sum_of(take(view.scene, looks).picture, 3) / (30 * disc(0.3)), 1, kLightError);
  // Two at one place are one.
  view.scene.surfaces = {view.sphere({0.3, 0.4, 0}, 0.3), view.sphere({0.3, 0.4, 0}, 0.3)};
  EXPECT_NEAR(sum_of(take(view.scene, {{flat(kWhite)}, {flat(kWhite)}}).picture, 3) / disc(0.3), 1,
              kLightError);
}

/// Pixels of the film in which rays meet the first surface, by `density` x `density` rays a pixel.
double area_by_rays(const Tracer& tracer, int density) {
  TraceBatch batch = tracer.make_batch();
  const int width = tracer.camera().width * density, height = tracer.camera().height * density;
  std::int64_t hits = 0;
  for (int row = 0; row < height; ++row) {
    for (int first = 0; first < width; first += kBatchSize) {
      const int count = std::min(kBatchSize, width - first);
      for (int i = 0; i < kBatchSize; ++i) {
        batch.x[i] = (first + std::min(i, count - 1) + 0.5) / density;
        batch.y[i] = (row + 0.5) / density;
      }
      tracer.trace(batch);
      const auto& outcomes = batch.surfaces[0].outcome;
      hits += std::count(outcomes.begin(), outcomes.begin() + count, Outcome::Hit);
    }
  }
  return static_cast<double>(hits) / (density * density);
}

TEST(ThinBodies, RingsBehindALensHaveTheLightOfVeryManyRays) {
  for (const double beside : {0.3, 12.0}) {  // round the lens, and across it
    for (const double tilt : {kPi / 2, 0.5}) {
      View view(80, 80);
      Ring ring = view.ring({beside, 0.4, 0}, 13.7, 14, tilt);
      view.scene.surfaces = {ring};
      const double einstein = 12 * slope_per_pixel(view.scene.camera);
      const Vec3 lens = view.at(0.3, 0.2) * 0.5;
      view.scene.lenses = {{einstein * einstein * kFar / 4, lens}};
      const Tracer tracer(view.scene, plan_trace(view.scene, Method::Planes));
      const double expected = area_by_rays(tracer.without_passes(), 16);
      EXPECT_NEAR(sum_of(take(view.scene, {{flat(kWhite)}}).picture, 3) / expected, 1, kLightError)
          << beside << ' ' << tilt;
      EXPECT_GT(std::abs(expected / ((disc(14) - disc(13.7)) * std::sin(tilt)) - 1), 0.05);  // it is lensed
    }
  }
}

TEST(ThinBodies, ARingRoundAMassHasItsLightByEveryMethod) {
  Scene scene;
  scene.camera.width = scene.camera.height = 80;
  scene.camera.fov_rad = 1;
  scene.camera.position = {0, 2, 14};
  scene.camera.axes = basis_looking_along({0, -2, -14}, {0, 1, 0});
  scene.lenses = {{0.005, {0, 0, 0}}};
  scene.surfaces = {Ring{{0, 0, 0}, {}, 4.9, 5}};
  const double expected = area_by_rays(Tracer(scene, plan_trace(scene, Method::Planes)), 32);
  for (const Method method : {Method::Planes, Method::Geodesic}) {
    TraceSettings settings;
    settings.method = method;
    settings.effects.jacobian = true;
    const Picture picture =
        composite(Tracer(scene, plan_trace(scene, settings)), {{flat(kGreen)}}, {}).picture;
    EXPECT_NEAR(sum_of(picture, 1) / expected, 1, kLightError) << static_cast<int>(method);
  }
}

TEST(ThinBodies, OnPanoramicFilmsAreAsLargeAsTheFilmMakesThem) {
  for (const Projection projection : {Projection::LatLong, Projection::Fisheye}) {
    for (const double angle : {0.02, 0.7, 1.4}) {  // latitude, or from the axis
      for (int n = 0; n < kPlaces; n += 4) {
        Scene scene;
        scene.camera.width = projection == Projection::LatLong ? 360 : 180;
        scene.camera.height = 180;
        scene.camera.projection = projection;
        scene.camera.fov_rad = kPi;
        const double pixel = pixel_angle(scene.camera), radius = 0.3 * pixel;
        const double turn = 0.4 + 0.003 * n, off = angle + 0.01 * n * pixel;
        const Vec3 place =
            projection == Projection::LatLong
                ? Vec3(std::sin(turn) * std::cos(off), std::sin(off), -std::cos(turn) * std::cos(off))
                : Vec3(std::cos(turn) * std::sin(off), std::sin(turn) * std::sin(off), -std::cos(off));
        scene.surfaces = {Sphere{place, std::sin(radius), {}}};
        const double enlarged = projection == Projection::LatLong ? 1 / std::cos(off) : off / std::sin(off);
        const Composite taken = take(scene, {{flat(kWhite)}});
        EXPECT_NEAR(sum_of(taken.picture, 3) / (disc(0.3) * enlarged), 1, kLightError)
            << static_cast<int>(projection) << ' ' << angle << ' ' << n;
      }
    }
  }
}

TEST(ThinBodies, HaveTheirLightInEachInstantOfAnExposure) {
  for (int n = 0; n < kPlaces; ++n) {
    View view(14, 14);
    view.scene.surfaces = {view.sphere(View::place(n), 0.3)};
    const Picture picture = take(view.scene, {{flat(kWhite)}}, {.max = 4, .first = 8}).picture;
    EXPECT_NEAR(sum_of(picture, 3) / disc(0.3), 1, kLightError);
  }
}

TEST(ThinBodies, AreAsLargeWithoutLensesAsInAPictureWithoutThem) {
  for (const double radius : {0.05, 0.45, 1.5}) {
    View view(20, 20);
    const Sphere inside = view.sphere({0.3, 0.2, 0}, radius), cut = view.sphere({10, 3.2, 0}, radius);
    EXPECT_NEAR(covered_without_lenses(view.scene.camera, inside, {}) / disc(radius), 1, kLightError);
    for (const Sphere& sphere : {inside, cut}) {
      view.scene.surfaces = {sphere};
      const double hits = take(view.scene, {{flat(kWhite)}}).hits[0];
      EXPECT_GT(hits, 0);
      EXPECT_NEAR(covered_without_lenses(view.scene.camera, sphere, {}) / hits, 1, kLightError) << radius;
    }
  }
}

TEST(ThinBodies, CoverPixelsAsPicturesShowThem) {
  View view(16, 16);
  view.scene.surfaces = {view.sphere({0.3, 0.1, 0}, 0.7)};
  const Picture picture = take(view.scene, {{flat(kWhite)}}).picture;
  const ThinBodies thin(Tracer(view.scene, plan_trace(view.scene, Method::Planes)));
  for (int row = 0; row < 16; ++row) {
    for (int column = 0; column < 16; ++column)
      EXPECT_NEAR(thin.coverage({column + 0.5, row + 0.5}, 0), picture.at(column, row)[3], 1e-3);
  }
}

TEST(ThinBodies, DoNotDependOnTheNumberOfThreads) {
  View view(150, 70);
  view.scene.surfaces = {view.ring({0.3, 0.1, 0}, 29.8, 30, 0.4), view.sphere({0.6, 0.2, 0}, 2)};
  const auto with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return take(view.scene, {{flat(kWhite)}, {flat(kRed)}});
  };
  const Composite one = with(1), three = with(3);
  EXPECT_EQ(one.picture.pixels, three.picture.pixels);
  EXPECT_EQ(one.hits, three.hits);
}

TEST(PixelWeight, AddsUpToOneWhereverLightIs) {
  for (const double at : {0.0, 0.1, 0.25, 0.5, 0.77}) {
    double sum = 0;
    for (int pixel = -3; pixel <= 3; ++pixel) sum += pixel_weight(at - pixel);
    EXPECT_NEAR(sum, 1, 1e-4);
    EXPECT_EQ(pixel_weight(at), pixel_weight(-at));
  }
  EXPECT_GT(pixel_weight(0), pixel_weight(0.3));
  EXPECT_EQ(pixel_weight(2.5), 0);
}

}  // namespace
}  // namespace lensplane
