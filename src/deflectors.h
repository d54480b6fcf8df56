// SPDX-License-Identifier: Apache-2.0
//
// Deflectors: the masses of a scene as the method `planes` meets them, each with the law that the plan gives
// it.
//
// Everything is in camera axes, relative to the camera, in metres.

#pragma once

#include <cstddef>
#include <vector>

#include "src/company.h"
#include "src/deflection.h"
#include "src/fermat.h"
#include "src/lens_planes.h"

namespace lensplane {

/// A mass and how it bends.
struct Deflector {
  double m;       // geometric mass, metres, > 0
  Vec3 position;  // metres, camera axes
  Law law;
  std::size_t lens = 0;  // its number in the scene
  double index = 1;      // Fermat index n of its metric at the camera; 1 without finite distance
  Company company = {};  // of the exact law: what the other masses add; see in_company()
};

/// Deflectors that bend a ray together: their bends are added up, so that their order has no influence.
struct DeflectorPlane {
  Vec3 centre{0};  // the mean of their positions
  std::vector<Deflector> deflectors;
};

/// The planes in the order in which light from the camera meets them.
struct Deflectors {
  std::vector<DeflectorPlane> planes;
  std::size_t outward = 0;       // so many planes every ray meets; the rest only light that has turned back
  bool finite_distance = false;  // bends are only as large as the light's way from the camera makes them
  bool flat = true;    // the planes are parallel to a screen: light that runs along it meets no more
  bool blind = false;  // the camera is inside a horizon: it sees nothing
};

/// Index of refraction of one mass's isotropic metric, n = (1 + S)^3/(1 - S) with S = m/(2 rho), at the
/// distance rho; infinite on and inside the horizon rho = m/2. It makes
/// b = n rho sin(chi) the impact parameter of a ray that leaves at chi from the direction of the mass.
double fermat_index(double m, double rho);

/// The deflectors of `scene`, all by the same law.
Deflectors deflectors_of(const Scene& scene, Law law, bool finite_distance);

}  // namespace lensplane
