// SPDX-License-Identifier: Apache-2.0
//
// One ray by any method, through the readable references: for rays that batches leave aside, for probes, and
// for what has no batches.

#pragma once

#include <span>
#include <vector>

#include "src/plan.h"
#include "src/sight.h"

namespace lensplane {

/// What the ray through `film` meets on each surface of `sight`, in their order. `recipe`: which of the
/// plan's, by `planes`.
template <class Number>
RayHits<Number> trace_ray(const Sight& sight, const Plan& plan, std::size_t recipe, FilmPosition film);

/// The same as the plan has it at `film`: by its tile's recipe, bodies perhaps by curved rays.
template <class Number>
RayHits<Number> trace_film(const Sight& sight, const Plan& plan, FilmPosition film);

/// The same by curved rays, for many at once.
template <class Number>
std::vector<RayHits<Number>> trace_curved_rays(const Sight& sight, const Plan& plan,
                                               std::span<const FilmPosition> films);

/// The ray's path by the plane methods.
template <class Number>
RayPath<Number> path_of_ray(const Camera& camera, const Plan& plan, std::size_t recipe, FilmPosition film);

}  // namespace lensplane
