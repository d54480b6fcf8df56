// SPDX-License-Identifier: Apache-2.0
//
// The plan: what is simulated for a scene, as a value that can be printed and tested.

#pragma once

#include <string>
#include <vector>

#include "src/lens_planes.h"

namespace lensplane {

struct Plan {
  Method method = Method::ShinotsukaMakino;
  std::vector<LensPlane> planes;  // in camera axes, as lens_planes orders them
};

/// What it takes to trace `scene` by `method`.
Plan plan_trace(const Scene& scene, Method method);

/// The plan in one line: "shinotsuka-makino: weak law, 3 sources on 3 planes".
std::string describe(const Plan& plan);

}  // namespace lensplane
