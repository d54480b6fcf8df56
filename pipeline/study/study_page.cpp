// SPDX-License-Identifier: Apache-2.0

#include "pipeline/study/study_page.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/image/version.h"
#include "pipeline/study/error_map.h"
#include "pipeline/study/readable.h"
#include "pipeline/study/study_plot.h"

namespace lensplane {
namespace {

using Cells = std::vector<std::string>;

constexpr const char* kStyle = R"css(
body{font:15px/1.45 sans-serif;color:#222;max-width:1280px;margin:2em auto;padding:0 1.5em}
h1{font-size:1.5em} h2{font-size:1.2em;margin-top:2em} .advice{font-size:1.1em;background:#f4f1e6;padding:.7em 1em}
table{border-collapse:collapse;font-size:13px} th,td{padding:.25em .7em;text-align:right;border-bottom:1px solid #e6e6e6} td{white-space:nowrap}
th{vertical-align:bottom;text-align:right} td:nth-child(1),th:nth-child(1){text-align:left}
#prices td:nth-child(6),#prices th:nth-child(6),#lenses td:nth-child(5),#lenses th:nth-child(5){text-align:left;white-space:normal}
#pictures td:nth-child(3),#pictures th:nth-child(3){text-align:left}
tr.pareto td{background:#eef5ee} tr.own td:first-child{border-left:4px solid #e07b00} tr.violated td{background:#ffd6d6}
.maps{display:flex;flex-wrap:wrap;gap:14px} figure{margin:0;width:300px;font-size:12px}
figure img{width:300px;image-rendering:pixelated;display:block}
#tip{position:fixed;display:none;background:#222;color:#fff;padding:.5em .8em;font-size:12px;max-width:520px;pointer-events:none;white-space:pre-line}
)css";

// What lies on one another in the plot is told together.
constexpr const char* kScript = R"js(
const tip = document.getElementById('tip'), points = [...document.querySelectorAll('#plot .point')];
document.getElementById('plot').addEventListener('mousemove', e => {
  const near = points.filter(p => {
    const r = p.querySelector('path').getBoundingClientRect();
    return Math.hypot(r.x + r.width / 2 - e.clientX, r.y + r.height / 2 - e.clientY) < 9;
  });
  tip.style.display = near.length ? 'block' : 'none';
  tip.textContent = near.map(p => p.querySelector('title').textContent).join('\n');
  tip.style.left = Math.min(e.clientX + 14, innerWidth - 540) + 'px';
  tip.style.top = e.clientY + 14 + 'px';
});
document.getElementById('plot').addEventListener('mouseleave', () => { tip.style.display = 'none'; });
)js";

std::string row_of(const char* tag, const Cells& cells, const std::string& classes = "") {
  std::string html = classes.empty() ? "<tr>" : fmt::format(R"(<tr class="{}">)", classes);
  for (const std::string& cell : cells) html += fmt::format("<{0}>{1}</{0}>", tag, escaped(cell));
  return html + "</tr>\n";
}

std::string table(const char* id, const Cells& head, const std::string& rows) {
  return fmt::format("<table id=\"{}\"><thead>{}</thead><tbody>\n{}</tbody></table>\n", id,
                     row_of("th", head), rows);
}

std::string classes_of(bool pareto, bool own, bool violated = false) {
  return fmt::format("{}{}{}", pareto ? "pareto " : "", own ? "own " : "", violated ? "violated" : "");
}

std::string spread_of(const Timing& timing) {
  return fmt::format("{} to {}, {} runs{}", readable_seconds(timing.least_s), readable_seconds(timing.most_s),
                     timing.repeats, timing.of_a_part ? ", from a part" : "");
}

std::string trace_table(const Study& study) {
  std::string rows;
  for (const TraceRow& row : study.traces) {
    Cells cells = {name_of(row.rung.settings), readable_seconds(row.seconds()), spread_of(row.trace),
                   fmt::format("{:.3g}", study.rays_per_s(row) / 1e6)};
    const Cells errors = error_cells(row);
    cells.insert(cells.end(), errors.begin(), errors.end());
    rows += row_of("td", cells, classes_of(row.pareto, row.rung.of_shot, row.violated));
  }
  return table("traces",
               {"trace", "a frame", "trace alone, spread", "million rays/s", "median, px", "99 %, px",
                "most, px", "> 0.1 px", "validity differs", "bound, px", "left out, px", "memory"},
               rows);
}

std::string reference_text(const Study& study) {
  const Reference& r = study.reference;
  std::string text = fmt::format(
      "Errors are measured at {}, against curved rays (geodesic) to {:.1g} rad. A trace by a hundred times "
      "that tolerance differs from it by {} in 99 of 100 pixels and {} at most: so good the reference is at "
      "least.",
      readable_grid(r.grid), r.tolerance_rad, readable_pixels(r.own.p99_px), readable_pixels(r.own.most_px));
  if (r.closed_form) {
    text += fmt::format(
        " From the closed form for a single mass it differs by {} and {} at most; {} are seen by only one.",
        readable_pixels(r.closed_form->p99_px), readable_pixels(r.closed_form->most_px),
        readable_share(r.closed_form->share_validity_differs));
  }
  return text +
         " Shares are of the pixels that see something by either trace, median, 99 % and most of those that "
         "do by both. The time of a frame is planning and tracing, the median of all runs. Bound: what the "
         "plan says that it leaves out at most; left out: what it does leave out of the same planes with "
         "everything on. Memory is what was held beyond what had been held before. Pixels say how far aside "
         "of its place a "
         "pixel looks; where light is stretched, next to critical curves, points lie farther off on the "
         "film.";
}

std::string picture_table(const Study& study) {
  std::string rows;
  for (const PictureRow& row : study.pictures) {
    rows +=
        row_of("td",
               {fmt::format("up to {} {} a pixel", row.sampling.max, row.sampling.max == 1 ? "ray" : "rays"),
                row.sampling.max > 1 ? fmt::format("{}", row.sampling.threshold) : "-", name_of(row.trace),
                readable_seconds(row.timing.median_s), spread_of(row.timing),
                fmt::format("{:.3g}", row.rays_per_pixel), fmt::format("{:.1f} dB", row.psnr_db),
                readable_memory(row.peak_bytes)},
               classes_of(row.pareto, row.of_shot));
  }
  return table("pictures",
               {"picture", "threshold", "trace", "a frame", "spread", "rays a pixel", "PSNR", "memory"},
               rows);
}

std::string price_table(const Study& study) {
  std::string rows;
  for (const Price& price : study.prices) {
    rows += row_of(
        "td", {price.name, price.on ? "on" : "off", readable_price(price), readable_seconds(price.base_s),
               !price.on && price.bound_px > 0 ? readable_pixels(price.bound_px) : "-", price.why});
  }
  return table("prices", {"effect or pass", "", "adds", "to", "left out at most", "why"}, rows);
}

/// The lenses that move the most; a crowd is not listed in full.
std::string lens_table(const Study& study) {
  constexpr std::size_t kMost = 40;
  std::vector<LensFate> lenses = study.lenses;
  std::stable_sort(lenses.begin(), lenses.end(),
                   [](const LensFate& a, const LensFate& b) { return a.plan.moves_px > b.plan.moves_px; });
  std::string rows;
  for (std::size_t i = 0; i < std::min(kMost, lenses.size()); ++i) {
    const LensPlan& plan = lenses[i].plan;
    rows += row_of("td", {lenses[i].name, plan.culled ? "left out" : std::string(name_of(plan.law)),
                          readable_pixels(plan.moves_px), readable_pixels(plan.bound_px), plan.reason});
  }
  const std::string more =
      lenses.size() > kMost ? fmt::format("<p>and {} more that move less</p>", lenses.size() - kMost) : "";
  return table("lenses", {"lens", "law", "moves at most", "left out at most", "why"}, rows) + more;
}

std::string maps_of(const Study& study) {
  std::string html;
  for (const TraceRow& row : study.traces) {
    html += fmt::format(
        "<figure><img alt=\"errors of {0}\" src=\"{1}\"><figcaption>{0}: {2} in 99 of 100 "
        "pixels</figcaption></figure>\n",
        escaped(name_of(row.rung.settings)), data_uri_of(error_map(study.reference.grid, row.errors)),
        row.error.compared > 0 ? readable_pixels(row.error.p99_px) : "nothing");
  }
  return html;
}

std::string notes_of(const Study& study) {
  std::string html;
  for (const std::string& note : study.notes) html += "<p>Note: " + escaped(note) + ".</p>\n";
  if (study.interrupted) html += "<p>The study was interrupted: what was not done is missing.</p>\n";
  return html;
}

}  // namespace

std::string page_from_study(const Study& study) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><link rel=\"icon\" "
      "href=\"data:,\"><title>{0}, frame {1}: what accuracy costs in "
      "time</title><style>{2}</style></head><body>\n<h1>{0}, frame {1}: what accuracy costs in "
      "time</h1>\n<p>{3} x {4} pixels, {5} {6}; {7} threads of {8}; lensplane {9}.</p>\n<p "
      "class=\"advice\">{10}.</p>\n",
      escaped(study.shot), study.frame, kStyle, study.camera.width, study.camera.height, study.masses,
      study.masses == 1 ? "mass" : "masses", study.threads, escaped(study.processor), kVersion,
      escaped(study.advice));
  html += notes_of(study) + plot_of(study);
  html += "<h2>Traces</h2>\n" + trace_table(study) + "<p>" + escaped(reference_text(study)) +
          " Green rows: no other is both as fast and as right. An orange edge: the shot's own.</p>\n";
  if (!study.pictures.empty()) {
    html += fmt::format(
        "<h2>Pictures</h2>\n{}<p>Against {} rays a pixel, each a point, at {} pixels. Composited only: "
        "without planning, stars, motion blur and glow.</p>\n",
        picture_table(study), study.truth_rays, study.truth_pixels);
  }
  if (!study.prices.empty()) {
    html += "<h2>What effects cost</h2>\n" + price_table(study) +
            "<p>Only what is on is paid for. What is off was switched on, where that could be, to see what "
            "it would add.</p>\n";
  }
  if (!study.lenses.empty()) {
    html += fmt::format("<h2>What the plan leaves out</h2>\n<p>Of this shot, {} at most.</p>\n{}",
                        readable_pixels(study.left_out_px), lens_table(study));
  }
  html += "<h2>Where errors lie</h2>\n" + error_legend() + "\n<div class=\"maps\">\n" + maps_of(study) +
          "</div>\n";
  return html + "<div id=\"tip\"></div><script>" + kScript + "</script></body></html>\n";
}

}  // namespace lensplane
