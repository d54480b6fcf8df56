// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/map_jacobian.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace lensplane {
namespace {

/// From one pixel to the next.
struct Step {
  double s = 0, t = 0;
  double length = 0;  // pixels of the picture
};

/// A row or a column of a map.
class Line {
 public:
  Line(const StMap& map, const MappedPicture& picture, std::size_t first, std::size_t stride, int count)
      : map_(map), picture_(picture), first_(first), stride_(stride), count_(count) {}

  /// The derivative at pixel `i` along the line.
  Step derivative(int i) const {
    const auto before = smooth_step(i - 1), after = smooth_step(i);
    if (before && after) return {(before->s + after->s) / 2, (before->t + after->t) / 2};
    if (before) return *before;
    return after.value_or(Step{});
  }

 private:
  std::size_t index(int i) const { return first_ + stride_ * static_cast<std::size_t>(i); }
  bool covered(int i) const { return i >= 0 && i < count_ && map_.coverage[index(i)] > 0; }

  /// From pixel `i` to the next, unless one of them has no coverage.
  std::optional<Step> step(int i) const {
    if (!covered(i) || !covered(i + 1)) return std::nullopt;
    Step step;
    step.s = double{map_.s[index(i + 1)]} - map_.s[index(i)];
    step.t = double{map_.t[index(i + 1)]} - map_.t[index(i)];
    if (picture_.s_repeats) step.s -= std::round(step.s);
    if (picture_.t_repeats) step.t -= std::round(step.t);
    step.length = std::hypot(step.s * picture_.width, step.t * picture_.height);
    return step;
  }

  /// The length of the steps around step `i`, of two to each side: the lower median, so that of two jumps
  /// beside one another neither makes the other look right. Nothing where there are none.
  std::optional<double> length_around(int i) const {
    std::array<double, 4> lengths{};
    std::size_t count = 0;
    for (const int neighbour : {i - 2, i - 1, i + 1, i + 2}) {
      if (const auto near = step(neighbour)) lengths[count++] = near->length;
    }
    if (count == 0) return std::nullopt;
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>((count - 1) / 2);
    std::nth_element(lengths.begin(), middle, lengths.begin() + static_cast<std::ptrdiff_t>(count));
    return *middle;
  }

  std::optional<Step> smooth_step(int i) const {
    const auto taken = step(i);
    if (!taken || taken->length <= kShortStep) return taken;
    const auto around = length_around(i);
    if (!around || taken->length > kJump * std::max(*around, kShortStep / kJump)) return std::nullopt;
    return taken;
  }

  const StMap& map_;
  const MappedPicture& picture_;
  std::size_t first_, stride_;
  int count_;
};

Footprint footprint_at(const StMap& map, const MappedPicture& picture, int column, int row) {
  const Line along_row(map, picture, map.index(0, row), 1, map.width);
  const Line along_column(map, picture, map.index(column, 0), static_cast<std::size_t>(map.width),
                          map.height);
  const Step dx = along_row.derivative(column), dy = along_column.derivative(row);
  return {dx.s, dy.s, dx.t, dy.t};
}

/// Calls `make(column, row)` for every covered pixel, rows in parallel.
template <class Make>
std::vector<Footprint> for_covered(const StMap& map, Make make) {
  std::vector<Footprint> footprints(map.s.size());
  tbb::parallel_for(tbb::blocked_range<int>(0, map.height), [&](const tbb::blocked_range<int>& rows) {
    for (int row = rows.begin(); row != rows.end(); ++row) {
      for (int column = 0; column < map.width; ++column) {
        const std::size_t i = map.index(column, row);
        if (map.coverage[i] > 0) footprints[i] = make(column, row);
      }
    }
  });
  return footprints;
}

}  // namespace

std::vector<Footprint> footprints_from_differences(const StMap& map, const MappedPicture& picture) {
  return for_covered(map, [&](int column, int row) { return footprint_at(map, picture, column, row); });
}

std::vector<Footprint> footprints_from_jacobian(const StMap& map, const MapJacobian& jacobian,
                                                const MappedPicture& picture) {
  return for_covered(map, [&](int column, int row) {
    const std::size_t i = map.index(column, row);
    const Footprint traced{jacobian.ds_dx[i], jacobian.ds_dy[i], jacobian.dt_dx[i], jacobian.dt_dy[i]};
    const bool is_there = traced.ds_dx != 0 || traced.ds_dy != 0 || traced.dt_dx != 0 || traced.dt_dy != 0;
    const bool is_finite = std::isfinite(traced.ds_dx) && std::isfinite(traced.ds_dy) &&
                           std::isfinite(traced.dt_dx) && std::isfinite(traced.dt_dy);
    return is_there && is_finite ? traced : footprint_at(map, picture, column, row);
  });
}

}  // namespace lensplane
