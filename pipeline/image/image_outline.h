// SPDX-License-Identifier: Apache-2.0
//
// What an image's header says of its pixels: for other programs, which have to be told where they lie and
// what they are called.

#pragma once

#include <array>
#include <string>

#include "pipeline/image/pixel_windows.h"

namespace lensplane {

struct ImageOutline {
  PixelWindows windows;
  int part = 0;                        // from 0
  std::array<std::string, 3> colours;  // what the file calls R, G and B; grey: the same three times
  std::string alpha;                   // empty: none
  bool premultiplied = true;           // as the file says
};

}  // namespace lensplane
