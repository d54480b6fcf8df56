// SPDX-License-Identifier: Apache-2.0
//
// A picture of bent rays by POV-Ray: every ray goes on from its last bend, in its new direction, through the
// scene.
//
// What stands nearer than that is seen on the straight stretches before: for each plane at which light is
// bent the scene is rendered up to there, before a curtain that is once white and once black. What is
// different between the two is how much of the curtain is seen, which is covered by what comes from behind
// it. A stretch whose white curtain is seen everywhere has nothing on it, and costs one picture.

#pragma once

#include "pipeline/povray/work_folder.h"
#include "pipeline/sequence/plate_task.h"
#include "src/outgoing_rays.h"

namespace lensplane {

/// Renders passes of bent rays, one after another.
class BentPlate {
 public:
  /// `job` says size, scene and folder; everything has to outlive this.
  BentPlate(const PovRayJob& job, const WorkFolder& folder, const PovRay& povray, const PovRayHooks& hooks)
      : job_(job), folder_(folder), povray_(povray), hooks_(hooks) {}

  /// Premultiplied; transparent black where light ends in a mass before it meets anything.
  PovRayPicture render(const PlatePass& pass);

 private:
  PovRayPicture trace(const PlatePass& pass, std::span<const OutgoingRay> rays,
                      std::optional<Curtain> curtain);
  PovRayPicture look(const PlatePass& pass, std::size_t bends, const Curtain& curtain);
  std::optional<Picture> stretch(const PlatePass& pass, std::size_t bends, double depth_m);

  const PovRayJob& job_;
  const WorkFolder& folder_;
  const PovRay& povray_;
  const PovRayHooks& hooks_;
  std::vector<bool> empty_;  // stretches that are known to have nothing on them
};

}  // namespace lensplane
