// SPDX-License-Identifier: Apache-2.0
//
// The ladder climbed: every way of tracing a frame timed, and compared with curved rays.

#pragma once

#include "pipeline/shot/shot.h"
#include "pipeline/study/study.h"
#include "pipeline/study/study_hooks.h"

namespace lensplane {

/// The scene that a study traces: the shot's at `frame`, each layer once. Where light was bent before it came
/// to a layer, and where only stars are seen, it is the sky that is looked at.
Scene study_scene(const Shot& shot, int frame);

/// How many pixels of the frame are compared: as many as curved rays can be traced of in a second or so.
int rays_of(const StudyEffort& effort, std::size_t masses);

/// The time to trace the frame, overscan included, by bands of rows, as it is rendered. What takes long is
/// traced in part: in rows evenly spread over the film, or, like all curved rays, at the pixels of `grid`.
Timing time_trace(const Tracer& tracer, const FilmGrid& grid, const Repeats& repeats);

/// Whether a plan leaves out more than it says. `left_out`: against the same planes with everything on. Where
/// the plan knows a limit, both have to agree on which light is captured, too.
bool violates(double bound_px, const ErrorSummary& left_out, double rounding_px);

/// Fills the reference and the rows of `study`, as far as `hooks` let it. Throws Failure as scene_at.
void study_traces(const Shot& shot, int frame, const StudyEffort& effort, const StudyHooks& hooks,
                  Study& study);

}  // namespace lensplane
