// SPDX-License-Identifier: Apache-2.0

#include "src/tracer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "src/bodies.h"
#include "src/constants.h"
#include "src/finite_shift.h"
#include "src/march_batch.h"
#include "src/planes_march.h"
#include "src/single_ray.h"
#include "src/sphere_reach.h"

namespace lensplane {
namespace {

const Ends& no_end() {
  static const Ends ends = [] {
    Ends e;
    std::fill_n(e.at, kBatchSize, std::numeric_limits<double>::infinity());
    return e;
  }();
  return ends;
}

/// The rays of `batch` that `pick(i)` names, side by side. Lanes that are left over repeat the last.
struct PickedRays {
  std::vector<int> rays;
  TraceBatch batch;
};

template <class Pick>
PickedRays picked(const Sight& sight, const TraceBatch& batch, Pick pick) {
  PickedRays result{{}, make_batch(sight)};
  for (int i = 0; i < kBatchSize; ++i) {
    if (pick(i)) result.rays.push_back(i);
  }
  for (std::size_t k = 0; k < kBatchSize && !result.rays.empty(); ++k) {
    const int i = result.rays[std::min(k, result.rays.size() - 1)];
    result.batch.x[k] = batch.x[i];
    result.batch.y[k] = batch.y[i];
  }
  return result;
}

void put_back(const PickedRays& from, TraceBatch& batch) {
  for (std::size_t k = 0; k < from.rays.size(); ++k) {
    copy_ray(from.batch, static_cast<int>(k), batch, from.rays[k]);
  }
}

/// Which rays may meet a body on the chords after their stretches. Rings and cards count every stretch.
template <class Number>
void find_near_chords(const Sight& sight, const Stretches<Number>& before, const LineBatch<Number>& after,
                      BatchArray& near) {
  const bool spheres_only = std::none_of(
      sight.surfaces.begin(), sight.surfaces.end(),
      [](const Surface& surface) { return is_body(surface) && !std::holds_alternative<Sphere>(surface); });
  std::fill_n(near, kBatchSize, spheres_only ? 0.0 : 1.0);
  for (const Surface& surface : sight.surfaces) {
    const auto* sphere = std::get_if<Sphere>(&surface);
    if (sphere && spheres_only) add_near_chords(before, after, *sphere, near);
  }
}

/// The way round the masses of a plane, as chords: from where the rays `before` it end, by end_nearest(), to
/// where `after` starts. Where `near` is 0 they have no length and no end.
template <class Number>
LineBatch<Number> chords_between(const Sight& sight, int bends, const Vec3& centre,
                                 const LineBatch<Number>& before, const Ends& ends, const BatchArray& near,
                                 const LineBatch<Number>& after, Ends& chord_ends) {
  LineBatch<Number> chord = after;
  const Vector<Number> end(Number(centre.x), Number(centre.y), Number(centre.z));
  for (int i = 0; i < kBatchSize; ++i) {
    if (near[i] == 0.0) {
      chord_ends.at[i] = -std::numeric_limits<double>::infinity();
      continue;
    }
    const Vector<Number> start = before.start.get(i), direction = before.direction.get(i);
    const Number along = (end - start).dot(direction);  // as end_nearest(), with its derivatives
    const RaySegment<Number> in{start, direction, select(ends.at[i] == 0.0, Number(0.0), along), bends};
    const RaySegment<Number> out{after.start.get(i), after.direction.get(i), Number(0.0), bends + 1};
    const RaySegment<Number> joint =
        sight.finite ? chord_between(*sight.finite, in, out)
                     : straight_between(in.start + in.direction * in.length, out.start, in);
    chord.start.set(i, joint.start);
    chord.direction.set(i, joint.direction);
    chord.path.v[i] = before.path.v[i] + ends.at[i];
    chord_ends.at[i] = value_of(joint.length);
  }
  return chord;
}

/// Rays that the plane number `plane` has captured, which `before` does not yet say, end in its masses. Those
/// that would have ended on an earlier stretch are marked irregular.
template <class Number>
void end_in_masses(const Deflectors& deflectors, std::size_t plane, const LineBatch<Number>& before,
                   LineBatch<Number>& rays, Ends& ends) {
  if (!any_of(rays.captured)) return;
  for (int i = 0; i < kBatchSize; ++i) {
    if (rays.captured[i] == 0.0 || before.captured[i] != 0.0) continue;
    const auto capture = capture_by(deflectors.planes[plane], deflectors.finite_distance,
                                    value_of(before.start.get(i)), value_of(before.direction.get(i)));
    if (!capture) continue;
    const bool clamped = deflectors.finite_distance && capture->way < 0.0;
    ends.at[i] = clamped ? 0.0 : capture->way;
    if (capture->way < 0.0 && plane > 0) rays.irregular[i] = 1.0;
  }
}

/// Marks the rays irregular that are so in `from`.
void add_irregular(const BatchArray& from, BatchArray& irregular) {
  for (int i = 0; i < kBatchSize; ++i) irregular[i] = std::max(irregular[i], from[i]);
}

/// Traces the batch through the planes of `deflectors`. True when it leaves rays to others, which `irregular`
/// then names.
template <class Number>
bool march_planes_batch(const Sight& sight, const Deflectors& deflectors, Reach reach, TraceBatch& batch,
                        BatchArray& irregular) {
  LineBatch<Number> rays, before;
  Ends ends, chord_ends;
  alignas(64) BatchArray near;
  const bool bodies = sight.any_body();
  const PlanesWork work{reach, bodies || sight.effects.delay, sight.effects.delay};
  start_lines(sight.camera, sight.slope, batch.x, batch.y, work.path, rays);
  if (work.shapiro) clear_excess(rays.excess);
  if (deflectors.blind) std::fill_n(rays.captured, kBatchSize, 1.0);
  const std::size_t count = deflectors.blind ? 0 : deflectors.outward;
  for (std::size_t k = 0; k < count; ++k) {
    if (bodies) {
      end_nearest(deflectors.planes[k].centre, deflectors.finite_distance, rays, ends);
      before = rays;
    }
    pass_plane(deflectors, k, work, rays);
    if (bodies) {
      const int bends = static_cast<int>(k);
      end_in_masses(deflectors, k, before, rays, ends);
      see_bodies(sight, ends, bends, Stretch::Straight, before, batch);
      add_irregular(before.irregular, rays.irregular);
      find_near_chords(sight, Stretches<Number>{before, ends, bends, sight.finite}, rays, near);
      if (!any_of(near)) continue;
      LineBatch<Number> chord =
          chords_between(sight, bends, deflectors.planes[k].centre, before, ends, near, rays, chord_ends);
      see_bodies(sight, chord_ends, bends, Stretch::Chord, chord, batch);
      std::copy_n(chord.irregular, kBatchSize, rays.irregular);
    }
  }
  if (bodies) see_bodies(sight, no_end(), static_cast<int>(count), Stretch::Straight, rays, batch);
  see_infinity(sight, rays, static_cast<int>(count), batch);
  std::copy_n(rays.irregular, kBatchSize, irregular);
  // A batch does not keep how far a captured ray came.
  for (int i = 0; (sight.effects.direction || sight.effects.bends) && i < kBatchSize; ++i) {
    irregular[i] = rays.captured[i] != 0.0 ? 1.0 : irregular[i];
  }
  return any_of(irregular);
}

}  // namespace

Tracer::Tracer(const Scene& scene, Plan plan) : camera_(scene.camera), plan_(std::move(plan)) {
  assert(camera_.width > 0 && camera_.height > 0 && camera_.overscan >= 0);
  assert(camera_.projection != Projection::Perspective || (camera_.fov_rad > 0 && camera_.fov_rad < kPi));
  if (camera_.projection == Projection::Perspective) slope_ = slope_per_pixel(camera_);
  for (const Surface& surface : scene.surfaces) surfaces_.push_back(camera_from_world(camera_, surface));
}

Sight Tracer::sight(const Deflectors* finite, bool bodies) const {
  return {camera_, surfaces_, plan_.effects, slope_, finite, bodies};
}

TraceBatch Tracer::make_batch() const {
  return lensplane::make_batch(sight());
}

Tracer Tracer::without_passes() const {
  Tracer plain = *this;
  plain.plan_.effects = {};
  return plain;
}

void Tracer::trace(TraceBatch& batch) const {
  assert(batch.surfaces.size() == surfaces_.size());
  clear_bodies(sight(), batch);
  const bool flat = camera_.projection == Projection::Perspective;
  const bool paper = plan_.method == Method::Kishi || plan_.method == Method::ShinotsukaMakino;
  if (plan_.method == Method::Planes) {
    trace_by_planes(batch);
  } else if (paper && flat && !plan_.effects.derivatives() && !plan_.effects.delay) {
    trace_by_paper(batch);
  } else if (plan_.method == Method::Geodesic) {
    std::array<int, kBatchSize> all;
    std::iota(all.begin(), all.end(), 0);
    trace_curved(all, false, batch);
  } else {
    for (int i = 0; i < kBatchSize; ++i) trace_singly(0, i, batch);
  }
  if (camera_.projection != Projection::Fisheye) return;
  for (int i = 0; i < kBatchSize; ++i) {
    if (sees(camera_, {batch.x[i], batch.y[i]})) continue;
    SurfaceHit<Dual> unseen;  // with derivatives, so that they are cleared, too
    unseen.outcome = Outcome::Unseen;
    for (SurfaceBatch& surface : batch.surfaces) set(sight(), unseen, i, surface);
    batch.captured[i] = 0.0;
  }
}

/// By the laws of each ray's own tile; bodies by curved rays where the plan says so.
void Tracer::trace_by_planes(TraceBatch& batch) const {
  const std::vector<int> curved = curved_rays(batch);
  const bool bodies = curved.size() < kBatchSize;
  const LevelRange levels = levels_of(plan_, camera_, batch.x, batch.y);
  if (levels.least == levels.most) {
    trace_by_recipe(levels.least, Reach::Far, bodies, batch);
  } else {
    for (std::size_t level = levels.least; level <= levels.most; ++level) {
      PickedRays rays = picked(sight(), batch, [&](int i) {
        return level_at(plan_, camera_, {batch.x[i], batch.y[i]}) == level;
      });
      if (rays.rays.empty()) continue;
      trace_by_recipe(level, Reach::Far, bodies, rays.batch);
      put_back(rays, batch);
    }
  }
  if (!curved.empty()) trace_curved(curved, true, batch);
}

void Tracer::trace_by_recipe(std::size_t recipe, Reach reach, bool bodies, TraceBatch& batch) const {
  const Deflectors& deflectors = plan_.recipes[recipe];
  const Sight view = sight(deflectors.finite_distance ? &deflectors : nullptr, bodies);
  alignas(64) BatchArray irregular;
  const bool any = plan_.effects.derivatives()
                       ? march_planes_batch<Dual>(view, deflectors, reach, batch, irregular)
                       : march_planes_batch<double>(view, deflectors, reach, batch, irregular);
  if (!any) return;
  if (reach == Reach::Far) {
    PickedRays rays = picked(view, batch, [&](int i) { return irregular[i] != 0.0; });
    trace_by_recipe(recipe, Reach::Near, bodies, rays.batch);
    put_back(rays, batch);
    return;
  }
  for (int i = 0; i < kBatchSize; ++i) {
    if (irregular[i] != 0.0) trace_singly(recipe, i, batch);
  }
}

void Tracer::trace_by_paper(TraceBatch& batch) const {
  LineBatch<double> rays;
  Ends ends;
  const Sight view = sight();
  const bool bodies = view.any_body();
  start_lines(camera_, slope_, batch.x, batch.y, true, rays);
  int bends = 0;
  for (const LensPlane& plane : plan_.planes) {
    if (!(plane.distance > 0.0)) continue;
    if (bodies) {
      end_at_plane(plane.distance, rays, ends);
      see_bodies(view, ends, bends, Stretch::Straight, rays, batch);
    }
    advance_rays(plane.distance, rays);
    for (const Source& source : plane.sources) bend_rays(source, rays);
    ++bends;
  }
  if (bodies) see_bodies(view, no_end(), bends, Stretch::Straight, rays, batch);
  see_infinity(view, rays, bends, batch);
  for (int i = 0; i < kBatchSize; ++i) {
    if (rays.irregular[i] != 0.0) trace_singly(0, i, batch);
  }
}

/// Curved rays, what they meet on the bodies or on all surfaces.
void Tracer::trace_curved(std::span<const int> rays, bool bodies_only, TraceBatch& batch) const {
  std::vector<FilmPosition> films;
  for (const int i : rays) films.push_back({batch.x[i], batch.y[i]});
  const Sight view = sight();
  const auto put = [&](const auto& seen) {
    for (std::size_t n = 0; n < rays.size(); ++n) {
      for (std::size_t k = 0; bodies_only && k < surfaces_.size(); ++k) {
        if (is_body(surfaces_[k])) set(view, seen[n].hits[k], rays[n], batch.surfaces[k]);
      }
      if (!bodies_only) set(view, seen[n], rays[n], batch);
    }
  };
  if (plan_.effects.derivatives()) {
    put(trace_curved_rays<Dual>(view, plan_, films));
  } else {
    put(trace_curved_rays<double>(view, plan_, films));
  }
}

/// The rays of a batch for which bodies are met by curved rays.
std::vector<int> Tracer::curved_rays(const TraceBatch& batch) const {
  std::vector<int> rays;
  if (plan_.tiles.curved.empty() || !sight().any_body()) return rays;
  for (int i = 0; i < kBatchSize; ++i) {
    if (curves_at(plan_, camera_, {batch.x[i], batch.y[i]})) rays.push_back(i);
  }
  return rays;
}

void Tracer::trace_singly(std::size_t recipe, int i, TraceBatch& batch) const {
  const Sight view = sight();
  const FilmPosition film{batch.x[i], batch.y[i]};
  if (plan_.effects.derivatives()) {
    set(view, trace_ray<Dual>(view, plan_, recipe, film), i, batch);
  } else {
    set(view, trace_ray<double>(view, plan_, recipe, film), i, batch);
  }
}

}  // namespace lensplane
