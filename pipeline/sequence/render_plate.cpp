// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/render_plate.h"

#include <fmt/format.h>

#include "pipeline/povray/work_folder.h"
#include "pipeline/sequence/bent_plate.h"

namespace lensplane {
PovRayPicture render_plate(const Shot& shot, const PlateTask& task, const PovRay& povray,
                           const PovRayHooks& hooks) {
  const Layer& layer = shot.layers[task.layer];
  const WorkFolder folder(shot.output.directory,
                          fmt::format("{}.{}.povray.{:04}", shot.name, layer.name, task.frame));
  const PovRayJob job{std::filesystem::absolute(layer.povray->scene.text),
                      folder.path(),
                      task.camera.full_width(),
                      task.camera.full_height(),
                      task.antialias,
                      task.clock,
                      layer.povray->timeout_s};
  BentPlate bent(job, folder, povray, hooks);
  const auto render = [&](const PlatePass& pass) {
    if (pass.facts.kind == PovRayCamera::Mesh) return bent.render(pass);
    folder.write("lensplane.inc", camera_include(pass.facts));
    return render_by_povray(job, hooks);
  };
  PovRayPicture mean = render(task.passes.front());
  for (std::size_t n = 1; n < task.passes.size(); ++n) {
    const PovRayPicture next = render(task.passes[n]);
    for (std::size_t i = 0; i < mean.picture.pixels.size(); ++i) {
      for (std::size_t c = 0; c < 4; ++c) mean.picture.pixels[i][c] += next.picture.pixels[i][c];
    }
  }
  if (task.passes.size() == 1) return mean;  // to the last bit
  const float share = 1.0F / static_cast<float>(task.passes.size());
  for (Rgba& pixel : mean.picture.pixels) {
    for (float& channel : pixel) channel *= share;
  }
  return mean;
}

}  // namespace lensplane
