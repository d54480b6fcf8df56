// SPDX-License-Identifier: Apache-2.0
//
// The colour management that a shot asks for.

#pragma once

#include "pipeline/colour/colour_config.h"
#include "pipeline/shot/shot.h"

namespace lensplane {

/// The config of the shot, else that of $OCIO (`environment`, null when not set), else the built-in one.
/// Throws Failure: BadInput when a config or the file of a grade cannot be read; BadShot when the shot names
/// a colour space, display or view that it does not have, or a working space in which light does not add up.
ColourConfig load_colours(const Shot& shot, const char* environment);

/// How the shot's pictures are shown.
ViewSettings view_of(const Shot& shot);

/// The second half of the above: whether `colours` has what the shot names.
void check_colours(const Shot& shot, const ColourConfig& colours);

}  // namespace lensplane
