// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/bent_plate.h"

#include <algorithm>

#include "pipeline/povray/ray_mesh.h"

namespace lensplane {
namespace {

Scene scene_of(const PlatePass& pass) {
  Scene scene;
  scene.camera = pass.facts.camera;
  for (const NamedLens& named : pass.facts.lenses) scene.lenses.push_back(named.lens);
  return scene;
}

std::vector<FilmPosition> films_of(const PlatePass& pass) {
  const Camera& camera = pass.facts.camera;
  std::vector<FilmPosition> films;
  for (int row = 0; row < camera.full_height(); ++row) {
    for (int column = 0; column < camera.full_width(); ++column) {
      films.push_back({column - camera.overscan + pass.in_pixel.x, row - camera.overscan + pass.in_pixel.y});
    }
  }
  return films;
}

void drop_first_row(Picture& picture) {
  picture.pixels.erase(picture.pixels.begin(), picture.pixels.begin() + picture.width);
  --picture.height;
  --picture.display_height;
}

/// What stands before a curtain, premultiplied, from its pictures before a white one and a black one.
Picture before_curtain(const Picture& white, Picture black) {
  for (std::size_t i = 0; i < black.pixels.size(); ++i) {
    float curtain = 0.0F;
    for (std::size_t c = 0; c < 3; ++c) curtain += (white.pixels[i][c] - black.pixels[i][c]) / 3.0F;
    black.pixels[i][3] = std::clamp(1.0F - curtain, 0.0F, 1.0F);
  }
  return black;
}

bool is_all_white(const Picture& picture) {
  return std::all_of(picture.pixels.begin(), picture.pixels.end(),
                     [](const Rgba& p) { return p[0] == 1.0F && p[1] == 1.0F && p[2] == 1.0F; });
}

void lay_under(Picture& over, const Picture& under) {
  for (std::size_t i = 0; i < over.pixels.size(); ++i) {
    const float clear = 1.0F - over.pixels[i][3];
    for (std::size_t c = 0; c < 4; ++c) over.pixels[i][c] += clear * under.pixels[i][c];
  }
}

}  // namespace

/// The scene along these rays; nothing where they have no light.
PovRayPicture BentPlate::trace(const PlatePass& pass, std::span<const OutgoingRay> rays,
                               std::optional<Curtain> curtain) {
  SceneFacts facts = pass.facts;
  facts.kind = PovRayCamera::Mesh;
  facts.curtain = curtain;
  folder_.write("lensplane.inc", camera_include(facts));
  folder_.write("lensplane_rays.inc",
                [&](std::ostream& to) { write_ray_mesh(facts.camera, rays, facts.unit_m, to); });
  PovRayJob job = job_;
  job.antialias = 1;  // its own would ask for the same rays again
  if (povray_.repeats_row) ++job.height;
  PovRayPicture result = render_by_povray(job, hooks_);
  if (povray_.repeats_row) drop_first_row(result.picture);
  const float nothing = curtain ? static_cast<float>(curtain->light) : 0.0F;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (rays[i].lightless) result.picture.pixels[i] = {nothing, nothing, nothing, 0.0F};
  }
  return result;
}

/// The stretch after so many bends, before a curtain. At a perspective camera that needs no mesh.
PovRayPicture BentPlate::look(const PlatePass& pass, std::size_t bends, const Curtain& curtain) {
  if (bends > 0 || pass.facts.camera.projection != Projection::Perspective)
    return trace(pass, rays_after(scene_of(pass), pass.plan, bends, films_of(pass)), curtain);
  SceneFacts facts = pass.facts;
  facts.kind = PovRayCamera::Shot;
  facts.in_pixel = pass.in_pixel;
  facts.curtain = curtain;
  folder_.write("lensplane.inc", camera_include(facts));
  PovRayJob job = job_;
  job.antialias = 1;
  return render_by_povray(job, hooks_);
}

/// What stands on a stretch; nothing when that is nothing.
std::optional<Picture> BentPlate::stretch(const PlatePass& pass, std::size_t bends, double depth_m) {
  if (empty_[bends] || !(depth_m > 0.0)) return std::nullopt;
  const Picture white = look(pass, bends, {depth_m, 1.0}).picture;
  empty_[bends] = is_all_white(white);
  if (empty_[bends]) return std::nullopt;
  return before_curtain(white, look(pass, bends, {depth_m, 0.0}).picture);
}

PovRayPicture BentPlate::render(const PlatePass& pass) {
  const Scene scene = scene_of(pass);
  const std::vector<double> depths = bend_depths(scene, pass.plan);
  empty_.resize(std::max(empty_.size(), depths.size()), false);
  PovRayPicture result = trace(pass, outgoing_rays(scene, pass.plan, films_of(pass)), {});
  for (std::size_t bends = depths.size(); bends-- > 0;) {
    auto nearer = stretch(pass, bends, depths[bends]);
    if (!nearer) continue;
    lay_under(*nearer, result.picture);
    result.picture = std::move(*nearer);
  }
  return result;
}

}  // namespace lensplane
