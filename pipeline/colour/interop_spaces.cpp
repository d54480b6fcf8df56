// SPDX-License-Identifier: Apache-2.0

#include "pipeline/colour/interop_spaces.h"

namespace lensplane {
namespace {

namespace OCIO = OCIO_NAMESPACE;

// Primaries and white from SMPTE ST 2065-1, ACES TB-2014-004, ITU-R BT.709, SMPTE EG 432-1 (with the white
// of D65), and ITU-R BT.2020.
constexpr Chromaticities kAp1 = {{{.713F, .293F}, {.165F, .830F}, {.128F, .044F}, {.32168F, .33767F}}};
constexpr Chromaticities kAp0 = {{{.7347F, .2653F}, {0.F, 1.F}, {.0001F, -.077F}, {.32168F, .33767F}}};
constexpr Chromaticities kRec709 = {{{.64F, .33F}, {.30F, .60F}, {.15F, .06F}, {.3127F, .3290F}}};
constexpr Chromaticities kP3D65 = {{{.680F, .320F}, {.265F, .690F}, {.150F, .060F}, {.3127F, .3290F}}};
constexpr Chromaticities kRec2020 = {{{.708F, .292F}, {.170F, .797F}, {.131F, .046F}, {.3127F, .3290F}}};

using Curve = InteropSpace::Curve;

// IDs of the Color Interop Forum; names from the ACES configs of OpenColorIO, versions 1 and 2.
constexpr std::array<InteropSpace, 9> kInteropSpaces = {{
    {"lin_ap1_scene", {"ACEScg", "lin_ap1", "ACES - ACEScg"}, kAp1, Curve::Linear},
    {"lin_ap0_scene", {"ACES2065-1", "lin_ap0", "ACES - ACES2065-1"}, kAp0, Curve::Linear},
    {"lin_rec709_scene", {"lin_rec709", "lin_srgb", "Utility - Linear - sRGB"}, kRec709, Curve::Linear},
    {"srgb_rec709_scene", {"sRGB - Texture", "srgb_tx", "Utility - sRGB - Texture"}, kRec709, Curve::Srgb},
    {"g22_rec709_scene",
     {"Gamma 2.2 Rec.709 - Texture", "g22_rec709", "rec709_g22"},
     kRec709,
     Curve::Power,
     2.2},
    {"srgb_rec709_display", {"sRGB - Display", "srgb_display", "sRGB"}, kRec709, Curve::Srgb},
    {"g24_rec709_display",
     {"Rec.1886 Rec.709 - Display", "rec1886_rec709_display", "Rec.709"},
     kRec709,
     Curve::Power,
     2.4},
    {"g26_p3d65_display", {"P3-D65 - Display", "p3d65_display", "P3-D65"}, kP3D65, Curve::Power, 2.6},
    {"pq_rec2020_display",
     {"Rec.2100-PQ - Display", "rec2100_pq_display", "Rec.2100-PQ"},
     kRec2020,
     Curve::Other},
}};

bool is_named(const OCIO::Config& config, const char* name, const std::string& space) {
  const auto candidate = config.getColorSpace(name);
  return candidate && candidate->getName() == space;
}

}  // namespace

const InteropSpace* find_interop_space(const OCIO::Config& config, const std::string& space) {
  const auto wanted = config.getColorSpace(space.c_str());
  if (!wanted || wanted->isData()) return nullptr;
  for (const InteropSpace& known : kInteropSpaces) {
    if (is_named(config, known.id, wanted->getName())) return &known;
    for (const char* name : known.names) {
      if (is_named(config, name, wanted->getName())) return &known;
    }
  }
  return nullptr;
}

const InteropSpace* interop_space_of(const std::string& id) {
  for (const InteropSpace& known : kInteropSpaces) {
    if (id == known.id) return &known;
  }
  return nullptr;
}

std::optional<std::string> space_of_interop_id(const OCIO::Config& config, const std::string& id) {
  if (const auto named = config.getColorSpace(id.c_str())) return named->getName();
  if (id == "data") {
    for (int i = 0; i < config.getNumColorSpaces(); ++i) {
      const auto space = config.getColorSpace(config.getColorSpaceNameByIndex(i));
      if (space->isData()) return space->getName();
    }
  }
  const InteropSpace* known = interop_space_of(id);
  if (!known) return std::nullopt;
  for (const char* name : known->names) {
    if (const auto named = config.getColorSpace(name)) return named->getName();
  }
  return std::nullopt;
}

}  // namespace lensplane
