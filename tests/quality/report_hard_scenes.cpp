// SPDX-License-Identifier: Apache-2.0

#include <OpenImageIO/imagebuf.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/quality/hard_scenes.h"
#include "tests/quality/reports.h"
#include "tests/quality/scores.h"

namespace lensplane {
namespace {

void write(const std::filesystem::path& path, const Picture& picture) {
  const OIIO::ImageSpec spec(picture.width, picture.height, 4, OIIO::TypeDesc::FLOAT);
  OIIO::ImageBuf image(spec, const_cast<float*>(picture.pixels.front().data()));
  image.write(path.string());
}

/// Ten times the difference, as grey.
Picture difference(const Picture& a, const Picture& b) {
  Picture result = a;
  for (std::size_t i = 0; i < result.pixels.size(); ++i) {
    float most = 0;
    for (std::size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(a.pixels[i][c] - b.pixels[i][c]));
    result.pixels[i] = {10 * most, 10 * most, 10 * most, 1};
  }
  return result;
}

void write_errors(const std::filesystem::path& folder, std::string name, const Frame& frame) {
  std::replace(name.begin(), name.end(), ' ', '-');
  std::filesystem::create_directories(folder);
  write(folder / (name + ".truth.exr"), frame.truth.by_pixel_filter);
  const Picture truth = clipped(frame.truth.by_pixel_filter);
  const std::vector<std::pair<const char*, const Picture*>> ours = {
      {"render", &frame.render}, {"comp", &frame.comp}, {"warp", &frame.warp}};
  for (const auto& [way, picture] : ours) {
    write(folder / fmt::format("{}.{}.exr", name, way), *picture);
    write(folder / fmt::format("{}.{}-off.exr", name, way), difference(clipped(*picture), truth));
  }
}

/// The better of the two truths: a peer's filter may be another.
double best(const std::vector<const Picture*>& pictures, const Truth& truth, double peak) {
  double best = 0;
  for (const Picture* picture : pictures) {
    for (const Picture* right : {&truth.by_pixel_filter, &truth.by_box})
      best = std::max(best, psnr(squares(*picture, *right), peak));
  }
  return best;
}

double largest_off(const Picture& picture, const Picture& truth) {
  const std::vector<double> off = squares(picture, truth);
  return std::sqrt(*std::max_element(off.begin(), off.end()));
}

void print_row(const std::string& name, const Frame& frame, double peak) {
  const Picture& truth = frame.truth.by_pixel_filter;
  const auto ours = [&](const Picture& picture) { return psnr(squares(picture, truth), peak); };
  fmt::print("| {} | {:.1f} | {:.3f} | {:.1f} | {:.3f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} |\n", name,
             ours(frame.render), largest_off(frame.render, truth) / peak, ours(frame.comp),
             largest_off(frame.comp, truth) / peak, ours(frame.warp),
             best({&frame.st_warp[0], &frame.st_warp[1]}, frame.truth, peak),
             best({&frame.area}, frame.truth, peak), best({&frame.supersampled}, frame.truth, peak));
  std::fflush(stdout);
}

Frame clipped(Frame frame) {
  for (Picture* picture :
       {&frame.truth.by_pixel_filter, &frame.truth.by_box, &frame.render, &frame.comp, &frame.warp,
        &frame.st_warp[0], &frame.st_warp[1], &frame.area, &frame.supersampled})
    *picture = clipped(std::move(*picture));
  return frame;
}

}  // namespace

void report_hard_scenes(const std::filesystem::path& errors) {
  fmt::print(
      "| scene, dB | render | worst | comp | worst | warp | st_warp | area filter | supersampling |\n");
  fmt::print("|---|---|---|---|---|---|---|---|---|\n");
  for (const HardScene& hard : hard_scenes()) {
    const Frame frame = make_frame(hard.scene, hard.surfaces);
    const double peak = std::max(1.0, brightest(frame.truth.by_pixel_filter));
    print_row(hard.name, frame, peak);
    if (peak > 1.5) print_row("the same, clipped at 1", clipped(frame), 1);
    if (!errors.empty()) write_errors(errors, hard.name, frame);
  }
}

}  // namespace lensplane
