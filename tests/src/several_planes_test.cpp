// SPDX-License-Identifier: Apache-2.0
//
// The method `planes` against figures of lens theory: several planes, rings, and two masses on one plane.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/src/scenes.h"
#include "tests/src/small_angles.h"

namespace lensplane {
namespace {

constexpr double kScale = 1e-5;
constexpr double kSmall = 1e-8;  // what finite angles and rounding may do at that scale

TEST(SeveralPlanes, JacobianIsThePublishedOneWithItsRotation) {
  const Deflectors deflectors =
      scaled_down({{.01, .3, -.2, 10}, {.02, -.5, .4, 10}, {.015, .1, .6, 20}, {.005, -.2, -.7, 30}}, kScale);
  ASSERT_EQ(deflectors.outward, 3U);
  const Angle<Dual> end = crossing(path_seen_at(deflectors, kScale, {.11, .07}), kScale, 40);
  EXPECT_NEAR(end.x.v, 1.46444847010245284, kSmall);
  EXPECT_NEAR(end.y.v, 1.46961363978952305, kSmall);
  EXPECT_NEAR(end.x.dx / 40, 1.472078011220032, kSmall);
  EXPECT_NEAR(end.x.dy / 40, .4892131091108007, kSmall);
  EXPECT_NEAR(end.y.dx / 40, .4609466131751025, kSmall);
  EXPECT_NEAR(end.y.dy / 40, .6603937643932852, kSmall);
  EXPECT_NEAR(40 * 40 / determinant(end), 1.339315585427419, kSmall);
  EXPECT_NEAR((end.y.dx - end.x.dy) / 80, -.0141332479678, kSmall);
}

/// How far beside the axis a ray crosses the plane at `z`.
double beside_axis(const Deflectors& deflectors, double theta, double z) {
  const RaySegment<double> last = march_planes<double>(deflectors, at_angle(theta)).segments.back();
  return last.start.x + last.direction.x * ((-z - last.start.z) / last.direction.z);
}

TEST(SeveralPlanes, AlignedMassesHaveTheirPublishedRings) {
  const double h = 1e9, m = 1e-3;  // theta about 1e-6
  const std::vector<std::vector<double>> published = {
      {1.0 / 2},
      {1, 1.0 / 3},
      {1.39038820320220757, .359611796797792431, .883795939621999108, .282870727044667559}};
  for (std::size_t n = 1; n <= 3; ++n) {
    std::vector<Lens> lenses;
    for (std::size_t k = 1; k <= n; ++k) lenses.push_back({m, {0, 0, -static_cast<double>(k) * h}});
    const Deflectors deflectors = flat_deflectors(lenses, Law::Weak);
    const double z = static_cast<double>(n + 1) * h;
    for (const double theta2 : published[n - 1]) {
      const double theta = std::sqrt(theta2 * 4 * m / h);
      EXPECT_LT(
          beside_axis(deflectors, theta * (1 - 1e-9), z) * beside_axis(deflectors, theta * (1 + 1e-9), z), 0)
          << n << " " << theta2;
    }
  }
}

TEST(SeveralPlanes, RingsOfTheSeedMassHaveTheirPublishedRadii) {
  // Published for small angles, 2 theta = alpha(D theta). The tracer's ring is where 2 theta = alpha(D sin
  // theta).
  for (const auto& [law, published] :
       {std::pair{Law::Weak, 5.435187719900e-3}, {Law::Exact, 5.4570230675707e-3}}) {
    const Deflectors deflectors = flat_deflectors({{seed_m(), {0, 0, -1e9}}}, law);
    double inside = 0.9 * published, outside = 1.1 * published;
    for (int i = 0; i < 60; ++i) {
      const double middle = (inside + outside) / 2;
      (beside_axis(deflectors, middle, 2e9) < 0 ? inside : outside) = middle;
    }
    EXPECT_NEAR(2 * inside, entry_of(law).deflection(seed_m(), 1e9 * std::sin(inside)).alpha, 1e-13);
    EXPECT_NEAR(entry_of(law).deflection(seed_m(), 1e9 * published).alpha / (2 * published), 1, 1e-12);
    EXPECT_NEAR(inside / published, 1 + published * published / 12, 2e-8);
  }
}

/// Two masses of 1/2 on one plane, d = 1 apart; the Einstein angle of both together is 1.
Deflectors two_masses(double d) {
  return scaled_down({{0.125, -d / 2, 0, 1}, {0.125, d / 2, 0, 1}}, kScale);
}

TEST(TwoMasses, ImagesOfASourceBetweenThemAreThePublishedOnes) {
  const Deflectors deflectors = two_masses(1);
  struct {
    double x, y, mu;
  } const kImages[] = {{0, 0, -1.0 / 15},
                       {std::sqrt(5.0) / 2, 0, -4.0 / 5},
                       {-std::sqrt(5.0) / 2, 0, -4.0 / 5},
                       {0, std::sqrt(3.0) / 2, 4.0 / 3},
                       {0, -std::sqrt(3.0) / 2, 4.0 / 3}};
  for (const auto& [x, y, mu] : kImages) {
    const Angle<Dual> source = source_angle(path_seen_at(deflectors, kScale, {x, y}), kScale);
    EXPECT_NEAR(source.x.v, 0, kSmall);
    EXPECT_NEAR(source.y.v, 0, kSmall);
    EXPECT_NEAR(1 / determinant(source), mu, kSmall);
  }
}

TEST(TwoMasses, CriticalCurveMeetsTheAxisAtItsPublishedPoint) {
  const Deflectors deflectors = two_masses(1);
  const double critical = 1.27122987841870624;
  const auto at = [&](double x) { return source_angle(path_seen_at(deflectors, kScale, {x, 0}), kScale); };
  EXPECT_LT(determinant(at(critical - 1e-8)), 0);
  EXPECT_GT(determinant(at(critical + 1e-8)), 0);
  EXPECT_NEAR(std::abs(at(critical).x.v), 0.34062501931660664, kSmall);
}

/// All images of a source, by Newton's method from everywhere, with the tracer's own derivatives.
std::vector<Angle<double>> images_of(const Deflectors& deflectors, Angle<double> source) {
  std::vector<Angle<double>> images;
  for (int start = 0; start < 41 * 41; ++start) {
    Angle<double> theta{start % 41 * 0.1 - 2.003, start / 41 * 0.1 - 2.001};
    double step = 1;
    for (int i = 0; i < 60 && step > 1e-12; ++i) {
      const auto path = path_seen_at(deflectors, kScale, theta);
      if (path.captured) break;
      const Angle<Dual> at = source_angle(path, kScale);
      const double dx = source.x - at.x.v, dy = source.y - at.y.v, det = determinant(at);
      const double x = (at.y.dy * dx - at.x.dy * dy) / det, y = (at.x.dx * dy - at.y.dx * dx) / det;
      step = std::hypot(x, y);
      const double shorten = std::min(1.0, 0.2 / step);
      theta = {theta.x + shorten * x, theta.y + shorten * y};
    }
    const bool known = std::any_of(images.begin(), images.end(), [&](const Angle<double>& image) {
      return std::hypot(image.x - theta.x, image.y - theta.y) < 1e-6;
    });
    if (step <= 1e-12 && !known) images.push_back(theta);
  }
  return images;
}

TEST(TwoMasses, AmplificationsAreThePublishedOnes) {
  struct {
    double x, y;
    std::size_t images;
    double amplification;
  } constexpr kPublished[] = {{0, 0, 5, 13.0 / 3},
                              {0.1, 0.05, 5, 4.801785712988886},
                              {0.5, 0.5, 3, 1.490643095314934},
                              {1, 0, 3, 1.374452722927657}};
  const Deflectors deflectors = two_masses(1);
  for (const auto& [x, y, count, amplification] : kPublished) {
    const auto images = images_of(deflectors, {x, y});
    EXPECT_EQ(images.size(), count) << x;
    double sum = 0, signed_sum = 0;
    for (const Angle<double>& image : images) {
      const double mu = 1 / determinant(source_angle(path_seen_at(deflectors, kScale, image), kScale));
      sum += std::abs(mu);
      signed_sum += mu;
    }
    EXPECT_NEAR(sum, amplification, 10 * kSmall) << x;
    if (count == 5) {
      EXPECT_NEAR(signed_sum, 1, 10 * kSmall) << x;  // inside the caustic
    }
  }
}

}  // namespace
}  // namespace lensplane
