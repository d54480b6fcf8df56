// SPDX-License-Identifier: Apache-2.0
//
// Where the rays of a pixel go when one is not enough: points spread as the pixel filter weighs the film.
//
// The points are those of Sobol's sequence in two dimensions, scrambled and taken through the inverse of the
// normal distribution: any power of four from its beginning covers the filter evenly in both directions at
// once. Unscrambled points lie on diagonals, which an edge meets all together; these do not. All pixels use
// the same points: what moves over the film is sampled the same way everywhere, and nothing crawls.

#pragma once

#include <array>

#include "src/map_coverage.h"

namespace lensplane {

/// How many rays a pixel may get, and when it has enough.
struct Sampling {
  int max = 64;              // rays a pixel: 1, 4, 16 or 64
  double threshold = 0.004;  // of the standard error, as seen; see seen_brightness()
  int first = 0;  // the first of the points that is used: a multiple of max, less than kMostSamples
};

inline constexpr int kMostSamples = 64;

/// Rays of the first look at an edge, from whose spread the error is estimated.
inline constexpr int kFirstSamples = 16;

/// How far the share of the points on one side of a straight edge is from what the pixel filter has there,
/// over all slopes and places: at most for all points, and root mean square for those of a first look.
inline constexpr double kWorstEdgeError = 0.051;
inline constexpr double kFirstEdgeError = 0.042;

/// Each ray is filtered itself, this much of the pixel filter wide; points and rays together are as wide as
/// the filter.
inline constexpr double kSampleScale = 0.3;

/// Pixels from the pixel's centre.
struct SampleOffset {
  double x, y;
};

/// The points; so many of them as a power of four are a pattern of their own, from the beginning and after
/// any multiple of their number.
const std::array<SampleOffset, kMostSamples>& sample_offsets();

/// The pixel filter of the same points, for the coverage of maps: they alone are as wide as the filter.
FilmFilter coverage_filter();

}  // namespace lensplane
