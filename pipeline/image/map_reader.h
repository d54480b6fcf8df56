// SPDX-License-Identifier: Apache-2.0
//
// Deflection maps from disk: STMaps of ours, edited ones, and those of other programs, with the data files
// beside ours.

#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "pipeline/image/pixel_windows.h"

namespace lensplane {

/// Where t = 0 lies.
enum class StOrigin { BottomLeft, TopLeft };

/// Which point of a picture is seen at every pixel, row by row from the top. s and t are finite; origin at
/// the bottom left, as everywhere in memory.
struct StMap : PixelWindows {
  bool half = false;  // s and t were stored as half: blocks of up to half a pixel and more
  std::vector<float> s, t;
  std::vector<float> coverage;  // 0 to 1; 0 where s and t mean nothing
};

/// Derivatives of s and t by the film position, per pixel; x to the right, y down.
struct MapJacobian {
  std::vector<float> ds_dx, ds_dy, dt_dx, dt_dy;
};

/// What a data file has that a picture is made with.
struct MapData {
  std::optional<MapJacobian> jacobian;
  std::vector<float> depth;  // metres along the ray, the largest float at infinity; empty when there is none
  std::vector<float> alpha;  // A, which the file of the shadow has; empty when there is none
};

/// Reads s from R, t from G, coverage from B, without B (or where B is 0 everywhere though s or t is not)
/// from A, else it is 1. `origin` says where t = 0 lies; nothing: as the file says by lensplane:st_origin,
/// else at the bottom left. What is not a finite number counts as not covered. Throws Failure (BadInput) that
/// names the path when the file is missing, broken, no map, or one of whole numbers.
StMap read_st_map(const std::filesystem::path& path, std::optional<StOrigin> origin = std::nullopt);

/// Reads what there is of a data file's jacobian.*, depth.z and A. Throws Failure (BadInput) also when its
/// windows are not those of `map`.
MapData read_map_data(const std::filesystem::path& path, const StMap& map);

/// The data file beside a map of ours: SHOT.LAYER.data.1001.exr for SHOT.LAYER.map.1001.exr; nothing when the
/// name is none of ours or there is no such file.
std::optional<std::filesystem::path> data_file_beside(const std::filesystem::path& map);

}  // namespace lensplane
