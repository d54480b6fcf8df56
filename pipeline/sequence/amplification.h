// SPDX-License-Identifier: Apache-2.0
//
// A = N_g/N of the paper: how much larger than without lenses a body appears, and how the picture's header
// keeps it.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/shot/shot.h"

namespace lensplane {

/// The area of the frame that a sphere layer covers with the lenses, over that without.
struct Amplification {
  std::string layer;
  std::optional<double> factor;  // nothing when the layer is not in the frame without lenses
};

/// Those of all spheres at a frame, the mean over the time that the shutter is open of both areas. `covered`:
/// pixels that each surface of the scene covers with the lenses.
std::vector<Amplification> amplifications_of(const Shot& shot, int frame, const std::vector<double>& covered);

/// "earth 4.46 moon -", and back.
std::string text_from_amplifications(const std::vector<Amplification>& amplifications);
std::vector<Amplification> amplifications_from_text(const std::string& text);

}  // namespace lensplane
