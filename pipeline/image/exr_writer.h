// SPDX-License-Identifier: Apache-2.0
//
// EXR files: pictures and maps, with the header that every file of a shot carries.
//
// Two renders of the same frame give the same bytes: no dates, host names or absolute paths are written.

#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/image/exr_header.h"
#include "pipeline/image/picture.h"

namespace lensplane {

/// One channel, row by row from the top.
struct ExrChannel {
  std::string name;
  const float* samples;
  std::size_t stride = 1;  // floats from one sample to the next
};

/// A single-part file that is written from the top, some rows at a time, and appears whole or not at all.
/// Half samples are clamped to the largest half. Throws Failure (BadOutput).
class ExrFile {
 public:
  /// `channels` are their names.
  ExrFile(const std::filesystem::path& path, const ExrWindow& window,
          const std::vector<std::string>& channels, const ExrFormat& format, const ExrHeader& header);
  /// With windows and attributes as they stand in `header`; its channels are added.
  ExrFile(const std::filesystem::path& path, Imf::Header header, const std::vector<std::string>& channels,
          PixelType type);
  ~ExrFile();

  /// The next `rows` rows of all channels; `samples` begin at the first of them.
  void write(const std::vector<ExrChannel>& samples, int rows);
  /// After the last row. Returns the file's size in bytes.
  std::size_t commit();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Writes the whole file. Returns its size in bytes.
std::size_t write_exr(const std::filesystem::path& path, const ExrWindow& window,
                      const std::vector<ExrChannel>& channels, const ExrFormat& format,
                      const ExrHeader& header);

/// Writes R, G, B, A of a picture of no shot, whose colour space has this colorInteropID and primaries.
std::size_t write_exr_picture(const std::filesystem::path& path, const Picture& picture, PixelType type,
                              const std::string& colour_interop,
                              const std::optional<Chromaticities>& chromaticities);

/// Reads back the attribute `lensplane:NAME` of a file that is whole, nothing when there is no such file, no
/// such attribute, or the file breaks off.
std::optional<std::string> read_exr_attribute(const std::filesystem::path& path, const std::string& name);

/// The framesPerSecond of a file, from its header alone; nothing when it has none that is a rate, or is no
/// EXR file.
std::optional<Rational> read_frame_rate(const std::filesystem::path& path);

}  // namespace lensplane
