// SPDX-License-Identifier: Apache-2.0

#include "src/map_coverage.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <span>
#include <utility>

#include "src/map_channels.h"
#include "src/map_edges.h"

namespace lensplane {
namespace {

/// The coverage of what the centre alone sees: next to nothing, but not lost.
constexpr float kLeastSeen = 1e-3F;

/// What one ray of a pixel sees of one surface.
struct Glimpse {
  Outcome outcome = Outcome::Missed;
  double s = 0, t = 0;
};

/// Traces more rays through edge pixels; one for each thread.
class EdgeTracer {
 public:
  EdgeTracer(const Tracer& tracer, const FilmFilter& filter, const ThinCoverage& thin, int top,
             std::vector<LensMap>& maps)
      : tracer_(tracer),
        plain_(tracer.without_passes()),
        filter_(filter),
        thin_(thin),
        top_(top),
        maps_(maps),
        plain_batch_(plain_.make_batch()),
        batch_(tracer.make_batch()) {}

  void take(std::span<const MapPixel> pixels) {
    pixels_ = pixels;
    glimpses_.assign(pixels.size() * maps_.size() * filter_.points.size(), {});
    std::vector<std::size_t> wanting(pixels.size());
    for (std::size_t p = 0; p < wanting.size(); ++p) wanting[p] = p;
    counts_.assign(pixels.size(), filter_.first);
    add_rays(wanting, 0, filter_.first);
    std::erase_if(wanting, [&](std::size_t p) { return all_alike(p); });
    for (const std::size_t p : wanting) counts_[p] = filter_.points.size();
    add_rays(wanting, filter_.first, filter_.points.size());
    std::vector<Chosen> chosen;
    for (std::size_t p = 0; p < pixels.size(); ++p) {
      for (std::size_t k = 0; k < maps_.size(); ++k) set(p, k, chosen);
    }
    if (!maps_.front().passes.empty()) trace_passes(chosen);
  }

  std::int64_t rays() const { return rays_; }

 private:
  /// The ray whose point of the surface a pixel shows.
  struct Chosen {
    std::size_t pixel, surface, ray;
  };

  FilmPosition film(std::size_t pixel, std::size_t ray) const {
    const int overscan = tracer_.camera().overscan;
    return {pixels_[pixel].column - overscan + 0.5 + filter_.points[ray].x,
            top_ + pixels_[pixel].row - overscan + 0.5 + filter_.points[ray].y};
  }

  Glimpse& glimpse(std::size_t pixel, std::size_t surface, std::size_t ray) {
    return glimpses_[(pixel * maps_.size() + surface) * filter_.points.size() + ray];
  }

  /// Traces ray number n of `rays`, which goes through film position `position(n)`, and calls `use(n, i)`
  /// where it is number i of its batch.
  template <class Position, class Use>
  void trace(const Tracer& tracer, std::size_t rays, TraceBatch& batch, Position position, Use use) {
    for (std::size_t first = 0; first < rays; first += kBatchSize) {
      const std::size_t count = std::min<std::size_t>(kBatchSize, rays - first);
      for (std::size_t i = 0; i < kBatchSize; ++i) {
        const FilmPosition film = position(first + std::min(i, count - 1));
        batch.x[i] = film.x, batch.y[i] = film.y;
      }
      tracer.trace(batch);
      rays_ += static_cast<std::int64_t>(count);
      for (std::size_t i = 0; i < count; ++i) use(first + i, i);
    }
  }

  void add_rays(const std::vector<std::size_t>& pixels, std::size_t from, std::size_t until) {
    const std::size_t each = until - from;
    trace(
        plain_, pixels.size() * each, plain_batch_,
        [&](std::size_t n) { return film(pixels[n / each], from + n % each); },
        [&](std::size_t n, std::size_t i) {
          for (std::size_t k = 0; k < maps_.size(); ++k) {
            const SurfaceBatch& surface = plain_batch_.surfaces[k];
            Outcome outcome = surface.outcome[i];
            const bool thin =
                outcome == Outcome::Hit && thin_.holds({plain_batch_.x[i], plain_batch_.y[i]}, k);
            if (thin) outcome = Outcome::Missed;  // is counted as a whole
            glimpse(pixels[n / each], k, from + n % each) = {outcome, surface.s[i], surface.t[i]};
          }
        });
  }

  /// Do all rays of a pixel see what its centre does?
  bool all_alike(std::size_t pixel) {
    for (std::size_t k = 0; k < maps_.size(); ++k) {
      const std::size_t at = place_in(maps_[k], pixels_[pixel].row, pixels_[pixel].column);
      const bool centre_hits = maps_[k].valid[at] != 0;
      for (std::size_t ray = 0; ray < counts_[pixel]; ++ray) {
        const Outcome outcome = glimpse(pixel, k, ray).outcome;
        if ((outcome == Outcome::Hit) != centre_hits || outcome != glimpse(pixel, k, 0).outcome) return false;
      }
    }
    return true;
  }

  float share_of(std::size_t pixel, std::size_t surface, Outcome outcome) {
    std::size_t found = 0;
    for (std::size_t ray = 0; ray < counts_[pixel]; ++ray)
      found += glimpse(pixel, surface, ray).outcome == outcome ? 1 : 0;
    return static_cast<float>(found) / static_cast<float>(counts_[pixel]);
  }

  /// Of the rays that hit, the one nearest to the middle of them.
  std::size_t middle_of_hits(std::size_t pixel, std::size_t surface) {
    FilmOffset sum;
    double hits = 0;
    const auto for_hits = [&](auto use) {
      for (std::size_t ray = 0; ray < counts_[pixel]; ++ray) {
        if (glimpse(pixel, surface, ray).outcome == Outcome::Hit) use(ray, filter_.points[ray]);
      }
    };
    for_hits([&](std::size_t, const FilmOffset& at) { sum.x += at.x, sum.y += at.y, hits += 1; });
    double least = std::numeric_limits<double>::infinity();
    std::size_t nearest = 0;
    for_hits([&](std::size_t ray, const FilmOffset& at) {
      const double x = at.x - sum.x / hits, y = at.y - sum.y / hits, away = x * x + y * y;
      if (away < least) least = away, nearest = ray;
    });
    return nearest;
  }

  /// Writes coverage and shadow, and where the centre misses the surface also s and t.
  void set(std::size_t pixel, std::size_t surface, std::vector<Chosen>& chosen) {
    LensMap& map = maps_[surface];
    const std::size_t at = place_in(map, pixels_[pixel].row, pixels_[pixel].column);
    const bool centre_hits = map.valid[at] != 0;
    const float share = share_of(pixel, surface, Outcome::Hit);
    map.valid[at] = std::max(share, centre_hits ? kLeastSeen : 0.0F);
    for (Pass& pass : map.passes) {
      if (pass.channel == kShadowChannel) pass.values[at] = share_of(pixel, surface, Outcome::Captured);
    }
    if (centre_hits || share == 0) return;
    chosen.push_back({pixel, surface, middle_of_hits(pixel, surface)});
    const Glimpse& seen = glimpse(pixel, surface, chosen.back().ray);
    map.s[at] = static_cast<float>(seen.s);
    map.t[at] = static_cast<float>(seen.t);
  }

  void trace_passes(const std::vector<Chosen>& chosen) {
    trace(
        tracer_, chosen.size(), batch_, [&](std::size_t n) { return film(chosen[n].pixel, chosen[n].ray); },
        [&](std::size_t n, std::size_t i) {
          const MapPixel& pixel = pixels_[chosen[n].pixel];
          LensMap& map = maps_[chosen[n].surface];
          store_passes(batch_.surfaces[chosen[n].surface], static_cast<int>(i),
                       place_in(map, pixel.row, pixel.column), map);
        });
  }

  const Tracer& tracer_;
  Tracer plain_;
  const FilmFilter& filter_;
  const ThinCoverage& thin_;
  int top_;
  std::vector<LensMap>& maps_;
  TraceBatch plain_batch_, batch_;
  std::span<const MapPixel> pixels_;
  std::vector<std::size_t> counts_;  // rays of each pixel
  std::vector<Glimpse> glimpses_;    // by pixel, surface and ray
  std::int64_t rays_ = 0;
};

/// The nearest pixel within reach that sees something of the surface; the pixel itself where none does.
MapPixel nearest_seen(const LensMap& map, MapPixel pixel) {
  MapPixel nearest = pixel;
  int least = std::numeric_limits<int>::max();
  for (int row = std::max(pixel.row - kExtension, 0); row <= std::min(pixel.row + kExtension, map.height - 1);
       ++row) {
    for (int column = std::max(pixel.column - kExtension, 0);
         column <= std::min(pixel.column + kExtension, map.width - 1); ++column) {
      const int x = column - pixel.column, y = row - pixel.row, away = x * x + y * y;
      if (map.valid[place_in(map, row, column)] != 0 && away < least) least = away, nearest = {row, column};
    }
  }
  return nearest;
}

/// Lets s, t and what the passes say of the surface go on into the pixels of a row that see nothing of it.
void extend_row(const std::vector<std::vector<int>>& edges, int row, LensMap& map) {
  std::vector<std::uint8_t> done(static_cast<std::size_t>(map.width), 0);
  for (int near = std::max(row - kExtension, 0); near <= std::min(row + kExtension, map.height - 1); ++near) {
    for (const int edge : edges[static_cast<std::size_t>(near)]) {
      const int last = std::min(edge + kExtension, map.width - 1);
      for (int column = std::max(edge - kExtension, 0); column <= last; ++column) {
        const std::size_t at = place_in(map, row, column);
        if (map.valid[at] != 0 || std::exchange(done[static_cast<std::size_t>(column)], 1)) continue;
        const MapPixel nearest = nearest_seen(map, {row, column});
        const std::size_t from = place_in(map, nearest.row, nearest.column);
        map.s[at] = map.s[from], map.t[at] = map.t[from];
        for (Pass& pass : map.passes) {
          if (is_of_surface(pass.channel)) pass.values[at] = pass.values[from];
        }
      }
    }
  }
}

/// The shares of thin images that lie in `rows`.
std::span<const ThinShare> shares_in(const ThinCoverage& thin, RowRange rows) {
  const auto at = [&](int row) {
    return std::partition_point(thin.shares().begin(), thin.shares().end(),
                                [&](const ThinShare& share) { return share.pixel.row < row; });
  };
  return {at(rows.begin), at(rows.end)};
}

void add_columns(std::span<const ThinShare> shares, int top, std::vector<std::vector<int>>& edges) {
  for (const ThinShare& share : shares) {
    std::vector<int>& columns = edges[static_cast<std::size_t>(share.pixel.row - top)];
    const auto after = std::lower_bound(columns.begin(), columns.end(), share.pixel.column);
    if (after == columns.end() || *after != share.pixel.column) columns.insert(after, share.pixel.column);
  }
}

/// Adds what thin images cover, and where nothing else is seen what they show.
void add_thin(const Tracer& tracer, std::span<const ThinShare> shares, int top, std::vector<LensMap>& maps) {
  std::vector<const ThinShare*> shown;
  const auto place = [&](const ThinShare& share) {
    return place_in(maps[share.surface], share.pixel.row - top, share.pixel.column);
  };
  for (const ThinShare& share : shares) {
    LensMap& map = maps[share.surface];
    const std::size_t at = place(share);
    float& valid = map.valid[at];
    if (valid == 0) {
      map.s[at] = static_cast<float>(share.st.s), map.t[at] = static_cast<float>(share.st.t);
      shown.push_back(&share);
    }
    const double other = valid > kLeastSeen ? valid : 0.0;
    valid = static_cast<float>(std::min(other + share.share, 1.0));
  }
  if (maps.front().passes.empty()) return;
  TraceBatch batch = tracer.make_batch();
  for (std::size_t first = 0; first < shown.size(); first += kBatchSize) {
    const std::size_t count = std::min<std::size_t>(kBatchSize, shown.size() - first);
    for (std::size_t i = 0; i < kBatchSize; ++i) {
      const FilmPosition& film = shown[first + std::min(i, count - 1)]->film;
      batch.x[i] = film.x, batch.y[i] = film.y;
    }
    tracer.trace(batch);
    for (std::size_t i = 0; i < count; ++i) {
      const ThinShare& share = *shown[first + i];
      store_passes(batch.surfaces[share.surface], static_cast<int>(i), place(share), maps[share.surface]);
    }
  }
}

}  // namespace

std::int64_t filter_coverage(const Tracer& tracer, const FilmFilter& filter, const ThinCoverage& thin,
                             RowRange rows, std::vector<LensMap>& maps) {
  if (maps.empty()) return 0;
  const int height = rows.end - rows.begin;
  MapEdges found = find_edges(tracer, rows, maps);
  std::vector<std::vector<int>>& edges = found.columns;
  const std::span<const ThinShare> shares = shares_in(thin, rows);
  add_columns(shares, rows.begin, edges);
  std::atomic<std::int64_t> rays = found.rays;
  std::vector<MapPixel> pixels;
  for (int row = 0; row < height; ++row) {
    for (const int column : edges[static_cast<std::size_t>(row)]) pixels.push_back({row, column});
  }
  if (pixels.empty()) return rays;
  constexpr std::size_t kChunk = 64;  // pixels: whole batches
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, (pixels.size() + kChunk - 1) / kChunk),
                    [&](const tbb::blocked_range<std::size_t>& chunks) {
                      EdgeTracer edge_tracer(tracer, filter, thin, rows.begin, maps);
                      for (std::size_t i = chunks.begin(); i != chunks.end(); ++i) {
                        const std::size_t first = i * kChunk;
                        edge_tracer.take({&pixels[first], std::min(kChunk, pixels.size() - first)});
                      }
                      rays += edge_tracer.rays();
                    });
  add_thin(tracer, shares, rows.begin, maps);
  tbb::parallel_for(0, height, [&](int row) {
    for (LensMap& map : maps) extend_row(edges, row, map);
  });
  return rays;
}

}  // namespace lensplane
