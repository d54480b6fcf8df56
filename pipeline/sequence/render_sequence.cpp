// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/render_sequence.h"

#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

namespace lensplane {

std::vector<FrameReport> render_sequence(const Shot& shot, const ColourConfig& colours,
                                         const std::vector<int>& frames, const FrameTasks& tasks,
                                         const SequenceHooks& hooks) {
  TextureStore textures(shot, colours);
  std::vector<FrameReport> reports;
  std::size_t next = 0;
  const auto take_frame = [&](tbb::flow_control& flow) {
    if (next == frames.size() || hooks.stop()) {
      flow.stop();
      return 0;
    }
    return frames[next++];
  };
  const auto make_frame = [&](int frame) {
    // Isolated: while a frame waits for its own rows it must not begin another frame on the same thread.
    return tbb::this_task_arena::isolate([&] { return render_frame(shot, colours, textures, frame, tasks); });
  };
  const auto report_frame = [&](const FrameReport& report) {
    reports.push_back(report);
    hooks.frame_done(report);
  };
  tbb::parallel_pipeline(
      kFramesAtOnce,
      tbb::make_filter<void, int>(tbb::filter_mode::serial_in_order, take_frame) &
          tbb::make_filter<int, FrameReport>(tbb::filter_mode::parallel, make_frame) &
          tbb::make_filter<FrameReport, void>(tbb::filter_mode::serial_in_order, report_frame));
  return reports;
}

}  // namespace lensplane
