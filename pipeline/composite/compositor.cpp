// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/compositor.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <numeric>

namespace lensplane {
namespace {

constexpr int kPixelsPerBatch = kBatchSize / kRaysPerPixel;

/// Film positions of the rays of the kPixelsPerBatch pixels of a row that begin at `column`. At the end of a
/// row some may lie beyond it; their rays are not used.
void place_rays(const Camera& camera, int row, int column, TraceBatch& batch) {
  const double left = column - camera.overscan;
  const double top = row - camera.overscan;
  for (int i = 0; i < kBatchSize; ++i) {
    const int ray = i % kRaysPerPixel;
    batch.x[i] = left + i / kRaysPerPixel + (ray % kRaysPerAxis + 0.5) / kRaysPerAxis;
    batch.y[i] = top + (ray / kRaysPerAxis + 0.5) / kRaysPerAxis;
  }
}

bool in_frame(const Camera& camera, double x, double y) {
  return x > 0 && x < camera.width && y > 0 && y < camera.height;
}

/// Calls `use(row, column, pixels, batch)` for every batch of traced rays, rows in parallel.
template <class Use>
void trace_pixels(const Tracer& tracer, Use use) {
  const Camera& camera = tracer.camera();
  tbb::parallel_for(tbb::blocked_range<int>(0, camera.full_height()),
                    [&](const tbb::blocked_range<int>& rows) {
                      TraceBatch batch = tracer.make_batch();
                      for (int row = rows.begin(); row != rows.end(); ++row) {
                        for (int column = 0; column < camera.full_width(); column += kPixelsPerBatch) {
                          place_rays(camera, row, column, batch);
                          tracer.trace(batch);
                          use(row, column, std::min(kPixelsPerBatch, camera.full_width() - column), batch);
                        }
                      }
                    });
}

/// Rays of each surface, counted row by row so that no two threads meet.
class HitCounter {
 public:
  explicit HitCounter(const Tracer& tracer)
      : camera_(tracer.camera()),
        surfaces_(tracer.surfaces().size()),
        counts_(surfaces_ * static_cast<std::size_t>(camera_.full_height()), 0) {}

  void add(int row, int pixels, const TraceBatch& batch) {
    for (std::size_t k = 0; k < surfaces_; ++k) {
      std::int64_t hits = 0;
      for (int i = 0; i < pixels * kRaysPerPixel; ++i) {
        const bool hit = batch.surfaces[k].outcome[static_cast<std::size_t>(i)] == Outcome::Hit;
        hits += hit && in_frame(camera_, batch.x[i], batch.y[i]);
      }
      counts_[static_cast<std::size_t>(row) * surfaces_ + k] += hits;
    }
  }

  std::vector<std::int64_t> totals() const {
    std::vector<std::int64_t> totals(surfaces_, 0);
    for (std::size_t i = 0; i < counts_.size(); ++i) totals[i % surfaces_] += counts_[i];
    return totals;
  }

 private:
  Camera camera_;
  std::size_t surfaces_;
  std::vector<std::int64_t> counts_;
};

/// The surfaces in the order of their depth, farthest first, as far as it does not depend on the ray: skies,
/// then everything else.
std::vector<std::size_t> order_at_infinity(const std::vector<Surface>& surfaces) {
  std::vector<std::size_t> order(surfaces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_partition(order.begin(), order.end(),
                        [&](std::size_t k) { return std::holds_alternative<LatLong>(surfaces[k]); });
  return order;
}

Rgba shade(const SurfaceLook& look, TextureCoordinates st) {
  Rgba colour = look.texture->lookup(st);
  if (look.light) {
    const auto cosine = static_cast<float>(std::max(0.0, sphere_normal_from_st(st).dot(*look.light)));
    for (std::size_t c = 0; c < 3; ++c) colour[c] *= cosine;
  }
  return colour;
}

/// `over` laid over `under`.
void lay_under(Rgba& over, const Rgba& under) {
  const float clear = 1.0F - over[3];
  for (std::size_t c = 0; c < 4; ++c) over[c] += clear * under[c];
}

/// Sorts by falling distance at ray `i`, equal distances left as they are. There are few surfaces: insertion
/// sort.
void sort_by_depth(const TraceBatch& batch, std::size_t i, std::vector<std::size_t>& order) {
  const auto farther = [&](std::size_t a, std::size_t b) {
    return batch.surfaces[a].distance[i] > batch.surfaces[b].distance[i];
  };
  for (auto k = order.begin(); k != order.end(); ++k) {
    std::rotate(std::upper_bound(order.begin(), k, *k, farther), k, k + 1);
  }
}

/// What ray `i` sees; `order` holds the surfaces, farthest first.
Rgba see(const TraceBatch& batch, std::size_t i, const std::vector<SurfaceLook>& looks,
         const std::vector<std::size_t>& order) {
  Rgba colour{0, 0, 0, 0};
  for (auto k = order.rbegin(); k != order.rend() && colour[3] < 1.0F; ++k) {
    const SurfaceBatch& surface = batch.surfaces[*k];
    if (surface.outcome[i] != Outcome::Hit) continue;
    lay_under(colour, shade(looks[*k], {surface.s[i], surface.t[i]}));
  }
  return colour;
}

/// Whether a ray of the batch's pixel number `pixel` meets any surface.
bool meets_anything(const TraceBatch& batch, int pixel) {
  return std::any_of(batch.surfaces.begin(), batch.surfaces.end(), [pixel](const SurfaceBatch& surface) {
    const auto first = surface.outcome.begin() + pixel * kRaysPerPixel;
    return std::find(first, first + kRaysPerPixel, Outcome::Hit) != first + kRaysPerPixel;
  });
}

/// The mean of the rays of the batch's pixel number `pixel`. `order` holds the surfaces, farthest first where
/// a ray meets two at the same distance.
Rgba average(const TraceBatch& batch, int pixel, const std::vector<SurfaceLook>& looks,
             const std::vector<std::size_t>& order) {
  Rgba sum{0, 0, 0, 0};
  if (!meets_anything(batch, pixel)) return sum;
  std::vector<std::size_t> by_depth = order;
  for (int ray = 0; ray < kRaysPerPixel; ++ray) {
    const auto i = static_cast<std::size_t>(pixel * kRaysPerPixel + ray);
    if (order.size() > 1) {
      by_depth = order;
      sort_by_depth(batch, i, by_depth);
    }
    const Rgba seen = see(batch, i, looks, by_depth);
    for (std::size_t c = 0; c < 4; ++c) sum[c] += seen[c];
  }
  for (float& channel : sum) channel /= kRaysPerPixel;
  return sum;
}

}  // namespace

Composite composite(const Tracer& tracer, const std::vector<SurfaceLook>& looks) {
  assert(looks.size() == tracer.surfaces().size());
  const Camera& camera = tracer.camera();
  Picture picture{camera.full_width(),
                  camera.full_height(),
                  -camera.overscan,
                  -camera.overscan,
                  camera.width,
                  camera.height,
                  {}};
  picture.pixels.resize(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
  HitCounter counter(tracer);
  const std::vector<std::size_t> order = order_at_infinity(tracer.surfaces());
  trace_pixels(tracer, [&](int row, int column, int pixels, const TraceBatch& batch) {
    counter.add(row, pixels, batch);
    for (int pixel = 0; pixel < pixels; ++pixel) {
      picture.at(column + pixel, row) = average(batch, pixel, looks, order);
    }
  });
  return {std::move(picture), counter.totals()};
}

std::vector<std::int64_t> count_hits(const Tracer& tracer) {
  HitCounter counter(tracer);
  trace_pixels(tracer,
               [&](int row, int, int pixels, const TraceBatch& batch) { counter.add(row, pixels, batch); });
  return counter.totals();
}

}  // namespace lensplane
