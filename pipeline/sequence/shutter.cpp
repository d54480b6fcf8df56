// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/shutter.h"

#include <algorithm>

namespace lensplane {
namespace {

/// Fewer rays would not find where in a pixel an edge lies that stands still.
constexpr int kLeastRays = 4;

}  // namespace

std::vector<Moment> moments_of(const Shot& shot, int frame) {
  const Shutter& shutter = shot.camera.shutter;
  Sampling sampling{shot.sampling.max, shot.sampling.threshold};
  const int count = shutter.samples;
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
