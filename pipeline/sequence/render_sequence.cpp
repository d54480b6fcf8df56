// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/render_sequence.h"

#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <exception>

namespace lensplane {
namespace {

/// What became of a frame. Failures travel as values: an exception that left a stage would silently cut short
/// the loops of the frame beside it.
struct FrameResult {
  FrameReport report;
  std::exception_ptr failure;
};

}  // namespace

std::vector<FrameReport> render_sequence(const Shot& shot, const ColourConfig& colours,
                                         const std::vector<int>& frames, const FrameTasks& tasks,
                                         const SequenceHooks& hooks) {
  ShotAssets assets(shot, colours);
  std::vector<FrameReport> reports;
  std::size_t next = 0;
  std::atomic<bool> failed = false;
  std::exception_ptr first_failure;
  const auto take_frame = [&](tbb::flow_control& flow) {
    if (next == frames.size() || failed || hooks.stop()) {
      flow.stop();
      return 0;
    }
    return frames[next++];
  };
  const auto make_frame = [&](int frame) {
    FrameResult result;
    // Isolated: while a frame waits for its own rows it must not begin another frame on the same thread.
    tbb::this_task_arena::isolate([&] {
      try {
        result.report = render_frame(shot, colours, assets, frame, tasks);
      } catch (...) {
        result.failure = std::current_exception();
        failed = true;
      }
    });
    return result;
  };
  const auto report_frame = [&](const FrameResult& result) {
    if (result.failure) {
      if (!first_failure) first_failure = result.failure;
      return;
    }
    reports.push_back(result.report);
    hooks.frame_done(result.report);
  };
  tbb::parallel_pipeline(
      kFramesAtOnce,
      tbb::make_filter<void, int>(tbb::filter_mode::serial_in_order, take_frame) &
          tbb::make_filter<int, FrameResult>(tbb::filter_mode::parallel, make_frame) &
          tbb::make_filter<FrameResult, void>(tbb::filter_mode::serial_in_order, report_frame));
  if (first_failure) std::rethrow_exception(first_failure);
  return reports;
}

}  // namespace lensplane
