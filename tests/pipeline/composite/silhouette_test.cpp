// SPDX-License-Identifier: Apache-2.0
//
// Silhouettes of balls that move by parts of a pixel, against the integral of the pixel filter over the disc.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "pipeline/composite/compositor.h"
#include "pipeline/composite/footprint.h"
#include "src/constants.h"

namespace lensplane {
namespace {

// Of a pixel's coverage: by 64 rays, with all slopes and places of an edge among the pixels.
constexpr double kWorstSilhouette = 0.06;
constexpr double kRmsSilhouette = 0.02;

// What a pixel jumps from the mean of the frames before and after, beyond what the disc itself does.
constexpr double kWorstPop = 0.06;

constexpr int kSize = 56;       // pixels of the frame, both ways
constexpr double kRadius = 20;  // pixels of the disc
constexpr double kFilm = 1e-4;  // radians from edge to edge: flat

struct Place {
  double x, y;  // of the disc's centre on the film
};

/// The alphas of a white ball.
std::vector<double> alphas_of(Place centre) {
  Scene scene;
  scene.camera.width = scene.camera.height = kSize;
  scene.camera.fov_rad = kFilm;
  const double pixel = slope_per_pixel(scene.camera) * 1e6;  // metres, at the ball
  const Vec3 at{(centre.x - kSize / 2.0) * pixel, (kSize / 2.0 - centre.y) * pixel, -1e6};
  scene.surfaces = {Sphere{at, kRadius * pixel, {}}};
  TraceSettings settings;
  settings.effects.jacobian = true;
  const Picture white{1, 1, 0, 0, 1, 1, {{1, 1, 1, 1}}};
  const SurfaceLook look{std::make_shared<const Texture>(white, Wrap::Clamp)};
  std::vector<double> alphas;
  for (const Rgba& c : composite(Tracer(scene, plan_trace(scene, settings)), {look}, {}).picture.pixels) {
    alphas.push_back(c[3]);
  }
  return alphas;
}

double normal_share(double x) {
  return 0.5 * std::erfc(-x / std::sqrt(2.0));
}

/// The pixel filter's share of the disc, row by row of it.
double true_alpha(Place centre, int column, int row) {
  const double x = (centre.x - column - 0.5) / kPixelSigma, y = (centre.y - row - 0.5) / kPixelSigma;
  const double radius = kRadius / kPixelSigma;
  constexpr double kReach = 6, kStep = 0.01;  // in standard deviations
  double sum = 0;
  for (double v = -kReach + kStep / 2; v < kReach; v += kStep) {
    const double square = radius * radius - (v - y) * (v - y);
    if (square <= 0) continue;
    const double half = std::sqrt(square);
    sum +=
        kStep * std::exp(-v * v / 2) / std::sqrt(2 * kPi) * (normal_share(x + half) - normal_share(x - half));
  }
  return sum;
}

std::vector<double> true_alphas_of(Place centre) {
  std::vector<double> alphas;
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      const double off = std::abs(std::hypot(column + 0.5 - centre.x, row + 0.5 - centre.y) - kRadius);
      const bool inside = std::hypot(column + 0.5 - centre.x, row + 0.5 - centre.y) < kRadius;
      alphas.push_back(off > 5 * kPixelSigma ? inside : true_alpha(centre, column, row));
    }
  }
  return alphas;
}

TEST(Silhouette, IsWhatThePixelFilterHasOfTheDisc) {
  double worst = 0, squares = 0;
  int edge_pixels = 0;
  for (int n = 0; n < 16; ++n) {
    const Place centre{28 + std::fmod(0.618034 * n, 1.0), 28 + std::fmod(0.754878 * n, 1.0)};
    const std::vector<double> alphas = alphas_of(centre), truths = true_alphas_of(centre);
    for (std::size_t i = 0; i < alphas.size(); ++i) {
      if (truths[i] < 0.02 || truths[i] > 0.98) {
        ASSERT_NEAR(alphas[i], truths[i], kWorstSilhouette);
        continue;
      }
      const double off = alphas[i] - truths[i];
      worst = std::max(worst, std::abs(off));
      squares += off * off;
      ++edge_pixels;
    }
  }
  EXPECT_GT(edge_pixels, 16 * 150);
  EXPECT_LT(worst, kWorstSilhouette);
  EXPECT_LT(std::sqrt(squares / edge_pixels), kRmsSilhouette);
}

TEST(Silhouette, DoesNotPopWhileItMovesSlowly) {
  for (const Place move : {Place{0.04, 0}, Place{0.02, 0.02}, Place{0.03, -0.013}}) {
    std::vector<std::vector<double>> off;
    for (int frame = 0; frame < 24; ++frame) {
      const Place centre{28.1 + frame * move.x, 27.9 + frame * move.y};
      off.push_back(alphas_of(centre));
      const std::vector<double> truths = true_alphas_of(centre);
      for (std::size_t i = 0; i < truths.size(); ++i) off.back()[i] -= truths[i];
    }
    double worst = 0;
    for (std::size_t frame = 1; frame + 1 < off.size(); ++frame) {
      for (std::size_t i = 0; i < off[frame].size(); ++i) {
        worst = std::max(worst, std::abs(off[frame][i] - (off[frame - 1][i] + off[frame + 1][i]) / 2));
      }
    }
    EXPECT_LT(worst, kWorstPop);
  }
}

}  // namespace
}  // namespace lensplane
