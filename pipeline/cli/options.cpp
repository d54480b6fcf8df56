// SPDX-License-Identifier: Apache-2.0

#include "pipeline/cli/options.h"

#include <CLI/CLI.hpp>

#include "pipeline/image/failure.h"
#include "pipeline/image/version.h"
#include "pipeline/sequence/plate_margins.h"
#include "pipeline/shot/frame_range.h"
#include "pipeline/shot/layer_files.h"
#include "pipeline/shot/shot_reader.h"
#include "pipeline/shot/shot_scene.h"

namespace lensplane {
namespace {

constexpr int kMaxThreads = 1024;
constexpr int kMaxProxy = 64;

constexpr const char* kExamples = R"(
Examples:
  lensplane check scenes/seed-fig5.yaml                   is the shot right? reads no image
  lensplane plan scenes/seed-fig5.yaml                    what will be simulated, and why
  lensplane probe scenes/seed-fig5.yaml -f 1001 -x 200.5 -y 120     one ray, with all that happens to it
  lensplane render scenes/seed-fig5.yaml                  maps, picture and review picture of every frame
  lensplane render shot.yaml -f 1001-1010 --proxy 4       ten frames at a quarter of the resolution
  lensplane map shot.yaml --output /tmp/maps              only the STMaps, for another compositor
  lensplane comp shot.yaml                                the picture once more from edited maps
  lensplane study scenes/seed-fig6.yaml -f 1001           what accuracy costs in time, method by method
  lensplane export shot.yaml --to chan                    the camera, as a file for other programs
  lensplane export shot.yaml --to nuke                    a script that makes the picture from the maps
  lensplane warp shot.bg.map.1001.exr plate.exr out.exr   any STMap, applied to any image
  lensplane render shot.yaml --set camera.fov="2 deg" --set lenses.near.mass="10 Msun"

Exit codes: 0 done; 1 the shot or the command line is wrong; 2 an input is missing or broken;
            3 an output could not be written; 75 interrupted or worth another try.)";

/// Refuses the empty text, which a script makes of a variable that is not set.
std::string refuse_empty(const std::string& text) {
  return text.empty() ? "it is empty" : "";
}

void add_common(CLI::App& command, Options& options) {
  command.add_option("SHOT", options.shot, "the shot file")->required();
  command
      .add_option("--set", options.settings, "put a value over the shot's: key.path=value; may be repeated")
      ->allow_extra_args(false);
  command.add_option("-f,--frames", options.frames, "the frames: 1001, 1001-1048, 1001-1100x2, with commas")
      ->check(refuse_empty);
  command.add_option("--proxy", options.proxy, "1/N of the resolution, in a folder proxyN of its own")
      ->check(CLI::Range(1, kMaxProxy));
  command.add_flag("--quiet", options.quiet, "say nothing but errors");
}

void add_threads(CLI::App& command, Options& options) {
  command.add_option("--threads", options.threads, "threads to use (else one for each core)")
      ->check(CLI::Range(1, kMaxThreads));
}

void add_rendering(CLI::App& command, Options& options) {
  add_threads(command, options);
  command.add_option("--output", options.output, "the folder for everything that is written")
      ->check(refuse_empty);
  command.add_option("--stats", options.stats, "write seconds and bytes of each phase to this JSON file")
      ->check(refuse_empty);
  command.add_flag("--redo", options.redo, "make again what is already done and right");
}

void add_warp(CLI::App& command, WarpOptions& warp) {
  command.add_option("MAP", warp.map, "an STMap: R = s, G = t, B (or A) = coverage")->required();
  command.add_option("IMAGE", warp.image, "the image that is seen through it")->required();
  command.add_option("OUT", warp.out, "the file to write: .exr, .png or .tif")->required();
  command.add_option("--data", warp.data, "the map's data file, with its jacobian (else the one beside it)")
      ->check(refuse_empty);
  command
      .add_option("--origin", warp.origin,
                  "where t = 0 lies: bottom or top (else as the map says, or bottom)")
      ->check(CLI::IsMember({"bottom", "top"}));
  command.add_option("--edge", warp.edge, "what lies outside the image (else black)")
      ->check(CLI::IsMember({"black", "clamp", "mirror", "repeat", "globe"}));
  command
      .add_option("--filter", warp.filter, "footprint: what a pixel covers (the default); none: one sample")
      ->check(CLI::IsMember({"footprint", "none"}));
  command
      .add_option("--space", warp.space, "the image's colour space (else as its header or the config says)")
      ->check(refuse_empty);
}

}  // namespace

ParsedCommandLine parse_command_line(int argc, const char* const* argv) {
  ParsedCommandLine parsed;
  Options& options = parsed.options;
  CLI::App app("lensplane: gravitational lensing for film production, from a shot file to a lensed picture.",
               "lensplane");
  app.set_version_flag("--version", std::string("lensplane ") + kVersion);
  app.require_subcommand(1);
  app.footer(kExamples);

  CLI::App* check = app.add_subcommand("check", "is the shot right? reads no image");
  CLI::App* plan = app.add_subcommand("plan", "what will be simulated, and why");
  CLI::App* render = app.add_subcommand("render", "everything: maps, composite, review picture");
  CLI::App* map = app.add_subcommand("map", "only the maps and their data files");
  CLI::App* comp = app.add_subcommand("comp", "the picture from the maps on disk, edited ones, for example");
  CLI::App* warp = app.add_subcommand("warp", "apply any STMap to any image");
  CLI::App* probe = app.add_subcommand("probe", "one film position in full");
  CLI::App* exporting = app.add_subcommand("export", "the shot's camera, or its maps, for other programs");
  CLI::App* study = app.add_subcommand("study", "what accuracy costs in time: tables, plot, page");
  const std::pair<CLI::App*, Command> commands[] = {{check, Command::Check},      {plan, Command::Plan},
                                                    {render, Command::Render},    {map, Command::Map},
                                                    {comp, Command::Comp},        {probe, Command::Probe},
                                                    {exporting, Command::Export}, {study, Command::Study}};
  for (const auto& [app_of, command] : commands) {
    add_common(*app_of, options);
    app_of->footer(kExamples);
    app_of->callback([&options, command = command] { options.command = command; });
  }
  for (CLI::App* command : {render, map, comp}) add_rendering(*command, options);
  exporting
      ->add_option("--to", options.to,
                   "chan: the camera; nuke, blender, oiio: a script that makes the picture from the maps")
      ->required()
      ->check(CLI::IsMember({"chan", "nuke", "blender", "oiio"}));
  exporting->add_option("--output", options.output, "the folder for what is written (else that of the maps)")
      ->check(refuse_empty);
  add_threads(*study, options);
  study
      ->add_option("--output", options.output,
                   "the folder in which the study's own is made (else that of the shot's output)")
      ->check(refuse_empty);
  for (CLI::App* command : {plan, probe}) command->add_flag("--json", options.json, "for programs: as JSON");
  warp->callback([&options] { options.command = Command::Warp; });
  warp->footer(kExamples);
  add_warp(*warp, options.warp);
  add_threads(*warp, options);
  warp->add_flag("--quiet", options.quiet, "say nothing but errors");
  probe->add_option("-x", options.x, "pixels from the left of the frame, fractions allowed")->required();
  probe->add_option("-y", options.y, "pixels from the top of the frame, fractions allowed")->required();

  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    const auto chosen = app.get_subcommands();
    parsed.text = chosen.empty() ? app.help() : chosen.front()->help();
  } catch (const CLI::CallForVersion& version) {
    parsed.text = std::string(version.what()) + "\n";
  } catch (const CLI::Error& error) {
    throw Failure(ExitCode::BadShot, "lensplane: " + std::string(error.what()) + "; see lensplane --help");
  }
  return parsed;
}

Shot shot_of(const Options& options) {
  Shot shot = read_shot(options.shot, options.settings);
  // Quick looks must not overwrite the frames that they are looks at.
  if (options.proxy > 1) shot.output.directory /= "proxy" + std::to_string(options.proxy);
  if (!options.output.empty()) shot.output.directory = options.output;
  put_plates(shot);
  return with_overscan(proxy_of(std::move(shot), options.proxy));
}

std::vector<int> frames_of(const Options& options, const Shot& shot) {
  if (options.frames.empty()) return shot.frames;
  const ParsedFrames parsed = parse_frames(options.frames);
  if (!parsed.error.empty()) throw Failure(ExitCode::BadShot, "-f: " + parsed.error);
  return parsed.frames;
}

}  // namespace lensplane
