// SPDX-License-Identifier: Apache-2.0
//
// The glow that a shot's camera has at a frame.

#pragma once

#include <optional>

#include "pipeline/composite/glow.h"
#include "pipeline/shot/shot.h"

namespace lensplane {

/// Nothing when the shot asks for none, or its strength is 0 at this frame.
std::optional<Glow> glow_at(const Shot& shot, double frame);

}  // namespace lensplane
