// SPDX-License-Identifier: Apache-2.0
//
// Looking pictures up by (s, t): the one place where a plate or a texture is filtered.
//
// (s, t) cover the picture's display window, origin at the bottom left. Colours are premultiplied throughout.
// A texture is a picture with its pyramid in memory, or a tiled file of which the tiles come when they are
// asked for; lookups do not tell the two apart.

#pragma once

#include <utility>
#include <variant>

#include "pipeline/composite/pyramid.h"
#include "pipeline/composite/texture_filter.h"
#include "pipeline/composite/tiled_texels.h"
#include "pipeline/image/picture.h"
#include "src/surfaces.h"

namespace lensplane {

class Texture {
 public:
  Texture(Picture picture, Wrap wrap) : source_(make_pyramid(std::move(picture), wrap)), wrap_(wrap) {}
  Texture(TiledTexture tiled, Wrap wrap) : source_(std::move(tiled)), wrap_(wrap) {}

  /// The colour of the surface between the finest texels at (s, t), which must be finite: Catmull-Rom's cubic
  /// as it is, which may ring; for a picture, see filtered().
  Rgba lookup(TextureCoordinates st) const;

  /// The colour that a pixel of the film sees whose centre sees (s, t): filtered by its footprint, and held
  /// to the range of the texels around. A footprint of scale 0 is a ray that pixels are made of: lookup() at
  /// its place, held to that range where its pixel's filter is narrow. Never a NaN nor an infinity, whatever
  /// is asked for. Tiled textures throw Failure (BadInput) when their file breaks.
  Rgba filtered(TextureCoordinates st, const Footprint& footprint) const;

  /// Texels that were no numbers; of a tiled texture among those that have been read.
  std::int64_t not_numbers() const;

  /// Of the finest level.
  const PixelWindows& windows() const;

  /// What the finest level takes in memory: nothing of a tiled texture, which is read when it is needed.
  std::size_t bytes() const;

 private:
  std::variant<Pyramid, TiledTexture> source_;
  Wrap wrap_;
};

}  // namespace lensplane
