// SPDX-License-Identifier: Apache-2.0
//
// All frames of a shot, some at a time.

#pragma once

#include <functional>
#include <vector>

#include "pipeline/sequence/render_frame.h"

namespace lensplane {

/// Frames in the making at once: one is traced while another is compressed and written.
inline constexpr int kFramesAtOnce = 2;

struct SequenceHooks {
  std::function<void(const FrameReport&)> frame_done;  // called in the order of the frames
  std::function<bool()> stop;                          // true: begin no further frame
};

/// Makes `frames`, of which none is begun after hooks.stop() holds or one has failed; those begun are
/// finished. Returns the reports of all that were. Throws Failure.
std::vector<FrameReport> render_sequence(const Shot& shot, const ColourConfig& colours,
                                         const std::vector<int>& frames, const FrameTasks& tasks,
                                         const SequenceHooks& hooks);

}  // namespace lensplane
