// SPDX-License-Identifier: Apache-2.0

#include "tests/quality/peer_st_warp.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include "tests/quality/peer_plate.h"

namespace lensplane {
namespace {

Picture continued(const Picture& plate, Wrap edge, int margin) {
  const int width = plate.width + 2 * margin, height = plate.height + 2 * margin;
  Picture picture{width, height, 0, 0, width, height, {}};
  for (int row = -margin; row < plate.height + margin; ++row) {
    for (int column = -margin; column < plate.width + margin; ++column) {
      picture.pixels.push_back(texel_at(plate, edge, column, row));
    }
  }
  return picture;
}

}  // namespace

Picture warped_by_oiio(const LensMap& map, const Picture& plate, Wrap edge, const std::string& filter) {
  const int margin = plate.width / 10;
  const Picture wide = continued(plate, edge, margin);
  const OIIO::ImageSpec spec(wide.width, wide.height, 4, OIIO::TypeDesc::FLOAT);
  OIIO::ImageBuf source(spec, const_cast<float*>(wide.pixels.front().data()));
  OIIO::ImageBuf coordinates(OIIO::ImageSpec(map.width, map.height, 2, OIIO::TypeDesc::FLOAT));
  const auto moved = [&](float at, int size, int all) {
    return static_cast<float>((static_cast<double>(at) * size + margin) / all);
  };
  for (int row = 0; row < map.height; ++row) {
    for (int column = 0; column < map.width; ++column) {
      const auto i = static_cast<std::size_t>(row * map.width + column);
      const std::array<float, 2> st{moved(map.s[i], plate.width, wide.width),
                                    moved(map.t[i], plate.height, wide.height)};
      coordinates.setpixel(column, row, st.data(), 2);
    }
  }
  const OIIO::ImageBuf result =
      OIIO::ImageBufAlgo::st_warp(source, coordinates, filter, 0.0F, 0, 1, false, true);
  return warped(map, [&](int column, int row, std::size_t) {
    Rgba pixel{};
    result.getpixel(column, row, pixel.data(), 4);
    return pixel;
  });
}

}  // namespace lensplane
