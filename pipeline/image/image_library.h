// SPDX-License-Identifier: Apache-2.0
//
// The library that reads and writes image files by OpenImageIO (pipeline/oiio), loaded when it is needed.
//
// OpenImageIO brings some 250 libraries along, and to link them takes the system's loader a third of a
// second: longer than most commands take that look at no image, and time in which a frame's maps can be
// traced. What is called is declared in image_reader.h, map_reader.h, tiled_image.h and display_writer.h.

#pragma once

#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/image/display_writer.h"
#include "pipeline/image/encoded_image.h"
#include "pipeline/image/image_outline.h"
#include "pipeline/image/map_reader.h"
#include "pipeline/image/tiled_image.h"

namespace lensplane {

/// What the library offers; each is what the function of its name is, unless it says more.
struct ImageLibrary {
  const char* version;  // of the lensplane that it belongs to
  EncodedImage (*read_image)(const std::filesystem::path&, const ImageChoice&);
  ImageOutline (*read_outline)(const std::filesystem::path&, const ImageChoice&);
  bool (*is_larger_than_memory)(const std::filesystem::path&, const ImageChoice&);
  std::shared_ptr<const TiledImage> (*open_tiled_image)(const std::filesystem::path&, std::size_t,
                                                        const ImageChoice&);
  StMap (*read_st_map)(const std::filesystem::path&, std::optional<StOrigin>);
  MapData (*read_map_data)(const std::filesystem::path&, const StMap&);
  /// What an image's header says under a name; empty when it says nothing, or cannot be read.
  std::string (*read_attribute)(const std::filesystem::path&, const char* name);
  /// The file of a picture as write_display describes it; `path` is only for the Failure's text.
  std::vector<unsigned char> (*png_bytes)(const std::filesystem::path&, const Picture&, int bits,
                                          const DisplayHeader&);
};

/// What the library exports: a function of this name and type.
inline constexpr const char* kImageLibraryEntry = "lensplane_image_library";
using ImageLibraryEntry = const ImageLibrary*();

/// Loads the library when that has not been done, from the folder lib/lensplane beside the program's own. It
/// then uses as many threads as TBB may. Throws Failure (BadInput) when it is not there.
const ImageLibrary& image_library();

/// Begins to load the library beside other work. What goes wrong is told by image_library(). Whoever lets go
/// of the result waits for the end.
[[nodiscard]] std::future<void> begin_to_load_image_library();

}  // namespace lensplane
