// SPDX-License-Identifier: Apache-2.0
//
// Where a camera sees nothing, not even the shadow of a mass, as the maps of a frame tell it: what they have
// traced the compositor need not trace again.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/lens_map.h"

namespace lensplane {

/// Remembers which pixels' centres meet something.
class EmptySpace {
 public:
  /// What is known of a batch.
  enum class Known { Nothing, MeetsSomething, MeetsNothing };

  EmptySpace() = default;  // of no camera: nothing is ever known
  explicit EmptySpace(const Camera& camera);

  /// `maps`: some rows of all the surfaces that the camera sees, from sample `first` on, with their shadow
  /// pass where light may end in a mass: that is not nothing. With soft edges they may say of a centre that
  /// it sees something when only its neighbourhood does.
  void learn(std::span<const LensMap> maps, std::size_t first, RowRange rows);

  /// Of a batch of pixel centres. It meets something where one of them does.
  Known known_of(const TraceBatch& batch) const;

 private:
  enum class Centre : std::uint8_t { Unknown, Empty, Seen };

  Centre at(double film_x, double film_y) const;

  int overscan_ = 0, width_ = 0, height_ = 0;
  std::vector<Centre> centres_;  // row by row from the top of the overscan
};

}  // namespace lensplane
