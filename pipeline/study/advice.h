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

/// "14 ms", "1.2 s".
std::string readable_seconds(double seconds);

/// "0.0021 px", or "no limit".
std::string readable_pixels(double px);

/// What an effect adds, or would add if it were on: "3.2 ms", "would add 3.2 ms", "too little to tell" of
/// less than kNoise of the whole, or "-" of what was not measured.
std::string readable_price(const Price& price);
inline constexpr double kNoise = 0.02;

/// Which pixels are compared: "240 x 135 pixels, one in 8 both ways".
std::string readable_grid(const FilmGrid& grid);

/// "13 MB"; "-" where it is not known.
std::string readable_memory(const std::optional<std::size_t>& bytes);

/// "8.0 %", "< 0.1 %" of what is more than nothing.
std::string readable_share(double share);

}  // namespace lensplane
