// SPDX-License-Identifier: Apache-2.0

#include "pipeline/cli/export.h"

#include <cstdio>

#include "pipeline/image/atomic_file.h"
#include "pipeline/image/failure.h"
#include "pipeline/shot/camera_file.h"

namespace lensplane {

void run_export(const Options& options) {
  const Shot shot = shot_of(options);
  const std::vector<int> frames = frames_of(options, shot);
  if (shot.camera.projection != Projection::Perspective)
    throw Failure(ExitCode::BadShot,
                  shot.file + ": camera.projection: .chan files are of perspective cameras only");
  const std::filesystem::path path = shot.output.directory / (shot.name + ".chan");
  std::error_code error;
  if (shot.camera.from && std::filesystem::equivalent(path, shot.camera.from->path.text, error))
    throw Failure(
        ExitCode::BadShot,
        path.string() + ": the shot reads this file and would overwrite it; choose another --output");
  write_atomically(path, chan_text(chan_of_camera(shot, frames)));
  if (!options.quiet) std::fputs((path.string() + "\n").c_str(), stdout);
}

}  // namespace lensplane
