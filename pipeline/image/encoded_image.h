// SPDX-License-Identifier: Apache-2.0
//
// Pixels in memory as they are on disk: values as stored, colour not yet interpreted.

#pragma once

#include <cstddef>

#include "pipeline/image/pixel_windows.h"
#include "src/unset_allocator.h"

namespace lensplane {

enum class SampleType { UInt8, UInt16, Half, Float };

/// Size of one sample in bytes.
constexpr std::size_t size_of(SampleType type) {
  return type == SampleType::UInt8 ? 1 : type == SampleType::Float ? 4 : 2;
}

/// Samples one after another, of whatever type.
using Samples = UnsetVector<std::byte>;

/// RGBA samples row by row from the top, in the file's own type and encoding. Grey files have R = G = B,
/// files without alpha have it at full.
struct EncodedImage : PixelWindows {
  SampleType type = SampleType::Float;
  bool has_alpha = false;
  bool premultiplied = true;  // whether colours are premultiplied by alpha; true without alpha
  Samples samples;
};

}  // namespace lensplane
