// SPDX-License-Identifier: Apache-2.0
//
// Motion blur: the moments at which a frame is taken while the shutter is open, and the rays that each takes.
//
// Moments that lie far apart on the film are seen as several pictures over one another. A shot that does not
// say how many there are gets as many as what moves fastest needs.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/composite/sample_pattern.h"
#include "pipeline/shot/shot.h"

namespace lensplane {

/// One of the instants that a picture is the mean of.
struct Moment {
  double time;        // in frames
  Sampling sampling;  // of this instant's pixels: together they get about as many rays as one instant would
};

/// Pixels between two moments of what moves fastest at most: wider gaps are seen.
inline constexpr double kFarthestApart = 1.5;

/// So many moments at most where the shot leaves it to us.
inline constexpr int kMostAutomatic = 64;

/// How a frame is sampled over time.
struct ShutterSampling {
  int frame = 0;
  int samples = 1;
  int needed = 1;          // for gaps of kFarthestApart
  bool automatic = false;  // whether it was left to us
  double motion_px = 0;    // screen_motion()

  double apart_px() const { return motion_px / samples; }
  /// Are moments seen one by one?
  bool strobes() const { return samples < needed; }
};

/// Of a shot without a shutter, and where nothing moves, it is one sample, in no need of more.
ShutterSampling shutter_sampling(const Shot& shot, int frame);

/// The worst of those frames that strobe; nothing when none does.
std::optional<ShutterSampling> worst_strobing(const Shot& shot, const std::vector<int>& frames);

/// "shutter: 12 samples, 1.4 px apart (auto)", and what is wrong with them where they strobe.
std::string line_of(const ShutterSampling& sampling);

/// The moments of a frame: the middles of as many equal parts of the time that the shutter is open. With one
/// sample that is the frame itself, whenever the shutter opens: it then shows what the frame's maps show.
std::vector<Moment> moments_of(const Shot& shot, int frame);

}  // namespace lensplane
