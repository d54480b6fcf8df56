// SPDX-License-Identifier: Apache-2.0
//
// One film position in full: all that happens to its ray on the way.

#pragma once

#include <cstddef>
#include <vector>

#include "src/tracer.h"

namespace lensplane {

/// A ray passes a mass.
struct ProbedCrossing {
  std::size_t lens;  // its number in the scene
  double path;       // metres along the ray to the closest approach
  double b_over_m;   // from the mass to the ray's line, over the geometric mass; see Passage
  double alpha;      // radians
};

/// What the ray meets on one surface.
struct ProbedSurface {
  Outcome outcome;
  TextureCoordinates st;
  double ds_dx, ds_dy, dt_dx, dt_dy;  // per pixel
  double magnification;               // signed
  double delay;                       // seconds
  double distance;                    // metres along the ray; infinite for plates and skies
};

struct Probe {
  FilmPosition film;
  bool seen = true;  // false outside a fisheye's circle
  bool captured = false;
  bool unresolved = false;                // given up: what becomes of it is not known
  Vec3 first{0};                          // unit vector in the world, at the camera
  Vec3 last{0};                           // after the last bend
  std::size_t recipe = 0;                 // of the plan's recipes, by `planes`
  bool curved = false;                    // bodies are met by curved rays
  double chords_px = 0;                   // by how much chords would misplace them at most, by `planes`
  std::vector<ProbedCrossing> crossings;  // by the plane methods, in the order of the ray
  std::vector<ProbedSurface> surfaces;    // in the order of the scene
};

/// Follows the ray of one film position, by the readable references of all methods and with all effects.
Probe probe(const Scene& scene, const Plan& plan, FilmPosition film);

}  // namespace lensplane
