// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/render_frame.h"

#include "pipeline/sequence/make_maps.h"
#include "pipeline/sequence/make_picture.h"
#include "pipeline/sequence/side_by_side.h"

namespace lensplane {

FrameReport render_frame(const Shot& shot, const ColourConfig& colours, ShotAssets& assets, int frame,
                         const FrameTasks& tasks) {
  FrameReport report;
  report.frame = frame;
  timed(report.seconds, [&] {
    const FrameSetup setup = set_up_frame(shot, colours, assets.textures, frame, tasks);
    const bool maps_done = setup.maps.empty() && setup.data.empty() && !setup.shadow;
    report.already_done = maps_done && !setup.picture;
    FrameReport of_maps;
    EmptySpace empty;
    std::vector<SurfaceLook> looks;
    side_by_side(
        [&] {
          if (!maps_done) empty = make_maps(shot, frame, setup, of_maps);
        },
        [&] {
          if (setup.picture) looks = load_picture(shot, assets, frame, setup, report);
        });
    add_costs(of_maps, report);
    if (setup.picture) make_picture(shot, colours, assets, frame, tasks, setup, looks, empty, report);
    if (tasks.picture && !setup.picture) report.amplifications = kept_amplifications(shot, frame);
  });
  return report;
}

}  // namespace lensplane
