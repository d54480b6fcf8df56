// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/texture_store.h"

#include "pipeline/image/frame_path.h"
#include "pipeline/image/image_reader.h"
#include "pipeline/image/shipped.h"
#include "pipeline/sequence/fingerprint.h"
#include "pipeline/sequence/located_in_shot.h"
#include "pipeline/shot/layer_files.h"

namespace lensplane {
namespace {

std::string path_of(const LocatedText& pattern, int frame) {
  return resolve_shipped(path_of_frame(pattern.text, frame)).string();
}

/// What is shown where a frame is missing.
std::optional<TextureStore::StandIn> stand_in_of(const LayerImage& image, int frame) {
  if (image.missing == Missing::Error || std::filesystem::exists(path_of(image.pattern, frame)))
    return std::nullopt;
  if (image.missing == Missing::Black) return TextureStore::StandIn{};
  const std::vector<int> frames = frames_on_disk(resolve_shipped(image.pattern.text).string());
  if (frames.empty()) return std::nullopt;  // to be told by whoever looks for the file
  const auto later = std::upper_bound(frames.begin(), frames.end(), frame);
  return TextureStore::StandIn{later == frames.begin() ? *later : *(later - 1)};
}

void require_file(const std::string& path, const std::string& noun) {
  if (!std::filesystem::exists(path)) throw Failure(ExitCode::BadInput, path + ": no such " + noun);
}

Wrap wrap_of(const Layer& layer) {
  if (std::holds_alternative<RingLayer>(layer.kind)) return Wrap::Clamp;
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

std::optional<std::string> file_shown(const LayerImage& image, int frame) {
  const auto stand_in = stand_in_of(image, frame);
  if (!stand_in) return path_of(image.pattern, frame);
  if (!stand_in->frame) return std::nullopt;
  return path_of(image.pattern, *stand_in->frame);
}

std::shared_ptr<const Texture> TextureStore::texture(std::size_t index, int frame) {
  const Layer& layer = shot_.layers[index];
  return load(layer.image, wrap_of(layer), frame);
}

std::shared_ptr<const Texture> TextureStore::night(std::size_t index, int frame) {
  const Layer& layer = shot_.layers[index];
  const auto* sphere = std::get_if<SphereLayer>(&layer.kind);
  return sphere && sphere->night ? load(*sphere->night, wrap_of(layer), frame) : nullptr;
}

std::optional<TextureStore::StandIn> TextureStore::stand_in(std::size_t index, int frame) const {
  for (const LayerImage* image : images_of(shot_.layers[index])) {
    if (const auto stand_in = stand_in_of(*image, frame)) return stand_in;
  }
  return std::nullopt;
}

std::string TextureStore::digest(std::size_t index, int frame) {
  const Layer& layer = shot_.layers[index];
  if (const auto* stars = std::get_if<StarsLayer>(&layer.kind)) return digest_of(stars->catalogue);
  Fingerprint print;
  for (const LayerImage* image : images_of(layer)) print.add(digest_of(*image, wrap_of(layer), frame));
  return print.digest();
}

Texture TextureStore::read(const LayerImage& image, Wrap wrap, int frame) const {
  return located_in_shot(image.pattern, [&] {
    const auto file = file_shown(image, frame);
    if (!file) return Texture(Picture{1, 1, 0, 0, 1, 1, {Rgba{0, 0, 0, 0}}}, wrap);
    const std::string& path = *file;
    const ImageEncoding encoding = encoding_of(image, path);
    const auto to_working = [this, encoding](const EncodedImage& encoded) {
      return colours_.to_working(encoded, encoding, shot_.colour.working.text);
    };
    if (!is_larger_than_memory(path, image.choice))
      return Texture(to_working(read_image(path, image.choice)), wrap);
    return Texture(TiledTexture(open_tiled_image(path, kFileCacheBytes, image.choice), to_working, tiles_),
                   wrap);
  });
}

std::shared_ptr<const Texture> TextureStore::load(const LayerImage& image, Wrap wrap, int frame) {
  if (!is_sequence(image.pattern.text)) {
    const std::lock_guard lock(mutex_);
    auto& kept = still_textures_[&image];
    if (!kept) kept = std::make_shared<const Texture>(read(image, wrap, frame));
    return kept;
  }
  {
    const std::lock_guard lock(mutex_);
    if (auto used = moving_textures_[{&image, frame}].lock()) return used;
  }
  auto texture = std::make_shared<const Texture>(read(image, wrap, frame));
  const std::lock_guard lock(mutex_);
  std::erase_if(moving_textures_, [](const auto& entry) { return entry.second.expired(); });
  moving_textures_[{&image, frame}] = texture;
  return texture;
}

std::string TextureStore::digest_of(const LayerImage& image, Wrap wrap, int frame) {
  const auto compute = [&] {
    return located_in_shot(image.pattern, [&] {
      const auto file = file_shown(image, frame);
      if (!file) return Fingerprint().add("black").digest();
      const std::string& path = *file;
      require_file(path, "image");
      const ImageEncoding encoding = encoding_of(image, path);
      return Fingerprint()
          .add_file(path)
          .add(image.choice.layer)
          .add(image.choice.part)
          .add(colours_.conversion_id(encoding.space, shot_.colour.working.text))
          .add(image.alpha ? static_cast<double>(*image.alpha) : -1.0)
          .add(static_cast<double>(wrap))
          .digest();
    });
  };
  if (is_sequence(image.pattern.text)) return compute();
  const std::lock_guard lock(mutex_);
  auto& kept = still_digests_[&image.pattern];
  if (kept.empty()) kept = compute();
  return kept;
}

std::string TextureStore::digest_of(const LocatedText& file) {
  const std::lock_guard lock(mutex_);
  auto& kept = still_digests_[&file];
  if (!kept.empty()) return kept;
  return kept = located_in_shot(file, [&] {
           const std::string path = resolve_shipped(file.text).string();
           require_file(path, "file");
           return Fingerprint().add_file(path).digest();
         });
}

ImageEncoding TextureStore::encoding_of(const LayerImage& image, const std::string& path) const {
  ImageEncoding encoding;
  encoding.space = image.space ? image.space->text : colours_.space_of_file(path, read_interop_id(path));
  if (image.alpha == AlphaKind::Associated) encoding.premultiplied = true;
  if (image.alpha == AlphaKind::Straight) encoding.premultiplied = false;
  encoding.ignore_alpha = image.alpha == AlphaKind::None;
  return encoding;
}

}  // namespace lensplane
