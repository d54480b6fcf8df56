// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/empty_space.h"

#include <cmath>

#include "src/map_channels.h"

namespace lensplane {

EmptySpace::EmptySpace(const Camera& camera)
    : overscan_(camera.overscan),
      width_(camera.full_width()),
      height_(camera.full_height()),
      centres_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), Centre::Unknown) {}

void EmptySpace::learn(std::span<const LensMap> maps, std::size_t first, RowRange rows) {
  const std::size_t at = static_cast<std::size_t>(rows.begin) * static_cast<std::size_t>(width_);
  const std::size_t count =
      static_cast<std::size_t>(rows.end - rows.begin) * static_cast<std::size_t>(width_);
  for (std::size_t i = 0; i < count; ++i) centres_[at + i] = Centre::Empty;
  const auto see_where = [&](const UnsetVector<float>& values) {
    for (std::size_t i = 0; i < count; ++i) {
      if (values[first + i] != 0) centres_[at + i] = Centre::Seen;
    }
  };
  for (const LensMap& map : maps) {
    see_where(map.valid);
    if (const Pass* shadow = pass_of(map, kShadowChannel)) see_where(shadow->values);
  }
}

EmptySpace::Known EmptySpace::known_of(const TraceBatch& batch) const {
  Known known = Known::MeetsNothing;
  for (std::size_t i = 0; i < kBatchSize; ++i) {
    const Centre centre = at(batch.x[i], batch.y[i]);
    if (centre == Centre::Seen) return Known::MeetsSomething;
    if (centre == Centre::Unknown) known = Known::Nothing;
  }
  return known;
}

EmptySpace::Centre EmptySpace::at(double film_x, double film_y) const {
  const double column = std::floor(film_x) + overscan_, row = std::floor(film_y) + overscan_;
  if (column < 0 || column >= width_ || row < 0 || row >= height_) return Centre::Unknown;
  return centres_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                  static_cast<std::size_t>(column)];
}

}  // namespace lensplane
