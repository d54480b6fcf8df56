// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/make_maps.h"

#include <algorithm>
#include <iterator>
#include <memory>

#include "pipeline/composite/sample_pattern.h"
#include "pipeline/image/exr_writer.h"
#include "pipeline/sequence/output_paths.h"
#include "pipeline/shot/shot_scene.h"
#include "src/map_bands.h"

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
                                const std::vector<std::size_t>& layers) {
  std::vector<LayerFile> files;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const std::string& name = shot.layers[layers[i]].name;
    const auto wanted = [&](const std::vector<std::size_t>& list) {
      return std::binary_search(list.begin(), list.end(), layers[i]);
    };
    if (wanted(setup.maps))
      files.push_back({i, map_channels, map_path(shot, name, frame), &setup.map_header});
    if (wanted(setup.data))
      files.push_back({i, data_channels, data_path(shot, name, frame), &setup.data_header});
  }
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

}  // namespace

EmptySpace make_maps(const Shot& shot, int frame, const FrameSetup& setup, FrameReport& report) {
  const std::vector<std::size_t> layers = layers_of(setup);
  Scene wanted = setup.scene;
  wanted.surfaces.clear();
  const auto map_surfaces = map_surfaces_of(shot);
  for (const std::size_t k : layers) wanted.surfaces.push_back(setup.scene.surfaces[*map_surfaces[k]]);
  const Tracer tracer(wanted, setup.data.empty() ? setup.plan : setup.data_plan);
  const Camera& camera = setup.scene.camera;
  const ExrWindow window{camera.width, camera.height, camera.overscan};
  std::vector<LayerFile> files = files_of(shot, frame, setup, layers);

  PhaseCost& tracing = report[Phase::Trace];
  PhaseCost& writing = report[Phase::Write];
  const int height = camera.full_height();
  int band = TileLevels{}.size;  // one row of tiles, which says how many fit into a band
  MapBands bands(
      tracer, shot.output.coverage == Coverage::Filtered ? std::optional(coverage_filter()) : std::nullopt);
  const bool all = setup.data.empty() && wanted.surfaces.size() == setup.scene.surfaces.size();
  EmptySpace empty = all ? EmptySpace(camera) : EmptySpace();
  for (int row = 0; row < height;) {
    row = std::min(height, row + band);
    const RowRange rows = timed(tracing.seconds, [&] { return bands.trace_until(row); });
    if (all) empty.learn(bands.maps(), bands.first_sample(), rows);
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
  return empty;
}

}  // namespace lensplane
