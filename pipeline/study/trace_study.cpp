// SPDX-License-Identifier: Apache-2.0

#include "pipeline/study/trace_study.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

#include "pipeline/shot/shot_scene.h"
#include "pipeline/study/worst_place.h"
#include "src/lens_map.h"
#include "src/schwarzschild_sky.h"
#include "src/sight.h"

namespace lensplane {
namespace {

constexpr double kReferencePx = 1e-8;    // the reference's tolerance...
constexpr double kReferenceRad = 1e-14;  // ...unless rounding is more
constexpr double kLooser = 100;          // the tolerance that tells how good it is
constexpr int kFewMasses = 4;            // up to here curved rays cost about the same
constexpr int kFewestRays = 256;

/// The surfaces that a study compares say where light comes from; their effects only what that takes.
TraceSettings to_compare(TraceSettings settings) {
  settings.effects = {};
  settings.effects.direction = true;
  return settings;
}

TraceSettings curved(double tolerance_px) {
  TraceSettings settings;
  settings.method = Method::Geodesic;
  settings.tolerance_px = tolerance_px;
  return to_compare(settings);
}

TraceSettings everything_on() {
  return to_compare({Method::Planes, Law::Exact, TraceSettings().tolerance_px, Choice::On, {}});
}

std::vector<RayError> errors_of(const Tracer& tracer, const FilmGrid& grid, const std::vector<TraceBatch>& a,
                                const std::vector<TraceBatch>& b) {
  std::vector<RayError> errors;
  for (std::size_t n = 0; n < static_cast<std::size_t>(grid.count()); ++n)
    errors.push_back(error_of_ray(tracer, a[n / kBatchSize], b[n / kBatchSize], n % kBatchSize));
  return errors;
}

std::size_t count_masses(const Scene& scene) {
  return static_cast<std::size_t>(
      std::count_if(scene.lenses.begin(), scene.lenses.end(), [](const Lens& lens) { return lens.m > 0.0; }));
}

/// How far curved rays round the only mass are from the closed form, in pixels of the sky.
std::optional<ErrorSummary> check_by_closed_form(Scene scene, const TraceSettings& settings,
                                                 const FilmGrid& grid) {
  if (count_masses(scene) != 1) return std::nullopt;
  std::erase_if(scene.lenses, [](const Lens& lens) { return lens.m == 0.0; });
  scene.surfaces = {LatLong{}};
  const Tracer tracer(scene, plan_trace(scene, settings));
  const std::vector<TraceBatch> batches = trace_grid(tracer, grid);
  const Camera& camera = scene.camera;
  const Lens& lens = scene.lenses.front();
  std::vector<RayError> errors;
  for (int n = 0; n < grid.count(); ++n) {
    if (!sees(camera, grid.at(n))) continue;
    const SurfaceBatch& surface = batches[static_cast<std::size_t>(n / kBatchSize)].surfaces.front();
    const auto i = static_cast<std::size_t>(n % kBatchSize);
    const Vec3 seen = camera.axes.parent_from_local(direction_from_film<double>(camera, grid.at(n)));
    const auto sky = sky_direction_past(lens.m, lens.position - camera.position, seen);
    const bool hit = surface.outcome[i] == Outcome::Hit;
    RayError error;
    error.compared = hit && sky.has_value();
    error.validity_differs = hit != sky.has_value();
    if (error.compared)
      error.px =
          angle_between(sky_direction_from_st({surface.s[i], surface.t[i]}), *sky) / pixel_angle(camera);
    errors.push_back(error);
  }
  const ErrorSummary summary = summary_of(errors);
  if (summary.compared == 0) return std::nullopt;  // within the photon sphere there is no closed form
  return summary;
}

/// Traces the rows of tiles number `first`, `first + every`, ... and returns how many rows of pixels that
/// were.
int trace_rows(const Tracer& tracer, int first, int every, std::vector<LensMap>& maps) {
  constexpr int kTile = TileLevels{}.size;
  const int height = tracer.camera().full_height();
  const int deep = every == 1 ? 4 * kTile : kTile;
  int rows = 0;
  for (int top = first * kTile; top < height; top += every == 1 ? deep : every * kTile) {
    const RowRange range{top, std::min(top + deep, height)};
    maps = trace_maps(tracer, range, std::move(maps));
    rows += range.end - range.begin;
  }
  return rows;
}

/// Times of the grid's pixels stand for the frame's: as if all threads were busy all the time, as they are in
/// a frame.
Timing time_grid(const Tracer& tracer, const FilmGrid& grid, const Repeats& repeats) {
  const Camera& camera = tracer.camera();
  const double pixels = static_cast<double>(camera.full_width()) * camera.full_height();
  const int batches = (grid.count() + kBatchSize - 1) / kBatchSize;
  const int threads = tbb::this_task_arena::max_concurrency();
  const int rounds = (batches + threads - 1) / threads;
  return scaled(time_repeatedly(repeats, [&] { return trace_grid(tracer, grid); }),
                pixels / (static_cast<double>(rounds) * threads * kBatchSize));
}

/// What is compared with, and all that the comparison needs.
struct Yardstick {
  const Shot* shot;
  Scene scene;
  FilmGrid grid;
  std::vector<TraceBatch> curved;      // the reference
  std::vector<TraceBatch> everything;  // by planes
  double rounding_px;
};

Yardstick make_yardstick(const Shot& shot, const Scene& scene, const FilmGrid& grid, Reference& reference) {
  const double pixel = pixel_angle(scene.camera);
  const double tolerance_px = std::max(kReferencePx, kReferenceRad / (kGeodesicShare * pixel));
  const Tracer finest(scene, plan_trace(scene, curved(tolerance_px)));
  const Tracer looser(scene, plan_trace(scene, curved(kLooser * tolerance_px)));
  const Tracer everything(scene, plan_trace(scene, everything_on()));
  Yardstick yardstick{&shot,
                      scene,
                      grid,
                      trace_grid(finest, grid),
                      trace_grid(everything, grid),
                      std::max(kRoundingPx, 4e-15 / pixel)};
  reference.grid = grid;
  reference.tolerance_rad = finest.plan().geodesic_tolerance;
  reference.own = summary_of(errors_of(finest, grid, trace_grid(looser, grid), yardstick.curved));
  reference.closed_form = check_by_closed_form(scene, curved(tolerance_px), grid);
  return yardstick;
}

/// What a plan is held against: everything by planes, but for bodies that it meets by curved rays the
/// reference.
std::vector<TraceBatch> held_against(const Tracer& tracer, const Yardstick& yardstick) {
  std::vector<TraceBatch> result;
  for (std::size_t n = 0; n < yardstick.everything.size(); ++n) {
    result.push_back(tracer.make_batch());
    for (int i = 0; i < kBatchSize; ++i) {
      const TraceBatch& planes = yardstick.everything[n];
      copy_ray(planes, i, result.back(), i);
      if (curves_at(tracer.plan(), tracer.camera(), {planes.x[i], planes.y[i]}))
        copy_bodies(tracer.surfaces(), yardstick.curved[n], i, result.back(), i);
    }
  }
  return result;
}

/// Holds what a row leaves out against what its plan says.
void check_bound(const Tracer& tracer, const std::vector<TraceBatch>& seen, const Yardstick& yardstick,
                 TraceRow& row) {
  if (tracer.plan().method != Method::Planes) return;
  row.bound_px = tracer.plan().bound_px;
  row.left_out = summary_of(errors_of(tracer, yardstick.grid, seen, held_against(tracer, yardstick)));
  row.violated = violates(*row.bound_px, row.left_out, yardstick.rounding_px);
}

TraceRow climb(const Rung& rung, const Yardstick& yardstick, const StudyEffort& effort) {
  const Scene& scene = yardstick.scene;
  TraceRow row;
  row.rung = rung;
  Plan plan;
  row.plan_s = time_repeatedly({0.0, 3, 3, 0.0}, [&] { plan = plan_trace(scene, rung.settings); }).median_s;
  Plan compared = plan;
  {
    const PeakMemory memory;
    const Tracer tracer(scene, std::move(plan));
    row.trace = time_trace(tracer, yardstick.grid, effort.repeats);
    if (!row.trace.of_a_part) row.peak_bytes = memory.bytes();
  }
  compared.effects.direction = true;
  const Tracer tracer(scene, std::move(compared));
  const std::vector<TraceBatch> seen = trace_grid(tracer, yardstick.grid);
  row.errors = errors_of(tracer, yardstick.grid, seen, yardstick.curved);
  row.error = summary_of(row.errors);
  if (row.error.compared > 0)
    row.worst_at =
        place_in_words(*yardstick.shot, scene, yardstick.grid.at(static_cast<int>(row.error.worst)));
  check_bound(tracer, seen, yardstick, row);
  return row;
}

}  // namespace

Scene study_scene(const Shot& shot, int frame) {
  Scene scene = scene_at(shot, frame);
  std::vector<Surface> surfaces;
  bool sky = has_stars(shot);
  for (const auto& k : map_surfaces_of(shot)) {
    if (!k) continue;
    if (is_bent(scene.surfaces[*k])) {
      sky = true;
    } else {
      surfaces.push_back(scene.surfaces[*k]);
    }
  }
  const bool has_sky = std::any_of(surfaces.begin(), surfaces.end(),
                                   [](const Surface& s) { return std::holds_alternative<LatLong>(s); });
  if ((sky || surfaces.empty()) && !has_sky) surfaces.push_back(LatLong{});
  scene.surfaces = std::move(surfaces);
  return scene;
}

int rays_of(const StudyEffort& effort, std::size_t masses) {
  const auto share = static_cast<double>(std::max<std::size_t>(masses, kFewMasses)) / kFewMasses;
  return std::max(std::min(kFewestRays, effort.most_rays), static_cast<int>(effort.most_rays / share));
}

Timing time_trace(const Tracer& tracer, const FilmGrid& grid, const Repeats& repeats) {
  constexpr int kTile = TileLevels{}.size;
  const int height = tracer.camera().full_height();
  const int tile_rows = (height + kTile - 1) / kTile;
  const double guess = time_grid(tracer, grid, {0, 1, 1}).median_s;
  if (tracer.plan().method == Method::Geodesic || guess / tile_rows > repeats.longest_s)
    return time_grid(tracer, grid, repeats);
  std::vector<LensMap> maps;
  double first = 0;  // of one row of tiles in the middle
  timed(first, [&] { return trace_rows(tracer, tile_rows / 2, tile_rows, maps); });
  const int every =
      std::clamp(static_cast<int>(std::ceil(first * tile_rows / repeats.longest_s)), 1, tile_rows);
  int rows = height;
  const Timing timing =
      time_repeatedly(repeats, [&] { rows = trace_rows(tracer, (every - 1) / 2, every, maps); });
  return scaled(timing, static_cast<double>(height) / rows);
}

bool violates(double bound_px, const ErrorSummary& left_out, double rounding_px) {
  return left_out.most_px > bound_px + rounding_px ||
         (std::isfinite(bound_px) && left_out.captured_differs > 0);
}

void study_traces(const Shot& shot, int frame, const StudyEffort& effort, const StudyHooks& hooks,
                  Study& study) {
  const Scene scene = study_scene(shot, frame);
  study.camera = scene.camera;
  study.masses = count_masses(scene);
  const std::vector<Rung> ladder = ladder_of(scene.camera, trace_at(shot, frame));
  if (scene.camera.projection != Projection::Perspective)
    study.notes.emplace_back(
        "without a flat screen finite distance is always on: there are no rows without it");
  if (study.masses > 1)
    study.notes.emplace_back(
        "of what masses do together, of the order of m1 m2/b^2, curved rays carry more than 99 % where that "
        "was "
        "tried, planes by the exact law most (docs/numerics.md), by the other laws a part");
  hooks.doing("the reference: curved rays");
  const Yardstick yardstick =
      make_yardstick(shot, scene, grid_of(scene.camera, rays_of(effort, study.masses)), study.reference);
  if (study.reference.own.compared > 0 && study.reference.own.p99_px > kSeenErrorPx)
    study.notes.emplace_back(fmt::format(
        "the reference itself is not sure of {} px: so narrow a view is beyond its digits", kSeenErrorPx));
  for (const Rung& rung : ladder) {
    if (hooks.stop()) {
      study.interrupted = true;
      return;
    }
    hooks.doing(
        fmt::format("trace {} of {}: {}", study.traces.size() + 1, ladder.size(), name_of(rung.settings)));
    study.traces.push_back(climb(rung, yardstick, effort));
  }
}

}  // namespace lensplane
