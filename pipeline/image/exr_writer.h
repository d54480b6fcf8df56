// SPDX-License-Identifier: Apache-2.0
//
// EXR files: pictures and maps, with the header that every file of a shot carries.
//
// Two renders of the same frame give the same bytes: no dates, host names or absolute paths are written.

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/image/exr_format.h"
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

/// One channel, row by row from the top.
struct ExrChannel {
  std::string name;
  const float* samples;
  std::size_t stride = 1;  // floats from one sample to the next
};

/// A display window of `width` x `height` at the origin, and a data window larger by `overscan` on every
/// side.
struct ExrWindow {
  int width;
  int height;
  int overscan;
};

/// Writes a single-part file, whole or not at all. Half samples are clamped to the largest half. Returns its
/// size in bytes. Throws Failure (BadOutput).
std::size_t write_exr(const std::filesystem::path& path, const ExrWindow& window,
                      const std::vector<ExrChannel>& channels, const ExrFormat& format,
                      const ExrHeader& header);

/// Reads back the attribute `lensplane:NAME` of a file that is whole, nothing when there is no such file, no
/// such attribute, or the file breaks off.
std::optional<std::string> read_exr_attribute(const std::filesystem::path& path, const std::string& name);

}  // namespace lensplane
