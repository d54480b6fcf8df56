// SPDX-License-Identifier: Apache-2.0
//
// The command line: what was asked for.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/shot/shot.h"

namespace lensplane {

enum class Command { Check, Plan, Render, Map, Comp, Warp, Probe, Export, Study };

/// Of lensplane warp.
struct WarpOptions {
  std::string map;
  std::string image;
  std::string out;
  std::string data;                  // a data file; empty: the one beside the map, if there is one
  std::string origin;                // where t = 0 lies: "bottom", "top"; empty: as the map says
  std::string edge = "black";        // what lies outside the image
  std::string filter = "footprint";  // "none": a single sample for each pixel
  std::string space;                 // the image's colour space; empty: as its header or the config says
};

struct Options {
  Command command = Command::Check;
  std::string shot;
  std::string frames;                 // as parse_frames reads them; empty: the shot's own
  std::vector<std::string> settings;  // key.path=value
  int proxy = 1;
  int threads = 0;  // 0: as many as there are cores
  std::string output;
  std::string stats;
  bool quiet = false;
  bool redo = false;
  bool json = false;
  std::string x, y;         // of a probe, as written
  std::string to = "chan";  // what is exported
  WarpOptions warp;
};

/// What parsing a command line leads to: options, or text to print and leave with Done.
struct ParsedCommandLine {
  Options options;
  std::optional<std::string> text;  // --help, --version
};

/// Throws Failure (BadShot) when the command line is wrong.
ParsedCommandLine parse_command_line(int argc, const char* const* argv);

/// The shot that the options ask for: read, with --set, --proxy and --output applied. Throws Failure.
Shot shot_of(const Options& options);

/// The frames that the options ask for. Throws Failure (BadShot).
std::vector<int> frames_of(const Options& options, const Shot& shot);

}  // namespace lensplane
