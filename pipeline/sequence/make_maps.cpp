// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/make_maps.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <span>

#include "pipeline/composite/sample_pattern.h"
#include "pipeline/image/exr_writer.h"
#include "pipeline/sequence/output_paths.h"
#include "pipeline/shot/shot_scene.h"
#include "src/bodies.h"
#include "src/map_bands.h"
#include "src/map_channels.h"

namespace lensplane {
namespace {

constexpr ExrFormat kFormat = {PixelType::Float, ExrCompression::Zip};

/// The channels of a map from sample `first` on.
std::vector<ExrChannel> map_channels(const LensMap& map, std::size_t first) {
  return {{"R", &map.s[first]}, {"G", &map.t[first]}, {"B", &map.valid[first]}};
}

std::vector<ExrChannel> data_channels(const LensMap& map, std::size_t first) {
  std::vector<ExrChannel> channels;
  for (const Pass& pass : map.passes) channels.push_back({std::string(pass.channel), &pass.values[first]});
  return channels;
}

/// The same without a shadow that only the shadow's own file asks for.
std::vector<ExrChannel> data_channels_but_shadow(const LensMap& map, std::size_t first) {
  std::vector<ExrChannel> channels = data_channels(map, first);
  std::erase_if(channels, [](const ExrChannel& channel) { return channel.name == kShadowChannel; });
  return channels;
}

/// White where light ends, premultiplied: a picture for any program.
std::vector<ExrChannel> shadow_channels(const LensMap& map, std::size_t first) {
  std::vector<ExrChannel> channels;
  for (const char* name : {"R", "G", "B", "A"})
    channels.push_back({name, &pass_of(map, kShadowChannel)->values[first]});
  return channels;
}

/// A file in the making.
struct LayerFile {
  std::size_t surface;  // of the maps that are traced
  std::vector<ExrChannel> (*channels)(const LensMap&, std::size_t first);
  std::filesystem::path path;
  const ExrHeader* header;
  std::unique_ptr<ExrFile> file = nullptr;  // opened with the first rows: they say which channels there are

  void write(const MapBands& bands, RowRange rows, const ExrWindow& window) {
    const std::vector<ExrChannel> samples = channels(bands.maps()[surface], bands.first_sample());
    if (!file) {
      std::vector<std::string> names;
      for (const ExrChannel& channel : samples) names.push_back(channel.name);
      file = std::make_unique<ExrFile>(path, window, names, kFormat, *header);
    }
    file->write(samples, rows.end - rows.begin);
  }
};

/// The layers that any file is wanted of, in their order.
std::vector<std::size_t> layers_of(const FrameSetup& setup) {
  std::vector<std::size_t> layers;
  std::set_union(setup.maps.begin(), setup.maps.end(), setup.data.begin(), setup.data.end(),
                 std::back_inserter(layers));
  return layers;
}

std::vector<LayerFile> files_of(const Shot& shot, int frame, const FrameSetup& setup,
                                const std::vector<std::size_t>& layers, std::size_t shadow_surface) {
  std::vector<LayerFile> files;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const std::string& name = shot.layers[layers[i]].name;
    const auto wanted = [&](const std::vector<std::size_t>& list) {
      return std::binary_search(list.begin(), list.end(), layers[i]);
    };
    if (wanted(setup.maps))
      files.push_back({i, map_channels, map_path(shot, name, frame), &setup.map_header});
    if (wanted(setup.data))
      files.push_back({i, shot.output.data.shadow ? data_channels : data_channels_but_shadow,
                       data_path(shot, name, frame), &setup.data_header});
  }
  if (setup.shadow)
    files.push_back({shadow_surface, shadow_channels, shadow_path(shot, frame), &setup.shadow_header});
  return files;
}

std::size_t bytes_per_row(const std::vector<LensMap>& maps) {
  std::size_t bytes = 0;
  for (const LensMap& map : maps)
    bytes += (3 + map.passes.size()) * static_cast<std::size_t>(map.width) * sizeof(float);
  return bytes;
}

/// Whole rows of tiles that fit into a band, given what a row of pixels takes.
int rows_per_band(std::size_t bytes_of_row) {
  constexpr int kTile = TileLevels{}.size;
  constexpr std::size_t kMost = 1024;  // rows of tiles
  return kTile * static_cast<int>(std::clamp<std::size_t>(kBandBytes / (kTile * bytes_of_row), 1, kMost));
}

/// What is to be traced, and how.
struct MapTrace {
  Scene scene;
  Plan plan;
  std::size_t shadow_surface = 0;  // the one that tells where light ends, where that is wanted
};

/// The surfaces of the layers. Bodies hide what light ends behind them: without a surface at infinity that
/// bent light meets, the shadow has a sky of its own.
MapTrace trace_of(const Shot& shot, const FrameSetup& setup, const std::vector<std::size_t>& layers) {
  MapTrace trace{setup.scene, setup.data.empty() ? setup.plan : setup.data_plan};
  std::vector<Surface>& surfaces = trace.scene.surfaces;
  surfaces.clear();
  const auto map_surfaces = map_surfaces_of(shot);
  for (const std::size_t k : layers) surfaces.push_back(setup.scene.surfaces[*map_surfaces[k]]);
  if (shot.lenses.empty()) return trace;
  trace.plan.effects.shadow = true;
  const auto far = std::find_if(surfaces.begin(), surfaces.end(),
                                [](const Surface& s) { return !is_body(s) && !is_bent(s); });
  trace.shadow_surface = static_cast<std::size_t>(far - surfaces.begin());
  if (setup.shadow && far == surfaces.end()) surfaces.push_back(LatLong{});
  return trace;
}

}  // namespace

EmptySpace make_maps(const Shot& shot, int frame, const FrameSetup& setup, FrameReport& report) {
  const std::vector<std::size_t> layers = layers_of(setup);
  const MapTrace trace = trace_of(shot, setup, layers);
  const Tracer tracer(trace.scene, trace.plan);
  const Camera& camera = setup.scene.camera;
  const ExrWindow window{camera.width, camera.height, camera.overscan};
  std::vector<LayerFile> files = files_of(shot, frame, setup, layers, trace.shadow_surface);

  PhaseCost& tracing = report[Phase::Trace];
  PhaseCost& writing = report[Phase::Write];
  const int height = camera.full_height();
  int band = TileLevels{}.size;  // one row of tiles, which says how many fit into a band
  MapBands bands(
      tracer, shot.output.coverage == Coverage::Filtered ? std::optional(coverage_filter()) : std::nullopt);
  const bool all = setup.data.empty() && layers.size() == setup.scene.surfaces.size();
  EmptySpace empty = all ? EmptySpace(camera) : EmptySpace();
  for (int row = 0; row < height;) {
    row = std::min(height, row + band);
    const RowRange rows = timed(tracing.seconds, [&] { return bands.trace_until(row); });
    if (all) empty.learn(std::span(bands.maps()).first(layers.size()), bands.first_sample(), rows);
    timed(writing.seconds, [&] {
      for (LayerFile& file : files) file.write(bands, rows, window);
    });
    tracing.bytes += bytes_per_row(bands.maps()) * static_cast<std::size_t>(rows.end - rows.begin);
    band = rows_per_band(bytes_per_row(bands.maps()));
  }
  timed(writing.seconds, [&] {
    for (LayerFile& file : files) writing.bytes += file.file->commit();
  });
  report.rays += bands.rays();
  report.unresolved += bands.unresolved();
  return empty;
}

}  // namespace lensplane
