// SPDX-License-Identifier: Apache-2.0
//
// Where the light of film positions comes from, as straight rays: for renderers that follow it on through a
// scene of their own.
//
// A ray begins at its last bend: at the camera where nothing bends it, by the plane methods at the foot point
// in the last plane, by `geodesic` on the line that the curved ray approaches, where that is nearest to the
// last mass.

#pragma once

#include <span>
#include <vector>

#include "src/plan.h"

namespace lensplane {

/// The straight rest of a ray, backwards in time, in camera axes.
struct OutgoingRay {
  Vec3 start{0};          // metres
  Vec3 direction{0};      // unit vector, away from the camera; 0 where there is no light
  bool lightless = true;  // it ends in a mass, or begins outside a fisheye's circle
};

/// The rays of film positions by `plan` after their last bend, in their order, traced in parallel. The same
/// for any number of threads.
std::vector<OutgoingRay> outgoing_rays(const Scene& scene, const Plan& plan,
                                       std::span<const FilmPosition> films);

/// The same on their way: after `bends` planes, 0 for the rays at the camera, where light comes through them.
std::vector<OutgoingRay> rays_after(const Scene& scene, const Plan& plan, std::size_t bends,
                                    std::span<const FilmPosition> films);

/// How far along the camera's axis the planes lie that all rays meet, in their order, metres: those of the
/// plan's last recipe. By `geodesic`, where there are none, the nearest mass ahead stands for all.
std::vector<double> bend_depths(const Scene& scene, const Plan& plan);

/// Does any mass bend light by `plan`?
bool bends_light(const Scene& scene, const Plan& plan);

}  // namespace lensplane
