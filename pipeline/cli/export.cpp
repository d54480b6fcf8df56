// SPDX-License-Identifier: Apache-2.0

#include "pipeline/cli/export.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>

#include "pipeline/colour/builtin_config.h"
#include "pipeline/handoff/blender_script.h"
#include "pipeline/handoff/nuke_script.h"
#include "pipeline/handoff/oiio_commands.h"
#include "pipeline/image/atomic_file.h"
#include "pipeline/image/failure.h"
#include "pipeline/image/frame_path.h"
#include "pipeline/sequence/overwriting.h"
#include "pipeline/sequence/shot_colours.h"
#include "pipeline/shot/camera_file.h"

namespace lensplane {
namespace {

void say(const Options& options, const std::string& line) {
  if (!options.quiet) std::fputs((line + "\n").c_str(), stdout);
}

void export_camera(const Options& options, const Shot& shot, const std::vector<int>& frames,
                   const std::filesystem::path& folder) {
  if (shot.camera.projection != Projection::Perspective)
    throw Failure(ExitCode::BadShot,
                  shot.file + ": camera.projection: .chan files are of perspective cameras only");
  const std::filesystem::path path = folder / (shot.name + ".chan");
  refuse_overwriting_inputs(shot, frames, {path});
  write_atomically(path, chan_text(chan_of_camera(shot, frames)));
  say(options, path.string());
}

/// A program that goes on with maps.
struct Receiver {
  const char* name;  // of --to
  const char* ending;
  const char* picture;  // ending of what it makes
  std::string (*script)(const Handoff&);
};

constexpr Receiver kReceivers[] = {
    {"nuke", ".nk", ".nuke.####.exr", nuke_script},
    {"blender", ".blender.py", ".blender.####.exr", blender_script},
    {"oiio", ".oiio.json", ".oiio.####.exr", oiio_commands},
};

/// The OCIO config that a script names, from its folder; the built-in one is written beside it.
struct ConfigFile {
  std::string name;
  bool is_builtin = false;
};

ConfigFile config_of(const Shot& shot, const std::filesystem::path& folder) {
  if (shot.colour.config) return {relative_to(shot.colour.config->text, folder)};
  const char* environment = std::getenv("OCIO");
  if (environment && *environment) return {relative_to(environment, folder)};
  return {shot.name + ".ocio", true};
}

void export_maps(const Options& options, const Receiver& receiver, const Shot& shot,
                 const std::vector<int>& frames, const std::filesystem::path& folder) {
  const ConfigFile config = config_of(shot, folder);
  const std::filesystem::path script = folder / (shot.name + receiver.ending);
  std::vector<std::filesystem::path> outputs = {script};
  if (config.is_builtin) outputs.push_back(folder / config.name);
  for (const int frame : frames)
    outputs.push_back(folder / path_of_frame(shot.name + receiver.picture, frame));
  refuse_overwriting_inputs(shot, frames, outputs);

  Handoff handoff = hand_off(shot, frames, folder, load_colours(shot, std::getenv("OCIO")));
  handoff.config = config.name;
  const std::string text = receiver.script(handoff);
  if (config.is_builtin) write_atomically(folder / config.name, std::string_view(kBuiltinOcioConfig));
  write_atomically(script, text);

  std::vector<std::string> missing = left_out(handoff);
  const bool is_oiio = receiver.script == oiio_commands;
  if (is_oiio) {
    for (std::string& words : left_out_by_oiiotool(handoff)) missing.push_back(std::move(words));
  }
  if (!missing.empty()) say(options, fmt::format("left out: {}", fmt::join(missing, ", ")));
  const auto reordered = reordered_at(handoff);
  if (reordered && !is_oiio)
    say(options,
        fmt::format("the depth order of the layers changes at frame {}; the script has that of frame {}",
                    *reordered, frames.front()));
  say(options, script.string());
}

}  // namespace

void run_export(const Options& options) {
  // --output says where the file goes; the maps stay where they are.
  Options of_shot = options;
  of_shot.output.clear();
  const Shot shot = shot_of(of_shot);
  const std::vector<int> frames = frames_of(options, shot);
  const std::filesystem::path folder =
      options.output.empty() ? shot.output.directory.string() : options.output;
  for (const Receiver& receiver : kReceivers) {
    if (options.to == receiver.name) return export_maps(options, receiver, shot, frames, folder);
  }
  export_camera(options, shot, frames, folder);
}

}  // namespace lensplane
