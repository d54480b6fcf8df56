// SPDX-License-Identifier: Apache-2.0
//
// A plan as a person reads it.

#pragma once

#include <string>

#include "pipeline/cli/planned_frame.h"
#include "pipeline/shot/shot.h"

namespace lensplane {

/// Of more lenses than kManyLenses only the kLensesShown that move most are listed, the others counted.
inline constexpr std::size_t kManyLenses = 40;
inline constexpr std::size_t kLensesShown = 20;

/// Lenses, effects and tiles in tables.
std::string text_from_plan(const Shot& shot, const PlannedFrame& planned);

/// How often each law stands in a recipe: "weak 2, exact 1".
std::string laws_of(const Deflectors& recipe);

}  // namespace lensplane
