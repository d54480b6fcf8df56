// SPDX-License-Identifier: Apache-2.0
//
// How good pictures are: ours and those of peers against the truth, as tables.
//
// Run by hand; docs/performance.md holds its results. PSNR in decibels of linear light. Peers get our map
// with all its digits, and of the two truths the one that favours them.
//
//   picture_quality [plates] [stills] [hard] [small] [FOLDER]
//
// Without names all tables are made. `stills`: plates without moving lenses. FOLDER: where the hard scenes'
// pictures and their errors are written.

#include <set>
#include <string>

#include "tests/quality/reports.h"

int main(int count, char** arguments) {
  std::set<std::string> names(arguments + 1, arguments + count);
  std::string folder;
  for (const std::string& name : names) {
    if (name.find('/') != std::string::npos) folder = name;
  }
  names.erase(folder);
  const auto wanted = [&](const char* name) { return names.empty() || names.count(name) > 0; };
  if (wanted("hard")) lensplane::report_hard_scenes(folder);
  if (wanted("small")) lensplane::report_small_things();
  if (wanted("plates") || wanted("stills")) lensplane::report_plates(names.count("stills") == 0);
}
