// SPDX-License-Identifier: Apache-2.0
//
// Pyramids: a picture at half its size, and half of that, down to one texel, all in memory.
//
// A level's display window covers the same area as the picture's; its width and height are half of the finer
// level's, rounded down, so that sizes need not be powers of two. Each level is the finer one filtered by the
// cubic B-spline that is as wide as its own texels need: a box would let through a tenth of the detail that a
// coarser level cannot hold, as moire; this lets through less than one part in a hundred, and has no negative
// weights that would ring around stars.

#pragma once

#include <vector>

#include "pipeline/composite/texels.h"

namespace lensplane {

struct Pyramid {
  std::vector<Picture> pictures;   // the picture itself first
  std::vector<TexelLevel> levels;  // of the pictures' texels

  Pyramid() = default;
  Pyramid(Pyramid&&) = default;  // texels stay where they are, unlike in a copy
  Pyramid& operator=(Pyramid&&) = default;
};

/// Runs in parallel. The picture's display window must not be empty.
Pyramid make_pyramid(Picture picture, Wrap wrap);

/// Reads a pyramid, which has to outlive it.
class PyramidTexels final : public Texels {
 public:
  PyramidTexels(const Pyramid& pyramid, Wrap wrap) : Texels(pyramid.levels, wrap), pyramid_(pyramid) {}

 private:
  TexelRun stored(int level, const TexelPlace& place) override {
    const Picture& picture = pyramid_.pictures[static_cast<std::size_t>(level)];
    return {&picture.at(place.column - picture.x, place.row - picture.y), place.count};
  }

  const Pyramid& pyramid_;
};

}  // namespace lensplane
