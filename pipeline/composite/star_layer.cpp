// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/star_layer.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "pipeline/composite/star_drawing.h"

namespace lensplane {
namespace {

bool hides_stars(const Surface& surface) {
  return !std::holds_alternative<LatLong>(surface);
}

void dim_batch(const Tracer& tracer, const Viewer& viewer, TraceBatch& batch, std::span<StarImage> images) {
  for (std::size_t i = 0; i < kBatchSize; ++i) {
    const FilmPosition film = images[std::min(i, images.size() - 1)].film;
    batch.x[i] = film.x;
    batch.y[i] = film.y;
  }
  tracer.trace(batch);
  std::vector<SeenPoint> points(tracer.surfaces().size());
  for (std::size_t i = 0; i < images.size(); ++i) {
    for (std::size_t k = 0; k < points.size(); ++k) points[k] = seen_point(batch.surfaces[k], i);
    const double clear = viewer.clearness(points);
    for (double& channel : images[i].light) channel *= clear;
  }
}

}  // namespace

void dim_hidden(const Tracer& tracer, const std::vector<SurfaceLook>& looks, std::vector<StarImage>& images) {
  if (std::none_of(tracer.surfaces().begin(), tracer.surfaces().end(), hides_stars)) return;
  const std::size_t batches = (images.size() + kBatchSize - 1) / kBatchSize;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, batches), [&](const auto& range) {
    const Viewer viewer(tracer.surfaces(), looks);
    TraceBatch batch = tracer.make_batch();
    for (std::size_t n = range.begin(); n != range.end(); ++n) {
      const std::size_t first = n * kBatchSize;
      dim_batch(tracer, viewer, batch,
                std::span(images).subspan(first, std::min<std::size_t>(kBatchSize, images.size() - first)));
    }
  });
}

void add_stars(const Tracer& tracer, const std::vector<SurfaceLook>& looks, const StarField& field,
               Picture& picture) {
  const PointSpread spread;
  std::vector<StarImage> images =
      find_star_images(tracer, field, {.margin_px = spread.reach_px(tracer.camera())});
  dim_hidden(tracer, looks, images);
  draw_stars(images, spread, tracer.camera(), picture);
}

}  // namespace lensplane
