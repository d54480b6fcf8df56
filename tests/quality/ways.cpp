// SPDX-License-Identifier: Apache-2.0

#include "tests/quality/ways.h"

#include <limits>

#include "pipeline/composite/compositor.h"
#include "pipeline/composite/map_composite.h"
#include "pipeline/composite/map_jacobian.h"
#include "pipeline/composite/sample_pattern.h"
#include "pipeline/sequence/map_layers.h"
#include "src/map_bands.h"
#include "tests/quality/peer_area_filter.h"
#include "tests/quality/peer_st_warp.h"
#include "tests/quality/peer_supersampling.h"

namespace lensplane {
namespace {

std::vector<float> pass(const LensMap& map, std::string_view channel) {
  for (const Pass& pass : map.passes) {
    if (pass.channel == channel) return {pass.values.begin(), pass.values.end()};
  }
  return {};
}

StMap st_map(const LensMap& map) {
  return {{map.width, map.height, 0, 0, map.width, map.height},
          false,
          {map.s.begin(), map.s.end()},
          {map.t.begin(), map.t.end()},
          {map.valid.begin(), map.valid.end()}};
}

MapJacobian jacobian_of(const LensMap& map) {
  return {pass(map, "jacobian.ds_dx"), pass(map, "jacobian.ds_dy"), pass(map, "jacobian.dt_dx"),
          pass(map, "jacobian.dt_dy")};
}

MapLayer map_layer(const LensMap& map, const Seen& seen) {
  MapLayer layer;
  layer.map = st_map(map);
  layer.look = seen.look;
  const bool globe = seen.edge == Wrap::Globe;
  layer.footprints = footprints_from_jacobian(layer.map, jacobian_of(map),
                                              {seen.picture.width, seen.picture.height, globe, false});
  return layer;
}

void lay_over(const Picture& over, Picture& under) {
  for (std::size_t i = 0; i < under.pixels.size(); ++i) {
    const float clear = 1 - over.pixels[i][3];
    for (std::size_t c = 0; c < 4; ++c) under.pixels[i][c] = over.pixels[i][c] + clear * under.pixels[i][c];
  }
}

/// `make(map, surface)` of every layer, over one another.
template <class Make>
Picture layered(const std::vector<LensMap>& maps, const std::vector<Seen>& surfaces, Make make) {
  Picture picture = make(maps[0], surfaces[0]);
  for (std::size_t k = 1; k < maps.size(); ++k) lay_over(make(maps[k], surfaces[k]), picture);
  return picture;
}

}  // namespace

Seen seen(Picture picture, Wrap edge) {
  SurfaceLook look{std::make_shared<const Texture>(picture, edge), {}, {}, {}};
  return {std::move(look), std::move(picture), edge};
}

std::vector<SurfaceLook> looks_of(const std::vector<Seen>& surfaces) {
  std::vector<SurfaceLook> looks;
  for (const Seen& surface : surfaces) looks.push_back(surface.look);
  return looks;
}

Tracer tracer_of(const Scene& scene) {
  TraceSettings settings;
  settings.effects.jacobian = true;
  settings.effects.magnification = true;
  settings.effects.depth = true;
  return {scene, plan_trace(scene, settings)};
}

std::vector<LensMap> maps_of(const Tracer& tracer) {
  MapBands bands(tracer, coverage_filter());
  bands.trace_until(tracer.camera().full_height());
  return bands.maps();
}

Picture by_comp(const Tracer& tracer, const std::vector<LensMap>& maps, const std::vector<Seen>& surfaces) {
  std::vector<MapLayer> layers;
  for (std::size_t k = 0; k < maps.size(); ++k) {
    MapLayer layer = map_layer(maps[k], surfaces[k]);
    layer.surface = tracer.surfaces()[k];
    layer.distance = distance_of(layer.surface, Vec3(0));
    layer.depth = pass(maps[k], "depth.z");
    layers.push_back(std::move(layer));
  }
  return composite_from_maps(layers);
}

Picture by_warp(const std::vector<LensMap>& maps, const std::vector<Seen>& surfaces) {
  return layered(maps, surfaces, [](const LensMap& map, const Seen& seen) {
    std::vector<MapLayer> layers = {map_layer(map, seen)};
    layers[0].distance = std::numeric_limits<double>::infinity();
    return composite_from_maps(layers);
  });
}

Frame make_frame(const Scene& scene, const std::vector<Seen>& surfaces, int rays) {
  const Tracer tracer = tracer_of(scene);
  const std::vector<SurfaceLook> looks = looks_of(surfaces);
  Frame frame;
  frame.maps = maps_of(tracer);
  frame.truth = true_picture(tracer, looks, rays);
  frame.render = composite(tracer, looks, {}).picture;
  frame.comp = by_comp(tracer, frame.maps, surfaces);
  frame.warp = by_warp(frame.maps, surfaces);
  for (const char* filter : {"", "triangle"}) {
    frame.st_warp.push_back(layered(frame.maps, surfaces, [&](const LensMap& map, const Seen& seen) {
      return warped_by_oiio(map, seen.picture, seen.edge, filter);
    }));
  }
  frame.area = layered(frame.maps, surfaces, [](const LensMap& map, const Seen& seen) {
    return warped_by_area(map, seen.picture, seen.edge);
  });
  frame.supersampled = layered(frame.maps, surfaces, [](const LensMap& map, const Seen& seen) {
    return warped_by_supersampling(map, seen.picture, seen.edge);
  });
  return frame;
}

}  // namespace lensplane
