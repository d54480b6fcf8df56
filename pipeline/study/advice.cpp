// SPDX-License-Identifier: Apache-2.0

#include "pipeline/study/advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/study/readable.h"

namespace lensplane {
namespace {

/// Marks the rows of least `error(row)` among those that take no longer.
template <class Row, class Seconds, class Error>
void mark(std::vector<Row>& rows, Seconds seconds, Error error) {
  for (Row& row : rows) {
    row.pareto = std::isfinite(error(row)) && std::none_of(rows.begin(), rows.end(), [&](const Row& other) {
                   const bool no_worse = seconds(other) <= seconds(row) && error(other) <= error(row);
                   return no_worse && (seconds(other) < seconds(row) || error(other) < error(row));
                 });
  }
}

/// The crudest of those that are within `px` and take no longer than the fastest of them, as far as times
/// tell.
const TraceRow* fastest_within(const Study& study, double px) {
  constexpr double kAsFast = 1.1;
  double least_s = INFINITY;
  for (const TraceRow& row : study.traces) {
    if (row.error.judged_px() <= px) least_s = std::min(least_s, row.seconds());
  }
  const auto row = std::find_if(study.traces.begin(), study.traces.end(), [&](const TraceRow& r) {
    return r.error.judged_px() <= px && r.seconds() <= kAsFast * least_s;
  });
  return row == study.traces.end() ? nullptr : &*row;
}

std::string of_the_paper(const Study& study) {
  const auto row = std::find_if(study.traces.begin(), study.traces.end(), [](const TraceRow& r) {
    return r.rung.settings.method == Method::ShinotsukaMakino;
  });
  if (row == study.traces.end() || row->error.compared == 0) return "";
  const std::string most =
      row->error.most_px > 0 ? fmt::format(" ({} at {})", readable_pixels(row->error.most_px), row->worst_at)
                             : "";
  const std::string differs = row->error.share_validity_differs > 0.01
                                  ? fmt::format(", and sees something else in {} of the pixels",
                                                readable_share(row->error.share_validity_differs))
                                  : "";
  return fmt::format("; the paper's method is {} off{}{}", readable_pixels(row->error.p99_px), most, differs);
}

}  // namespace

void mark_pareto(Study& study) {
  mark(
      study.traces, [](const TraceRow& row) { return row.seconds(); },
      [](const TraceRow& row) { return row.error.judged_px(); });
  mark(
      study.pictures, [](const PictureRow& row) { return row.timing.median_s; },
      [](const PictureRow& row) { return -row.psnr_db; });
}

std::string advice_of(const Study& study) {
  if (study.traces.empty()) return "nothing was traced";
  const auto nearest = std::min_element(
      study.traces.begin(), study.traces.end(),
      [](const TraceRow& a, const TraceRow& b) { return a.error.judged_px() < b.error.judged_px(); });
  if (!std::isfinite(nearest->error.judged_px()))
    return "nothing in the frame could be compared with curved rays";
  const TraceRow* best = fastest_within(study, kSeenErrorPx);
  const std::string target = fmt::format("for {} px in 99 of 100 pixels", kSeenErrorPx);
  if (!best) {
    return fmt::format("{} no row does; the nearest is {}: {} off", target, name_of(nearest->rung.settings),
                       readable_pixels(nearest->error.judged_px()));
  }
  return fmt::format("{} use {}: {}{}", target, name_of(best->rung.settings),
                     readable_seconds(best->seconds()), of_the_paper(study));
}

}  // namespace lensplane
