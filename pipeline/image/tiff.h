// SPDX-License-Identifier: Apache-2.0
//
// TIFF files of 16 bits, without compression and without a date: the same pixels give the same bytes.
//
// OpenImageIO writes TIFF only to a name of its own, and not into memory (2.4), so that the file could not
// appear whole or not at all.

#pragma once

#include <string>
#include <vector>

#include "pipeline/image/picture.h"

namespace lensplane {

/// The file of a picture's red, green and blue, clamped to 0 .. 1 and rounded. `description` goes into its
/// ImageDescription, `icc` is its profile; each is left out when it is empty. The directory comes last.
std::vector<unsigned char> tiff_bytes(const Picture& picture, const std::string& description,
                                      const std::vector<unsigned char>& icc);

}  // namespace lensplane
