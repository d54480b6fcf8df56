// SPDX-License-Identifier: Apache-2.0

#include "pipeline/image/exr_writer.h"

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfRationalAttribute.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <functional>

#include "pipeline/image/atomic_file.h"
#include "pipeline/image/failure.h"

namespace lensplane {
namespace {

/// OpenEXR's view of an AtomicFile.
class AtomicStream : public Imf::OStream {
 public:
  explicit AtomicStream(const std::filesystem::path& path) : Imf::OStream(path.c_str()), file_(path) {}
  void write(const char bytes[], int count) override {
    file_.write({bytes, static_cast<std::size_t>(count)});
  }
  std::uint64_t tellp() override { return file_.position(); }
  void seekp(std::uint64_t position) override { file_.seek(position); }
  std::size_t commit() { return file_.commit(); }

 private:
  AtomicFile file_;
};

std::vector<half> half_from_float(const ExrChannel& channel, std::size_t count) {
  constexpr float kLargestHalf = 65504.0F;
  std::vector<half> samples(count);
  for (std::size_t i = 0; i < count; ++i) {
    samples[i] = std::clamp(channel.samples[i * channel.stride], -kLargestHalf, kLargestHalf);
  }
  return samples;
}

}  // namespace

struct ExrFile::State {
  std::filesystem::path path;
  Imf::PixelType type;
  AtomicStream stream;
  std::optional<Imf::OutputFile> file;  // writes its table of rows when it goes
  int next_row;

  /// Where OpenEXR finds samples that begin at the next row: it addresses them by absolute coordinates of the
  /// data window.
  Imf::Slice slice_of(const void* samples, std::size_t sample_size) const {
    const Imath::Box2i data = file->header().dataWindow();
    const std::size_t row = sample_size * (static_cast<std::size_t>(data.size().x) + 1);
    const auto offset =
        static_cast<std::ptrdiff_t>(sample_size) * data.min.x + static_cast<std::ptrdiff_t>(row) * next_row;
    char* base = const_cast<char*>(static_cast<const char*>(samples)) - offset;
    return {type, base, sample_size, row};
  }

  /// Runs `work`; what OpenEXR throws becomes a Failure.
  void guarded(const std::function<void()>& work) const try { work(); } catch (const Failure&) {
    throw;
  } catch (const std::exception& error) {
    throw Failure(ExitCode::BadOutput, path.string() + ": cannot be written: " + error.what());
  }
};

ExrFile::ExrFile(const std::filesystem::path& path, const ExrWindow& window,
                 const std::vector<std::string>& channels, const ExrFormat& format, const ExrHeader& header)
    : ExrFile(path, imf_header(window, format, header), channels, format.type) {}

ExrFile::ExrFile(const std::filesystem::path& path, Imf::Header header,
                 const std::vector<std::string>& channels, PixelType pixel_type) {
  const Imf::PixelType type = pixel_type == PixelType::Half ? Imf::HALF : Imf::FLOAT;
  // Files are 1 to 5 % smaller at OpenEXR's 4, which takes 1.4 times as long.
  header.zipCompressionLevel() = 2;
  for (const std::string& channel : channels) header.channels().insert(channel, Imf::Channel(type));
  state_.reset(new State{path, type, AtomicStream(path), {}, header.dataWindow().min.y});
  state_->guarded([&] { state_->file.emplace(state_->stream, header); });
}

ExrFile::~ExrFile() = default;

void ExrFile::write(const std::vector<ExrChannel>& samples, int rows) {
  const Imath::Box2i data = state_->file->header().dataWindow();
  const std::size_t count = static_cast<std::size_t>(rows) * (static_cast<std::size_t>(data.size().x) + 1);
  Imf::FrameBuffer frame;
  std::vector<std::vector<half>> halves;
  for (const ExrChannel& channel : samples) {
    if (state_->type == Imf::HALF) {
      halves.push_back(half_from_float(channel, count));
      frame.insert(channel.name, state_->slice_of(halves.back().data(), sizeof(half)));
    } else {
      frame.insert(channel.name, state_->slice_of(channel.samples, channel.stride * sizeof(float)));
    }
  }
  state_->guarded([&] {
    state_->file->setFrameBuffer(frame);
    state_->file->writePixels(rows);
  });
  state_->next_row += rows;
}

std::size_t ExrFile::commit() {
  state_->file.reset();
  return state_->stream.commit();
}

namespace {

std::size_t write_whole(const std::filesystem::path& path, const Imf::Header& header,
                        const std::vector<ExrChannel>& channels, PixelType type) {
  constexpr int kRowsAtOnce = 256;  // as much as is converted to half at a time
  std::vector<std::string> names;
  for (const ExrChannel& channel : channels) names.push_back(channel.name);
  ExrFile file(path, header, names, type);
  const int width = header.dataWindow().size().x + 1, height = header.dataWindow().size().y + 1;
  std::vector<ExrChannel> rest = channels;
  for (int row = 0; row < height; row += kRowsAtOnce) {
    const int rows = std::min(kRowsAtOnce, height - row);
    file.write(rest, rows);
    for (ExrChannel& channel : rest)
      channel.samples += channel.stride * static_cast<std::size_t>(rows) * static_cast<std::size_t>(width);
  }
  return file.commit();
}

}  // namespace

std::size_t write_exr(const std::filesystem::path& path, const ExrWindow& window,
                      const std::vector<ExrChannel>& channels, const ExrFormat& format,
                      const ExrHeader& header) {
  return write_whole(path, imf_header(window, format, header), channels, format.type);
}

std::size_t write_exr_picture(const std::filesystem::path& path, const Picture& picture, PixelType type,
                              const std::string& colour_interop,
                              const std::optional<Chromaticities>& chromaticities) {
  std::vector<ExrChannel> channels;
  for (const char* name : {"R", "G", "B", "A"})
    channels.push_back({name, picture.pixels.front().data() + channels.size(), 4});
  return write_whole(path, imf_header_of_picture(picture, colour_interop, chromaticities), channels, type);
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

std::optional<Rational> read_frame_rate(const std::filesystem::path& path) try {
  if (!std::filesystem::exists(path)) return std::nullopt;
  const Imf::MultiPartInputFile file(path.c_str());
  const auto* rate = file.header(0).findTypedAttribute<Imf::RationalAttribute>("framesPerSecond");
  if (!rate || rate->value().n <= 0 || rate->value().d == 0) return std::nullopt;
  return Rational{rate->value().n, static_cast<int>(rate->value().d)};
} catch (const std::exception&) {
  return std::nullopt;
}

}  // namespace lensplane
