// SPDX-License-Identifier: Apache-2.0
//
// Which direction of the sky any film position sees, with derivatives and magnification, whatever surfaces
// and effects a tracer was made for.
//
// Light is traced by one recipe of the plan over the whole film, the most exact one that any of its tiles
// needs: so the map from film to sky has no steps between tiles.

#pragma once

#include <span>
#include <vector>

#include "src/tracer.h"

namespace lensplane {

/// What one film position sees of the sky.
struct SkyRay {
  FilmPosition film{0, 0};
  bool seen = false;         // false where light ends in a mass, or does not reach the film
  Vec3 direction{0};         // unit vector in the world, towards where the light comes from
  Vec3 by_x{0}, by_y{0};     // its derivatives per pixel; 0 at the poles of the world
  double magnification = 0;  // signed, as in PassBatch
};

class SkyRays {
 public:
  /// The sky as `tracer` sees it behind all masses; its own surfaces are not in the way.
  explicit SkyRays(const Tracer& tracer);

  const Camera& camera() const { return tracer_.camera(); }

  /// Where every mass that bends light is, in camera axes, metres.
  const std::vector<Vec3>& masses() const { return masses_; }

  /// What the film positions see, in their order.
  std::vector<SkyRay> trace(std::span<const FilmPosition> films) const;

 private:
  Tracer tracer_;
  std::vector<Vec3> masses_;
};

}  // namespace lensplane
