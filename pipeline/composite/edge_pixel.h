// SPDX-License-Identifier: Apache-2.0
//
// The rays of a pixel that holds an edge: what they see on average, and how much of that is left to chance.
//
// Chance is judged twice. Rays four by four, each of which cover the pixel evenly, have means that differ;
// but those may agree by chance. So the error has a floor from geometry: where rays see a jump, so many
// points are right to a known share of it (see sample_pattern.h), whatever they say.

#pragma once

#include <array>
#include <span>
#include <vector>

#include "pipeline/composite/edge_finder.h"
#include "pipeline/composite/layering.h"
#include "pipeline/composite/sample_pattern.h"

namespace lensplane {

inline constexpr float kMiddleGrey = 0.18F;

/// Light as an eye tells it apart, from 0 to 1: steps around middle grey are seen best.
float seen_brightness(float light);

class EdgePixel {
 public:
  /// A pixel of a tile, of so many surfaces; no rays yet.
  EdgePixel(int column, int row, PixelKind kind, std::size_t surfaces);

  int column() const { return column_; }
  int row() const { return row_; }

  /// Adds the next ray: what it meets on every surface, its colour, and what of it ends in a mass and is not
  /// covered. Up to kMostSamples. One that does not count lies where a thin body is, whose light is known
  /// (see thin_bodies.h): it is there for the error.
  void add(std::span<const SeenPoint> points, const Rgba& colour, float shadow = 0, bool counts = true);

  /// The mean of the colours of the rays that count; of all where none does.
  Rgba mean() const;

  /// The mean of what ends in masses, of the rays that count; 0 where none does.
  float shadow() const;

  /// The share of the rays that count that meets a surface; 0 where none does.
  double share_of(std::size_t surface) const;

  /// The standard error of the mean, as seen, the worst channel's. With fewer than 8 rays nothing is known:
  /// 0.
  float error() const;

 private:
  int counted() const;
  float spread_of_groups() const;
  float jump() const;

  int column_, row_;
  PixelKind kind_;
  int rays_ = 0;
  std::array<Rgba, kMostSamples> seen_{};
  std::array<bool, kMostSamples> counts_{};
  float shadow_ = 0;              // of all rays that count
  std::vector<int> hits_;         // per surface: how many of these meet it
  std::vector<SeenPoint> first_;  // of the first ray
  bool alike_ = true;             // all rays meet what the first does, in its order
};

}  // namespace lensplane
