// SPDX-License-Identifier: Apache-2.0

#include "pipeline/study/readable.h"

#include <fmt/format.h>

#include <cmath>

namespace lensplane {
namespace {

std::string number(double px) {
  return std::isfinite(px) ? fmt::format("{:.2g}", px) : "no limit";
}

}  // namespace

std::string readable_seconds(double seconds) {
  if (std::abs(seconds) < 1) return fmt::format("{:.3g} ms", seconds * 1e3);
  return fmt::format("{:.3g} s", seconds);
}

std::string readable_pixels(double px) {
  return std::isfinite(px) ? fmt::format("{:.2g} px", px) : "no limit";
}

std::string readable_price(const Price& price) {
  if (price.seconds == 0) return "-";
  const double least_s = kNoise * price.base_s;
  if (price.on ? std::abs(price.seconds) < least_s : price.seconds < least_s) return "too little to tell";
  return (price.on ? "" : "would add ") + readable_seconds(price.seconds);
}

std::string readable_grid(const FilmGrid& grid) {
  const std::string pixels = fmt::format("{} x {} pixels", grid.columns, grid.rows);
  return grid.step == 1 ? pixels + ", all that there are"
                        : fmt::format("{}, one in {} both ways", pixels, grid.step);
}

std::string readable_memory(const std::optional<std::size_t>& bytes) {
  return bytes ? fmt::format("{:.0f} MB", static_cast<double>(*bytes) / 1e6) : "-";
}

std::string readable_share(double share) {
  return share > 0 && share < 1e-3 ? "< 0.1 %" : fmt::format("{:.1f} %", 100 * share);
}

std::vector<std::string> error_cells(const TraceRow& row) {
  const ErrorSummary& e = row.error;
  const auto of_compared = [&](double px) { return e.compared > 0 ? number(px) : "-"; };
  const std::string bound = row.bound_px ? number(*row.bound_px) : "-";
  const std::string left_out = row.bound_px ? number(row.left_out.most_px) : "-";
  return {of_compared(e.median_px),
          of_compared(e.p99_px),
          of_compared(e.most_px),
          readable_share(e.share_seen),
          readable_share(e.share_validity_differs),
          bound,
          row.violated ? fmt::format("{} VIOLATES IT", left_out) : left_out,
          readable_memory(row.peak_bytes)};
}

}  // namespace lensplane
