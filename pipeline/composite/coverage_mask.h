// SPDX-License-Identifier: Apache-2.0
//
// Which part of a pixel a layer covers: read from the coverage of a map and its neighbours, which say from
// which side the edge comes.
//
// Two layers that are cut by one edge, the rim of a shadow, cover the same part, and what lies behind is not
// seen beside what lies before; two that meet at an edge leave nothing between them. And what is seen of a
// layer at its edge is the middle of the part that it covers, not that of the pixel.

#pragma once

#include <vector>

#include "pipeline/composite/footprint.h"
#include "pipeline/image/map_reader.h"

namespace lensplane {

/// Of a step in coverage at least this large between the pixels around one it is known where its edge runs;
/// smaller ones are soft by intention, and cover all parts of a pixel alike.
inline constexpr double kSharpEdge = 0.5;

/// What a layer covers of each share of a pixel, 0 to 1; the shares are the points of coverage_filter().
using CoverageMask = std::vector<float>;

/// The mask of pixel (column, row), whose mean is the map's coverage there: the pixel is cut by a straight
/// edge square to the slope of the coverage.
CoverageMask coverage_mask(const StMap& map, int column, int row);

/// Where a map looks at a pixel, and how much it covers there.
struct MapPlace {
  TextureCoordinates st;
  Footprint footprint;
};

/// The same for the covered part of the pixel alone. `place` is seen at the pixel's centre where more than
/// half of it is covered, else in the middle of the covered part, as maps with filtered coverage have it.
MapPlace covered_part(const MapPlace& place, const CoverageMask& mask, float coverage);

}  // namespace lensplane
