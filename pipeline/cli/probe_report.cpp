// SPDX-License-Identifier: Apache-2.0

#include "pipeline/cli/probe_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "pipeline/cli/plan_text.h"
#include "pipeline/cli/table.h"
#include "pipeline/image/version.h"
#include "pipeline/shot/shot_scene.h"
#include "src/constants.h"
#include "src/plan_words.h"

namespace lensplane {
namespace {

// Writes doubles with as many digits as bring them back, infinities as null.
using Json = nlohmann::ordered_json;
using Rows = std::vector<std::vector<std::string>>;

constexpr double kDegrees = 180.0 / kPi;  // per radian

std::string_view name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::Hit:
      return "hit";
    case Outcome::Missed:
      return "missed";
    case Outcome::Behind:
      return "behind";
    case Outcome::Captured:
      return "captured";
    case Outcome::Unseen:
      return "unseen";
    case Outcome::Unresolved:
      return "unresolved";
  }
  return {};
}

bool in_frame(const ProbedFrame& probed) {
  const auto& [x, y] = probed.probe.film;
  return x >= 0 && x <= probed.camera.width && y >= 0 && y <= probed.camera.height;
}

std::string number(double value) {
  return fmt::format("{:.9g}", value);
}

std::string direction_text(const Vec3& v) {
  return fmt::format("{:.12g} {:.12g} {:.12g}", v.x, v.y, v.z);
}

std::string crossing_table(const Shot& shot, const Probe& probe) {
  if (probe.crossings.empty()) return "";
  Rows rows = {{"passes", "after", "b/m", "alpha/rad", "alpha/deg"}};
  for (const ProbedCrossing& crossing : probe.crossings) {
    rows.push_back({shot.lenses[crossing.lens].name, number(crossing.path) + " m", number(crossing.b_over_m),
                    number(crossing.alpha), number(crossing.alpha * kDegrees)});
  }
  return "\n" + text_from_rows(rows);
}

/// Of further crossings of a layer only those that there are.
std::string surface_table(const Shot& shot, const LayerSurface& of, const ProbedSurface& surface) {
  if (of.crossing > 0 && surface.outcome != Outcome::Hit) return "";
  const std::string again = of.crossing > 0 ? fmt::format(", crossing {}", of.crossing + 1) : "";
  const std::string head =
      fmt::format("\nlayer {}{}: {}\n", shot.layers[of.layer].name, again, name_of(surface.outcome));
  if (surface.outcome != Outcome::Hit) return head;
  const std::string distance = std::isfinite(surface.distance) ? number(surface.distance) + " m" : "infinite";
  return head + text_from_rows({{"s, t", number(surface.st.s) + ", " + number(surface.st.t)},
                                {"ds/dx, ds/dy", number(surface.ds_dx) + ", " + number(surface.ds_dy)},
                                {"dt/dx, dt/dy", number(surface.dt_dx) + ", " + number(surface.dt_dy)},
                                {"magnification", number(surface.magnification)},
                                {"delay", number(surface.delay) + " s"},
                                {"distance", distance}});
}

std::string fate_of(const Probe& probe) {
  if (!probe.seen) return "no light: outside the circle of the fisheye";
  if (probe.unresolved) return "unresolved: given up on its way";
  return probe.captured ? "captured by a lens" : "goes on for ever";
}

Json json_from_vector(const Vec3& v) {
  return {v.x, v.y, v.z};
}

Json json_from_crossing(const Shot& shot, const ProbedCrossing& crossing) {
  return {{"lens", shot.lenses[crossing.lens].name},
          {"path", crossing.path},
          {"b_over_m", crossing.b_over_m},
          {"alpha_rad", crossing.alpha},
          {"alpha_deg", crossing.alpha * kDegrees}};
}

Json json_from_surface(const Shot& shot, const LayerSurface& of, const ProbedSurface& surface) {
  return {{"layer", shot.layers[of.layer].name},
          {"crossing", of.crossing + 1},
          {"outcome", name_of(surface.outcome)},
          {"s", surface.st.s},
          {"t", surface.st.t},
          {"ds_dx", surface.ds_dx},
          {"ds_dy", surface.ds_dy},
          {"dt_dx", surface.dt_dx},
          {"dt_dy", surface.dt_dy},
          {"magnification", surface.magnification},
          {"delay", surface.delay},
          {"distance", surface.distance}};
}

/// "curved rays: chords would misplace them by up to 3.7 px".
std::string body_meeting_text(const Probe& probe) {
  const bool bounded = std::isfinite(probe.chords_px);
  const std::string by = bounded ? "by up to " + in_pixels(probe.chords_px) : "without limit";
  return probe.curved ? "curved rays: chords would misplace them " + by : "chords, which misplace them " + by;
}

}  // namespace

std::string text_from_probe(const Shot& shot, const ProbedFrame& probed) {
  const Probe& probe = probed.probe;
  std::string text = fmt::format("shot {}, frame {:04}, film ({}, {}){}\n", shot.name, probed.frame,
                                 probe.film.x, probe.film.y, in_frame(probed) ? "" : ", outside the frame");
  Rows rows = {{"ray", fate_of(probe)}};
  if (probe.seen) {
    rows.push_back({"looks along", direction_text(probe.first)});
    rows.push_back({"last direction", direction_text(probe.last)});
  }
  if (probe.seen && probe.recipe < probed.plan.recipes.size())
    rows.push_back({"lenses by their laws", laws_of(probed.plan.recipes[probe.recipe])});
  if (probe.seen && !probed.plan.tiles.chords_px.empty())
    rows.push_back({"bodies are met by", body_meeting_text(probe)});
  text += text_from_rows(rows) + crossing_table(shot, probe);
  const std::vector<LayerSurface> surfaces = surfaces_of(shot);
  for (std::size_t i = 0; i < probe.surfaces.size(); ++i)
    text += surface_table(shot, surfaces[i], probe.surfaces[i]);
  return text;
}

std::string json_from_probe(const Shot& shot, const ProbedFrame& probed) {
  const Probe& probe = probed.probe;
  Json json = {{"lensplane", kVersion},
               {"shot", shot.name},
               {"frame", probed.frame},
               {"x", probe.film.x},
               {"y", probe.film.y},
               {"in_frame", in_frame(probed)},
               {"seen", probe.seen},
               {"captured", probe.captured},
               {"unresolved", probe.unresolved},
               {"first", json_from_vector(probe.first)},
               {"last", json_from_vector(probe.last)},
               {"plan", describe(probed.plan)},
               {"recipe", probe.recipe},
               {"curved", probe.curved},
               {"chords_px", probe.chords_px},
               {"crossings", Json::array()},
               {"layers", Json::array()}};
  for (const ProbedCrossing& crossing : probe.crossings)
    json["crossings"].push_back(json_from_crossing(shot, crossing));
  const std::vector<LayerSurface> surfaces = surfaces_of(shot);
  for (std::size_t i = 0; i < probe.surfaces.size(); ++i)
    json["layers"].push_back(json_from_surface(shot, surfaces[i], probe.surfaces[i]));
  return json.dump(2) + "\n";
}

}  // namespace lensplane
