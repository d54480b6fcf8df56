// SPDX-License-Identifier: Apache-2.0

#include "pipeline/colour/colour_config.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <sstream>

#include "pipeline/colour/builtin_config.h"
#include "pipeline/colour/interop_spaces.h"
#include "pipeline/image/failure.h"

namespace lensplane {
namespace {

namespace OCIO = OCIO_NAMESPACE;

OCIO::ConstConfigRcPtr load_file(const std::string& path, const std::string& named_by) {
  const auto refuse = [&](const std::string& reason) {
    throw Failure(ExitCode::BadInput,
                  fmt::format("{}: the OCIO config that {} names: {}", path, named_by, reason));
  };
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) refuse("no such file");
  try {
    const auto config = OCIO::Config::CreateFromFile(path.c_str());
    config->validate();
    return config;
  } catch (const OCIO::Exception& exception) {
    refuse(exception.what());
  }
  return nullptr;
}

/// From `working` to the grade's space, graded, and back. The file is read when a processor is made of it.
OCIO::GroupTransformRcPtr grade_transform(const Grade& grade, const std::string& working) {
  const auto convert = [](const std::string& from, const std::string& to) {
    const auto transform = OCIO::ColorSpaceTransform::Create();
    transform->setSrc(from.c_str());
    transform->setDst(to.c_str());
    return transform;
  };
  const auto cdl = OCIO::FileTransform::Create();
  cdl->setSrc(std::filesystem::absolute(grade.cdl).c_str());
  cdl->setCCCId(grade.id.empty() ? "0" : grade.id.c_str());  // a name, or a number from 0
  const auto steps = OCIO::GroupTransform::Create();
  steps->appendTransform(convert(working, grade.space));
  steps->appendTransform(cdl);
  steps->appendTransform(convert(grade.space, working));
  return steps;
}

OCIO::ConstProcessorRcPtr view_processor(const OCIO::ConstConfigRcPtr& config, const ViewSettings& view) {
  const auto show = OCIO::DisplayViewTransform::Create();
  show->setSrc(view.working.c_str());
  show->setDisplay(view.display.c_str());
  show->setView(view.view.c_str());
  if (!view.grade) return config->getProcessor(show);
  const auto steps = grade_transform(*view.grade, view.working);
  steps->appendTransform(show);
  return config->getProcessor(steps);
}

OCIO::BitDepth bit_depth(SampleType type) {
  switch (type) {
    case SampleType::UInt8:
      return OCIO::BIT_DEPTH_UINT8;
    case SampleType::UInt16:
      return OCIO::BIT_DEPTH_UINT16;
    case SampleType::Half:
      return OCIO::BIT_DEPTH_F16;
    case SampleType::Float:
      break;
  }
  return OCIO::BIT_DEPTH_F32;
}

/// Applies `processor` to rows of RGBA, in parallel, from one buffer to another, and then `change` to each
/// pixel: a few rows at a time, which stay in the processor's cache meanwhile.
template <class Change>
void apply_rows(const OCIO::ConstCPUProcessorRcPtr& processor, const void* in, SampleType type, int width,
                int height, Rgba* out, Change change) {
  constexpr int kRows = 8;
  const std::size_t row_in = static_cast<std::size_t>(width) * 4 * size_of(type);
  const std::size_t row_out = static_cast<std::size_t>(width);
  tbb::parallel_for(0, (height + kRows - 1) / kRows, [&](int block) {
    const auto first = static_cast<std::size_t>(block) * kRows;
    const long count = std::min<long>(kRows, height - block * kRows);
    auto* source = static_cast<std::byte*>(const_cast<void*>(in)) + first * row_in;
    Rgba* target = out + first * row_out;
    const OCIO::PackedImageDesc from(source, width, count, 4, bit_depth(type), OCIO::AutoStride,
                                     OCIO::AutoStride, OCIO::AutoStride);
    OCIO::PackedImageDesc to(target, width, count, 4, OCIO::BIT_DEPTH_F32, OCIO::AutoStride, OCIO::AutoStride,
                             OCIO::AutoStride);
    processor->apply(from, to);
    std::for_each(target, target + static_cast<std::size_t>(count) * row_out, change);
  });
}

/// Applies `processor` to pixels in place, in parallel. Much of space is nothing at all, and a view takes its
/// time: what that becomes is found out once.
void apply_where_lit(const OCIO::ConstCPUProcessorRcPtr& processor, UnsetVector<Rgba>& pixels) {
  constexpr Rgba kNothing{0, 0, 0, 0};
  constexpr std::size_t kAtOnce = 16384;
  Rgba nothing = kNothing;
  processor->applyRGBA(nothing.data());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pixels.size(), kAtOnce), [&](const auto& range) {
    const auto first = pixels.begin() + static_cast<std::ptrdiff_t>(range.begin());
    const auto end = pixels.begin() + static_cast<std::ptrdiff_t>(range.end());
    std::vector<Rgba> lit;
    std::copy_if(first, end, std::back_inserter(lit), [&](const Rgba& pixel) { return pixel != kNothing; });
    if (!lit.empty()) {
      OCIO::PackedImageDesc image(lit.data(), static_cast<long>(lit.size()), 1, 4);
      processor->apply(image);
    }
    auto next = lit.begin();
    for (auto pixel = first; pixel != end; ++pixel) *pixel = *pixel == kNothing ? nothing : *next++;
  });
}

void premultiply(Rgba& pixel) {
  for (std::size_t c = 0; c < 3; ++c) pixel[c] *= pixel[3];
}

void unpremultiply(Rgba& pixel) {
  if (pixel[3] == 0.0F) return;  // light without cover, of a flame, say: stays as it is
  for (std::size_t c = 0; c < 3; ++c) pixel[c] /= pixel[3];
}

std::vector<std::string> listed(int count, const auto& name_at) {
  std::vector<std::string> names;
  for (int i = 0; i < count; ++i) names.emplace_back(name_at(i));
  return names;
}

}  // namespace

ColourConfig ColourConfig::load(const std::optional<std::string>& path, const char* environment) {
  OCIO::SetLoggingLevel(OCIO::LOGGING_LEVEL_NONE);  // what matters is said by our own lines
  if (path) return ColourConfig(load_file(*path, "colour.config"));
  if (environment && *environment) return ColourConfig(load_file(environment, "$OCIO"));
  std::istringstream builtin(kBuiltinOcioConfig);
  return ColourConfig(OCIO::Config::CreateFromStream(builtin));
}

bool ColourConfig::has_space(const std::string& name) const {
  return config_->getColorSpace(name.c_str()) != nullptr;
}

std::vector<std::string> ColourConfig::spaces() const {
  return listed(config_->getNumColorSpaces(), [this](int i) { return config_->getColorSpaceNameByIndex(i); });
}

std::vector<std::string> ColourConfig::displays() const {
  return listed(config_->getNumDisplays(), [this](int i) { return config_->getDisplay(i); });
}

std::vector<std::string> ColourConfig::views(const std::string& display) const {
  return listed(config_->getNumViews(display.c_str()),
                [&](int i) { return config_->getView(display.c_str(), i); });
}

std::string ColourConfig::space_of_file(const std::string& path, const std::string& interop_id) const {
  if (interop_id.empty() || interop_id == "unknown") return config_->getColorSpaceFromFilepath(path.c_str());
  const auto space = space_of_interop_id(*config_, interop_id);
  if (!space) {
    throw Failure(
        ExitCode::BadInput,
        fmt::format("{}: its colorInteropID \"{}\" is no colour space of the OCIO config; say which "
                    "one it is by space",
                    path, interop_id));
  }
  return *space;
}

std::string ColourConfig::display_interop_id(const std::string& display, const std::string& view) const {
  const std::string named = config_->getDisplayViewColorSpaceName(display.c_str(), view.c_str());
  const std::string space = named == "<USE_DISPLAY_NAME>" ? display : named;
  if (const InteropSpace* known = find_interop_space(*config_, space)) return known->id;
  // Configs before displays had spaces of their own say it by the display's name.
  const auto found = config_->getColorSpace(space.c_str());
  const bool shows_colours = found && !found->isData();
  return shows_colours && display.starts_with("sRGB") ? "srgb_rec709_display" : "";
}

void ColourConfig::check_grade(const Grade& grade) const {
  std::error_code error;
  if (!std::filesystem::is_regular_file(grade.cdl, error))
    throw Failure(ExitCode::BadInput, grade.cdl + ": no such file");
  try {
    config_->getProcessor(grade_transform(grade, grade.space));
  } catch (const OCIO::Exception& exception) {
    throw Failure(ExitCode::BadInput,
                  fmt::format("{}: cannot be read as a CDL: {}", grade.cdl, exception.what()));
  }
}

bool ColourConfig::is_scene_linear(const std::string& space) const {
  const auto found = config_->getColorSpace(space.c_str());
  if (!found || found->isData() || found->getReferenceSpaceType() == OCIO::REFERENCE_SPACE_DISPLAY)
    return false;
  const std::string encoding = found->getEncoding();
  return encoding.empty() || encoding == "scene-linear";
}

// A processor's ID is made from the numbers of its steps; a config's would depend on dates of files, too.
std::string ColourConfig::conversion_id(const std::string& space, const std::string& working) const {
  return config_->getProcessor(space.c_str(), working.c_str())->getCacheID();
}

std::string ColourConfig::view_id(const ViewSettings& view) const {
  return view_processor(config_, view)->getCacheID();
}

std::string ColourConfig::interop_id(const std::string& space) const {
  const InteropSpace* known = find_interop_space(*config_, space);
  return known ? known->id : "";
}

std::optional<Chromaticities> ColourConfig::chromaticities(const std::string& space) const {
  const InteropSpace* known = find_interop_space(*config_, space);
  if (!known || known->curve != InteropSpace::Curve::Linear) return std::nullopt;
  return known->chromaticities;
}

Picture ColourConfig::to_working(const EncodedImage& image, const ImageEncoding& encoding,
                                 const std::string& working) const {
  Picture picture{image.width, image.height, image.x, image.y, image.display_width, image.display_height, {}};
  picture.pixels.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  const auto processor = config_->getProcessor(encoding.space.c_str(), working.c_str());
  const bool has_alpha = image.has_alpha && !encoding.ignore_alpha;
  const bool premultiplied = encoding.premultiplied.value_or(image.premultiplied);
  std::atomic<std::int64_t> not_numbers = 0;
  const auto finish = [&not_numbers, has_alpha, premultiplied](Rgba& pixel) {
    if (!has_alpha) pixel[3] = 1.0F;
    bool is_usual = !has_alpha;  // most pixels are, and one comparison finds all others
    for (const float channel : pixel) is_usual &= std::abs(channel) <= kBrightest;
    if (is_usual) return;
    if (!std::all_of(pixel.begin(), pixel.end(), [](float channel) { return std::isfinite(channel); })) {
      ++not_numbers;
      pixel = {0, 0, 0, std::isfinite(pixel[3]) ? pixel[3] : 1.0F};
    }
    const bool light_without_cover = premultiplied && pixel[3] == 0.0F;
    if (!light_without_cover) premultiply(pixel);
    for (float& channel : pixel) channel = std::clamp(channel, -kBrightest, kBrightest);
  };
  if (has_alpha && premultiplied) {
    // Colours have to be free of alpha while they go through the curves of the space.
    const auto as_stored = OCIO::Config::CreateRaw()->getProcessor("raw", "raw");
    apply_rows(as_stored->getOptimizedCPUProcessor(bit_depth(image.type), OCIO::BIT_DEPTH_F32,
                                                   OCIO::OPTIMIZATION_LOSSLESS),
               image.samples.data(), image.type, image.width, image.height, picture.pixels.data(),
               unpremultiply);
    apply_rows(processor->getDefaultCPUProcessor(), picture.pixels.data(), SampleType::Float, image.width,
               image.height, picture.pixels.data(), finish);
  } else {
    // From 8 and 16 bits OCIO looks the curves up in exact tables.
    constexpr auto kTables = static_cast<OCIO::OptimizationFlags>(OCIO::OPTIMIZATION_LOSSLESS |
                                                                  OCIO::OPTIMIZATION_COMP_SEPARABLE_PREFIX);
    apply_rows(processor->getOptimizedCPUProcessor(bit_depth(image.type), OCIO::BIT_DEPTH_F32, kTables),
               image.samples.data(), image.type, image.width, image.height, picture.pixels.data(), finish);
  }
  picture.not_numbers = not_numbers;
  return picture;
}

Picture ColourConfig::to_space(const Picture& picture, const std::string& working,
                               const std::string& space) const {
  const auto processor = config_->getProcessor(working.c_str(), space.c_str())->getDefaultCPUProcessor();
  Picture encoded = picture;
  apply_rows(processor, picture.pixels.data(), SampleType::Float, picture.width, picture.height,
             encoded.pixels.data(), [](const Rgba&) {});
  return encoded;
}

ViewSettings ColourConfig::default_view(const std::string& working) const {
  const std::string display = config_->getDefaultDisplay();
  return {working, display, config_->getDefaultView(display.c_str())};
}

Picture ColourConfig::to_display(Picture picture, const ViewSettings& view) const {
  const auto processor = view_processor(config_, view)->getDefaultCPUProcessor();
  apply_where_lit(processor, picture.pixels);
  return picture;
}

}  // namespace lensplane
