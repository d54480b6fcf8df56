// SPDX-License-Identifier: Apache-2.0
//
// The header that every EXR file of a shot carries.

#pragma once

#include <OpenEXR/ImfForward.h>

#include <optional>
#include <string>

#include "pipeline/image/exr_format.h"
#include "pipeline/image/picture.h"
#include "src/basis.h"

namespace lensplane {

/// What a file says about itself.
struct ExrHeader {
  std::string shot;
  int frame = 0;
  std::string plan;            // one line
  std::string parameters;      // hash of everything that determines the pixels
  std::string colour_interop;  // colorInteropID: "lin_ap1_scene", "data"; empty when the space has none
  std::optional<Chromaticities> chromaticities;
  Rational fps;
  Basis camera_axes;          // world from camera
  Vec3 camera_position{0};    // metres
  std::string amplification;  // "earth 4.46": A of each sphere layer; empty when there is none
};

/// A display window of `width` x `height` at the origin, and a data window larger by `overscan` on every
/// side.
struct ExrWindow {
  int width;
  int height;
  int overscan;
};

/// The same as OpenEXR has it, without channels.
Imf::Header imf_header(const ExrWindow& window, const ExrFormat& format, const ExrHeader& header);

/// The header of a picture of no shot: its windows, lensplane's version, and what its colours are.
Imf::Header imf_header_of_picture(const Picture& picture, const std::string& colour_interop,
                                  const std::optional<Chromaticities>& chromaticities);

}  // namespace lensplane
