// SPDX-License-Identifier: Apache-2.0

#include "pipeline/image/exr_writer.h"

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>

#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <limits>
#include <map>

#include "pipeline/image/atomic_file.h"
#include "pipeline/image/failure.h"
#include "pipeline/image/version.h"

namespace lensplane {
namespace {

/// A file in memory, so that it can be put on the disk whole.
class MemoryStream : public Imf::OStream {
 public:
  MemoryStream() : Imf::OStream("memory") {}
  void write(const char bytes[], int count) override {
    const std::size_t end = position_ + static_cast<std::size_t>(count);
    if (end > bytes_.size()) bytes_.resize(end);
    std::copy_n(bytes, count, bytes_.begin() + static_cast<std::ptrdiff_t>(position_));
    position_ = end;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }
  const std::vector<char>& bytes() const { return bytes_; }

 private:
  std::vector<char> bytes_;
  std::size_t position_ = 0;
};

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
  if (!header.colour_interop.empty()) text("colorInteropID", header.colour_interop);
  if (header.chromaticities) Imf::addChromaticities(imf, imf_chromaticities(*header.chromaticities));
  imf.insert("framesPerSecond", Imf::RationalAttribute(Imf::Rational(
                                    header.fps.numerator, static_cast<unsigned>(header.fps.denominator))));
  imf.insert("worldToCamera",
             Imf::M44fAttribute(world_to_camera(header.camera_axes, header.camera_position)));
  return imf;
}

std::vector<half> half_from_float(const ExrChannel& channel, std::size_t count) {
  constexpr float kLargestHalf = 65504.0F;
  std::vector<half> samples(count);
  for (std::size_t i = 0; i < count; ++i) {
    samples[i] = std::clamp(channel.samples[i * channel.stride], -kLargestHalf, kLargestHalf);
  }
  return samples;
}

/// Where OpenEXR finds the samples of a channel: it addresses them by absolute coordinates of the data
/// window.
Imf::Slice slice_of(PixelType type, const void* samples, std::size_t sample_size, const ExrWindow& window) {
  const std::size_t row = sample_size * static_cast<std::size_t>(window.width + 2 * window.overscan);
  const auto offset =
      static_cast<std::ptrdiff_t>(window.overscan) * static_cast<std::ptrdiff_t>(row + sample_size);
  char* base = const_cast<char*>(static_cast<const char*>(samples)) + offset;
  return {type == PixelType::Half ? Imf::HALF : Imf::FLOAT, base, sample_size, row};
}

}  // namespace

std::size_t write_exr(const std::filesystem::path& path, const ExrWindow& window,
                      const std::vector<ExrChannel>& channels, const ExrFormat& format,
                      const ExrHeader& header) {
  Imf::Header imf = imf_header(window, format, header);
  Imf::FrameBuffer frame;
  std::map<std::string, std::vector<half>> halves;
  const int width = window.width + 2 * window.overscan;
  const int height = window.height + 2 * window.overscan;
  for (const ExrChannel& channel : channels) {
    imf.channels().insert(channel.name,
                          Imf::Channel(format.type == PixelType::Half ? Imf::HALF : Imf::FLOAT));
    if (format.type == PixelType::Half) {
      auto& samples = halves[channel.name];
      samples = half_from_float(channel, static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
      frame.insert(channel.name, slice_of(format.type, samples.data(), sizeof(half), window));
    } else {
      frame.insert(channel.name,
                   slice_of(format.type, channel.samples, channel.stride * sizeof(float), window));
    }
  }
  MemoryStream stream;
  try {
    Imf::OutputFile file(stream, imf);
    file.setFrameBuffer(frame);
    file.writePixels(height);
  } catch (const std::exception& error) {
    throw Failure(ExitCode::BadOutput, path.string() + ": cannot be written: " + error.what());
  }
  write_atomically(path, stream.bytes());
  return stream.bytes().size();
}

std::optional<std::string> read_exr_attribute(const std::filesystem::path& path,
                                              const std::string& name) try {
  if (!std::filesystem::exists(path)) return std::nullopt;
  Imf::InputFile file(path.c_str());
  const auto* attribute = file.header().findTypedAttribute<Imf::StringAttribute>("lensplane:" + name);
  if (!attribute || !file.isComplete()) return std::nullopt;
  // The last rows lie at the end of the file: reading them shows that nothing was cut off.
  const Imath::Box2i data = file.header().dataWindow();
  std::vector<float> row(static_cast<std::size_t>(data.size().x) + 1);
  char* base = reinterpret_cast<char*>(row.data()) - static_cast<std::ptrdiff_t>(sizeof(float)) * data.min.x;
  Imf::FrameBuffer frame;
  frame.insert(file.header().channels().begin().name(), Imf::Slice(Imf::FLOAT, base, sizeof(float), 0));
  file.setFrameBuffer(frame);
  file.readPixels(data.max.y);
  return attribute->value();
} catch (const std::exception&) {
  return std::nullopt;
}

}  // namespace lensplane
