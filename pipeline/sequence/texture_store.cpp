// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/texture_store.h"

#include "pipeline/image/failure.h"
#include "pipeline/image/frame_path.h"
#include "pipeline/image/shipped.h"
#include "pipeline/sequence/fingerprint.h"

namespace lensplane {
namespace {

std::string path_of(const Layer& layer, int frame) {
  return resolve_shipped(path_of_frame(layer.image.pattern.text, frame)).string();
}

/// Runs `work`; when an input fails there, the line says which key of the shot names it.
auto located_in_shot(const Layer& layer, auto work) {
  try {
    return work();
  } catch (const Failure& failure) {
    const LocatedText& named = layer.image.pattern;
    throw Failure(failure.code(), located(named.location, named.key, failure.what()));
  }
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

}  // namespace

std::shared_ptr<const Texture> TextureStore::texture(std::size_t index, int frame) {
  const Layer& layer = shot_.layers[index];
  const auto load = [&] {
    return located_in_shot(layer, [&] {
      const std::string path = path_of(layer, frame);
      Picture picture =
          colours_.to_working(read_image(path), encoding_of(layer, path), shot_.colour.working.text);
      return std::make_shared<const Texture>(std::move(picture), wrap_of(layer));
    });
  };
  if (is_sequence(layer.image.pattern.text)) return load();
  const std::lock_guard lock(mutex_);
  auto& kept = still_textures_[index];
  if (!kept) kept = load();
  return kept;
}

std::string TextureStore::digest(std::size_t index, int frame) {
  const Layer& layer = shot_.layers[index];
  const auto compute = [&] {
    return located_in_shot(layer, [&] {
      const std::string path = path_of(layer, frame);
      if (!std::filesystem::exists(path)) throw Failure(ExitCode::BadInput, path + ": no such image");
      const ImageEncoding encoding = encoding_of(layer, path);
      return Fingerprint()
          .add_file(path)
          .add(colours_.conversion_id(encoding.space, shot_.colour.working.text))
          .add(layer.image.alpha ? static_cast<double>(*layer.image.alpha) : -1.0)
          .add(static_cast<double>(wrap_of(layer)))
          .digest();
    });
  };
  if (is_sequence(layer.image.pattern.text)) return compute();
  const std::lock_guard lock(mutex_);
  auto& kept = still_digests_[index];
  if (kept.empty()) kept = compute();
  return kept;
}

ImageEncoding TextureStore::encoding_of(const Layer& layer, const std::string& path) const {
  ImageEncoding encoding;
  encoding.space =
      layer.image.space ? layer.image.space->text : colours_.space_of_file(path, read_interop_id(path));
  if (layer.image.alpha == AlphaKind::Associated) encoding.premultiplied = true;
  if (layer.image.alpha == AlphaKind::Straight) encoding.premultiplied = false;
  encoding.ignore_alpha = layer.image.alpha == AlphaKind::None;
  return encoding;
}

}  // namespace lensplane
