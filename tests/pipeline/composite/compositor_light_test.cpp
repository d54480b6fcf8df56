// SPDX-License-Identifier: Apache-2.0
//
// What the compositor does to light: held against closed forms, and against very many rays.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "pipeline/composite/compositor.h"
#include "tests/pipeline/composite/brute_force.h"
#include "tests/pipeline/composite/reference_filter.h"
#include "tests/src/scenes.h"

namespace lensplane {
namespace {

// A constant stays a constant: rounding of floats over 64 rays.
constexpr double kConstantError = 1e-5;

// Of the light of a disc behind a lens: with all rays that a pixel may have, and with as many as an eye asks
// for.
constexpr double kLightError = 2e-3;
constexpr double kSeenLightError = 1e-2;

// Of a smooth sky of 512 texels round.
constexpr double kSkyError = 2e-3;

// Of pictures by up to 64 rays a pixel against very many.
constexpr double kPictureError = 0.01;
constexpr double kWorstPixel = 0.08;

// A threshold that no pixel keeps to before it has all of its rays.
constexpr double kAllRays = 1e-9;

std::shared_ptr<const Texture> texture(Picture picture, Wrap wrap) {
  return std::make_shared<const Texture>(std::move(picture), wrap);
}

/// A lens on the axis whose Einstein ring has a radius of `einstein` pixels, very far before what it bends.
Scene lensed_scene(int width, int height, double einstein) {
  Scene scene;
  scene.camera.width = width;
  scene.camera.height = height;
  scene.camera.fov_rad = 1e-4;
  const double angle = einstein * slope_per_pixel(scene.camera);
  if (einstein > 0) scene.lenses = {{angle * angle * 1e9 / 4, {0, 0, -1e9}}};
  return scene;
}

Tracer tracer_of(const Scene& scene) {
  TraceSettings settings{Method::Planes, Law::Weak, 0.05, Choice::Off, {}};
  settings.effects.jacobian = true;
  return {scene, plan_trace(scene, settings)};
}

TEST(CompositorLight, AConstantPlateStaysConstantUnderStrongLensing) {
  const Rgba colour{0.7F, 0.3F, 0.1F, 1};
  for (const Wrap wrap : {Wrap::Clamp, Wrap::Mirror, Wrap::Repeat}) {
    Scene scene = lensed_scene(96, 64, 20);
    scene.lenses.push_back({scene.lenses[0].m * 3e4, {2e4, 1e4, -5e8}});  // and one that casts a shadow
    scene.surfaces = {Plate{}};
    const Picture plate = painted(50, 40, [&](int, int) { return colour; });
    const Picture picture = composite(tracer_of(scene), {{texture(plate, wrap)}}, {}).picture;
    int whole = 0, none = 0;
    for (const Rgba& pixel : picture.pixels) {
      for (std::size_t c = 0; c < 3; ++c) ASSERT_NEAR(pixel[c], colour[c] * pixel[3], kConstantError);
      ASSERT_LE(pixel[3], 1 + kConstantError);
      whole += std::abs(pixel[3] - 1) < kConstantError ? 1 : 0;
      none += pixel[3] == 0 ? 1 : 0;
    }
    EXPECT_GT(whole, 3000);
    EXPECT_GT(none, 10);
  }
}

constexpr int kFrame = 120, kTexels = 8;  // to the pixel

/// How much of a texel a disc covers whose edge is `inside` pixels away.
double cover_at(double inside) {
  return std::clamp(inside * kTexels + 0.5, 0.0, 1.0);
}

/// What pixels have of the light at a film coordinate, counted from an edge between them: the sum of the
/// pixel filter over all of them, by Poisson's formula.
double weights_at(double x) {
  return 1 - 2 * std::exp(-2 * kPi * kPi * kPixelSigma * kPixelSigma) * std::cos(2 * kPi * x);
}

/// The light of a disc of brightness 5 behind a lens, as pixels have it: by the lens equation, over the film.
double light_on_film(double x, double y, double radius, double einstein) {
  constexpr double kStep = 0.025, kReach = kFrame / 4.0;
  double light = 0;
  for (double down = -kReach + kStep / 2; down < kReach; down += kStep) {
    for (double right = -kReach + kStep / 2; right < kReach; right += kStep) {
      const double bent = 1 - einstein * einstein / (right * right + down * down);
      const double inside = radius - std::hypot(right * bent - x, down * bent - y);
      light += cover_at(inside) * weights_at(right) * weights_at(down);
    }
  }
  return 5 * light * kStep * kStep;
}

/// A black plate with a disc of light 5 at (x, y) pixels from the axis.
Picture disc_plate(double x, double y, double radius) {
  return painted(kFrame * kTexels, kFrame * kTexels, [=](int column, int row) {
    const double right = (column + 0.5) / kTexels - kFrame / 2.0 - x;
    const double down = (row + 0.5) / kTexels - kFrame / 2.0 - y;
    const auto light = static_cast<float>(5 * cover_at(radius - std::hypot(right, down)));
    return Rgba{light, light, light, 1};
  });
}

/// What a picture of the plate behind a lens adds up to.
double light_behind(double einstein, const Picture& plate, double threshold) {
  Scene scene = lensed_scene(kFrame, kFrame, einstein);
  scene.surfaces = {Plate{}};
  const std::vector<SurfaceLook> looks = {{texture(plate, Wrap::Black)}};
  double light = 0;
  for (const Rgba& pixel : composite(tracer_of(scene), looks, {.threshold = threshold}).picture.pixels) {
    light += static_cast<double>(pixel[1]);
  }
  return light;
}

TEST(CompositorLight, ADiscBehindALensHasTheLightThatItsMagnificationSays) {
  const struct {
    double einstein, x, y, radius;
  } cases[] = {{0, 10, 5, 6}, {10, 18, -6, 5}, {4, 3.3, 1.7, 1.5}};
  for (const auto& c : cases) {
    const Picture plate = disc_plate(c.x, c.y, c.radius);
    const double expected = light_on_film(c.x, c.y, c.radius, c.einstein);
    EXPECT_NEAR(light_behind(c.einstein, plate, kAllRays) / expected, 1, kLightError) << c.x;
    EXPECT_NEAR(light_behind(c.einstein, plate, 0.004) / expected, 1, kSeenLightError) << c.x;
  }
  // A disc on the axis is magnified by sqrt(1 + 4/rho^2) in all.
  for (const double radius : {3.0, 8.0}) {
    const double rho = radius / 10, expected = 5 * kPi * radius * radius * std::sqrt(1 + 4 / (rho * rho));
    EXPECT_NEAR(light_behind(10, disc_plate(0, 0, radius), kAllRays) / expected, 1, kLightError) << radius;
  }
}

TEST(CompositorLight, UpIsUpAndLeftIsLeft) {
  Scene scene = lensed_scene(40, 40, 0);
  const Picture four = painted(40, 40, [](int column, int row) {
    return Rgba{column < 20 ? 1.0F : 0.0F, row < 20 ? 1.0F : 0.0F, 0, 1};
  });
  for (const Surface& plate : {Surface(Plate{}), Surface(Card{1e6})}) {
    scene.surfaces = {plate};
    const Picture picture = composite(tracer_of(scene), {{texture(four, Wrap::Clamp)}}, {}).picture;
    for (const int row : {5, 35}) {
      for (const int column : {5, 35}) {
        EXPECT_NEAR(picture.at(column, row)[0], column < 20 ? 1 : 0, kConstantError);
        EXPECT_NEAR(picture.at(column, row)[1], row < 20 ? 1 : 0, kConstantError);
      }
    }
  }
}

/// A smooth function of the direction.
double sky_light(const Vec3& d) {
  return 0.5 + 0.2 * d.x + 0.15 * d.y - 0.1 * d.z + 0.1 * d.x * d.y - 0.08 * d.y * d.z;
}

TEST(CompositorLight, SkiesHaveNeitherSeamNorPoles) {
  const Picture sky = painted(512, 256, [](int column, int row) {
    const double longitude = ((column + 0.5) / 512 - 0.5) * 2 * kPi,
                 latitude = (0.5 - (row + 0.5) / 256) * kPi;
    // The middle of a sky lies along -z, its right along +x.
    const auto light =
        static_cast<float>(sky_light({std::sin(longitude) * std::cos(latitude), std::sin(latitude),
                                      -std::cos(longitude) * std::cos(latitude)}));
    return Rgba{light, light, light, 1};
  });
  const auto look = texture(sky, Wrap::Globe);
  const struct {
    Projection projection;
    Vec3 forward;
  } views[] = {{Projection::Perspective, {0, 0, 1}},     // the seam
               {Projection::Perspective, {0, 1, 1e-3}},  // the poles
               {Projection::Perspective, {1e-3, -1, 0}},
               {Projection::Fisheye, {0.1, 0.9, 0.4}},  // both at once
               {Projection::LatLong, {0.3, 0.5, 0.8}}};
  for (const auto& view : views) {
    Scene scene;
    scene.camera.width = scene.camera.height = 61;
    scene.camera.projection = view.projection;
    scene.camera.fov_rad = view.projection == Projection::Perspective ? 0.7 : 3.5;
    scene.camera.axes = basis_looking_along(view.forward, {0.3, 1, 0.2});
    scene.surfaces = {LatLong{}};
    TraceSettings settings;
    settings.effects.jacobian = true;
    const Picture picture = composite(Tracer(scene, plan_trace(scene, settings)), {{look}}, {}).picture;
    int seen = 0;
    for (int row = 0; row < 61; ++row) {
      for (int column = 0; column < 61; ++column) {
        const FilmPosition film{column + 0.5, row + 0.5};
        const bool rim = std::hypot(film.x - 30.5, film.y - 30.5) > 28.5;
        if (view.projection == Projection::Fisheye && rim) continue;
        const Vec3 direction =
            scene.camera.axes.parent_from_local(direction_from_film<double>(scene.camera, film));
        ASSERT_NEAR(picture.at(column, row)[1], sky_light(direction), kSkyError)
            << view.forward << " " << column << " " << row;
        ++seen;
      }
    }
    EXPECT_GT(seen, 2000);
  }
}

/// A plate that is not symmetric and has some detail, transparent in its middle.
Picture detailed_plate() {
  return painted(48, 32, [](int column, int row) {
    const auto wave = static_cast<float>(0.5 + 0.5 * std::sin(0.5 * column) * std::cos(0.4 * row));
    const float alpha = std::abs(column - 24) < 5 ? 0.5F : 1.0F;
    return Rgba{alpha * wave, alpha * static_cast<float>(column) / 48, alpha * static_cast<float>(row) / 32,
                alpha};
  });
}

TEST(CompositorLight, BeyondItsEdgesAPlateGoesOnAsItIsTold) {
  Scene scene = lensed_scene(18, 12, 7);
  scene.surfaces = {Plate{}};
  const Tracer tracer = tracer_of(scene);
  std::vector<Picture> pictures;
  for (const Wrap wrap : {Wrap::Black, Wrap::Clamp, Wrap::Mirror, Wrap::Repeat}) {
    const std::vector<SurfaceLook> looks = {{texture(detailed_plate(), wrap)}};
    pictures.push_back(composite(tracer, looks, {}).picture);
    const Difference off = difference(pictures.back(), brute_force(tracer, looks, 12));
    EXPECT_LT(off.rms, kPictureError) << static_cast<int>(wrap);
    EXPECT_LT(off.most, kWorstPixel) << static_cast<int>(wrap);
  }
  // They are told apart in much of the picture.
  for (std::size_t a = 0; a < pictures.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_GT(difference(pictures[a], pictures[b]).rms, 5 * kPictureError);
  }
}

TEST(CompositorLight, MoreRaysComeNearerToTheTruth) {
  Scene scene = lensed_scene(16, 16, 4);
  scene.surfaces = {Sphere{{3e3, 2e3, -2e9}, 1.1e4, {}}, Plate{}};
  const Tracer tracer = tracer_of(scene);
  const std::vector<SurfaceLook> looks = {{texture(painted(1, 1,
                                                           [](int, int) {
                                                             return Rgba{1, 0.2F, 0, 1};
                                                           }),
                                                   Wrap::Globe)},
                                          {texture(detailed_plate(), Wrap::Mirror)}};
  const Picture truth = brute_force(tracer, looks, 12);
  double before = 1;
  for (const int rays : {1, 4, 16, 64}) {
    const Composite result = composite(tracer, looks, {.max = rays, .threshold = kAllRays});
    const double rms = difference(result.picture, truth).rms;
    EXPECT_LT(rms, 0.75 * before) << rays;
    EXPECT_EQ(result.refined > 0, rays > 1);
    EXPECT_GE(result.rays, result.refined * rays + 16 * 16);
    before = rms;
  }
  EXPECT_LT(before, 0.7 * kPictureError);
}

}  // namespace
}  // namespace lensplane
