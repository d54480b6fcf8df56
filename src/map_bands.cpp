// SPDX-License-Identifier: Apache-2.0

#include "src/map_bands.h"

#include <algorithm>

namespace lensplane {
namespace {

/// Calls `use` with all samples of a map, channel by channel, and those of the same channel of another.
template <class Use>
void for_channels(LensMap& a, LensMap& b, Use use) {
  use(a.s, b.s), use(a.t, b.t), use(a.valid, b.valid);
  for (std::size_t pass = 0; pass < a.passes.size(); ++pass)
    use(a.passes[pass].values, b.passes[pass].values);
}

/// The last rows of maps.
std::vector<LensMap> last_rows(std::vector<LensMap>& maps, int rows) {
  std::vector<LensMap> last(maps.size());
  for (std::size_t k = 0; k < maps.size(); ++k) {
    last[k].width = maps[k].width;
    last[k].height = rows;
    last[k].passes.resize(maps[k].passes.size());
    const auto samples = static_cast<std::ptrdiff_t>(rows) * maps[k].width;
    for_channels(maps[k], last[k],
                 [&](const auto& all, auto& some) { some.assign(all.end() - samples, all.end()); });
  }
  return last;
}

/// Pixels whose ray was given up before it met what some map shows.
std::int64_t most_unresolved(const std::vector<LensMap>& maps) {
  std::int64_t most = 0;
  for (const LensMap& map : maps) most = std::max(most, map.unresolved);
  return most;
}

}  // namespace

MapBands::MapBands(const Tracer& tracer, std::optional<FilmFilter> filter)
    : tracer_(tracer), filter_(std::move(filter)) {
  if (filter_) thin_ = ThinCoverage(tracer, filter_->sigma);
  rays_ = thin_.rays();
}

RowRange MapBands::trace_until(int until) {
  const int height = tracer_.camera().full_height();
  const int above = kept_.empty() ? 0 : kept_.front().height;
  const RowRange traced{held_.end, until};
  maps_ = trace_maps(tracer_, traced, std::move(maps_), above);
  rays_ += static_cast<std::int64_t>(tracer_.camera().full_width()) * (traced.end - traced.begin);
  unresolved_ += most_unresolved(maps_);
  held_ = {traced.begin - above, until};
  finished_ = {finished_.end, until};
  if (!filter_) return finished_;
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    for_channels(kept_[k], maps_[k],
                 [](const auto& rows, auto& all) { std::copy(rows.begin(), rows.end(), all.begin()); });
  }
  if (until < height) finished_.end = std::max(finished_.begin, until - kCoverageMargin);
  kept_ = last_rows(maps_, rows_to_keep());
  rays_ += filter_coverage(tracer_, *filter_, thin_, held_, maps_);
  return finished_;
}

int MapBands::rows_to_keep() const {
  return held_.end - std::max(held_.begin, finished_.end - kCoverageMargin);
}

std::size_t MapBands::first_sample() const {
  return static_cast<std::size_t>(finished_.begin - held_.begin) *
         static_cast<std::size_t>(tracer_.camera().full_width());
}

}  // namespace lensplane
