// SPDX-License-Identifier: Apache-2.0
//
// Maps with soft edges: coverage as the pixel filter sees it, and s and t that go on beyond the edge.
//
// A map's centres say who is seen and who is not: stairs. Here more rays go through the pixels where centres
// beside one another disagree, those just beyond the film included. `valid` becomes the share of the pixel
// filter in which the surface is seen. A pixel whose centre misses the surface gets s, t and the passes of
// one of its rays that hit it: of the one nearest to the middle of all that do, so that what is looked up
// there is what stands for the seen part. Two pixels farther out s, t and what the passes say of the surface
// are those of the nearest pixel that sees it: a program that mixes neighbours finds no zeros there. All else
// stays as it was, to the last bit. What is
// thinner than a pixel is found where it is, and its coverage known from there (thin_coverage.h).

#pragma once

#include <cstdint>
#include <vector>

#include "src/lens_map.h"
#include "src/thin_coverage.h"

namespace lensplane {

/// Pixels from a pixel's centre.
struct FilmOffset {
  double x = 0, y = 0;
};

/// Points that stand for the pixel filter, each for the same share of it.
struct FilmFilter {
  double sigma = 0;  // its standard deviation, pixels
  std::vector<FilmOffset> points;
  std::size_t first = 0;  // so many of them, from the beginning, are the outermost ones: pixels of which all
                          // these see what the centre does hold no edge, and get no more
};

/// Rows that have to be there above and below those that filter_coverage() is asked to finish.
inline constexpr int kCoverageMargin = 3;

/// How far, in pixels, s and t go on beyond the last pixel that sees anything of a surface.
inline constexpr int kExtension = 2;

/// Finishes `maps`, which hold what trace_maps() has found at the centres of `rows`. The outermost
/// kCoverageMargin rows, but for the film's own first and last, are not finished: they lack neighbours. Runs
/// in parallel, and does not depend on the number of threads. `thin`: what is thinner than a pixel, of the
/// same tracer. Returns how many rays were traced.
std::int64_t filter_coverage(const Tracer& tracer, const FilmFilter& filter, const ThinCoverage& thin,
                             RowRange rows, std::vector<LensMap>& maps);

}  // namespace lensplane
