// SPDX-License-Identifier: Apache-2.0
//
// A plan in words: why each lens and each effect is treated as it is, and the whole in one line.
//
// Where light may be captured everything is simulated (plan_bounds.h), whatever the lenses need elsewhere.
// The words say on how much of the film that is.

#pragma once

#include <string>

#include "src/plan.h"
#include "src/plan_bounds.h"

namespace lensplane {

/// "0.021 px", or "without limit".
std::string in_pixels(double px);

/// "36 %", of a share from 0 to 1; what is more than 0 never reads as 0, what is less than 1 never as 100.
std::string in_percent(double share);

/// Why a lens of the given bounds is culled, or has its law. `near_masses`: the share of the film on which
/// everything is simulated.
std::string reason_of(const LensPlan& lens, const LensBound& bound, double near_masses);

/// The reason for a finite distance that is simulated only on the share `near_masses` of the film.
std::string reason_near_masses(double near_masses, double elsewhere_px);

/// Why bodies are met by curved rays on the share `curved` of the film, where chords would misplace them by
/// up to `there_px`, and by chords elsewhere.
std::string reason_of_curves(double curved, double there_px, double elsewhere_px);

/// The plan in one line: "planes: 3 lenses, 2 weak, 1 exact; finite distance off; within 0.021 px".
std::string describe(const Plan& plan);

}  // namespace lensplane
