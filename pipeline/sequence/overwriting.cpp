// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/overwriting.h"

#include <filesystem>
#include <set>

#include "pipeline/image/failure.h"
#include "pipeline/image/frame_path.h"
#include "pipeline/image/shipped.h"
#include "pipeline/sequence/output_paths.h"
#include "pipeline/shot/layer_files.h"

namespace lensplane {
namespace {

/// One spelling for each file, links followed as far as the path exists.
std::string spelled(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::weakly_canonical(std::filesystem::absolute(path, error), error).string();
}

std::set<std::string> outputs_of(const Shot& shot, const std::vector<int>& frames) {
  // All of them lie in one folder, whose links need to be followed only once.
  Shot here = shot;
  here.output.directory = spelled(shot.output.directory);
  std::set<std::string> outputs;
  for (const int frame : frames) {
    outputs.insert(picture_path(here, frame).string());
    outputs.insert(review_path(here, frame).string());
    outputs.insert(shadow_path(here, frame).string());
    for (const Layer& layer : shot.layers) {
      outputs.insert(map_path(here, layer.name, frame).string());
      outputs.insert(data_path(here, layer.name, frame).string());
      if (layer.povray) outputs.insert(plate_path(here, layer.name, frame).string());
    }
  }
  return outputs;
}

std::set<std::string> inputs_of(const Shot& shot, const std::vector<int>& frames) {
  std::set<std::string> inputs = {spelled(shot.file)};
  if (shot.colour.config) inputs.insert(spelled(shot.colour.config->text));
  if (shot.camera.from && !shot.camera.from->is_plate) inputs.insert(spelled(shot.camera.from->path.text));
  if (shot.colour.grade) inputs.insert(spelled(shot.colour.grade->cdl.text));
  for (const Layer& layer : shot.layers) {
    for (const LocatedText* file : files_of(layer)) {
      const std::string pattern = spelled(resolve_shipped(file->text));
      if (!is_sequence(pattern)) inputs.insert(pattern);
      for (std::size_t i = 0; is_sequence(pattern) && i < frames.size(); ++i) {
        inputs.insert(path_of_frame(pattern, frames[i]));
      }
    }
  }
  return inputs;
}

}  // namespace

void refuse_overwriting_inputs(const Shot& shot, const std::vector<int>& frames,
                               const std::vector<std::filesystem::path>& outputs) {
  const std::set<std::string> inputs = inputs_of(shot, frames);
  for (const std::filesystem::path& output : outputs) {
    if (inputs.contains(spelled(output)))
      throw Failure(ExitCode::BadShot,
                    output.string() +
                        ": the shot reads this file and would overwrite it; choose another "
                        "--output");
  }
}

void refuse_overwriting(const Shot& shot, const std::vector<int>& frames, const std::string& statistics) {
  const auto refuse = [](const std::string& path, const std::string& why) {
    throw Failure(ExitCode::BadShot,
                  path + ": " + why + "; choose another output.directory, --output or --stats");
  };
  const std::set<std::string> outputs = outputs_of(shot, frames);
  const std::set<std::string> inputs = inputs_of(shot, frames);
  for (const std::string& input : inputs) {
    if (outputs.contains(input)) refuse(input, "the shot reads this file and would overwrite it");
  }
  if (statistics.empty()) return;
  if (inputs.contains(spelled(statistics)))
    refuse(statistics, "the shot reads this file and --stats would overwrite it");
  if (outputs.contains(spelled(statistics)))
    refuse(statistics, "the shot writes this file and --stats would overwrite it");
}

}  // namespace lensplane
