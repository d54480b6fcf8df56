// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/frame_looks.h"

#include <cmath>

#include "pipeline/shot/shot_scene.h"

namespace lensplane {

std::vector<SurfaceLook> looks_at(const Shot& shot, const Scene& scene, TextureStore& textures, int frame,
                                  double time) {
  std::vector<SurfaceLook> looks;
  const std::vector<LayerSurface> surfaces = surfaces_of(shot);
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    const std::size_t layer = surfaces[k].layer;
    SurfaceLook look{textures.texture(layer, frame)};
    if (const auto light = light_at(shot.layers[layer], time)) {
      look.light = std::get<Sphere>(scene.surfaces[k]).axes.local_from_parent(*light);
      look.sun = sun_at(shot.layers[layer], time);
      look.night = textures.night(layer, frame);
    }
    if (const auto shadow = shadow_at(shot, layer, time)) {
      const auto& ring = std::get<Ring>(scene.surfaces[k]);
      look.light = ring.axes.local_from_parent(shadow->light);
      look.sun = shadow->sun;
      look.caster = ShadowCaster{ring.axes.local_from_parent(shadow->sphere.centre - ring.centre),
                                 shadow->sphere.radius};
    }
    look.gain = static_cast<float>(std::exp2(value_at(shot.layers[layer].exposure, time)));
    looks.push_back(std::move(look));
  }
  return looks;
}

}  // namespace lensplane
