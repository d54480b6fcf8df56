// SPDX-License-Identifier: Apache-2.0
//
// What the image library gives to the program that loads it.

#include <OpenImageIO/imageio.h>
#include <tbb/global_control.h>

#include "pipeline/image/image_library.h"
#include "pipeline/image/version.h"
#include "pipeline/oiio/image_reader.h"
#include "pipeline/oiio/map_reader.h"
#include "pipeline/oiio/png_writer.h"
#include "pipeline/oiio/tiled_image.h"

namespace lensplane::oiio {
namespace {

constexpr ImageLibrary kLibrary = {kVersion,         read_image,  read_outline,  is_larger_than_memory,
                                   open_tiled_image, read_st_map, read_map_data, read_attribute,
                                   png_bytes};

}  // namespace

extern "C" [[gnu::visibility("default")]] const ImageLibrary* lensplane_image_library() {
  const auto threads = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  OIIO::attribute("threads", static_cast<int>(threads));
  return &kLibrary;
}

}  // namespace lensplane::oiio
