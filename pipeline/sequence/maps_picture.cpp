// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/maps_picture.h"

#include <algorithm>
#include <cmath>

#include "pipeline/composite/map_composite.h"
#include "pipeline/composite/star_drawing.h"
#include "pipeline/sequence/map_layers.h"
#include "pipeline/shot/shot_scene.h"

namespace lensplane {
namespace {

/// How much of the light from infinity a picture lets through at a film position.
float clearness_at(const Picture& cover, FilmPosition film) {
  const int column = std::clamp(static_cast<int>(std::floor(film.x)) - cover.x, 0, cover.width - 1);
  const int row = std::clamp(static_cast<int>(std::floor(film.y)) - cover.y, 0, cover.height - 1);
  return std::max(0.0F, 1.0F - cover.at(column, row)[3]);
}

void add_stars_to_maps(const Shot& shot, ShotAssets& assets, int frame, const Tracer& tracer,
                       const Picture& cover, Picture& picture) {
  const PointSpread spread;
  for (std::size_t k = 0; k < shot.layers.size(); ++k) {
    if (!std::holds_alternative<StarsLayer>(shot.layers[k].kind)) continue;
    std::vector<StarImage> images = find_star_images(tracer, *assets.stars.field(k, frame),
                                                     {.margin_px = spread.reach_px(tracer.camera())});
    for (StarImage& image : images) {
      for (double& channel : image.light) channel *= clearness_at(cover, image.film);
    }
    draw_stars(images, spread, tracer.camera(), picture);
  }
}

}  // namespace

ShadowedPicture picture_from_maps(const Shot& shot, ShotAssets& assets, int frame, const FrameSetup& setup,
                                  const std::vector<SurfaceLook>& looks, FrameReport& report) {
  std::vector<float> shadow;
  std::vector<MapLayer> layers = timed(report[Phase::Load].seconds, [&] {
    std::vector<MapLayer> loaded = load_map_layers(shot, setup.scene, looks, frame);
    shadow = load_shadow(shot, loaded, frame);
    return loaded;
  });
  return timed(report[Phase::Composite].seconds, [&] {
    ShadowedPicture result{blank_picture(setup.scene.camera), std::move(shadow)};
    Picture& picture = result.picture;
    if (!layers.empty()) picture = composite_from_maps(layers);
    result.shadow.resize(picture.pixels.size(), 0.0F);
    for (std::size_t i = 0; i < result.shadow.size(); ++i)
      result.shadow[i] = std::min(result.shadow[i], std::max(0.0F, 1.0F - picture.pixels[i][3]));
    if (!has_stars(shot)) return result;
    std::erase_if(layers, [](const MapLayer& l) { return std::holds_alternative<LatLong>(l.surface); });
    Picture cover = blank_picture(setup.scene.camera);
    if (!layers.empty()) cover = composite_from_maps(layers);
    add_stars_to_maps(shot, assets, frame, Tracer(setup.scene, setup.plan), cover, picture);
    return result;
  });
}

}  // namespace lensplane
