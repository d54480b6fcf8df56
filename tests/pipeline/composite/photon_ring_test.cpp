// SPDX-License-Identifier: Apache-2.0
//
// The light of the thin images round a shadow, against an integral in polar coordinates about its centre.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "pipeline/composite/compositor.h"
#include "src/constants.h"

namespace lensplane {
namespace {

// Of the light of all images round the shadow, in every frame.
constexpr double kRingLight = 0.01;

// From frame to frame, while the hole moves by a tenth of a pixel.
constexpr double kSteadiness = 0.01;

// Of the light of a pixel on the ring, against the mean of all at its distance from the rim: nothing is
// missing anywhere along it. The ring's light is 0.1 to 0.2 there.
constexpr double kUneven = 0.06;

constexpr int kSize = 72;         // pixels of the frame, both ways
constexpr double kShadow = 24;    // pixels of the shadow's radius, about
constexpr double kRingWidth = 2;  // pixels from the rim that hold the images round it, and nothing else

/// A hole of m = 1 in front of what shines.
struct Case {
  const char* name;
  double distance;  // of the camera, r_g
  std::vector<Surface> surfaces;
  Wrap wrap = Wrap::Clamp;
  Method method = Method::Planes;
};

Scene scene_of(const Case& c, double moved_px) {
  const double share = 0.5 / c.distance, index = std::pow(1 + share, 3) / (1 - share);
  const double slope = std::tan(std::asin(3 * std::sqrt(3.0) / (index * c.distance)));
  Scene scene;
  scene.camera.width = scene.camera.height = kSize;
  scene.camera.fov_rad = 2 * std::atan(slope * kSize / 2 / kShadow);
  const double pixel = slope / kShadow * c.distance;
  scene.lenses = {{1, {moved_px * pixel, 0, -c.distance}}};
  scene.surfaces = c.surfaces;
  return scene;
}

Tracer tracer_of(const Case& c, double moved_px) {
  TraceSettings settings;
  settings.method = c.method;
  settings.effects.jacobian = true;
  const Scene scene = scene_of(c, moved_px);
  return {scene, plan_trace(scene, settings)};
}

/// A plain tracer's answers, ray by ray.
class Ray {
 public:
  Ray(const Tracer& tracer, Wrap wrap)
      : tracer_(tracer.without_passes()), batch_(tracer_.make_batch()), wrap_(wrap) {}

  void trace(const std::vector<FilmPosition>& films,
             const std::function<void(std::size_t, bool, bool)>& use) {
    for (std::size_t first = 0; first < films.size(); first += kBatchSize) {
      for (std::size_t i = 0; i < kBatchSize; ++i) {
        const FilmPosition film = films[std::min(first + i, films.size() - 1)];
        batch_.x[i] = film.x, batch_.y[i] = film.y;
      }
      tracer_.trace(batch_);
      for (std::size_t i = 0; i < kBatchSize && first + i < films.size(); ++i) {
        bool captured = false, lit = false;
        for (const SurfaceBatch& surface : batch_.surfaces) {
          captured |= surface.outcome[i] == Outcome::Captured;
          const bool inside =
              surface.s[i] >= 0 && surface.s[i] <= 1 && surface.t[i] >= 0 && surface.t[i] <= 1;
          lit |= surface.outcome[i] == Outcome::Hit && (wrap_ != Wrap::Black || inside);
        }
        use(first + i, captured, lit);
      }
    }
  }

 private:
  Tracer tracer_;
  TraceBatch batch_;
  Wrap wrap_;
};

struct Truth {
  double light = 0;  // pixels' worth
  double rim = 0;    // mean radius of the shadow, pixels
};

/// The light within kRingWidth of the rim, along `angles` radii, in series of distances from the rim.
Truth truth_of(const Case& c, int angles) {
  constexpr double kNearest = 1e-6, kRatio = 1.003;
  Ray ray(tracer_of(c, 0), c.wrap);
  std::vector<double> captured(static_cast<std::size_t>(angles), 0), free(captured.size(), 1.5 * kShadow);
  const auto film = [&](std::size_t angle, double radius) {
    const double at = (static_cast<double>(angle) + 0.5) * 2 * kPi / angles;
    return FilmPosition{kSize / 2.0 + radius * std::cos(at), kSize / 2.0 + radius * std::sin(at)};
  };
  for (int step = 0; step < 36; ++step) {
    std::vector<FilmPosition> films;
    for (std::size_t a = 0; a < captured.size(); ++a) films.push_back(film(a, (captured[a] + free[a]) / 2));
    ray.trace(films, [&](std::size_t a, bool is_captured, bool) {
      (is_captured ? captured[a] : free[a]) = (captured[a] + free[a]) / 2;
    });
  }
  Truth truth;
  std::vector<FilmPosition> films;
  std::vector<double> weights;
  for (std::size_t a = 0; a < captured.size(); ++a) {
    truth.rim += free[a] / angles;
    for (double outer = kRingWidth; outer > kNearest; outer /= kRatio) {
      const double inner = outer / kRatio, radius = free[a] + (outer + inner) / 2;
      films.push_back(film(a, radius));
      weights.push_back((outer - inner) * radius * 2 * kPi / angles);
    }
  }
  ray.trace(films, [&](std::size_t n, bool, bool lit) { truth.light += lit ? weights[n] : 0; });
  return truth;
}

Picture white() {
  Picture picture{128, 128, 0, 0, 128, 128, {}};
  picture.pixels.assign(128 * 128, {1, 1, 1, 1});
  return picture;
}

Picture picture_of(const Case& c, double moved_px) {
  const SurfaceLook look{std::make_shared<const Texture>(white(), c.wrap)};
  return composite(tracer_of(c, moved_px), std::vector<SurfaceLook>(c.surfaces.size(), look), {}).picture;
}

double distance_from_rim(int column, int row, const Truth& truth, double moved_px) {
  return std::hypot(column + 0.5 - kSize / 2.0 - moved_px, row + 0.5 - kSize / 2.0) - truth.rim;
}

double light_in_ring(const Picture& picture, const Truth& truth, double moved_px) {
  double sum = 0;
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      if (distance_from_rim(column, row, truth, moved_px) < kRingWidth)
        sum += double(picture.at(column, row)[0]);
    }
  }
  return sum;
}

void expect_all_light(const Case& c, int angles, int frames) {
  SCOPED_TRACE(c.name);
  const Truth truth = truth_of(c, angles);
  EXPECT_GT(truth.light, 0.1);
  double least = 1e9, most = 0;
  for (int frame = 0; frame < frames; ++frame) {
    const double light = light_in_ring(picture_of(c, 0.1 * frame), truth, 0.1 * frame);
    EXPECT_NEAR(light / truth.light, 1, kRingLight) << frame;
    least = std::min(least, light), most = std::max(most, light);
  }
  EXPECT_LT((most - least) / truth.light, kSteadiness);
}

// Round the shadow they are seen from behind or from before, by light that has turned about the hole.
const Surface kBall = Sphere{{0, 0, -90}, 25, {}};
const Surface kAnnulus = Ring{{0, 0, -90}, {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}, 8, 25};

TEST(PhotonRing, HasAllLightOfPlates) {
  expect_all_light({"clamp", 50, {Plate{}}}, 8, 4);
  expect_all_light({"mirror, far away", 1e4, {Plate{}}, Wrap::Mirror}, 8, 2);
  expect_all_light({"repeat, near", 20, {Plate{}}, Wrap::Repeat}, 8, 2);
  expect_all_light({"black", 50, {Plate{}}, Wrap::Black}, 120, 2);
}

TEST(PhotonRing, HasAllLightOfBodies) {
  expect_all_light({"ball", 50, {kBall}}, 24, 3);
  expect_all_light({"annulus", 50, {kAnnulus}}, 24, 3);
}

TEST(PhotonRing, HasAllLightAlongCurvedRays) {
  expect_all_light({"curved", 50, {Plate{}}, Wrap::Clamp, Method::Geodesic}, 4, 2);
}

TEST(PhotonRing, IsEvenAllRound) {
  const Case c{"clamp", 50, {Plate{}}};
  const Truth truth = truth_of(c, 8);
  const Picture picture = picture_of(c, 0.3);
  std::vector<double> sums(20, 0.0);
  std::vector<int> counts(20, 0);
  const auto visit = [&](const std::function<void(std::size_t, double)>& use) {
    for (int row = 0; row < kSize; ++row) {
      for (int column = 0; column < kSize; ++column) {
        const double off = distance_from_rim(column, row, truth, 0.3);
        if (std::abs(off) < 1)
          use(static_cast<std::size_t>(10 * (off + 1)), double(picture.at(column, row)[0]));
      }
    }
  };
  visit([&](std::size_t bin, double light) { sums[bin] += light, ++counts[bin]; });
  EXPECT_GT(sums[10] / counts[10], 0.1);
  visit([&](std::size_t bin, double light) { EXPECT_NEAR(light, sums[bin] / counts[bin], kUneven); });
}

TEST(PhotonRing, OfAWhiteSkyIsWhatTheShadowLeaves) {
  const Case c{"sky", 50, {LatLong{}}, Wrap::Globe};
  const Truth truth = truth_of(c, 8);
  for (const double moved : {0.0, 0.1, 0.37}) {
    double dark = 0;
    for (const Rgba& pixel : picture_of(c, moved).pixels) dark += 1 - double(pixel[0]);
    EXPECT_NEAR(dark / (kPi * truth.rim * truth.rim), 1, 1e-3);
  }
}

}  // namespace
}  // namespace lensplane
