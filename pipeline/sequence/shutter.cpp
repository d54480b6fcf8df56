// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/shutter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/sequence/screen_motion.h"

namespace lensplane {
namespace {

/// Fewer rays would not find where in a pixel an edge lies that stands still.
constexpr int kLeastRays = 4;

}  // namespace

ShutterSampling shutter_sampling(const Shot& shot, int frame) {
  const std::optional<int>& given = shot.camera.shutter.samples;
  ShutterSampling sampling{frame, 1, 1, !given};
  // One sample is a still, whatever moves.
  if (given == 1) return sampling;
  sampling.motion_px = screen_motion(shot, frame);
  const double needed = std::ceil(sampling.motion_px / kFarthestApart);
  sampling.needed = static_cast<int>(std::clamp(needed, 1.0, 1e6));
  sampling.samples = given.value_or(std::min(sampling.needed, kMostAutomatic));
  return sampling;
}

std::optional<ShutterSampling> worst_strobing(const Shot& shot, const std::vector<int>& frames) {
  std::optional<ShutterSampling> worst;
  for (const int frame : frames) {
    const ShutterSampling sampling = shutter_sampling(shot, frame);
    if (sampling.strobes() && (!worst || sampling.apart_px() > worst->apart_px())) worst = sampling;
  }
  return worst;
}

std::string line_of(const ShutterSampling& sampling) {
  if (sampling.samples == 1 && !sampling.strobes())
    return "shutter: one sample; nothing moves by more than 1.5 px";
  std::string line =
      fmt::format("shutter: {} samples, {:.2g} px apart where the motion of frame {:04} is fastest",
                  sampling.samples, sampling.apart_px(), sampling.frame);
  if (!sampling.strobes()) return line + (sampling.automatic ? " (auto)" : "");
  return line +
         (sampling.automatic
              ? fmt::format(": auto takes {} at most, and single moments are seen; {} would be needed",
                            kMostAutomatic, sampling.needed)
              : fmt::format(": single moments are seen; samples: {} would do",
                            sampling.needed <= kMostAutomatic ? "auto" : fmt::format("{}", sampling.needed)));
}

std::vector<Moment> moments_of(const Shot& shot, int frame) {
  const Shutter& shutter = shot.camera.shutter;
  Sampling sampling{shot.sampling.max, shot.sampling.threshold};
  const int count = shutter_sampling(shot, frame).samples;
  if (count == 1) return {{static_cast<double>(frame), sampling}};
  while (sampling.max > kLeastRays && sampling.max / 4 * count >= shot.sampling.max) sampling.max /= 4;
  const double open = value_at(shutter.open, frame), close = value_at(shutter.close, frame);
  std::vector<Moment> moments;
  for (int i = 0; i < count; ++i) {
    sampling.first = i * sampling.max % kMostSamples;
    moments.push_back({frame + open + (close - open) * (i + 0.5) / count, sampling});
  }
  return moments;
}

}  // namespace lensplane
