// SPDX-License-Identifier: Apache-2.0
//
// Lines across a pixel that the rim of a shadow runs through, and where rays go along them.
//
// Beside the rim light winds round its mass, once more whenever it comes nearer by a factor of 535: every
// image of what is there lies there again, thinner and thinner. Film samples miss them. So lines cross the
// rim at right angles, side by side as the pixel filter weighs the film; the rim is found on each by
// bisection, and rays stand beside it at distances in geometric series, each for the light of its own
// stretch.

#pragma once

#include <cstddef>
#include <vector>

#include "pipeline/composite/sample_pattern.h"
#include "src/projection.h"

namespace lensplane {

/// How far lines reach on either side of the pixel's centre, in pixels.
inline constexpr double kLineReach = 1.4;

/// Rays stand as near to the rim as this, in pixels, and the rim is found as exactly as that: what is nearer
/// is less than a ten-thousandth of the light of the first image round a shadow of some pixels.
inline constexpr double kNearestToRim = 1e-5;
inline constexpr double kRimWidth = 4e-6;

/// A line across the rim. Places on it are pixels from the one beside the pixel's centre, towards the light.
struct RimLine {
  std::size_t pixel;              // any number of the caller's
  double aside;                   // pixels from the pixel's centre, along the rim
  double phase;                   // 0 to 1: which part of a step its rays are shifted by
  double captured = -kLineReach;  // a place where light is captured
  double free = kLineReach;       // and one where it is not, nearer and nearer
  bool crosses = false;           // whether they are that
};

/// A ray of a line, for all light of a stretch.
struct RimRay {
  std::size_t pixel;
  double aside, along;  // pixels from the pixel's centre
  double weight;        // of the pixel filter, as a share of the line's
  double length;        // of its stretch, pixels
};

/// How many lines a pixel has that may get so many rays.
int rim_lines_of(int rays);

/// How wide each of so many lines is filtered, in units of the pixel filter: lines and this are as wide as
/// it.
double rim_line_width(int lines);

/// The lines of the pixel number `pixel`, of equal weights. Instants of a shutter have different phases.
std::vector<RimLine> lines_across(std::size_t pixel, FilmPosition centre, const Sampling& sampling);

/// Adds the rays of a line on which the rim is found, or that does not cross it; their weights add up to 1.
void add_rays(const RimLine& line, std::vector<RimRay>& rays);

}  // namespace lensplane
