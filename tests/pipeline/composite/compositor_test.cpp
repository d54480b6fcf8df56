// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/compositor.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <random>

#include "pipeline/composite/locator.h"
#include "pipeline/composite/star_layer.h"
#include "src/lens_map.h"
#include "tests/src/scenes.h"

namespace lensplane {
namespace {

std::shared_ptr<const Texture> flat(const Rgba& colour) {
  return std::make_shared<const Texture>(Picture{1, 1, 0, 0, 1, 1, {colour}}, Wrap::Clamp);
}

Scene empty_scene(int width, int height, double fov_deg) {
  Scene scene;
  scene.camera.width = width;
  scene.camera.height = height;
  scene.camera.fov_rad = fov_deg * kDegree;
  return scene;
}

Tracer tracer_of(const Scene& scene) {
  TraceSettings settings;
  settings.method = Method::ShinotsukaMakino;
  settings.effects.jacobian = true;
  return {scene, plan_trace(scene, settings)};
}

Composite take_picture(const Scene& scene, const std::vector<SurfaceLook>& looks) {
  return composite(tracer_of(scene), looks, {});
}

void expect_colour(const Rgba& got, const Rgba& expected) {
  for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(got[c], expected[c], 1e-6);
}

const Rgba kRed{1, 0, 0, 1}, kGreen{0, 1, 0, 1}, kBlue{0, 0, 1, 1}, kHalfRed{0.5F, 0, 0, 0.5F};

TEST(Compositor, LaysNearerSurfacesOverFartherOnesWhateverTheirOrder) {
  Scene scene = empty_scene(9, 9, 10);
  const Surface near = Sphere{{0, 0, -100}, 6, {}}, far = Sphere{{0, 0, -200}, 14, {}};
  scene.surfaces = {near, far, LatLong{}};
  const SurfaceLook red{flat(kHalfRed), {}}, green{flat(kGreen), {}}, blue{flat(kBlue), {}};
  expect_colour(take_picture(scene, {red, green, blue}).picture.at(4, 4), {0.5F, 0.5F, 0, 1});
  scene.surfaces = {LatLong{}, far, near};
  const Composite other = take_picture(scene, {blue, green, red});
  expect_colour(other.picture.at(4, 4), {0.5F, 0.5F, 0, 1});
  expect_colour(other.picture.at(0, 0), kBlue);
}

TEST(Compositor, AtInfinityPlatesLieOverSkiesAndLaterOverEarlier) {
  Scene scene = empty_scene(3, 3, 10);
  const SurfaceLook red{flat(kRed), {}}, green{flat(kGreen), {}};
  scene.surfaces = {Plate{}, LatLong{}};
  expect_colour(take_picture(scene, {red, green}).picture.at(1, 1), kRed);
  scene.surfaces = {LatLong{}, Plate{}};
  expect_colour(take_picture(scene, {red, green}).picture.at(1, 1), kGreen);
  scene.surfaces = {Plate{}, Plate{}};
  expect_colour(take_picture(scene, {red, green}).picture.at(1, 1), kGreen);
}

TEST(Compositor, APlateThatNothingBendsComesBackToItsBorder) {
  std::mt19937 random(9);
  Scene scene = empty_scene(48, 27, 30);
  scene.surfaces = {Plate{}};
  Picture plate{48, 27, 0, 0, 48, 27, {}};
  for (int i = 0; i < 48 * 27; ++i) {
    const float value = static_cast<float>(random() % 1024) / 1023;
    plate.pixels.push_back({value, 1 - value, i % 3 == 0 ? 1.0F : 0.0F, 1});
  }
  for (const Wrap wrap : {Wrap::Black, Wrap::Clamp, Wrap::Mirror, Wrap::Repeat}) {
    const SurfaceLook look{std::make_shared<const Texture>(plate, wrap), {}};
    for (const int most : {1, 64}) {
      const Picture got = composite(tracer_of(scene), {look}, {.max = most}).picture;
      for (std::size_t i = 0; i < got.pixels.size(); ++i) {
        for (std::size_t c = 0; c < 4; ++c) ASSERT_NEAR(got.pixels[i][c], plate.pixels[i][c], 1e-5) << i;
      }
    }
  }
}

TEST(Compositor, APlateThatNothingBendsIsAsSharpBesideASilhouette) {
  // A ball covers a part of the pixels along its limb: what they show of the plate is the plate.
  std::mt19937 random(9);
  Scene scene = empty_scene(48, 27, 30);
  scene.surfaces = {Plate{}, Sphere{{0, 0, -10}, 1.3, {}}};
  Picture plate{48, 27, 0, 0, 48, 27, {}};
  for (int i = 0; i < 48 * 27; ++i) {
    const float value = static_cast<float>(random() % 1024) / 1023;
    plate.pixels.push_back({value, value, value, 1});
  }
  const SurfaceLook behind{std::make_shared<const Texture>(plate, Wrap::Black), {}},
      ball{flat({0, 1, 0, 1}), {}};
  const SurfaceLook white{flat({1, 1, 1, 1}), {}};
  const Picture got = composite(tracer_of(scene), {behind, ball}, {.threshold = 0}).picture;
  const Picture clear = composite(tracer_of(scene), {white, ball}, {.threshold = 0}).picture;
  int limb = 0;
  for (std::size_t i = 0; i < got.pixels.size(); ++i) {
    const float left = clear.pixels[i][0];  // of the plate
    limb += left > 0.01F && left < 0.99F ? 1 : 0;
    ASSERT_NEAR(got.pixels[i][0], left * plate.pixels[i][0], 2e-5) << i;
  }
  EXPECT_GT(limb, 20);
}

TEST(Compositor, NothingIsTransparentBlack) {
  Scene scene = empty_scene(5, 5, 10);
  scene.surfaces = {Sphere{{0, 0, 100}, 2, {}}};
  const Composite result = take_picture(scene, {{flat(kRed), {}}});
  for (const Rgba& pixel : result.picture.pixels) expect_colour(pixel, {0, 0, 0, 0});
  EXPECT_EQ(result.hits[0], 0);
}

TEST(Compositor, SilhouettesAreCoveredByTheirShareOfRays) {
  // A ball so large that its limb is a straight line through the middle of the frame.
  Scene scene = empty_scene(5, 5, 1e-3);
  scene.surfaces = {Sphere{{-1e6, 0, -1e3}, 1e6 - 1e-9, {}}};
  const Composite result = take_picture(scene, {{flat(kRed), {}}});
  EXPECT_NEAR(result.picture.at(2, 2)[3], 0.5, 0.01);
  EXPECT_EQ(result.picture.at(0, 2)[3], 1);
  EXPECT_EQ(result.picture.at(4, 2)[3], 0);
}

TEST(Compositor, CountsThePixelsOfTheFrameWithoutOverscan) {
  Scene scene = empty_scene(6, 4, 10);
  scene.surfaces = {Plate{}};
  EXPECT_EQ(take_picture(scene, {{flat(kRed), {}}}).hits[0], 6 * 4);
  scene.camera.overscan = 2;
  const Composite result = take_picture(scene, {{flat(kRed), {}}});
  EXPECT_EQ(result.hits[0], 6 * 4);
  EXPECT_EQ(result.picture.width, 10);
  EXPECT_EQ(result.picture.x, -2);
}

TEST(Compositor, LambertShadingIsTheCosineToTheLight) {
  Scene scene = empty_scene(201, 201, 1);
  const double radius = 1e3 * std::tan(0.45 * kDegree);
  scene.surfaces = {Sphere{{0, 0, -1e3}, radius, {}}};
  const Vec3 light = Vec3(0, 0, 1);  // from the camera
  const Picture picture = take_picture(scene, {{flat({0.8F, 0.8F, 0.8F, 1}), light}}).picture;
  EXPECT_NEAR(picture.at(100, 100)[0], 0.8, 1e-4);
  // 45 pixels beside the centre of a disc of 90.45 pixels: the normal leans by asin(45/90.45).
  const double lean = 45 / (radius / 1e3 / slope_per_pixel(scene.camera));
  EXPECT_NEAR(picture.at(145, 100)[0], 0.8 * std::sqrt(1 - lean * lean), 2e-3);
  // From behind it is black, but covers.
  const Picture dark = take_picture(scene, {{flat(kRed), Vec3(0, 0, -1)}}).picture;
  expect_colour(dark.at(100, 100), {0, 0, 0, 1});
}

TEST(Compositor, DoesNotDependOnTheNumberOfThreads) {
  Scene scene = seed_fig6(60);
  scene.surfaces.push_back(LatLong{});
  const std::vector<SurfaceLook> looks = {{flat(kRed), {}}, {flat(kBlue), {}}};
  const auto with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return take_picture(scene, looks);
  };
  const Composite one = with(1), two = with(2), seven = with(7);
  EXPECT_EQ(one.picture.pixels, two.picture.pixels);
  EXPECT_EQ(one.picture.pixels, seven.picture.pixels);
  EXPECT_EQ(one.hits, seven.hits);
}

/// The paper's sources before the Earth and a ring round it, in a wide frame.
constexpr int kPixels = 156 * 156;
Tracer tracer_of_mostly_empty_space() {
  Scene scene = seed_fig6(150);
  scene.camera.overscan = 3;
  scene.camera.fov_rad *= 3;
  const Basis tilted{{1, 0, 0}, {0, 0.6, 0.8}, {0, -0.8, 0.6}};
  scene.surfaces.push_back(Ring{{0, 0, -kSeedDistance}, tilted, 1.3e7, 1.6e7});
  TraceSettings settings;
  settings.effects.jacobian = true;
  return {scene, plan_trace(scene, settings)};
}

TEST(Compositor, LeavesOutDerivativesOnlyWhereNothingIsMet) {
  const Tracer tracer = tracer_of_mostly_empty_space();
  const std::vector<SurfaceLook> looks = {{flat(kRed)}, {flat(kBlue)}};
  const Composite result = composite(tracer, looks, {.max = 1});
  const std::vector<LensMap> maps = trace_maps(tracer);
  int met = 0;
  for (std::size_t i = 0; i < result.picture.pixels.size(); ++i) {
    const bool meets = maps[0].valid[i] != 0 || maps[1].valid[i] != 0;
    met += meets;
    ASSERT_EQ(result.picture.pixels[i][3] != 0, meets) << i;
  }
  EXPECT_GT(met, 400);
  EXPECT_LT(met, kPixels / 4);
}

TEST(Compositor, TracesNoRayThatIsKnownToMeetNothing) {
  const Tracer tracer = tracer_of_mostly_empty_space();
  const std::vector<SurfaceLook> looks = {{flat(kRed)}, {flat(kBlue)}};
  const int rows = tracer.camera().full_height();
  EmptySpace empty(tracer.camera());
  empty.learn(trace_maps(tracer.without_passes()), 0, {0, rows});
  const Composite unknown = composite(tracer, looks, {}), known = composite(tracer, looks, {}, empty);
  EXPECT_EQ(known.picture.pixels, unknown.picture.pixels);
  EXPECT_EQ(known.hits, unknown.hits);
  EXPECT_EQ(known.refined, unknown.refined);
  EXPECT_LT(known.rays, unknown.rays - kPixels / 4);
  // It is taken at its word: of a camera that is said to see nothing only what lies just outside is traced.
  std::vector<LensMap> nothing = trace_maps(tracer.without_passes());
  for (LensMap& map : nothing) std::fill(map.valid.begin(), map.valid.end(), 0.0F);
  empty.learn(nothing, 0, {0, rows});
  EXPECT_EQ(composite(tracer, looks, {.max = 1}, empty).picture.at(78, 40), (Rgba{0, 0, 0, 0}));
}

TEST(Compositor, StarsShineThroughWhatIsHalfTransparent) {
  // A half transparent card over a sphere over stars.
  Scene scene = empty_scene(41, 41, 10);
  scene.surfaces = {Sphere{{0, 0, -200}, 8, {}}, Card{100}};
  const std::vector<SurfaceLook> looks = {{flat({0, 1, 0, 1})}, {flat({0.2F, 0.1F, 0, 0.5F})}};
  Composite result = take_picture(scene, looks);
  const auto star_at = [&](double x, double y) {
    return Star{direction_from_pixel(scene.camera, {x, y}), 0, 0.6};
  };
  const StarField field = star_field({star_at(20.5, 20.5), star_at(35.5, 5.5)});
  add_stars(tracer_of(scene), looks, field, result.picture);
  // Over the sphere: (0.2, 0.1, 0) + 0.5 (0, 1, 0), and no star.
  expect_colour(result.picture.at(20, 20), {0.2F, 0.6F, 0, 1});
  // Beside it the card and half of the star's light: of a Gaussian of 0.6 pixels the middle pixel has
  // erf(0.5/(0.6 sqrt(2)))^2.
  const double share = 0.5 * std::pow(std::erf(0.5 / 0.6 / std::sqrt(2.0)), 2);
  const Rgba& lit = result.picture.at(35, 5);
  const std::array<double, 3> card = {0.2, 0.1, 0};
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(lit[c], card[c] + share * field.light[1][c], 2e-3);
  EXPECT_EQ(lit[3], 0.5F);
  expect_colour(result.picture.at(35, 35), {0.2F, 0.1F, 0, 0.5F});
}

TEST(Compositor, MeansOfSeveralAddUpAndScale) {
  const auto of = [](const Rgba& colour, double hits, std::int64_t rays, std::int64_t refined) {
    return Composite{
        {Picture{1, 2, 0, 0, 1, 2, {colour, {1, 2, 3, 1}}}, {colour[3], 0}}, {hits, 1}, rays, 0, refined};
  };
  Composite sum = of({0.2F, 0.4F, 0.6F, 1}, 3, 100, 7);
  add(of({0.6F, 0, 0.2F, 0.5F}, 5, 50, 2), sum);
  expect_colour(sum.picture.pixels[0], {0.8F, 0.4F, 0.8F, 1.5F});
  EXPECT_EQ(sum.hits, (std::vector<double>{8, 2}));
  scale(0.5, sum);
  expect_colour(sum.picture.pixels[0], {0.4F, 0.2F, 0.4F, 0.75F});
  expect_colour(sum.picture.pixels[1], {1, 2, 3, 1});
  EXPECT_EQ(sum.hits, (std::vector<double>{4, 1}));
  EXPECT_EQ(sum.shadow, (std::vector<float>{0.75F, 0}));
  EXPECT_EQ(sum.rays, 150);  // what was spent stays spent
  EXPECT_EQ(sum.refined, 9);
}

TEST(Locator, ShowsTheLensesWhereTheyAreAndBendsNothing) {
  Scene scene = seed_scene(100, {-1e6, 0, 0}, {0, 1e6, 0}, {1e6, -1e6, 0});
  scene.lenses.push_back({1, {0, 0, 1e9}});  // behind the camera
  const LocatorView locator = make_locator(scene, {{flat(kRed), {}}});
  EXPECT_TRUE(locator.scene.lenses.empty());
  ASSERT_EQ(locator.scene.surfaces.size(), 4U);
  ASSERT_EQ(locator.looks.size(), 4U);
  EXPECT_EQ(std::get<Sphere>(locator.scene.surfaces[2]).centre, scene.lenses[1].position);
  EXPECT_EQ(std::get<Sphere>(locator.scene.surfaces[1]).radius,
            std::get<Sphere>(locator.scene.surfaces[3]).radius);
}

}  // namespace
}  // namespace lensplane
