// SPDX-License-Identifier: Apache-2.0
//
// Looking pictures up by (s, t): the one place where a plate or a texture is filtered.
//
// (s, t) cover the picture's display window, origin at the bottom left. Lookups are bilinear between pixel
// centres.

#pragma once

#include <utility>

#include "pipeline/image/picture.h"
#include "src/surfaces.h"

namespace lensplane {

// Black     transparent black
// Clamp     the nearest pixel
// Mirror    the picture mirrored at its edges
// Repeat    the picture again
// Globe     longitude repeats; beyond a pole lies the other side of the globe
enum class Wrap { Black, Clamp, Mirror, Repeat, Globe };

class Texture {
 public:
  Texture(Picture picture, Wrap wrap) : picture_(std::move(picture)), wrap_(wrap) {}

  /// The colour at (s, t), which must be finite; premultiplied.
  Rgba lookup(TextureCoordinates st) const;

  const Picture& picture() const { return picture_; }

 private:
  Rgba stored(int column, int row) const;
  Rgba texel(int column, int row) const;

  Picture picture_;
  Wrap wrap_;
};

}  // namespace lensplane
