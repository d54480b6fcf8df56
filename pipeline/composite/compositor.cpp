// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/compositor.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

#include "pipeline/composite/capture_mask.h"
#include "pipeline/composite/edge_finder.h"
#include "pipeline/composite/edge_pixel.h"
#include "pipeline/composite/pixel_parts.h"
#include "pipeline/composite/ray_batches.h"
#include "pipeline/composite/rim_looker.h"
#include "pipeline/composite/sparse_tracer.h"
#include "pipeline/composite/thin_light.h"

namespace lensplane {
namespace {

constexpr int kTileSize = 64;  // pixels, as the plan's tiles

/// Pixels of the film, overscan included, counted from its upper left.
struct Tile {
  int left, top, width, height;
};

/// What a tile counts beside its picture.
struct TileCounts {
  std::vector<double> hits;
  std::int64_t rays = 0, unresolved = 0;
  std::int64_t refined = 0;
};

/// What of a captured ray's light is covered by nothing before.
float uncovered(const Rgba& seen) {
  return std::max(0.0F, 1.0F - seen[3]);
}

/// Traces and looks at one tile at a time; one for each thread.
class TileTaker {
 public:
  TileTaker(const Tracer& tracer, const std::vector<SurfaceLook>& looks, const Sampling& sampling,
            const EmptySpace& empty, const ThinBodies& thin)
      : tracer_(tracer),
        sampling_(sampling),
        thin_(thin),
        viewer_(tracer.surfaces(), looks),
        sparse_(tracer, empty),
        rims_(tracer, sampling, viewer_),
        batch_(tracer.make_batch()),
        points_(tracer.surfaces().size()) {}

  TileCounts take(const Tile& tile, Composite& result) {
    tile_ = tile;
    counts_ = {std::vector<double>(points_.size(), 0.0), 0, 0};
    look_at_thin_bodies();
    std::optional<CentreGrid> grid = trace_centres();
    if (!grid && !thin_light_.empty()) grid.emplace(tracer_.surfaces(), tile_.width, tile_.height);
    if (grid) {
      std::vector<std::uint8_t> done(grid->size(), 0);
      if (sampling_.max > 1) look_at_rims(*grid, done, result);
      std::vector<EdgePixel> edge_pixels = look_at_centres(*grid, done, result);
      look_at_edges(edge_pixels, result);
    }
    return std::move(counts_);
  }

 private:
  /// Film position of a pixel's centre.
  FilmPosition film(int column, int row) const {
    const int overscan = tracer_.camera().overscan;
    return {tile_.left + column - overscan + 0.5, tile_.top + row - overscan + 0.5};
  }

  bool in_frame(FilmPosition film) const {
    const Camera& camera = tracer_.camera();
    return film.x > 0 && film.x < camera.width && film.y > 0 && film.y < camera.height;
  }

  /// Writes a pixel of the tile, of which thin bodies have their share and all else is `seen`.
  void put(int column, int row, const SeenLight& seen, Composite& result) const {
    const int x = tile_.left + column, y = tile_.top + row;
    const SeenLight all = thin_light_.over(column, row, seen);
    result.picture.at(x, y) = all.colour;
    result.shadow[static_cast<std::size_t>(y) * static_cast<std::size_t>(result.picture.width) +
                  static_cast<std::size_t>(x)] = all.shadow;
  }

  /// What a ray sees that meets `points`.
  SeenLight see(std::span<const SeenPoint> points, double scale, bool captured,
                SampleOffset offset = {0, 0}) {
    const Rgba colour = viewer_.see(points, scale, offset);
    return {colour, captured ? uncovered(colour) : 0.0F};
  }

  /// `weight`: of the pixel at `film`.
  void count(FilmPosition film, std::span<const SeenPoint> points, double weight) {
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (points[k].hit && in_frame(film)) counts_.hits[k] += weight;
    }
  }

  void count(const EdgePixel& pixel) {
    const double rest = thin_light_.rest(pixel.column(), pixel.row());
    for (std::size_t k = 0; k < points_.size(); ++k) {
      if (in_frame(film(pixel.column(), pixel.row()))) counts_.hits[k] += rest * pixel.share_of(k);
    }
  }

  /// Takes the thin bodies off what a ray meets whose light is known. True when there are any.
  bool take_off_thin(FilmPosition film, std::span<SeenPoint> points) const {
    bool any = false;
    for (auto image = thin_.image_of(film, points); image >= 0; image = thin_.image_of(film, points)) {
      points[thin_.surface(static_cast<std::size_t>(image))] = {};
      any = true;
    }
    return any;
  }

  /// Traces the rays over thin images near the tile. Where another body's image lies over one of them, the
  /// first has the light of both.
  void look_at_thin_bodies() {
    const FilmPosition corner = film(0, 0);
    const std::vector<ThinRay> rays =
        thin_.rays_around(corner.x - 0.5, corner.y - 0.5, tile_.width, tile_.height);
    thin_light_ =
        rays.empty() ? ThinLight() : ThinLight(corner.x - 0.5, corner.y - 0.5, tile_.width, tile_.height);
    trace(
        rays.size(), [&](std::size_t n) { return rays[n].film; },
        [&](TraceBatch& batch) {
          thin_.tracer().trace(batch);
          return Found::Something;
        },
        [&](std::size_t n, std::size_t i) {
          for (std::size_t k = 0; k < points_.size(); ++k) points_[k] = seen_point(batch_.surfaces[k], i);
          if (thin_.image_of(rays[n].film, points_) != static_cast<std::ptrdiff_t>(rays[n].image)) return;
          thin_light_.add(
              rays[n], see(points_, rays[n].scale, batch_.captured[i] != 0.0),
              [&](int column, int row, double weight) { count(film(column, row), points_, weight); });
        });
  }

  /// As trace_in_batches(); `trace_batch(batch)` says what it has found.
  template <class Position, class TraceBatchOf, class Use>
  void trace(std::size_t rays, Position position, TraceBatchOf trace_batch, Use use) {
    trace_in_batches(
        rays, batch_, position,
        [&](TraceBatch& batch, std::size_t count) {
          const Found found = trace_batch(batch);
          if (found != Found::NothingNew) {
            counts_.rays += static_cast<std::int64_t>(count);
            counts_.unresolved += unresolved_rays(batch, count);
          }
          return found == Found::Something;
        },
        use);
  }

  /// Nothing when none of them meets anything.
  std::optional<CentreGrid> trace_centres() {
    const auto width = static_cast<std::size_t>(tile_.width + 2),
               height = static_cast<std::size_t>(tile_.height + 2);
    std::optional<CentreGrid> grid;
    sparse_.begin();
    trace(
        width * height,
        [&](std::size_t n) { return film(static_cast<int>(n % width) - 1, static_cast<int>(n / width) - 1); },
        [&](TraceBatch& batch) { return sparse_.trace(batch); },
        [&](std::size_t n, std::size_t i) {
          if (!grid) grid.emplace(tracer_.surfaces(), tile_.width, tile_.height);
          for (std::size_t k = 0; k < points_.size(); ++k) {
            grid->points(n)[k] = seen_point(batch_.surfaces[k], i);
          }
          grid->captured(n) = batch_.captured[i] != 0.0 ? 1 : 0;
          take_off_thin({batch_.x[i], batch_.y[i]}, grid->points(n));
        });
    return grid;
  }

  /// The centres of the tile that are captured; two pixels beyond it are traced where a rim may be near.
  std::optional<CaptureMask> captures(const CentreGrid& grid) {
    CaptureMask mask(tile_.width, tile_.height);
    std::vector<std::pair<int, int>> around;
    std::size_t captured = 0;
    for (int row = -2; row < tile_.height + 2; ++row) {
      for (int column = -2; column < tile_.width + 2; ++column) {
        const bool inside = row >= -1 && row <= tile_.height && column >= -1 && column <= tile_.width;
        if (!inside) {
          around.emplace_back(column, row);
        } else if (grid.captured(grid.place(column, row))) {
          mask.set_captured(column, row);
          ++captured;
        }
      }
    }
    if (captured == 0 || captured == grid.size()) return std::nullopt;
    std::vector<FilmPosition> films;
    for (const auto& [column, row] : around) films.push_back(film(column, row));
    const std::vector<std::uint8_t> found = rims_.captured_at(films);
    for (std::size_t n = 0; n < around.size(); ++n) {
      if (found[n] != 0) mask.set_captured(around[n].first, around[n].second);
    }
    return mask;
  }

  /// Looks at the pixels on the rims of shadows, which are done then.
  void look_at_rims(const CentreGrid& grid, std::vector<std::uint8_t>& done, Composite& result) {
    const std::int64_t before = rims_.rays();
    if (const std::optional<CaptureMask> mask = captures(grid)) {
      const std::vector<CaptureMask::RimPixel> places = mask->rim_pixels();
      std::vector<RimPixel> pixels;
      for (const auto& p : places) pixels.push_back({film(p.column, p.row), p.x, p.y});
      const std::vector<RimLight> lights = rims_.look(
          pixels, [&](FilmPosition at, std::span<SeenPoint> points) { return take_off_thin(at, points); });
      for (std::size_t n = 0; n < pixels.size(); ++n) {
        if (!lights[n].holds_rim) continue;
        const int column = places[n].column, row = places[n].row;
        done[grid.place(column, row)] = 1;
        put(column, row, lights[n].seen, result);
        for (std::size_t k = 0; k < points_.size() && in_frame(pixels[n].centre); ++k) {
          counts_.hits[k] += thin_light_.rest(column, row) * lights[n].shares[k];
        }
        ++counts_.refined;
      }
    }
    counts_.rays += rims_.rays() - before;
  }

  /// Looks where one ray does; returns the other pixels that are not done.
  std::vector<EdgePixel> look_at_centres(const CentreGrid& grid, const std::vector<std::uint8_t>& done,
                                         Composite& result) {
    const std::vector<PixelKind> kinds =
        sampling_.max > 1 ? grid.kinds() : std::vector<PixelKind>(grid.size(), PixelKind::Smooth);
    std::vector<EdgePixel> edge_pixels;
    for (int row = 0; row < tile_.height; ++row) {
      for (int column = 0; column < tile_.width; ++column) {
        const std::size_t at = grid.place(column, row);
        if (done[at] != 0) continue;
        if (kinds[at] > PixelKind::Bent) {
          edge_pixels.emplace_back(column, row, kinds[at], points_.size());
          continue;
        }
        count(film(column, row), grid.points(at), thin_light_.rest(column, row));
        const Rgba seen = see_pixel(grid, tracer_.surfaces(), column, row, kinds[at], viewer_);
        put(column, row, {seen, grid.captured(at) ? uncovered(seen) : 0.0F}, result);
      }
    }
    return edge_pixels;
  }

  /// Takes the rays number `from` to `until` of every pixel.
  void add_rays(const std::vector<EdgePixel*>& pixels, int from, int until) {
    const auto each = static_cast<std::size_t>(until - from);
    const auto offset_of = [&](std::size_t n) -> const SampleOffset& {
      return sample_offsets()[static_cast<std::size_t>(sampling_.first + from) + n % each];
    };
    trace(
        pixels.size() * each,
        [&](std::size_t n) {
          const EdgePixel& pixel = *pixels[n / each];
          const SampleOffset& offset = offset_of(n);
          const FilmPosition centre = film(pixel.column(), pixel.row());
          return FilmPosition{centre.x + offset.x, centre.y + offset.y};
        },
        [&](TraceBatch& batch) {
          tracer_.trace(batch);
          return Found::Something;
        },
        [&](std::size_t n, std::size_t i) {
          for (std::size_t k = 0; k < points_.size(); ++k) points_[k] = seen_point(batch_.surfaces[k], i);
          const bool on_thin = take_off_thin({batch_.x[i], batch_.y[i]}, points_);
          const SeenLight seen = see(points_, kSampleScale, batch_.captured[i] != 0.0, offset_of(n));
          pixels[n / each]->add(points_, seen.colour, seen.shadow, !on_thin);
        });
  }

  void look_at_edges(std::vector<EdgePixel>& pixels, Composite& result) {
    std::vector<EdgePixel*> wanting;
    for (EdgePixel& pixel : pixels) wanting.push_back(&pixel);
    const int first = std::min(kFirstSamples, sampling_.max);
    add_rays(wanting, 0, first);
    std::erase_if(wanting, [&](const EdgePixel* p) { return p->error() <= sampling_.threshold; });
    if (first < sampling_.max) add_rays(wanting, first, sampling_.max);
    for (const EdgePixel& pixel : pixels) {
      put(pixel.column(), pixel.row(), {pixel.mean(), pixel.shadow()}, result);
      count(pixel);
    }
    counts_.refined += static_cast<std::int64_t>(pixels.size());
  }

  const Tracer& tracer_;
  const Sampling& sampling_;
  const ThinBodies& thin_;
  Viewer viewer_;
  SparseTracer sparse_;
  RimLooker rims_;
  TraceBatch batch_;
  std::vector<SeenPoint> points_;  // of one ray
  Tile tile_{};
  TileCounts counts_;
  ThinLight thin_light_;  // in the tile
};

}  // namespace

Composite composite(const Tracer& tracer, const std::vector<SurfaceLook>& looks, const Sampling& sampling,
                    const EmptySpace& empty) {
  const Camera& camera = tracer.camera();
  Composite result{{blank_picture(camera), {}}, std::vector<double>(looks.size(), 0.0)};
  result.shadow.assign(result.picture.pixels.size(), 0.0F);
  const ThinBodies thin = sampling.max > 1 ? ThinBodies(tracer) : ThinBodies();
  const int columns = (camera.full_width() + kTileSize - 1) / kTileSize;
  const int rows = (camera.full_height() + kTileSize - 1) / kTileSize;
  std::vector<TileCounts> counts(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  tbb::parallel_for(tbb::blocked_range<int>(0, columns * rows), [&](const tbb::blocked_range<int>& range) {
    TileTaker taker(tracer, looks, sampling, empty, thin);
    for (int i = range.begin(); i != range.end(); ++i) {
      const int left = i % columns * kTileSize, top = i / columns * kTileSize;
      const Tile tile{left, top, std::min(kTileSize, camera.full_width() - left),
                      std::min(kTileSize, camera.full_height() - top)};
      counts[static_cast<std::size_t>(i)] = taker.take(tile, result);
    }
  });
  for (const TileCounts& of_tile : counts) {  // in one order, so that the sums are always the same
    for (std::size_t k = 0; k < looks.size(); ++k) result.hits[k] += of_tile.hits[k];
    result.rays += of_tile.rays;
    result.unresolved += of_tile.unresolved;
    result.refined += of_tile.refined;
  }
  return result;
}

Picture blank_picture(const Camera& camera) {
  Picture picture{camera.full_width(),
                  camera.full_height(),
                  -camera.overscan,
                  -camera.overscan,
                  camera.width,
                  camera.height,
                  {}};
  picture.pixels.assign(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height),
                        {});
  return picture;
}

void expose(double stops, Picture& picture) {
  if (stops == 0.0) return;
  const auto gain = static_cast<float>(std::exp2(stops));
  for (Rgba& pixel : picture.pixels) {
    for (std::size_t c = 0; c < 3; ++c) pixel[c] *= gain;
  }
}

void blacken_shadow(ShadowedPicture& result) {
  for (std::size_t i = 0; i < result.shadow.size(); ++i) result.picture.pixels[i][3] += result.shadow[i];
}

void add(const Composite& other, Composite& sum) {
  for (std::size_t i = 0; i < sum.shadow.size(); ++i) sum.shadow[i] += other.shadow[i];
  for (std::size_t i = 0; i < sum.picture.pixels.size(); ++i) {
    for (std::size_t c = 0; c < 4; ++c) sum.picture.pixels[i][c] += other.picture.pixels[i][c];
  }
  for (std::size_t k = 0; k < sum.hits.size(); ++k) sum.hits[k] += other.hits[k];
  sum.rays += other.rays;
  sum.unresolved += other.unresolved;
  sum.refined += other.refined;
}

void scale(double by, Composite& composite) {
  for (Rgba& pixel : composite.picture.pixels) {
    for (float& channel : pixel) channel *= static_cast<float>(by);
  }
  for (float& shadow : composite.shadow) shadow *= static_cast<float>(by);
  for (double& hits : composite.hits) hits *= by;
}

}  // namespace lensplane
