// SPDX-License-Identifier: Apache-2.0
//
// What the frames of a shot share: images and catalogues that are read once.

#pragma once

#include "pipeline/sequence/star_store.h"
#include "pipeline/sequence/texture_store.h"

namespace lensplane {

/// Safe to use from several threads. `shot` and `colours` have to outlive it.
struct ShotAssets {
  ShotAssets(const Shot& shot, const ColourConfig& colours) : textures(shot, colours), stars(shot, colours) {}

  TextureStore textures;
  StarStore stars;
};

}  // namespace lensplane
