// SPDX-License-Identifier: Apache-2.0

#include "pipeline/povray/camera_include.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/constants.h"
#include "src/projection.h"

namespace lensplane {
namespace {

std::string perspective(const SceneFacts& facts) {
  const Camera& camera = facts.camera;
  const double slope = slope_per_pixel(camera);
  return fmt::format("perspective location {} direction {} right {} up {}",
                     povray_vector(camera.position, facts.unit_m),
                     povray_vector(camera.axes.x * (slope * (facts.in_pixel.x - 0.5)) -
                                   camera.axes.y * (slope * (facts.in_pixel.y - 0.5)) - camera.axes.z),
                     povray_vector(camera.axes.x * (slope * camera.full_width())),
                     povray_vector(camera.axes.y * (slope * camera.full_height())));
}

std::string around(const SceneFacts& facts, const Basis& axes) {
  return fmt::format("spherical angle 360 180 location {} direction {} right {} up {}",
                     povray_vector(facts.camera.position, facts.unit_m), povray_vector(-axes.z),
                     povray_vector(axes.x), povray_vector(axes.y));
}

/// POV-Ray's fisheye fills the circle in which (x |right|)^2 + (y |up|)^2 <= 1, x and y being 1 at the edges.
/// With overscan it is wider, as far as that goes.
std::string fisheye(const SceneFacts& facts) {
  const Camera& camera = facts.camera;
  const double least = std::min(camera.width, camera.height);
  const double size = std::min(least + 2.0 * camera.overscan, least * 2.0 * kPi / camera.fov_rad);
  return fmt::format("fisheye angle {:.17g} location {} direction {} right {} up {}",
                     std::min(360.0, camera.fov_rad * (size / least) * (180.0 / kPi)),
                     povray_vector(camera.position, facts.unit_m), povray_vector(-camera.axes.z),
                     povray_vector(camera.axes.x * (camera.full_width() / size)),
                     povray_vector(camera.axes.y * (camera.full_height() / size)));
}

std::string view(const SceneFacts& facts) {
  if (facts.kind == PovRayCamera::Around) return around(facts, Basis());
  if (facts.kind == PovRayCamera::Mesh)
    return "mesh_camera { 1 0 mesh { lensplane_rays } } direction <0, 0, -1>";
  switch (facts.camera.projection) {
    case Projection::Perspective:
      return perspective(facts);
    case Projection::LatLong:
      return around(facts, facts.camera.axes);
    case Projection::Fisheye:
      return fisheye(facts);
  }
  return {};
}

/// What may stand in a name of POV-Ray's.
std::string identifier(std::string name) {
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

void declare(std::vector<Declaration>& list, const std::string& name, const std::string& value) {
  list.push_back({name, fmt::format("#declare {} = {};\n", name, value)});
}

void declare_lenses(const SceneFacts& facts, std::vector<Declaration>& list) {
  std::string positions, radii;
  declare(list, "lensplane_lens_count", fmt::format("{}", facts.lenses.size()));
  for (const NamedLens& named : facts.lenses) {
    const std::string position = povray_vector(named.lens.position, facts.unit_m);
    const std::string radius = fmt::format("{:.17g}", 2.0 * named.lens.m / facts.unit_m);
    declare(list, "lensplane_position_of_" + identifier(named.name), position);
    declare(list, "lensplane_radius_of_" + identifier(named.name), radius);
    positions += (positions.empty() ? "" : ", ") + position;
    radii += (radii.empty() ? "" : ", ") + radius;
  }
  if (facts.lenses.empty()) return;  // POV-Ray has no empty arrays
  declare(list, "lensplane_lens_position", fmt::format("array[{}] {{ {} }}", facts.lenses.size(), positions));
  declare(list, "lensplane_lens_radius", fmt::format("array[{}] {{ {} }}", facts.lenses.size(), radii));
}

std::string curtain_declaration(const SceneFacts& facts) {
  if (!facts.curtain) return {};
  const Camera& camera = facts.camera;
  const Vec3 middle = camera.position - camera.axes.z * facts.curtain->depth_m;
  return fmt::format(
      "plane {{ {}, 0 translate {} hollow no_shadow no_reflection no_radiosity photons {{ pass_through "
      "collect off }}\n"
      "  pigment {{ rgb {:g} }} finish {{ ambient 0 diffuse 0 emission 1 }} }}\n",
      povray_vector(-camera.axes.z), povray_vector(middle, facts.unit_m), facts.curtain->light);
}

}  // namespace

std::string povray_vector(const Vec3& world, double unit_m) {
  const Vec3 v = world / unit_m + Vec3(0);  // + 0: no negative zeros
  return fmt::format("<{:.17g}, {:.17g}, {:.17g}>", v.x, v.y, 0.0 - v.z);
}

std::vector<Declaration> declarations(const SceneFacts& facts) {
  std::vector<Declaration> list;
  declare(list, "lensplane_frame", fmt::format("{}", facts.frame));
  declare(list, "lensplane_time", fmt::format("{:.17g}", facts.time_s));
  declare(list, "lensplane_unit", fmt::format("{:.17g}", facts.unit_m));
  declare(list, "lensplane_camera_position", povray_vector(facts.camera.position, facts.unit_m));
  declare(list, "lensplane_camera_direction", povray_vector(-facts.camera.axes.z));
  declare(list, "lensplane_camera_right", povray_vector(facts.camera.axes.x));
  declare(list, "lensplane_camera_up", povray_vector(facts.camera.axes.y));
  declare_lenses(facts, list);
  return list;
}

std::string camera_declaration(const SceneFacts& facts) {
  const std::string rays = facts.kind == PovRayCamera::Mesh ? "#include \"lensplane_rays.inc\"\n" : "";
  return fmt::format("{}#declare lensplane_camera = camera {{ {} }}\n", rays, view(facts));
}

std::string camera_include(const SceneFacts& facts) {
  std::string text = "// The camera and the masses of a shot, written by lensplane for one frame.\n";
  for (const Declaration& declaration : declarations(facts)) text += declaration.line;
  return text + camera_declaration(facts) + curtain_declaration(facts);
}

}  // namespace lensplane
