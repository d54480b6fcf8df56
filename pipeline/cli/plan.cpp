// SPDX-License-Identifier: Apache-2.0

#include "pipeline/cli/plan.h"

#include <cstdio>

#include "pipeline/cli/plan_json.h"
#include "pipeline/cli/plan_text.h"
#include "pipeline/shot/shot_scene.h"

namespace lensplane {
namespace {

PlannedFrame planned(const Shot& shot, int frame) {
  const Scene scene = scene_at(shot, frame);
  const TraceSettings settings = trace_at(shot, frame);
  return {frame,
          scene,
          settings,
          plan_trace(scene, settings),
          plate_margins(shot, frame, scene.camera.width * scene.camera.height),
          shutter_sampling(shot, frame)};
}

}  // namespace

void run_plan(const Options& options) {
  const Shot shot = shot_of(options);
  const std::vector<int> frames =
      options.frames.empty() ? std::vector{shot.frames.front()} : frames_of(options, shot);
  std::vector<PlannedFrame> plans;
  for (const int frame : frames) plans.push_back(planned(shot, frame));
  if (options.quiet) return;
  std::string text;
  for (const PlannedFrame& plan : plans) text += (text.empty() ? "" : "\n") + text_from_plan(shot, plan);
  if (options.json) text = json_from_plans(shot, plans);
  std::fputs(text.c_str(), stdout);
}

}  // namespace lensplane
