// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/star_store.h"

#include <cmath>
#include <cstring>

#include "pipeline/image/shipped.h"
#include "pipeline/sequence/located_in_shot.h"

namespace lensplane {
namespace {

/// The colours as a picture of one row, which colour management can convert.
EncodedImage row_from_light(const std::vector<Rgb>& light) {
  EncodedImage row;
  row.width = row.display_width = static_cast<int>(light.size());
  row.height = row.display_height = 1;
  row.samples.resize(light.size() * sizeof(Rgba));
  for (std::size_t i = 0; i < light.size(); ++i) {
    const Rgba pixel{static_cast<float>(light[i][0]), static_cast<float>(light[i][1]),
                     static_cast<float>(light[i][2]), 1.0F};
    std::memcpy(&row.samples[i * sizeof(Rgba)], &pixel, sizeof pixel);
  }
  return row;
}

std::vector<Rgb> light_from_row(const Picture& row) {
  std::vector<Rgb> light;
  for (const Rgba& pixel : row.pixels) light.push_back({pixel[0], pixel[1], pixel[2]});
  return light;
}

StarField turned(const std::vector<Star>& stars, const std::vector<Rgb>& light, const Vec3& rotation,
                 double exposure) {
  const Basis axes = basis_from_zxy(rotation);
  std::vector<Vec3> directions;
  for (const Star& star : stars) directions.push_back(axes.parent_from_local(star.direction));
  std::vector<Rgb> exposed = light;
  const double gain = std::exp2(exposure);
  for (Rgb& colour : exposed) {
    for (double& channel : colour) channel *= gain;
  }
  return {DirectionIndex(std::move(directions)), std::move(exposed)};
}

}  // namespace

StarStore::Kept StarStore::read(const StarsLayer& layer) const {
  return located_in_shot(layer.catalogue, [&] {
    Kept kept;
    kept.stars = read_star_catalogue(resolve_shipped(layer.catalogue.text));
    const std::vector<Rgb> light = star_light(kept.stars);
    const std::string acescg = colours_.space_of_file(layer.catalogue.text, "lin_ap1_scene");
    kept.light =
        light_from_row(colours_.to_working(row_from_light(light), {acescg, {}}, shot_.colour.working.text));
    return kept;
  });
}

std::shared_ptr<const StarField> StarStore::field(std::size_t layer, double time) {
  const auto& stars = std::get<StarsLayer>(shot_.layers[layer].kind);
  const Vec3 rotation = value_at(stars.rotation, time);
  const double exposure = value_at(stars.exposure, time);
  const std::lock_guard lock(mutex_);
  auto found = kept_.find(layer);
  if (found == kept_.end()) found = kept_.emplace(layer, read(stars)).first;
  Kept& kept = found->second;
  if (!kept.field || kept.rotation != rotation || kept.exposure != exposure) {
    kept.rotation = rotation;
    kept.exposure = exposure;
    kept.field = std::make_shared<const StarField>(turned(kept.stars, kept.light, rotation, exposure));
  }
  return kept.field;
}

}  // namespace lensplane
