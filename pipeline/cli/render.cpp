// SPDX-License-Identifier: Apache-2.0

#include "pipeline/cli/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "pipeline/cli/threads.h"
#include "pipeline/image/atomic_file.h"
#include "pipeline/image/failure.h"
#include "pipeline/image/image_library.h"
#include "pipeline/sequence/image_rates.h"
#include "pipeline/sequence/make_plates.h"
#include "pipeline/sequence/overwriting.h"
#include "pipeline/sequence/plate_margins.h"
#include "pipeline/sequence/progress.h"
#include "pipeline/sequence/render_sequence.h"
#include "pipeline/sequence/shot_colours.h"
#include "pipeline/sequence/shutter.h"
#include "pipeline/sequence/statistics.h"

namespace lensplane {
namespace {

void write_statistics(const Options& options, const Shot& shot, int threads, double seconds,
                      const std::vector<FrameReport>& reports) {
  if (options.stats.empty()) return;
  const std::string json = json_from_reports(shot.name, threads, seconds, reports);
  write_atomically(options.stats, json);
}

void render_plates(const Shot& shot, const std::vector<int>& frames, bool redo,
                   const std::function<bool()>& interrupted, const Progress& progress) {
  const auto made = [&](const PlateReport& report) {
    progress.say(line_of(report));
    for (const std::string& warning : report.warnings)
      progress.say(fmt::format("{:04}: {}: POV-Ray says: {}", report.frame, report.layer, warning));
  };
  make_plates(shot, frames, redo,
              {made, [&](const std::string& doing) { progress.show(doing); }, interrupted});
}

}  // namespace

void run_render(const Options& options, const std::function<bool()>& interrupted) {
  const Shot shot = shot_of(options);
  const std::vector<int> frames = frames_of(options, shot);
  const auto& maps = shot.output.maps;
  if (options.command == Command::Map && std::find(maps.begin(), maps.end(), true) == maps.end()) {
    throw Failure(ExitCode::BadShot,
                  shot.file + ": output.maps: none: there is nothing to do for lensplane map");
  }
  refuse_overwriting(shot, frames, options.stats);
  const Threads threads(options.threads);
  std::future<void> images;
  if (options.command != Command::Map) images = begin_to_load_image_library();

  const ColourConfig colours = load_colours(shot, std::getenv("OCIO"));
  const FrameTasks tasks{.maps = options.command != Command::Comp,
                         .picture = options.command != Command::Map,
                         .redo = options.redo,
                         .from_maps = options.command == Command::Comp};
  if (!options.quiet) {
    for (const std::string& line : other_rates(shot, frames)) std::fputs((line + "\n").c_str(), stdout);
    const auto strobing = tasks.picture && !tasks.from_maps ? worst_strobing(shot, frames) : std::nullopt;
    if (strobing) std::fputs((line_of(*strobing) + "\n").c_str(), stdout);
    for (const PlateMargin& margin : worst_margins(shot, frames)) {
      std::fputs((line_of(margin) + "\n").c_str(), stdout);
    }
  }
  double seconds = 0;
  std::vector<FrameReport> reports;
  {
    Progress progress(frames.size(), options.quiet);
    if (tasks.picture) render_plates(shot, frames, options.redo, interrupted, progress);
    reports = timed(seconds, [&] {
      return render_sequence(
          shot, colours, frames, tasks,
          {[&progress](const FrameReport& report) { progress.frame_done(report); }, interrupted});
    });
  }
  write_statistics(options, shot, threads.count(), seconds, reports);
  if (reports.size() < frames.size()) {
    throw Failure(
        ExitCode::TryAgain,
        fmt::format("lensplane: interrupted with {} of {} frames done; the same command goes on from there",
                    reports.size(), frames.size()));
  }
  if (!options.quiet) {
    std::fputs(fmt::format("{} {} in {}\n", frames.size(), frames.size() == 1 ? "frame" : "frames",
                           shot.output.directory.string())
                   .c_str(),
               stdout);
  }
}

}  // namespace lensplane
