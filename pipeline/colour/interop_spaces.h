// SPDX-License-Identifier: Apache-2.0
//
// What colour spaces are called between programs: the `colorInteropID` of image files, and what the spaces
// of an OpenColorIO config are by it.

#pragma once

#include <OpenColorIO/OpenColorIO.h>

#include <optional>
#include <string>

#include "pipeline/image/exr_format.h"

namespace lensplane {

/// A colour space that has an ID.
struct InteropSpace {
  const char* id;
  std::array<const char*, 3> names;  // what configs call it, besides the ID
  Chromaticities chromaticities;
  enum class Curve { Linear, Srgb, Power, Other } curve;
  double gamma = 1;  // of Curve::Power
};

/// The space among those with an ID that `space` of `config` is; null when it is none of them.
const InteropSpace* find_interop_space(const OCIO_NAMESPACE::Config& config, const std::string& space);

/// The space with this ID; null when there is none.
const InteropSpace* interop_space_of(const std::string& id);

/// The space of `config` with the name or alias `id`, or with one of the names of the space of that ID;
/// "data": its first space for data. Nothing when it has none.
std::optional<std::string> space_of_interop_id(const OCIO_NAMESPACE::Config& config, const std::string& id);

}  // namespace lensplane
