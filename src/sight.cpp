// SPDX-License-Identifier: Apache-2.0

#include "src/sight.h"

#include <algorithm>
#include <limits>
#include <type_traits>

#include "src/bodies.h"
#include "src/constants.h"
#include "src/finite_shift_batch.h"
#include "src/sphere_reach.h"

namespace lensplane {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Captured rays end here. A body that they met before stays; at infinity they see nothing.
void end_captured(const BatchArray& captured, bool at_infinity, int bends, SurfaceBatch& surface) {
  if (!any_of(captured)) return;
  for (int i = 0; i < kBatchSize; ++i) {
    if (captured[i] == 0.0 || (!at_infinity && surface.outcome[i] == Outcome::Hit)) continue;
    surface.s[i] = surface.t[i] = 0.0;
    surface.outcome[i] = Outcome::Captured;
    if (!surface.passes) continue;
    PassBatch& p = *surface.passes;
    p.ds_dx[i] = p.ds_dy[i] = p.dt_dx[i] = p.dt_dy[i] = p.magnification[i] = p.delay[i] = 0.0;
    p.bends[i] = bends;
  }
}

template <class Number>
void fill_along(const Sight& sight, const LineBatch<Number>& rays, int bends, PassBatch& passes) {
  if (sight.effects.direction) {
    for (int i = 0; i < kBatchSize; ++i) {
      const Vec3 d = sight.camera.axes.parent_from_local(value_of(rays.direction.get(i)));
      passes.dir_x[i] = d.x, passes.dir_y[i] = d.y, passes.dir_z[i] = d.z;
    }
  }
  if (sight.effects.bends) std::fill_n(passes.bends, kBatchSize, bends);
  if (sight.effects.delay) {
    for (int i = 0; i < kBatchSize; ++i) {
      passes.delay[i] = (excess_over_wave_front(rays.excess.get(i)) + rays.shapiro.v[i]) / kLightSpeed;
    }
  }
}

template <class Number>
void see_at_infinity(const Sight& sight, const Surface& surface, const LineBatch<Number>& rays, int bends,
                     const TraceBatch& batch, SurfaceBatch& result) {
  const Camera& camera = sight.camera;
  const bool plate = std::holds_alternative<Plate>(surface), bent = is_bent(surface);
  const bool kernel = plate && !bent && camera.projection == Projection::Perspective && bends > 0;
  if (kernel) {
    meet_plate(camera, sight.slope, batch.x, batch.y, rays, result);
  } else {
    for (int i = 0; i < kBatchSize; ++i) {
      const FilmPosition film{batch.x[i], batch.y[i]};
      const auto first = direction_from_film<Number>(camera, film);
      const auto last = bends > 0 && !bent ? rays.direction.get(i) : first;  // to the last bit
      set(sight, plate ? meet_plate(camera, film, first, last) : meet_sky(camera, first, last), i, result);
    }
  }
  if (bent) return;
  if (result.passes) fill_along(sight, rays, bends, *result.passes);
  end_captured(rays.captured, true, bends, result);
}

}  // namespace

bool Sight::any_body() const {
  return bodies && std::any_of(surfaces.begin(), surfaces.end(), is_body);
}

namespace {

void clear(SurfaceBatch& surface) {
  std::fill_n(surface.s, kBatchSize, 0.0);
  std::fill_n(surface.t, kBatchSize, 0.0);
  std::fill_n(surface.distance, kBatchSize, 0.0);
  surface.outcome.fill(Outcome::Missed);
  surface.passages.fill({});
  if (surface.passes) *surface.passes = {};
}

}  // namespace

TraceBatch make_batch(const Sight& sight) {
  TraceBatch batch;
  batch.surfaces.resize(sight.surfaces.size());
  for (SurfaceBatch& surface : batch.surfaces) {
    if (sight.effects.any()) surface.passes = std::make_unique<PassBatch>();
    clear(surface);
  }
  return batch;
}

int unresolved_rays(const TraceBatch& batch, std::size_t count) {
  int unresolved = 0;
  for (std::size_t i = 0; i < count; ++i) {
    unresolved += std::any_of(batch.surfaces.begin(), batch.surfaces.end(), [i](const SurfaceBatch& surface) {
      return surface.outcome[i] == Outcome::Unresolved;
    });
  }
  return unresolved;
}

void clear_bodies(const Sight& sight, TraceBatch& batch) {
  for (std::size_t k = 0; k < sight.surfaces.size(); ++k) {
    if (is_body(sight.surfaces[k])) clear(batch.surfaces[k]);
  }
}

template <class Number>
void set(const Sight& sight, const SurfaceHit<Number>& hit, int i, SurfaceBatch& surface) {
  surface.s[i] = value_of(hit.st.s);
  surface.t[i] = value_of(hit.st.t);
  surface.distance[i] = hit.distance;
  surface.outcome[i] = hit.outcome;
  if (!surface.passes) return;
  PassBatch& passes = *surface.passes;
  if constexpr (std::is_same_v<Number, Dual>) {
    passes.ds_dx[i] = hit.st.s.dx, passes.ds_dy[i] = hit.st.s.dy;
    passes.dt_dx[i] = hit.st.t.dx, passes.dt_dy[i] = hit.st.t.dy;
    passes.magnification[i] = hit.magnification;
  }
  passes.delay[i] = hit.delay / kLightSpeed;
  const Vec3 d = sight.camera.axes.parent_from_local(hit.direction);
  passes.dir_x[i] = d.x, passes.dir_y[i] = d.y, passes.dir_z[i] = d.z;
  passes.bends[i] = hit.bends;
}

template <class Number>
void set(const Sight& sight, const RayHits<Number>& ray, int i, TraceBatch& batch) {
  for (std::size_t k = 0; k < ray.hits.size(); ++k) set(sight, ray.hits[k], i, batch.surfaces[k]);
  batch.captured[i] = ray.captured ? 1.0 : 0.0;
}

namespace {

void copy_ray(const SurfaceBatch& a, int i, SurfaceBatch& b, int k) {
  b.s[k] = a.s[i], b.t[k] = a.t[i], b.distance[k] = a.distance[i], b.outcome[k] = a.outcome[i];
  if (!a.passes) return;
  const PassBatch& p = *a.passes;
  PassBatch& q = *b.passes;
  q.ds_dx[k] = p.ds_dx[i], q.ds_dy[k] = p.ds_dy[i], q.dt_dx[k] = p.dt_dx[i], q.dt_dy[k] = p.dt_dy[i];
  q.magnification[k] = p.magnification[i], q.delay[k] = p.delay[i], q.bends[k] = p.bends[i];
  q.dir_x[k] = p.dir_x[i], q.dir_y[k] = p.dir_y[i], q.dir_z[k] = p.dir_z[i];
}

}  // namespace

void copy_ray(const TraceBatch& from, int i, TraceBatch& to, int k) {
  to.captured[k] = from.captured[i];
  for (std::size_t n = 0; n < from.surfaces.size(); ++n) copy_ray(from.surfaces[n], i, to.surfaces[n], k);
}

void copy_bodies(const std::vector<Surface>& surfaces, const TraceBatch& from, int i, TraceBatch& to, int k) {
  for (std::size_t n = 0; n < surfaces.size(); ++n) {
    if (is_body(surfaces[n])) copy_ray(from.surfaces[n], i, to.surfaces[n], k);
  }
}

namespace {

/// Rays that look for the body number `body` on one of their stretches.
struct Search {
  const Sight& sight;
  std::size_t body;
  const Ends& ends;
  int bends;
  Stretch stretch;

  const Surface& surface() const { return sight.surfaces[body]; }
  const Deflectors* finite() const { return stretch == Stretch::Straight ? sight.finite : nullptr; }
};

/// Writes that ray `i` meets the body.
template <class Number>
void set_on_body(const Search& search, const StretchHit<Number>& at, int i, LineBatch<Number>& rays,
                 TraceBatch& batch) {
  const Sight& sight = search.sight;
  const FilmPosition film{batch.x[i], batch.y[i]};
  Vector<Number> first(Number(0.0));  // not every body asks where the ray left
  if (sight.effects.magnification || std::holds_alternative<Card>(search.surface())) {
    first = direction_from_film<Number>(sight.camera, film);
  }
  auto hit = meet_body_at(search.surface(), sight.camera, film, first, at.point);
  if constexpr (std::is_same_v<Number, Dual>) {
    if (sight.effects.magnification && hit.outcome == Outcome::Hit)
      hit.magnification = magnification_on_body(search.surface(), first, at.point);
  }
  hit.direction = at.direction;
  hit.bends = search.bends;
  if (hit.outcome == Outcome::Hit) hit.distance = rays.path.v[i] + at.way;
  set(sight, hit, i, batch.surfaces[search.body]);
  const bool lacks_derivatives = std::is_same_v<Number, Dual> && search.stretch == Stretch::Chord;
  if (sight.effects.delay || lacks_derivatives) rays.irregular[i] = 1.0;
}

template <class Number>
void see_sphere(const Search& search, const Sphere& sphere, LineBatch<Number>& rays, TraceBatch& batch) {
  const Deflectors* finite = search.finite();
  alignas(64) BatchArray entry, near;
  if (search.stretch == Stretch::Straight) {
    find_near(Stretches<Number>{rays, search.ends, search.bends, finite}, sphere, near);
    if (!any_of(near)) return;
  }
  VectorLane<Number> start = rays.start, direction = rays.direction;
  if (finite) shift_to_ball(*finite, sphere, search.ends, search.bends, start, direction);
  enter_sphere(sphere, start, direction, search.ends, entry);
  const SurfaceBatch& surface = batch.surfaces[search.body];
  for (int i = 0; i < kBatchSize; ++i) {
    if (!(entry[i] < kInfinity) || surface.outcome[i] == Outcome::Hit || rays.captured[i] != 0.0) continue;
    const Vector<Number> from = start.get(i), along = direction.get(i);
    const Number way = sphere_entry(from, along, sphere.centre, sphere.radius);
    set_on_body(search, StretchHit<Number>{from + along * way, value_of(along), entry[i]}, i, rays, batch);
  }
}

template <class Number>
void see_disc(const Search& search, const Disc& disc, LineBatch<Number>& rays, TraceBatch& batch) {
  auto& passages = batch.surfaces[search.body].passages;
  alignas(64) BatchArray sides;
  end_sides(disc, rays, search.ends, sides);
  for (int i = 0; i < kBatchSize; ++i) {
    DiscPassage& passage = passages[static_cast<std::size_t>(i)];
    if (passage.side == 0) {
      passage.side = first_side(disc, value_of(rays.start.get(i)), value_of(rays.direction.get(i)));
    }
    // Most rays stay where they are; with finite distance that is known only of the shifted stretch.
    const bool stays = sides[i] == 0.0 || sides[i] == passage.side;
    if ((stays && !search.finite()) || passage.crossings > disc.crossing || rays.captured[i] != 0.0) continue;
    const RaySegment<Number> stretch{rays.start.get(i), rays.direction.get(i), Number(search.ends.at[i]),
                                     search.bends};
    const auto crossing = meet_disc(disc, stretch, search.finite(), passage);
    if (crossing) set_on_body(search, *crossing, i, rays, batch);
  }
}

}  // namespace

template <class Number>
void see_bodies(const Sight& sight, const Ends& ends, int bends, Stretch stretch, LineBatch<Number>& rays,
                TraceBatch& batch) {
  for (std::size_t k = 0; k < sight.surfaces.size(); ++k) {
    const Search search{sight, k, ends, bends, stretch};
    if (const auto* sphere = std::get_if<Sphere>(&sight.surfaces[k])) {
      see_sphere(search, *sphere, rays, batch);
    } else if (const auto disc = disc_of(sight.surfaces[k])) {
      see_disc(search, *disc, rays, batch);
    }
  }
}

template <class Number>
void see_infinity(const Sight& sight, const LineBatch<Number>& rays, int bends, TraceBatch& batch) {
  std::copy_n(rays.captured, kBatchSize, batch.captured);
  for (std::size_t k = 0; k < sight.surfaces.size(); ++k) {
    SurfaceBatch& surface = batch.surfaces[k];
    if (!is_body(sight.surfaces[k])) {
      see_at_infinity(sight, sight.surfaces[k], rays, bends, batch, surface);
      continue;
    }
    if (sight.effects.direction || sight.effects.bends) {  // of rays that miss it
      for (int i = 0; i < kBatchSize; ++i) {
        if (surface.outcome[i] == Outcome::Hit) continue;
        SurfaceHit<Number> miss;
        miss.direction = value_of(rays.direction.get(i));
        miss.bends = bends;
        set(sight, miss, i, surface);
      }
    }
    end_captured(rays.captured, false, bends, surface);
  }
}

template void set(const Sight&, const SurfaceHit<double>&, int, SurfaceBatch&);
template void set(const Sight&, const SurfaceHit<Dual>&, int, SurfaceBatch&);
template void set(const Sight&, const RayHits<double>&, int, TraceBatch&);
template void set(const Sight&, const RayHits<Dual>&, int, TraceBatch&);
template void see_bodies(const Sight&, const Ends&, int, Stretch, LineBatch<double>&, TraceBatch&);
template void see_bodies(const Sight&, const Ends&, int, Stretch, LineBatch<Dual>&, TraceBatch&);
template void see_infinity(const Sight&, const LineBatch<double>&, int, TraceBatch&);
template void see_infinity(const Sight&, const LineBatch<Dual>&, int, TraceBatch&);

}  // namespace lensplane
