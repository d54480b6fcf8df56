// SPDX-License-Identifier: Apache-2.0

#include "pipeline/study/picture_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/composite/compositor.h"
#include "pipeline/sequence/frame_looks.h"
#include "pipeline/shot/shot_scene.h"
#include "pipeline/study/trace_study.h"
#include "pipeline/study/true_pixels.h"
#include "src/film_grid.h"

namespace lensplane {
namespace {

bool same(const PictureRow& a, const PictureRow& b) {
  return a.sampling.max == b.sampling.max &&
         (a.sampling.max == 1 || a.sampling.threshold == b.sampling.threshold) &&
         a.trace.method == b.trace.method && a.trace.tolerance_px == b.trace.tolerance_px;
}

/// The shot's own way first, then from one ray a pixel to as many as there may be, then tolerances of the
/// trace.
std::vector<PictureRow> rows_of(const Shot& shot, int frame) {
  TraceSettings trace = trace_at(shot, frame);
  trace.effects = {};
  const SamplingSettings& own = shot.sampling;
  std::vector<PictureRow> rows = {{{own.max, own.threshold}, trace, true}};
  const auto add = [&](const Sampling& sampling, const TraceSettings& settings) {
    const PictureRow row{sampling, settings};
    if (std::none_of(rows.begin(), rows.end(), [&](const PictureRow& r) { return same(r, row); }))
      rows.push_back(row);
  };
  for (const int max : {1, 4, 16, kMostSamples}) add({max, own.threshold}, trace);
  for (const double threshold : {0.016, 0.001}) add({kMostSamples, threshold}, trace);
  if (trace.method != Method::Planes || trace.law) return rows;
  for (const double tolerance : {1.0, 0.001}) {
    TraceSettings other = trace;
    other.tolerance_px = tolerance;
    add({own.max, own.threshold}, other);
  }
  return rows;
}

Tracer tracer_of(const Scene& scene, TraceSettings settings) {
  settings.effects = {};
  settings.effects.jacobian = true;
  return {scene, plan_trace(scene, settings)};
}

/// Rays that are traced in a second, from a few of the frame's.
double rays_per_second(const Scene& scene, const Tracer& tracer, const StudyEffort& effort) {
  const FilmGrid grid = grid_of(scene.camera, rays_of(effort, scene.lenses.size()));
  double seconds = 0;
  timed(seconds, [&] { return trace_grid(tracer, grid); });
  return grid.count() / seconds;
}

/// How many squares of true pixels are made each way: fewer where rays cost more, so that they take some
/// seconds.
int tiles_of(const Scene& scene, const Tracer& tracer, const StudyEffort& effort) {
  constexpr double kFast = 3e6;  // rays per second with which all squares are made
  const double share = std::min(1.0, rays_per_second(scene, tracer, effort) / kFast);
  return std::max(1, static_cast<int>(effort.truth_tiles * std::sqrt(share)));
}

}  // namespace

double guess_picture_s(const Shot& shot, int frame, const StudyEffort& effort) {
  const Scene scene = scene_at(shot, frame);
  const Tracer tracer = tracer_of(scene, trace_at(shot, frame));
  return static_cast<double>(scene.camera.full_width()) * scene.camera.full_height() /
         rays_per_second(scene, tracer, effort);
}

void study_pictures(const Shot& shot, ShotAssets& assets, int frame, const StudyEffort& effort,
                    const StudyHooks& hooks, Study& study) {
  hooks.doing("pictures: reading images");
  const Scene scene = scene_at(shot, frame);
  const std::vector<SurfaceLook> looks = looks_at(shot, scene, assets.textures, frame, frame);
  const std::vector<PictureRow> rows = rows_of(shot, frame);
  hooks.doing("pictures: the truth, by many rays");
  TraceSettings finest = rows.front().trace;
  if (finest.method == Method::Planes) finest.law = Law::Exact, finest.finite_distance = Choice::On;
  const Tracer true_tracer = tracer_of(scene, finest);
  const auto truth = true_tiles(true_tracer, looks, tiles_of(scene, true_tracer, effort), effort.truth_rays);
  study.truth_rays = effort.truth_rays * effort.truth_rays;
  for (const TrueTile& tile : truth) study.truth_pixels += tile.size * tile.size;
  const double pixels = static_cast<double>(scene.camera.full_width()) * scene.camera.full_height();
  double spent = 0;
  for (PictureRow row : rows) {
    if ((study.interrupted = hooks.stop())) return;
    if (spent > effort.pictures_s) {
      study.notes.push_back(
          fmt::format("{} of {} ways of sampling the picture are left out: the others took {:.0f} s",
                      rows.size() - study.pictures.size(), rows.size(), spent));
      return;
    }
    hooks.doing(fmt::format("picture {} of {}: up to {} rays", study.pictures.size() + 1, rows.size(),
                            row.sampling.max));
    const Tracer tracer = tracer_of(scene, row.trace);
    const PeakMemory memory;
    Composite result;
    row.timing = time_repeatedly(effort.repeats, [&] {
      result = {};  // or two pictures would be in memory
      result = composite(tracer, looks, row.sampling);
    });
    spent += row.timing.median_s * row.timing.repeats;
    row.peak_bytes = memory.bytes();
    row.rays_per_pixel = static_cast<double>(result.rays) / pixels;
    row.psnr_db = psnr_of(result.picture, truth);
    study.pictures.push_back(row);
  }
}

}  // namespace lensplane
