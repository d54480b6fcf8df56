// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/plate_task.h"

#include <algorithm>
#include <cmath>

#include "pipeline/sequence/fingerprint.h"
#include "pipeline/sequence/plate_margins.h"
#include "pipeline/sequence/shutter.h"
#include "pipeline/shot/shot_scene.h"
#include "src/constants.h"
#include "src/outgoing_rays.h"

namespace lensplane {
namespace {

/// The widest lat-long that nobody has asked for.
constexpr int kWidestAutomatic = 4096;

double time_of(const Shot& shot, double frame) {
  return (frame - shot.frames.front()) * shot.fps.denominator / shot.fps.numerator;
}

double clock_of(const Shot& shot, int frame) {
  const auto [first, last] = std::minmax_element(shot.frames.begin(), shot.frames.end());
  return *first == *last ? 0.0 : static_cast<double>(frame - *first) / (*last - *first);
}

SceneFacts facts_at(const Shot& shot, const PovRayScene& povray, int frame, double time) {
  const Scene scene = scene_at(shot, time);
  SceneFacts facts;
  facts.camera = scene.camera;
  facts.unit_m = povray.unit_m;
  facts.frame = frame;
  facts.time_s = time_of(shot, time);
  for (std::size_t i = 0; i < scene.lenses.size(); ++i)
    facts.lenses.push_back({shot.lenses[i].name, scene.lenses[i]});
  return facts;
}

/// A lat-long as fine as the camera sees.
int automatic_width(const Camera& camera) {
  const double pixels = 2.0 * kPi / pixel_angle(camera);
  return pixels < kWidestAutomatic ? std::max(2, static_cast<int>(std::ceil(pixels / 2.0)) * 2)
                                   : kWidestAutomatic;
}

/// How light is followed to whatever the scene may hold.
Plan plan_of_rays(const Shot& shot, double time) {
  Scene scene = scene_at(shot, time);
  scene.surfaces = {LatLong{}};
  TraceSettings settings = trace_at(shot, time);
  settings.effects = {};
  return plan_trace(scene, settings);
}

/// Nothing bends the light, and POV-Ray has the very camera: its own is exact, and finds edges.
bool camera_serves(const SceneFacts& facts, const Plan& plan) {
  Scene scene;
  scene.camera = facts.camera;
  for (const NamedLens& named : facts.lenses) scene.lenses.push_back(named.lens);
  const bool has_camera = facts.camera.projection != Projection::LatLong || facts.camera.overscan == 0;
  return has_camera && !bends_light(scene, plan);
}

/// The passes of bent rays: n x n places in a pixel, spread over the moments while the shutter is open.
std::vector<PlatePass> bent_passes(const Shot& shot, const PovRayScene& povray, int frame) {
  const std::vector<Moment> moments = moments_of(shot, frame);
  const std::size_t n = static_cast<std::size_t>(povray.antialias), places = n * n;
  const std::size_t each = (places + moments.size() - 1) / moments.size();
  std::vector<PlatePass> passes;
  for (std::size_t m = 0; m < moments.size(); ++m) {
    PlatePass pass{facts_at(shot, povray, frame, moments[m].time), plan_of_rays(shot, moments[m].time)};
    const bool straight = camera_serves(pass.facts, pass.plan);
    pass.facts.kind = straight ? PovRayCamera::Shot : PovRayCamera::Mesh;
    pass.plan.tiles.level.clear();  // all rays through the same planes
    for (std::size_t i = 0; i < each; ++i) {
      const std::size_t place = (m * each + i) % places;
      pass.in_pixel = {(static_cast<double>(place % n) + 0.5) / static_cast<double>(n),
                       (static_cast<double>(place / n) + 0.5) / static_cast<double>(n)};
      passes.push_back(pass);
      if (straight && moments.size() == 1) break;  // once, with POV-Ray's own antialiasing
    }
  }
  return passes;
}

void add_pass(const PlatePass& pass, const SceneFiles& files, Fingerprint& print) {
  print.add(camera_declaration(pass.facts));
  for (const Declaration& declaration : declarations(pass.facts)) {
    if (!files.complete || files.says(declaration.name)) print.add(declaration.line);
  }
  if (pass.facts.kind != PovRayCamera::Mesh) return;
  Scene scene;
  scene.camera = pass.facts.camera;
  for (const NamedLens& named : pass.facts.lenses) scene.lenses.push_back(named.lens);
  print.add(fingerprint_of_trace(scene, pass.plan).digest());
  print.add(pass.facts.unit_m).add(pass.in_pixel.x).add(pass.in_pixel.y);
}

std::string digest_of(const PlateTask& task, const SceneFiles& files, const PovRay& povray) {
  Fingerprint print;
  print.add("plate").add(povray.version);
  for (const auto& file : files.files) print.add_file(file);
  print.add(task.camera.width).add(task.camera.height).add(task.camera.overscan).add(task.antialias);
  if (!files.complete || files.says("clock")) print.add(task.clock);
  for (const PlatePass& pass : task.passes) add_pass(pass, files, print);
  return print.digest();
}

}  // namespace

PlateTask plate_task(const Shot& shot, std::size_t layer, int frame, const SceneFiles& files,
                     const PovRay& povray) {
  const PovRayScene& scene = *shot.layers[layer].povray;
  PlateTask task{layer, frame, {}, scene.antialias, clock_of(shot, frame), {}, {}};
  if (scene.as == PovRayAs::Bent) {
    task.passes = bent_passes(shot, scene, frame);
  } else {
    task.passes = {{facts_at(shot, scene, frame, frame), {}}};
    Camera& camera = task.passes.front().facts.camera;
    camera.overscan = scene.as == PovRayAs::Plate ? needed_overscan(shot, layer, frame) : 0;
  }
  task.camera = task.passes.front().facts.camera;
  if (scene.as == PovRayAs::LatLong) {
    task.passes.front().facts.kind = PovRayCamera::Around;
    task.camera.width = scene.width.value_or(automatic_width(task.camera));
    task.camera.height = task.camera.width / 2;
  }
  task.digest = digest_of(task, files, povray);
  return task;
}

}  // namespace lensplane
