// SPDX-License-Identifier: Apache-2.0

#include "pipeline/cli/warp.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "pipeline/cli/threads.h"
#include "pipeline/colour/colour_config.h"
#include "pipeline/colour/icc_profile.h"
#include "pipeline/composite/map_composite.h"
#include "pipeline/composite/map_jacobian.h"
#include "pipeline/image/display_writer.h"
#include "pipeline/image/exr_writer.h"
#include "pipeline/image/failure.h"
#include "pipeline/image/image_library.h"
#include "pipeline/image/image_reader.h"
#include "pipeline/image/shipped.h"

namespace lensplane {
namespace {

/// The role of every config for light that adds up; the name of the space that has it.
constexpr const char* kWorking = "scene_linear";

void check_output(const WarpOptions& warp) {
  const std::filesystem::path out = warp.out;
  if (out.extension() != ".exr" && out.extension() != ".png" && !is_tiff(out))
    throw Failure(ExitCode::BadShot,
                  fmt::format("{}: allowed: a name that ends in .exr, .png or .tif", warp.out));
  std::error_code error;
  for (const std::string& input : {warp.map, resolve_shipped(warp.image).string(), warp.data}) {
    if (std::filesystem::equivalent(out, input, error))
      throw Failure(ExitCode::BadShot,
                    fmt::format("{}: warp reads this file and would overwrite it", warp.out));
  }
}

ColourConfig load_config() {
  ColourConfig colours = ColourConfig::load(std::nullopt, std::getenv("OCIO"));
  if (!colours.has_space(kWorking))
    throw Failure(ExitCode::BadInput, fmt::format("the OCIO config of $OCIO has no role {}", kWorking));
  return colours;
}

std::string space_of(const WarpOptions& warp, const std::string& image, const ColourConfig& colours) {
  if (warp.space.empty()) return colours.space_of_file(image, read_interop_id(image));
  if (!colours.has_space(warp.space))
    throw Failure(ExitCode::BadShot,
                  fmt::format("--space: \"{}\" is no colour space of the OCIO config", warp.space));
  return warp.space;
}

StMap read_map(const Options& options) {
  std::optional<StOrigin> origin;
  if (!options.warp.origin.empty())
    origin = options.warp.origin == "top" ? StOrigin::TopLeft : StOrigin::BottomLeft;
  StMap map = read_st_map(options.warp.map, origin);
  if (map.half && !options.quiet) {
    std::fputs(
        fmt::format("{}: its coordinates are half floats: the picture will show blocks\n", options.warp.map)
            .c_str(),
        stderr);
  }
  return map;
}

Wrap wrap_of(const WarpOptions& warp) {
  constexpr std::array<std::string_view, 5> kNames = {"black", "clamp", "mirror", "repeat", "globe"};
  return static_cast<Wrap>(std::find(kNames.begin(), kNames.end(), warp.edge) - kNames.begin());
}

std::vector<Footprint> footprints_by_jacobian(const WarpOptions& warp, const StMap& map,
                                              const PixelWindows& picture) {
  const Wrap wrap = wrap_of(warp);
  const MappedPicture mapped{picture.display_width, picture.display_height,
                             wrap == Wrap::Globe || wrap == Wrap::Repeat, wrap == Wrap::Repeat};
  const auto data_file =
      warp.data.empty() ? data_file_beside(warp.map) : std::optional<std::filesystem::path>(warp.data);
  if (data_file) {
    const MapData data = read_map_data(*data_file, map);
    if (data.jacobian) return footprints_from_jacobian(map, *data.jacobian, mapped);
    if (!warp.data.empty())
      throw Failure(ExitCode::BadInput,
                    fmt::format("{}: it has no jacobian.ds_dx, ds_dy, dt_dx, dt_dy", warp.data));
  }
  return footprints_from_differences(map, mapped);
}

std::vector<Footprint> footprints_of(const WarpOptions& warp, const StMap& map, const PixelWindows& picture) {
  if (warp.filter == "none")
    return std::vector<Footprint>(map.s.size(), Footprint{});  // no wider than a point
  return footprints_by_jacobian(warp, map, picture);
}

void write(const WarpOptions& warp, const ColourConfig& colours, const Picture& picture, SampleType type,
           const std::string& space) {
  const std::filesystem::path out = warp.out;
  if (out.extension() == ".exr") {
    write_exr_picture(out, picture, type == SampleType::Float ? PixelType::Float : PixelType::Half,
                      colours.interop_id(kWorking), colours.chromaticities(kWorking));
    return;
  }
  const bool show = colours.is_scene_linear(space);
  const ViewSettings view = colours.default_view(kWorking);
  const std::string interop =
      show ? colours.display_interop_id(view.display, view.view) : colours.interop_id(space);
  const Picture encoded =
      show ? colours.to_display(picture, view) : colours.to_space(picture, kWorking, space);
  write_display(out, encoded, type == SampleType::UInt8 ? 8 : 16, {{}, interop, icc_profile(interop)});
}

}  // namespace

void run_warp(const Options& options) {
  const WarpOptions& warp = options.warp;
  check_output(warp);
  const Threads threads(options.threads);
  const std::future<void> images = begin_to_load_image_library();
  const ColourConfig colours = load_config();
  const std::string image = resolve_shipped(warp.image).string();
  StMap map = read_map(options);
  const EncodedImage encoded = read_image(image);
  const std::string space = space_of(warp, image, colours);
  const auto texture = std::make_shared<const Texture>(
      colours.to_working(encoded, {space, std::nullopt, false}, kWorking), wrap_of(warp));

  std::vector<MapLayer> layers(1);
  layers[0].footprints = footprints_of(warp, map, texture->windows());
  layers[0].map = std::move(map);
  layers[0].look.texture = texture;
  write(warp, colours, composite_from_maps(layers), encoded.type, space);
}

}  // namespace lensplane
