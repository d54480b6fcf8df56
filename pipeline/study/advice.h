// SPDX-License-Identifier: Apache-2.0
//
// What a study comes to: which rows are worth their time, and one sentence of advice.

#pragma once

#include "pipeline/study/study.h"

namespace lensplane {

/// Marks the rows for which no other is both at least as fast and at least as right: of traces by what 99 of
/// 100 pixels are within (ErrorSummary::judged_px), of pictures by PSNR.
void mark_pareto(Study& study);

/// One sentence: "for 0.1 px in 99 of 100 pixels use planes, law auto, 0.1 px, finite distance off: 14 ms;
/// the paper's method is 0.4 px off (0.8 px at (203.5, 118.5), 12 px from near)".
std::string advice_of(const Study& study);

}  // namespace lensplane
