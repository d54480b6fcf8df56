// SPDX-License-Identifier: Apache-2.0
//
// The shot as POV-Ray scenes see it: the text of `lensplane.inc`, which declares the camera, the frame, its
// time and where the lenses are.
//
// POV-Ray is left-handed: its z is the world's -z. Lengths are in the scene's own unit.

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "src/projection.h"

namespace lensplane {

/// What POV-Ray's camera is to see.
enum class PovRayCamera { Shot, Around, Mesh };

/// A lens by its name in the shot.
struct NamedLens {
  std::string name;
  Lens lens;
};

/// A wall across the camera's view that only its own rays meet: it neither throws shadows nor is it
/// reflected.
struct Curtain {
  double depth_m = 0;  // along the camera's axis
  double light = 0;    // that it shines with, all over
};

/// What is said to a scene about a frame.
struct SceneFacts {
  PovRayCamera kind = PovRayCamera::Shot;
  Camera camera;        // of the shot; with the overscan that is rendered
  double unit_m = 1.0;  // metres that one unit of the scene is
  int frame = 0;
  double time_s = 0;  // since the shot's first frame
  std::vector<NamedLens> lenses;
  FilmPosition in_pixel{0.5, 0.5};  // where a perspective camera's rays go through their pixels
  std::optional<Curtain> curtain = {};
};

/// One thing that is declared, as a line of POV-Ray's language.
struct Declaration {
  std::string name;
  std::string line;
};

/// A vector in POV-Ray's axes and the scene's unit, with all its digits.
std::string povray_vector(const Vec3& world, double unit_m = 1.0);

/// Everything that is declared but for the camera, each by itself: a scene need not use it all.
std::vector<Declaration> declarations(const SceneFacts& facts);

/// `#declare lensplane_camera`.
///   Shot    what the shot's camera sees, exactly, by its own projection
///   Around  everything around the shot's camera as a lat-long, upright in the world: its middle looks along
///   -z Mesh    the rays of lensplane_rays.inc, see ray_mesh.h
std::string camera_declaration(const SceneFacts& facts);

/// The whole text of lensplane.inc.
std::string camera_include(const SceneFacts& facts);

}  // namespace lensplane
