// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/rim_lines.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/composite/footprint.h"
#include "pipeline/composite/normal_distribution.h"

namespace lensplane {
namespace {

constexpr int kMostLines = 4;

/// Rays stand as densely as this far from the rim, in pixels, and on the captured side.
constexpr double kStep = 0.2, kCapturedStep = 0.4;

/// Beside it stretches are shorter by this factor each, so many of them; those nearer still by more, kCoarse
/// of these steps in one.
const double kShrink = std::exp(-0.125);
constexpr int kFineSteps = 52, kCoarse = 4;

/// There a ray stands at the logarithmic mean of its stretch's bounds, this share of the outer one: where
/// what is seen ends on the stretch, and all phases are alike, that is right on average.
double mean_of_stretch(double inner) {
  return (1 - inner) / -std::log(inner);
}

/// Stretches of kStep and those of the series are equally long here.
const double kSeriesFrom = kStep / (1 - kShrink);

double below(double along) {
  return normal_share(along / kPixelSigma);
}

/// Adds rays for the stretches between neighbouring bounds, of which the first and the last count as
/// infinite, with a weight of `all` together.
class Stretches {
 public:
  Stretches(const RimLine& line, std::vector<RimRay>& rays) : line_(line), rays_(rays) {}

  /// A ray at `along` for the light between two places, in any order.
  void add(double from, double to, double along) {
    const auto weighed = [](double place) {
      constexpr double kInfinity = std::numeric_limits<double>::infinity();
      return std::abs(place) < kLineReach ? below(place) : below(std::copysign(kInfinity, place));
    };
    rays_.push_back(
        {line_.pixel, line_.aside, along, std::abs(weighed(to) - weighed(from)), std::abs(to - from)});
  }

  /// Stretches of the same length, of `step` at most.
  void add_even(double from, double to, double step) {
    const int count = std::max(1, static_cast<int>(std::ceil(std::abs(to - from) / step)));
    for (int i = 0; i < count; ++i) {
      const double length = (to - from) / count;
      add(from + i * length, i + 1 == count ? to : from + (i + 1) * length, from + (i + 0.5) * length);
    }
  }

 private:
  const RimLine& line_;
  std::vector<RimRay>& rays_;
};

}  // namespace

int rim_lines_of(int rays) {
  return std::clamp(rays / 16, 1, kMostLines);
}

double rim_line_width(int lines) {
  double variance = 0;
  for (int i = 0; i < lines; ++i) variance += std::pow(normal_quantile((i + 0.5) / lines), 2) / lines;
  return std::sqrt(1 - variance);
}

std::vector<RimLine> lines_across(std::size_t pixel, FilmPosition centre, const Sampling& sampling) {
  const int lines = rim_lines_of(sampling.max);
  // Far apart for neighbours in every direction, and for those that mirror one another about a shadow.
  const double of_pixel = 0.754877666 * centre.x + 0.569840291 * centre.y;
  std::vector<RimLine> result;
  for (int i = 0; i < lines; ++i) {
    // Neighbours' phases are far apart; those of all lines are evenly spread.
    const int number = i * 3 % lines;
    const double instant = static_cast<double>(sampling.first) / kMostSamples;
    result.push_back(
        {pixel, kPixelSigma * normal_quantile((i + 0.5) / lines), (number + instant) / lines + of_pixel});
  }
  return result;
}

void add_rays(const RimLine& line, std::vector<RimRay>& rays) {
  Stretches stretches(line, rays);
  if (!line.crosses) return stretches.add_even(-kLineReach, kLineReach, kStep);
  const double side = line.free > line.captured ? 1 : -1, far = side * kLineReach;
  stretches.add_even(-far, line.free, kCapturedStep);
  const double most = std::abs(far - line.free);
  const double phase = line.phase - std::floor(line.phase);
  const auto place = [&](double from_rim) { return line.free + side * from_rim; };
  double outer = kSeriesFrom * std::pow(kShrink, kCoarse * phase);
  int steps = 0;
  for (; outer >= most && steps < kFineSteps; ++steps) outer *= kShrink;
  outer = std::min(outer, most);
  if (outer < most) stretches.add_even(far, place(outer), kStep);
  for (; outer > kNearestToRim; ++steps) {
    const double shrink = steps < kFineSteps ? kShrink : std::pow(kShrink, kCoarse);
    stretches.add(place(outer), place(outer * shrink), place(outer * mean_of_stretch(shrink)));
    outer *= shrink;
  }
  stretches.add(place(outer), line.free, place(outer / 2));
}

}  // namespace lensplane
