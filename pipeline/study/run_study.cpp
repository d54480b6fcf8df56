// SPDX-License-Identifier: Apache-2.0

#include "pipeline/study/run_study.h"

#include <fmt/format.h>

#include <fstream>
#include <new>

#include "pipeline/image/failure.h"
#include "pipeline/sequence/shot_assets.h"
#include "pipeline/study/advice.h"
#include "pipeline/study/effect_prices.h"
#include "pipeline/study/picture_study.h"
#include "pipeline/study/trace_study.h"

namespace lensplane {
namespace {

/// The processor's name, where the system tells.
std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "a processor without a name";
}

/// Images may be missing, and a picture too large for memory: traces are of use without them.
template <class Work>
void note_what_fails(const char* what, Study& study, Work work) {
  try {
    work();
  } catch (const Failure& failure) {
    study.notes.push_back(fmt::format("{}: {}", what, failure.what()));
  } catch (const std::bad_alloc&) {
    study.notes.push_back(fmt::format("{}: out of memory", what));
  }
}

void add_pictures(const Shot& shot, const ColourConfig& colours, int frame, const StudyEffort& effort,
                  const StudyHooks& hooks, Study& study) {
  const double guess_s = guess_picture_s(shot, frame, effort);
  if (guess_s > effort.pictures_s) {
    study.notes.push_back(fmt::format("pictures are left out: the rays of one take about {:.0f} s", guess_s));
    return;
  }
  ShotAssets assets(shot, colours);
  note_what_fails("pictures are left out", study,
                  [&] { study_pictures(shot, assets, frame, effort, hooks, study); });
  if (study.interrupted) return;
  note_what_fails("prices of the picture are left out", study,
                  [&] { price_pictures(shot, colours, assets, frame, effort, hooks, study); });
}

}  // namespace

Study run_study(const Shot& shot, const ColourConfig& colours, int frame, int threads,
                const StudyEffort& effort, const StudyHooks& hooks) {
  Study study;
  study.shot = shot.name;
  study.frame = frame;
  study.threads = threads;
  study.processor = processor_name();
  study_traces(shot, frame, effort, hooks, study);
  if (!study.interrupted) price_traces(shot, frame, effort, hooks, study);
  if (!study.interrupted) add_pictures(shot, colours, frame, effort, hooks, study);
  mark_pareto(study);
  study.advice = advice_of(study);
  return study;
}

void require_bounds(const Study& study) {
  std::string violations;
  for (const TraceRow& row : study.traces) {
    if (!row.violated) continue;
    violations +=
        fmt::format("{}{} leaves out {} px where it says at most {} px{}", violations.empty() ? "" : "; ",
                    name_of(row.rung.settings), row.left_out.most_px, *row.bound_px,
                    row.left_out.captured_differs > 0 ? ", and captures other light" : "");
  }
  if (!violations.empty()) throw Failure(ExitCode::BadShot, "lensplane: a bound is violated: " + violations);
}

}  // namespace lensplane
