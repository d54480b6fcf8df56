// SPDX-License-Identifier: Apache-2.0

#include "pipeline/study/study_files.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>

#include "pipeline/image/atomic_file.h"
#include "pipeline/image/version.h"
#include "pipeline/study/study_page.h"

namespace lensplane {
namespace {

using Json = nlohmann::ordered_json;

Json json_from(const Timing& timing) {
  return {{"median_s", timing.median_s},
          {"least_s", timing.least_s},
          {"most_s", timing.most_s},
          {"repeats", timing.repeats},
          {"of_a_part", timing.of_a_part}};
}

/// JSON has no infinity: null stands for no limit, and where there is nothing.
Json json_from_bound(double px) {
  return std::isfinite(px) ? Json(px) : Json();
}

Json json_from(const ErrorSummary& e) {
  const auto of_compared = [&](double px) { return e.compared > 0 ? json_from_bound(px) : Json(); };
  return {{"rays", e.rays},
          {"compared", e.compared},
          {"median_px", of_compared(e.median_px)},
          {"p99_px", of_compared(e.p99_px)},
          {"most_px", of_compared(e.most_px)},
          {"share_above_0.1_px", e.share_seen},
          {"share_validity_differs", e.share_validity_differs}};
}

Json json_from(const TraceSettings& s) {
  constexpr const char* kChoices[] = {"auto", "on", "off"};
  return {{"method", name_of(s.method)},
          {"law", s.law ? Json(name_of(*s.law)) : Json("auto")},
          {"tolerance_px", s.tolerance_px},
          {"finite_distance", kChoices[static_cast<int>(s.finite_distance)]}};
}

Json json_from(const Study& study, const TraceRow& row) {
  Json json = {{"name", name_of(row.rung.settings)},
               {"settings", json_from(row.rung.settings)},
               {"of_shot", row.rung.of_shot},
               {"pareto", row.pareto},
               {"seconds", row.seconds()},
               {"plan_s", row.plan_s},
               {"trace", json_from(row.trace)},
               {"rays_per_s", study.rays_per_s(row)},
               {"peak_bytes", row.peak_bytes ? Json(*row.peak_bytes) : Json()},
               {"error", json_from(row.error)},
               {"worst_at", row.worst_at}};
  if (row.bound_px) {
    json["bound_px"] = json_from_bound(*row.bound_px);
    json["left_out_px"] = row.left_out.most_px;
    json["violated"] = row.violated;
  }
  return json;
}

Json json_from(const PictureRow& row) {
  return {{"max", row.sampling.max},
          {"threshold", row.sampling.threshold},
          {"settings", json_from(row.trace)},
          {"of_shot", row.of_shot},
          {"pareto", row.pareto},
          {"time", json_from(row.timing)},
          {"peak_bytes", row.peak_bytes ? Json(*row.peak_bytes) : Json()},
          {"rays_per_pixel", row.rays_per_pixel},
          {"psnr_db", row.psnr_db}};
}

Json json_from(const Price& price) {
  return {{"name", price.name},
          {"on", price.on},
          {"seconds", price.seconds},
          {"base_s", price.base_s},
          {"bound_px", json_from_bound(price.bound_px)},
          {"why", price.why}};
}

Json json_from(const LensFate& lens) {
  return {{"name", lens.name},
          {"culled", lens.plan.culled},
          {"law", name_of(lens.plan.law)},
          {"moves_px", json_from_bound(lens.plan.moves_px)},
          {"bound_px", json_from_bound(lens.plan.bound_px)},
          {"why", lens.plan.reason}};
}

Json json_from(const Reference& r) {
  Json json = {{"tolerance_rad", r.tolerance_rad},
               {"step", r.grid.step},
               {"columns", r.grid.columns},
               {"rows", r.grid.rows},
               {"own_error", json_from(r.own)}};
  if (r.closed_form) json["error_against_closed_form"] = json_from(*r.closed_form);
  return json;
}

template <class Row>
Json list_of(const std::vector<Row>& rows) {
  Json list = Json::array();
  for (const Row& row : rows) list.push_back(json_from(row));
  return list;
}

/// A text in a CSV file.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + "\"";
}

/// A number; empty where there is none.
std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : "";
}

/// The fields of a line in their order; those that a row does not have stay empty.
constexpr std::array kColumns = {"part",
                                 "name",
                                 "of_shot",
                                 "pareto",
                                 "seconds",
                                 "plan_s",
                                 "median_s",
                                 "least_s",
                                 "most_s",
                                 "repeats",
                                 "of_a_part",
                                 "rays_per_s",
                                 "peak_bytes",
                                 "error_median_px",
                                 "error_p99_px",
                                 "error_most_px",
                                 "share_above_0.1_px",
                                 "share_validity_differs",
                                 "bound_px",
                                 "left_out_px",
                                 "violated",
                                 "rays_per_pixel",
                                 "psnr_db"};
using Fields = std::map<std::string_view, std::string>;

std::string line_of(const Fields& fields) {
  std::string line;
  for (const char* column : kColumns) {
    const auto field = fields.find(column);
    line += (line.empty() ? "" : ",") + (field == fields.end() ? "" : field->second);
  }
  return line + "\n";
}

std::string text_of(bool flag) {
  return flag ? "1" : "0";
}
std::string text_of(const std::optional<std::size_t>& bytes) {
  return bytes ? fmt::format("{}", *bytes) : "";
}

/// A line's fields that all parts have in which something is timed.
Fields fields_of(const char* part, const std::string& name, bool of_shot, bool pareto, const Timing& t) {
  return {{"part", part},
          {"name", quoted(name)},
          {"of_shot", text_of(of_shot)},
          {"pareto", text_of(pareto)},
          {"median_s", number(t.median_s)},
          {"least_s", number(t.least_s)},
          {"most_s", number(t.most_s)},
          {"repeats", fmt::format("{}", t.repeats)},
          {"of_a_part", text_of(t.of_a_part)}};
}

Fields fields_of(const Study& study, const TraceRow& row) {
  Fields fields = fields_of("trace", name_of(row.rung.settings), row.rung.of_shot, row.pareto, row.trace);
  fields["seconds"] = number(row.seconds());
  fields["plan_s"] = number(row.plan_s);
  fields["rays_per_s"] = number(study.rays_per_s(row));
  fields["peak_bytes"] = text_of(row.peak_bytes);
  if (row.error.compared > 0) {
    fields["error_median_px"] = number(row.error.median_px);
    fields["error_p99_px"] = number(row.error.p99_px);
    fields["error_most_px"] = number(row.error.most_px);
  }
  fields["share_above_0.1_px"] = number(row.error.share_seen);
  fields["share_validity_differs"] = number(row.error.share_validity_differs);
  if (!row.bound_px) return fields;
  fields["bound_px"] = number(*row.bound_px);
  fields["left_out_px"] = number(row.left_out.most_px);
  fields["violated"] = text_of(row.violated);
  return fields;
}

Fields fields_of(const PictureRow& row) {
  const std::string name = fmt::format("up to {} rays, threshold {}; {}", row.sampling.max,
                                       row.sampling.threshold, name_of(row.trace));
  Fields fields = fields_of("picture", name, row.of_shot, row.pareto, row.timing);
  fields["seconds"] = number(row.timing.median_s);
  fields["peak_bytes"] = text_of(row.peak_bytes);
  fields["rays_per_pixel"] = number(row.rays_per_pixel);
  fields["psnr_db"] = number(row.psnr_db);
  return fields;
}

Fields fields_of(const Price& price) {
  return {{"part", "price"},
          {"name", quoted(price.name)},
          {"of_shot", text_of(price.on)},
          {"seconds", number(price.seconds)},
          {"bound_px", number(price.bound_px)}};
}

}  // namespace

std::filesystem::path study_folder(const Shot& shot, int frame) {
  return shot.output.directory / fmt::format("{}.study.{:04}", shot.name, frame);
}

void write_study(const std::filesystem::path& folder, const Study& study) {
  write_atomically(folder / "study.csv", csv_from_study(study));
  write_atomically(folder / "study.json", json_from_study(study));
  write_atomically(folder / "study.html", page_from_study(study));
}

std::string csv_from_study(const Study& study) {
  std::string text = fmt::format("{}\n", fmt::join(kColumns, ","));
  for (const TraceRow& row : study.traces) text += line_of(fields_of(study, row));
  for (const PictureRow& row : study.pictures) text += line_of(fields_of(row));
  for (const Price& price : study.prices) text += line_of(fields_of(price));
  return text;
}

std::string json_from_study(const Study& study) {
  Json traces = Json::array();
  for (const TraceRow& row : study.traces) traces.push_back(json_from(study, row));
  const Json json = {{"lensplane", kVersion},
                     {"shot", study.shot},
                     {"frame", study.frame},
                     {"width", study.camera.width},
                     {"height", study.camera.height},
                     {"overscan", study.camera.overscan},
                     {"masses", study.masses},
                     {"threads", study.threads},
                     {"processor", study.processor},
                     {"interrupted", study.interrupted},
                     {"advice", study.advice},
                     {"notes", study.notes},
                     {"reference", json_from(study.reference)},
                     {"traces", traces},
                     {"pictures", list_of(study.pictures)},
                     {"truth", {{"rays_per_pixel", study.truth_rays}, {"pixels", study.truth_pixels}}},
                     {"prices", list_of(study.prices)},
                     {"lenses", list_of(study.lenses)},
                     {"left_out_px", json_from_bound(study.left_out_px)}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace lensplane
