// SPDX-License-Identifier: Apache-2.0
//
// Maps of any size, band by band of rows, with soft edges: coverage looks at neighbours, which may lie in
// another band.

#pragma once

#include <optional>

#include "src/map_coverage.h"

namespace lensplane {

/// Makes the maps of a tracer's camera from the top down.
class MapBands {
 public:
  /// Without a filter the maps are those of trace_maps(). `tracer` has to stay.
  MapBands(const Tracer& tracer, std::optional<FilmFilter> filter);

  /// Traces on down to row `until`, which lies below those traced before: fastest are multiples of
  /// TileLevels::size. Returns the rows that are finished with this.
  RowRange trace_until(int until);

  /// Where the first finished row begins in maps().
  std::size_t first_sample() const;
  const std::vector<LensMap>& maps() const { return maps_; }

  std::int64_t rays() const { return rays_; }              // that were traced so far
  std::int64_t unresolved() const { return unresolved_; }  // pixels whose ray was given up

 private:
  /// How many rows at the end of maps() the next band needs once more.
  int rows_to_keep() const;

  const Tracer& tracer_;
  std::optional<FilmFilter> filter_;
  ThinCoverage thin_;
  std::vector<LensMap> maps_;
  std::vector<LensMap> kept_;  // as their centres see them: the last rows of maps(), for the next band
  RowRange held_;              // the rows of maps_
  RowRange finished_;
  std::int64_t rays_ = 0, unresolved_ = 0;
};

}  // namespace lensplane
