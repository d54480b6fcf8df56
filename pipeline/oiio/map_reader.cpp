// SPDX-License-Identifier: Apache-2.0

#include "pipeline/oiio/map_reader.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/image/failure.h"
#include "pipeline/image/image_reader.h"
#include "pipeline/oiio/pixel_layout.h"

namespace lensplane::oiio {
namespace {

/// An open file of which channels are read by their names.
class ChannelFile {
 public:
  explicit ChannelFile(const std::filesystem::path& path, const char* noun) : path_(path), noun_(noun) {
    std::error_code error;
    if (!std::filesystem::exists(path, error))
      throw Failure(ExitCode::BadInput, fmt::format("{}: no such {}", path.string(), noun));
    input_ = OIIO::ImageInput::open(path.string());
    if (!input_) refuse(OIIO::geterror());
    if (spec().image_pixels() > kMaxImagePixels) {
      refuse(fmt::format("{} x {} pixels; allowed: up to {} million", spec().width, spec().height,
                         kMaxImagePixels >> 20));
    }
  }

  [[noreturn]] void refuse(const std::string& reason) const {
    throw Failure(ExitCode::BadInput,
                  fmt::format("{}: cannot be read as a {}: {}", path_.string(), noun_, reason));
  }

  const OIIO::ImageSpec& spec() const { return input_->spec(); }

  /// Empty when there is no such channel.
  std::vector<float> read(const char* channel) {
    const int index = spec().channelindex(channel);
    if (index < 0) return {};
    std::vector<float> samples(spec().image_pixels());
    if (!input_->read_image(0, 0, index, index + 1, OIIO::TypeDesc::FLOAT, samples.data()))
      refuse(input_->geterror());
    return samples;
  }

 private:
  std::filesystem::path path_;
  const char* noun_;
  std::unique_ptr<OIIO::ImageInput> input_;
};

bool is_zero(const std::vector<float>& samples) {
  return std::all_of(samples.begin(), samples.end(), [](float sample) { return sample == 0; });
}

/// B, but for maps whose makers left it black; else A; else full.
std::vector<float> read_coverage(ChannelFile& file, const StMap& map) {
  std::vector<float> coverage = file.read("B");
  if (!coverage.empty() && is_zero(coverage) && !(is_zero(map.s) && is_zero(map.t))) coverage.clear();
  if (coverage.empty()) coverage = file.read("A");
  if (coverage.empty()) coverage.assign(map.s.size(), 1.0F);
  return coverage;
}

/// Nothing that is no number gets past here.
void clean(StMap& map) {
  for (std::size_t i = 0; i < map.s.size(); ++i) {
    float& coverage = map.coverage[i];
    coverage = coverage > 0 ? std::min(coverage, 1.0F) : 0.0F;  // NaN: 0
    if (!std::isfinite(map.s[i]) || !std::isfinite(map.t[i])) coverage = 0;
    if (coverage == 0) map.s[i] = map.t[i] = 0;
  }
}

StOrigin origin_of(const ChannelFile& file, std::optional<StOrigin> said) {
  if (said) return *said;
  const bool top = file.spec().get_string_attribute("lensplane:st_origin") == "top left";
  return top ? StOrigin::TopLeft : StOrigin::BottomLeft;
}

}  // namespace

StMap read_st_map(const std::filesystem::path& path, std::optional<StOrigin> origin) {
  ChannelFile file(path, "map");
  const OIIO::ImageSpec& spec = file.spec();
  StMap map{windows_of(spec), false, {}, {}, {}};
  for (const char* name : {"R", "G"}) {
    const int channel = spec.channelindex(name);
    if (channel < 0) file.refuse(fmt::format("it has no channel {}; needed: R = s and G = t", name));
    const OIIO::TypeDesc type = spec.channelformat(channel);
    if (!type.is_floating_point())
      file.refuse(fmt::format("its channel {} has whole numbers ({}); needed: float", name, type.c_str()));
    map.half |= type == OIIO::TypeDesc::HALF;
  }
  map.s = file.read("R");
  map.t = file.read("G");
  map.coverage = read_coverage(file, map);
  if (origin_of(file, origin) == StOrigin::TopLeft) {
    for (float& t : map.t) t = 1.0F - t;
  }
  clean(map);
  return map;
}

MapData read_map_data(const std::filesystem::path& path, const StMap& map) {
  ChannelFile file(path, "data file");
  const OIIO::ImageSpec& spec = file.spec();
  const PixelWindows own = windows_of(spec);
  if (own.width != map.width || own.height != map.height || own.x != map.x || own.y != map.y) {
    file.refuse(fmt::format("{} x {} pixels from ({}, {}), its map {} x {} from ({}, {})", own.width,
                            own.height, own.x, own.y, map.width, map.height, map.x, map.y));
  }
  MapData data;
  MapJacobian jacobian{file.read("jacobian.ds_dx"), file.read("jacobian.ds_dy"), file.read("jacobian.dt_dx"),
                       file.read("jacobian.dt_dy")};
  const bool whole = !jacobian.ds_dx.empty() && !jacobian.ds_dy.empty() && !jacobian.dt_dx.empty() &&
                     !jacobian.dt_dy.empty();
  if (whole) data.jacobian = std::move(jacobian);
  data.depth = file.read("depth.z");
  data.alpha = file.read("A");
  return data;
}

}  // namespace lensplane::oiio
