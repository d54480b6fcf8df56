// SPDX-License-Identifier: Apache-2.0

#include "pipeline/cli/probe.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdio>

#include "pipeline/cli/probe_report.h"
#include "pipeline/image/failure.h"
#include "pipeline/shot/location.h"
#include "pipeline/shot/shot_scene.h"

namespace lensplane {
namespace {

double read_coordinate(std::string_view option, const std::string& text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error == std::errc() && stop == end && std::isfinite(value)) return value;
  throw Failure(ExitCode::BadShot,
                fmt::format("{}: {} is not a position on the film; write a number of pixels, like 100.5",
                            option, in_quotes(text)));
}

int read_frame(const Options& options, const Shot& shot) {
  const std::vector<int> frames = frames_of(options, shot);
  if (frames.size() == 1) return frames.front();
  throw Failure(ExitCode::BadShot,
                fmt::format("-f: a probe has one frame, not {}; write -f {}", frames.size(), frames.front()));
}

}  // namespace

void run_probe(const Options& options) {
  const FilmPosition film{read_coordinate("-x", options.x), read_coordinate("-y", options.y)};
  const Shot shot = shot_of(options);
  const int frame = read_frame(options, shot);
  const Scene scene = scene_at(shot, frame);
  const Plan plan = plan_trace(scene, trace_at(shot, frame));
  const ProbedFrame probed{frame, scene.camera, plan, probe(scene, plan, film)};
  if (options.quiet) return;
  const std::string text = options.json ? json_from_probe(shot, probed) : text_from_probe(shot, probed);
  std::fputs(text.c_str(), stdout);
}

}  // namespace lensplane
