// SPDX-License-Identifier: Apache-2.0

#include "src/plan.h"

namespace lensplane {
namespace {

std::string counted(std::size_t count, std::string_view noun) {
  return std::to_string(count) + " " + std::string(noun) + (count == 1 ? "" : "s");
}

}  // namespace

Plan plan_trace(const Scene& scene, Method method) {
  return {method, lens_planes(scene, method)};
}

std::string describe(const Plan& plan) {
  std::size_t sources = 0;
  for (const LensPlane& plane : plan.planes) sources += plane.sources.size();
  return std::string(name_of(plan.method)) + ": weak law, " + counted(sources, "source") + " on " +
         counted(plan.planes.size(), "plane");
}

}  // namespace lensplane
