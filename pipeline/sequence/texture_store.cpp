// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/texture_store.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/image/failure.h"
#include "pipeline/image/frame_path.h"
#include "pipeline/image/shipped.h"
#include "pipeline/sequence/fingerprint.h"

namespace lensplane {
namespace {

std::string path_of(const Layer& layer, int frame) {
  return resolve_shipped(path_of_frame(layer.image.pattern, frame)).string();
}

Wrap wrap_of(const Layer& layer) {
  const auto* plate = std::get_if<PlateLayer>(&layer.kind);
  if (!plate) return Wrap::Globe;
  switch (plate->edge) {
    case Edge::Black:
      return Wrap::Black;
    case Edge::Clamp:
      return Wrap::Clamp;
    case Edge::Mirror:
      return Wrap::Mirror;
    case Edge::Repeat:
      return Wrap::Repeat;
  }
  return Wrap::Black;
}

void require_among(const LocatedText& name, const std::vector<std::string>& allowed, std::string_view noun) {
  if (std::find(allowed.begin(), allowed.end(), name.text) != allowed.end()) return;
  refuse(name.location, name.key,
         fmt::format("{} is no {} of the OCIO config; allowed: {}", in_quotes(name.text), noun,
                     comma_list(allowed)));
}

void require_space(const LocatedText& name, const ColourConfig& colours) {
  if (!colours.has_space(name.text)) require_among(name, colours.spaces(), "colour space");
}

}  // namespace

void check_colours(const Shot& shot, const ColourConfig& colours) {
  require_space(shot.colour.working, colours);
  require_among(shot.colour.display, colours.displays(), "display");
  require_among(shot.colour.view, colours.views(shot.colour.display.text), "view of this display");
  for (const Layer& layer : shot.layers) {
    if (layer.image.space) require_space(*layer.image.space, colours);
  }
}

std::shared_ptr<const Texture> TextureStore::texture(std::size_t index, int frame) {
  const Layer& layer = shot_.layers[index];
  if (is_sequence(layer.image.pattern)) return load(layer, path_of(layer, frame));
  const std::lock_guard lock(mutex_);
  auto& kept = still_textures_[index];
  if (!kept) kept = load(layer, path_of(layer, frame));
  return kept;
}

std::string TextureStore::digest(std::size_t index, int frame) {
  const Layer& layer = shot_.layers[index];
  const auto compute = [&] {
    const std::string path = path_of(layer, frame);
    if (!std::filesystem::exists(path)) throw Failure(ExitCode::BadInput, path + ": no such image");
    const ImageEncoding encoding = encoding_of(layer, path);
    return Fingerprint()
        .add_file(path)
        .add(encoding.space)
        .add(layer.image.alpha ? static_cast<double>(*layer.image.alpha) : -1.0)
        .add(static_cast<double>(wrap_of(layer)))
        .digest();
  };
  if (is_sequence(layer.image.pattern)) return compute();
  const std::lock_guard lock(mutex_);
  auto& kept = still_digests_[index];
  if (kept.empty()) kept = compute();
  return kept;
}

ImageEncoding TextureStore::encoding_of(const Layer& layer, const std::string& path) const {
  ImageEncoding encoding;
  encoding.space = layer.image.space ? layer.image.space->text : colours_.space_of_file(path);
  if (layer.image.alpha == AlphaKind::Associated) encoding.premultiplied = true;
  if (layer.image.alpha == AlphaKind::Straight) encoding.premultiplied = false;
  encoding.ignore_alpha = layer.image.alpha == AlphaKind::None;
  return encoding;
}

std::shared_ptr<const Texture> TextureStore::load(const Layer& layer, const std::string& path) const {
  Picture picture =
      colours_.to_working(read_image(path), encoding_of(layer, path), shot_.colour.working.text);
  return std::make_shared<const Texture>(std::move(picture), wrap_of(layer));
}

}  // namespace lensplane
