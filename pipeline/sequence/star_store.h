// SPDX-License-Identifier: Apache-2.0
//
// The catalogues of a shot's stars, read once, turned as the shot turns them, in the working space.

#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "pipeline/colour/colour_config.h"
#include "pipeline/composite/star_images.h"
#include "pipeline/shot/shot.h"

namespace lensplane {

/// Safe to use from several threads.
class StarStore {
 public:
  /// `shot` and `colours` have to outlive the store.
  StarStore(const Shot& shot, const ColourConfig& colours) : shot_(shot), colours_(colours) {}

  /// The stars of a layer (an index into Shot::layers) at a time, with light in the working space. Throws
  /// Failure (BadInput) when the catalogue cannot be read, or when the OCIO config has no ACEScg.
  std::shared_ptr<const StarField> field(std::size_t layer, double time);

 private:
  struct Kept {
    std::vector<Star> stars;  // as the catalogue has them
    std::vector<Rgb> light;   // at exposure 0
    Vec3 rotation{0};
    double exposure = 0;
    std::shared_ptr<const StarField> field;  // with these two; null at first
  };

  Kept read(const StarsLayer& layer) const;

  const Shot& shot_;
  const ColourConfig& colours_;
  std::mutex mutex_;
  std::map<std::size_t, Kept> kept_;
};

}  // namespace lensplane
