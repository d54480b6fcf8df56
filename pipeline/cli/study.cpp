// SPDX-License-Identifier: Apache-2.0

#include "pipeline/cli/study.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>

#include "pipeline/cli/study_text.h"
#include "pipeline/cli/threads.h"
#include "pipeline/image/atomic_file.h"
#include "pipeline/image/failure.h"
#include "pipeline/sequence/progress.h"
#include "pipeline/sequence/shot_colours.h"
#include "pipeline/study/run_study.h"
#include "pipeline/study/study_files.h"

namespace lensplane {
namespace {

int frame_of(const Options& options, const Shot& shot) {
  const std::vector<int> frames = frames_of(options, shot);
  if (options.frames.empty() || frames.size() == 1) return frames.front();
  throw Failure(ExitCode::BadShot, fmt::format("-f: {} frames; a study takes one", frames.size()));
}

}  // namespace

void run_study_command(const Options& options, const std::function<bool()>& interrupted) {
  const Shot shot = shot_of(options);
  const int frame = frame_of(options, shot);
  const std::filesystem::path folder = study_folder(shot, frame);
  // Whether it can be written shows before minutes of work, not after them.
  { const AtomicFile writable(folder / "study.csv"); }
  const Threads threads(options.threads);
  const ColourConfig colours = load_colours(shot, std::getenv("OCIO"));
  Study study;
  {
    const Progress progress(1, options.quiet);
    study = run_study(shot, colours, frame, threads.count(), {},
                      {[&](const std::string& doing) { progress.show(doing); }, interrupted});
  }
  if (!options.quiet) std::fputs(text_from_study(study).c_str(), stdout);
  write_study(folder, study);
  if (!options.quiet) std::fputs(((folder / "study.html").string() + "\n").c_str(), stdout);
  require_bounds(study);
  if (study.interrupted)
    throw Failure(ExitCode::TryAgain, "lensplane: interrupted; what was done is in " + folder.string());
}

}  // namespace lensplane
