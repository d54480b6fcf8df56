// SPDX-License-Identifier: Apache-2.0
//
// A peer: OpenImageIO's st_warp, by our map with all its digits.

#pragma once

#include <string>

#include "pipeline/composite/texel_place.h"
#include "pipeline/image/picture.h"
#include "src/lens_map.h"

namespace lensplane {

/// `plate` as seen through the map, premultiplied by its coverage. `filter`: one of OpenImageIO's, or empty
/// for what it takes by itself. It knows no edges: the plate is continued for it as `edge` says, by a tenth
/// of its width.
Picture warped_by_oiio(const LensMap& map, const Picture& plate, Wrap edge, const std::string& filter);

}  // namespace lensplane
