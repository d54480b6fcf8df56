// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/make_review.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "pipeline/colour/icc_profile.h"
#include "pipeline/composite/compositor.h"
#include "pipeline/composite/locator.h"
#include "pipeline/image/display_writer.h"
#include "pipeline/sequence/output_paths.h"
#include "pipeline/sequence/shot_colours.h"

namespace lensplane {
namespace {

/// The display window of a picture, without its overscan.
Picture display_window(const Picture& picture) {
  Picture window{picture.display_width, picture.display_height, 0, 0,
                 picture.display_width, picture.display_height, {}};
  window.pixels.resize(static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height));
  tbb::parallel_for(0, window.height, [&](int row) {
    std::copy_n(&picture.at(-picture.x, row - picture.y), window.width, &window.at(0, row));
  });
  return window;
}

Picture beside(const Picture& left, const Picture& right) {
  Picture both{left.width + right.width, left.height, 0, 0, left.width + right.width, left.height, {}};
  for (int row = 0; row < both.height; ++row) {
    for (const Picture* part : {&left, &right}) {
      both.pixels.insert(both.pixels.end(), &part->at(0, row), &part->at(0, row) + part->width);
    }
  }
  return both;
}

}  // namespace

void make_review(const Shot& shot, const ColourConfig& colours, int frame, const FrameSetup& setup,
                 const Picture& picture, const std::vector<SurfaceLook>& looks, FrameReport& report) {
  Picture shown = display_window(picture);
  expose(value_at(shot.output.review_exposure, frame), shown);
  if (shot.output.locator == Locator::Beside) {
    const LocatorView locator = make_locator(setup.scene, looks);
    TraceSettings settings;
    settings.method = setup.plan.method;
    settings.effects.jacobian = true;
    const Tracer tracer(locator.scene, plan_trace(locator.scene, settings));
    const Composite view =
        timed(report[Phase::Composite].seconds, [&] { return composite(tracer, locator.looks, {}); });
    shown = beside(shown, display_window(view.picture));
  }
  const Picture display =
      timed(report[Phase::View].seconds, [&] { return colours.to_display(std::move(shown), view_of(shot)); });
  report[Phase::View].bytes += display.pixels.size() * sizeof(Rgba);
  report[Phase::Write].bytes += timed(report[Phase::Write].seconds, [&] {
    const std::string interop = colours.display_interop_id(shot.colour.display.text, shot.colour.view.text);
    return write_display(review_path(shot, frame), display, *shot.output.review == ReviewFormat::Png ? 8 : 16,
                         {setup.review_parameters, interop, icc_profile(interop)});
  });
}

}  // namespace lensplane
