// SPDX-License-Identifier: Apache-2.0

#include "pipeline/image/exr_header.h"

#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>

#include "pipeline/image/version.h"

namespace lensplane {
namespace {

Imf::Compression imf_compression(ExrCompression compression) {
  switch (compression) {
    case ExrCompression::None:
      return Imf::NO_COMPRESSION;
    case ExrCompression::Rle:
      return Imf::RLE_COMPRESSION;
    case ExrCompression::Zips:
      return Imf::ZIPS_COMPRESSION;
    case ExrCompression::Zip:
      return Imf::ZIP_COMPRESSION;
    case ExrCompression::Piz:
      return Imf::PIZ_COMPRESSION;
    case ExrCompression::Pxr24:
      return Imf::PXR24_COMPRESSION;
    case ExrCompression::B44:
      return Imf::B44_COMPRESSION;
    case ExrCompression::B44a:
      return Imf::B44A_COMPRESSION;
    case ExrCompression::Dwaa:
      return Imf::DWAA_COMPRESSION;
    case ExrCompression::Dwab:
      return Imf::DWAB_COMPRESSION;
  }
  return Imf::ZIP_COMPRESSION;
}

/// Camera from world for row vectors, as EXR stores it.
Imath::M44f world_to_camera(const Basis& axes, const Vec3& position) {
  const Vec3 origin = axes.local_from_parent(-position) + Vec3(0);  // + 0: no negative zeros
  Imath::M44f matrix;
  for (int i = 0; i < 3; ++i) {
    matrix[i][0] = static_cast<float>(axes.x[i]);
    matrix[i][1] = static_cast<float>(axes.y[i]);
    matrix[i][2] = static_cast<float>(axes.z[i]);
    // float32 ends at 3.4e38 m, far outside the universe.
    matrix[3][i] = static_cast<float>(std::clamp(origin[i], -1e38, 1e38));
  }
  return matrix;
}

Imf::Chromaticities imf_chromaticities(const Chromaticities& c) {
  const auto xy = [&c](std::size_t i) { return Imath::V2f(c[i][0], c[i][1]); };
  return {xy(0), xy(1), xy(2), xy(3)};
}

void add_colours(const std::string& interop, const std::optional<Chromaticities>& chromaticities,
                 Imf::Header& imf) {
  if (!interop.empty()) imf.insert("colorInteropID", Imf::StringAttribute(interop));
  if (chromaticities) Imf::addChromaticities(imf, imf_chromaticities(*chromaticities));
}

}  // namespace

Imf::Header imf_header_of_picture(const Picture& picture, const std::string& colour_interop,
                                  const std::optional<Chromaticities>& chromaticities) {
  const Imath::V2i corner(picture.x, picture.y);
  Imf::Header imf(Imath::Box2i({0, 0}, {picture.display_width - 1, picture.display_height - 1}),
                  Imath::Box2i(corner, corner + Imath::V2i(picture.width - 1, picture.height - 1)));
  imf.compression() = Imf::ZIP_COMPRESSION;
  imf.insert("lensplane:version", Imf::StringAttribute(kVersion));
  add_colours(colour_interop, chromaticities, imf);
  return imf;
}

Imf::Header imf_header(const ExrWindow& window, const ExrFormat& format, const ExrHeader& header) {
  const Imath::Box2i display({0, 0}, {window.width - 1, window.height - 1});
  const Imath::Box2i data(display.min - Imath::V2i(window.overscan),
                          display.max + Imath::V2i(window.overscan));
  Imf::Header imf(display, data);
  imf.compression() = imf_compression(format.compression);
  const auto text = [&imf](const char* name, const std::string& value) {
    imf.insert(name, Imf::StringAttribute(value));
  };
  text("lensplane:version", kVersion);
  text("lensplane:shot", header.shot);
  imf.insert("lensplane:frame", Imf::IntAttribute(header.frame));
  text("lensplane:plan", header.plan);
  text("lensplane:parameters", header.parameters);
  text("lensplane:st_origin", "bottom left");
  if (!header.amplification.empty()) text("lensplane:amplification", header.amplification);
  add_colours(header.colour_interop, header.chromaticities, imf);
  imf.insert("framesPerSecond", Imf::RationalAttribute(Imf::Rational(
                                    header.fps.numerator, static_cast<unsigned>(header.fps.denominator))));
  imf.insert("worldToCamera",
             Imf::M44fAttribute(world_to_camera(header.camera_axes, header.camera_position)));
  return imf;
}

}  // namespace lensplane
