// SPDX-License-Identifier: Apache-2.0
//
// The images of a shot's layers: found, read, brought into the working space, and kept while they are needed.

#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "pipeline/colour/colour_config.h"
#include "pipeline/composite/texture.h"
#include "pipeline/shot/shot.h"

namespace lensplane {

/// The file that an image shows at a frame, which may be that of another one; nothing for black.
std::optional<std::string> file_shown(const LayerImage& image, int frame);

/// Safe to use from many threads. Still images are kept; those of sequences as long as their frame uses them.
/// Of images larger than memory (tiled_image.h) no more than kTileBytes are held together.
class TextureStore {
 public:
  /// `shot` and `colours` have to outlive the store.
  TextureStore(const Shot& shot, const ColourConfig& colours) : shot_(shot), colours_(colours) {}

  /// The image of a layer (an index into Shot::layers) at a frame. Not of stars: they have none. Throws
  /// Failure (BadInput).
  std::shared_ptr<const Texture> texture(std::size_t layer, int frame);

  /// The image of a sphere's night; null when it has none. Throws Failure (BadInput).
  std::shared_ptr<const Texture> night(std::size_t layer, int frame);

  /// The frame of a layer's image (else of its night's) that is shown because the one asked for is missing.
  struct StandIn {
    std::optional<int> frame;  // nothing: black
  };
  std::optional<StandIn> stand_in(std::size_t layer, int frame) const;

  /// A hash of all the layer's files, images or catalogue, and of how their colours are read.
  std::string digest(std::size_t layer, int frame);

 private:
  Texture read(const LayerImage& image, Wrap wrap, int frame) const;
  std::shared_ptr<const Texture> load(const LayerImage& image, Wrap wrap, int frame);
  std::string digest_of(const LayerImage& image, Wrap wrap, int frame);
  std::string digest_of(const LocatedText& file);
  ImageEncoding encoding_of(const LayerImage& image, const std::string& path) const;

  const Shot& shot_;
  const ColourConfig& colours_;
  std::mutex mutex_;
  const std::shared_ptr<TileCache> tiles_ = std::make_shared<TileCache>();
  std::map<const LayerImage*, std::shared_ptr<const Texture>> still_textures_;
  std::map<std::pair<const LayerImage*, int>, std::weak_ptr<const Texture>> moving_textures_;
  std::map<const LocatedText*, std::string> still_digests_;
};

}  // namespace lensplane
