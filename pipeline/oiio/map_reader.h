// SPDX-License-Identifier: Apache-2.0
//
// Deflection maps from disk.

#pragma once

#include "pipeline/image/map_reader.h"

namespace lensplane::oiio {

/// As pipeline/image/map_reader.h has them.
StMap read_st_map(const std::filesystem::path& path, std::optional<StOrigin> origin);
MapData read_map_data(const std::filesystem::path& path, const StMap& map);

}  // namespace lensplane::oiio
