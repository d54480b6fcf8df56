// SPDX-License-Identifier: Apache-2.0

#include "pipeline/povray/povray.h"

#include <OpenEXR/ImfArray.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <fmt/format.h>

#include <cmath>
#include <fstream>

#include "pipeline/image/failure.h"
#include "pipeline/povray/povray_log.h"
#include "pipeline/povray/process.h"

namespace lensplane {
namespace {

constexpr const char* kPicture = "picture.exr";
constexpr double kProbeTimeout_s = 60.0;

std::vector<std::string> words_of(const PovRayJob& job) {
  std::vector<std::string> words = {"povray",
                                    "+I" + job.scene.string(),
                                    "+L" + job.scene.parent_path().string(),
                                    std::string("+O") + kPicture,
                                    "+FE",  // EXR: half, linear
                                    "+UA",  // with alpha
                                    "-D",   // Debian's settings would show it
                                    "-P",
                                    "-C",    // from the beginning
                                    "+V",    // with progress
                                    "+WT1",  // more threads give another picture each time
                                    fmt::format("+W{}", job.width),
                                    fmt::format("+H{}", job.height),
                                    fmt::format("+K{:.17g}", job.clock)};
  if (job.antialias > 1) {
    for (const std::string& word :
         {std::string("+A0.05"), std::string("+AM1"), fmt::format("+R{}", job.antialias), std::string("-J")})
      words.push_back(word);
  } else {
    words.push_back("-A");
  }
  return words;
}

Picture read_picture(const std::filesystem::path& path, const PovRayJob& job) {
  try {
    Imf::RgbaInputFile file(path.c_str());
    const Imath::Box2i window = file.dataWindow();
    const int width = window.max.x - window.min.x + 1, height = window.max.y - window.min.y + 1;
    if (width != job.width || height != job.height)
      throw Failure(ExitCode::BadInput, fmt::format("a picture of {} x {} pixels", width, height));
    Imf::Array2D<Imf::Rgba> pixels(height, width);
    file.setFrameBuffer(&pixels[0][0] - window.min.x - static_cast<std::ptrdiff_t>(window.min.y) * width, 1,
                        static_cast<std::size_t>(width));
    file.readPixels(window.min.y, window.max.y);
    Picture picture{{width, height, 0, 0, width, height}, {}, 0};
    for (int row = 0; row < height; ++row) {
      for (int column = 0; column < width; ++column) {
        const Imf::Rgba& p = pixels[row][column];
        picture.pixels.push_back({p.r, p.g, p.b, p.a});
      }
    }
    return picture;
  } catch (const std::exception& error) {
    throw Failure(ExitCode::BadInput, fmt::format("POV-Ray's picture cannot be read: {}", error.what()));
  }
}

/// The words of version `text`, "3.7.0.10.unofficial", or nothing.
std::string version_in(const std::string& line) {
  constexpr std::string_view kName = "POV-Ray ";
  if (!line.starts_with(kName)) return {};
  const std::string version = line.substr(kName.size());
  return version.substr(0, version.find(' '));
}

bool is_new_enough(const std::string& version) {
  int major = 0, minor = 0;
  return std::sscanf(version.c_str(), "%d.%d", &major, &minor) == 2 &&
         (major > 3 || (major == 3 && minor >= 7));
}

/// Two rows of rays, upwards to the light and down into the dark: does the second row see the dark?
bool repeats_row(const std::filesystem::path& folder) {
  std::ofstream(folder / "probe.pov") << R"(#version 3.7; global_settings { assumed_gamma 1.0 }
sphere { <0, 0, 10>, 5 pigment { rgb 1 } finish { emission 1 ambient 0 diffuse 0 } }
#declare Rays = mesh2 { vertex_vectors { 6, <-1,-1,0>, <1,0,0>, <0,1,0>, <-1,-1,0>, <0,1,0>, <1,0,0> }
face_indices { 2, <0,2,1>, <3,5,4> } }
camera { mesh_camera { 1 0 mesh { Rays } } direction <0, 0, -1> }
)";
  const PovRayJob job{folder / "probe.pov", folder, 1, 2, 1, 0.0, kProbeTimeout_s};
  const Picture picture = render_by_povray(job, {}).picture;
  return picture.at(0, 0) == picture.at(0, 1);
}

}  // namespace

PovRay find_povray(const std::filesystem::path& folder, bool mesh) {
  PovRay found;
  const auto deadline = PovRayLog::Clock::now() + std::chrono::duration<double>(kProbeTimeout_s);
  const ProcessEnd end = run_process(
      {{"povray", "--version"}, folder},
      [&](const std::string& line) {
        if (found.version.empty()) found.version = version_in(line);
      },
      [&] { return PovRayLog::Clock::now() < deadline ? Watch::GoOn : Watch::Kill; });
  if (!end.started)
    throw Failure(ExitCode::BadInput, "povray: no such program in $PATH; Debian's package is povray");
  if (!is_new_enough(found.version)) {
    throw Failure(ExitCode::BadInput, fmt::format("povray: {}; needed: POV-Ray 3.7 or later",
                                                  found.version.empty() ? "it does not say its version"
                                                                        : "version " + found.version));
  }
  if (mesh) found.repeats_row = repeats_row(folder);
  return found;
}

PovRayPicture render_by_povray(const PovRayJob& job, const PovRayHooks& hooks) {
  PovRayLog log;
  bool stopped = false;
  const ProcessEnd end = run_process(
      {words_of(job), job.folder},
      [&](const std::string& line) {
        log.add(line, PovRayLog::Clock::now());
        hooks.say(line);
      },
      [&] {
        stopped = hooks.stop();
        const std::chrono::duration<double> idle = PovRayLog::Clock::now() - log.last_progress();
        return stopped || idle.count() > job.timeout_s ? Watch::Kill : Watch::GoOn;
      });
  if (stopped)
    throw Failure(ExitCode::TryAgain,
                  "interrupted while POV-Ray worked; the same command goes on from there");
  const auto fail = [&](const std::string& how) {
    throw Failure(ExitCode::BadInput, fmt::format("{}: POV-Ray {}", job.scene.string(), how));
  };
  if (!end.started) fail("is no longer there");
  if (end.killed)
    fail(fmt::format("made no progress for {:g} s and was ended; its last words: {}", job.timeout_s,
                     log.last_lines()));
  if (end.signal != 0)
    fail(fmt::format("was ended by signal {}; its last words: {}", end.signal, log.last_lines()));
  if (end.exit_code != 0) fail("says: " + log.complaint());
  return {read_picture(job.folder / kPicture, job), log.warnings()};
}

}  // namespace lensplane
