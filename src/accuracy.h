// SPDX-License-Identifier: Apache-2.0
//
// How far apart two traces of the same film positions are, in pixels of the output frame.
//
// On skies that is the angle between two directions over pixel_angle(); on plates and cards the distance of
// (s, t) in pixels of the frame; on spheres how far aside one ray is of where the other meets it, and on
// rings the angle between both places, as seen from the camera. They are the measures of plan_bounds.h.

#pragma once

#include <cstddef>
#include <vector>

#include "src/tracer.h"

namespace lensplane {

/// Pixels between what two traces see on `surface` (in camera axes), which both have to hit. Spheres need the
/// direction among the passes.
double pixels_apart(const Camera& camera, const Surface& surface, const SurfaceBatch& a,
                    const SurfaceBatch& b, std::size_t i);

/// What two traces of one film position come to, on all surfaces together.
struct RayError {
  bool compared = false;          // both hit one of the surfaces
  bool validity_differs = false;  // one is valid somewhere where the other is not
  bool captured_differs = false;
  double px = 0;  // the farthest apart on any surface that both hit; infinite if that is no number
};

/// The error of ray `i` of a batch; `tracer` made either of both.
RayError error_of_ray(const Tracer& tracer, const TraceBatch& a, const TraceBatch& b, std::size_t i);

/// Errors larger than this are counted: what can be seen in a picture that moves.
inline constexpr double kSeenErrorPx = 0.1;

/// Of rays that see something by either trace.
struct ErrorSummary {
  std::size_t rays = 0;
  std::size_t compared = 0;  // of these; without any there is no median, nor what follows it
  double median_px = 0;      // of the rays that could be compared
  double p99_px = 0;         // 99 % of these are no farther off
  double most_px = 0;
  std::size_t worst = 0;              // which error that is
  double share_seen = 0;              // of all: off by more than kSeenErrorPx
  double share_validity_differs = 0;  // of all
  std::size_t captured_differs = 0;   // rays that only one trace takes to be captured, seen or not

  /// What 99 of 100 rays are within: p99_px, but infinite where more than one in a hundred cannot be
  /// compared.
  double judged_px() const;
};

ErrorSummary summary_of(const std::vector<RayError>& errors);

}  // namespace lensplane
