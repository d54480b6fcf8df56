// SPDX-License-Identifier: Apache-2.0
//
// The figures of a study as people read them, in tables and on the page.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/study/study.h"

namespace lensplane {

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

/// What a row's table tells of it behind its time: median, 99 %, most, share above kSeenErrorPx, share whose
/// validity differs, bound, left out, memory; "-" where there is nothing.
std::vector<std::string> error_cells(const TraceRow& row);

}  // namespace lensplane
