// SPDX-License-Identifier: Apache-2.0

#include "pipeline/cli/study_text.h"

#include <fmt/format.h>

#include "pipeline/cli/table.h"
#include "pipeline/study/readable.h"

namespace lensplane {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string mark_of(bool pareto, bool of_shot) {
  return fmt::format("{}{}", pareto ? "*" : " ", of_shot ? "S" : " ");
}

/// "14 ms (13-17)"; of what was timed in part "~12 s (11-13)".
std::string text_of(const Timing& timing, double more_s = 0) {
  const bool in_s = timing.median_s + more_s >= 1;
  const double unit = in_s ? 1 : 1e3;
  return fmt::format("{}{:.3g} {} ({:.3g}-{:.3g})", timing.of_a_part ? "~" : "",
                     (timing.median_s + more_s) * unit, in_s ? "s" : "ms", (timing.least_s + more_s) * unit,
                     (timing.most_s + more_s) * unit);
}

std::string trace_table(const Study& study) {
  Rows rows;
  rows.push_back({"", "trace", "a frame", "Mrays/s", "median", "99 %", "most", "> 0.1 px", "validity",
                  "bound", "left out", "memory"});
  for (const TraceRow& row : study.traces) {
    std::vector<std::string> cells = {mark_of(row.pareto, row.rung.of_shot), name_of(row.rung.settings),
                                      text_of(row.trace, row.plan_s),
                                      fmt::format("{:.3g}", study.rays_per_s(row) / 1e6)};
    const std::vector<std::string> errors = error_cells(row);
    cells.insert(cells.end(), errors.begin(), errors.end());
    rows.push_back(cells);
  }
  return text_from_rows(rows);
}

std::string reference_text(const Study& study) {
  const Reference& r = study.reference;
  std::string text = fmt::format(
      "errors in pixels, at {}, against geodesic to {:.1g} rad,\nwhich is itself off by about {} (99 %), {} "
      "at most",
      readable_grid(r.grid), r.tolerance_rad, readable_pixels(r.own.p99_px), readable_pixels(r.own.most_px));
  if (r.closed_form) {
    text += fmt::format("; from the closed form of a single mass by {} (99 %), {} at most",
                        readable_pixels(r.closed_form->p99_px), readable_pixels(r.closed_form->most_px));
  }
  return text + "\n";
}

std::string picture_table(const Study& study) {
  if (study.pictures.empty()) return "";
  Rows rows = {{"", "picture", "threshold", "trace", "a frame", "rays/pixel", "PSNR", "memory"}};
  for (const PictureRow& row : study.pictures) {
    rows.push_back({mark_of(row.pareto, row.of_shot), fmt::format("up to {} rays", row.sampling.max),
                    row.sampling.max > 1 ? fmt::format("{}", row.sampling.threshold) : "-",
                    name_of(row.trace), text_of(row.timing), fmt::format("{:.3g}", row.rays_per_pixel),
                    fmt::format("{:.1f} dB", row.psnr_db), readable_memory(row.peak_bytes)});
  }
  return fmt::format("\n{}against {} rays a pixel, at {} pixels\n", text_from_rows(rows), study.truth_rays,
                     study.truth_pixels);
}

std::string price_table(const Study& study) {
  if (study.prices.empty()) return "";
  Rows rows = {{"effect", "", "adds", "to", "left out at most", "why"}};
  for (const Price& price : study.prices) {
    rows.push_back({price.name, price.on ? "on" : "off", readable_price(price),
                    readable_seconds(price.base_s),
                    !price.on && price.bound_px > 0 ? readable_pixels(price.bound_px) : "-", price.why});
  }
  return "\n" + text_from_rows(rows);
}

}  // namespace

std::string text_from_study(const Study& study) {
  std::string text = fmt::format("shot {}, frame {:04}: {} x {}, {}, {} threads of {}\n", study.shot,
                                 study.frame, study.camera.width, study.camera.height,
                                 study.masses == 1 ? "1 mass" : fmt::format("{} masses", study.masses),
                                 study.threads, study.processor);
  text +=
      "\n" + trace_table(study) + reference_text(study) + picture_table(study) + price_table(study) + "\n";
  for (const std::string& note : study.notes) text += "note: " + note + "\n";
  text += "* no other is both as fast and as right   S the shot's own   ~ timed on a part\n";
  return text + study.advice + "\n";
}

}  // namespace lensplane
