// SPDX-License-Identifier: Apache-2.0

#include "pipeline/cli/plan_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "pipeline/cli/table.h"
#include "pipeline/shot/location.h"
#include "src/plan_words.h"

namespace lensplane {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string pixels(double px) {
  return std::isfinite(px) ? fmt::format("{:.3g} px", px) : "no limit";
}

std::string fate_of(const LensPlan& lens, Method method) {
  if (lens.culled) return "culled";
  return method == Method::Geodesic ? "curved rays" : std::string(name_of(lens.law));
}

std::vector<std::string> row_of(const Shot& shot, const PlannedFrame& planned, const LensPlan& lens) {
  const bool bounded = planned.plan.method == Method::Planes;
  return {shot.lenses[lens.lens].name,
          readable_mass(planned.scene.lenses[lens.lens].m),
          readable_length(distance_of(planned, lens)),
          fate_of(lens, planned.plan.method),
          bounded ? pixels(lens.moves_px) : "-",
          bounded ? pixels(lens.bound_px) : "-",
          lens.reason};
}

/// "and 60 more: culled 10, weak 50; each moves at most 0.01 px, left out together at most 0.002 px".
std::string summary_of(const PlannedFrame& planned, const std::vector<LensPlan>& rest) {
  std::map<std::string, int> counts;
  double moves = 0, bound = 0;
  for (const LensPlan& lens : rest) {
    ++counts[fate_of(lens, planned.plan.method)];
    moves = std::max(moves, lens.moves_px);
    bound += lens.bound_px;
  }
  std::vector<std::string> fates;
  for (const auto& [fate, count] : counts) fates.push_back(fmt::format("{} {}", fate, count));
  const std::string line = fmt::format("  and {} more: {}", rest.size(), comma_list(fates));
  if (planned.plan.method != Method::Planes) return line + "\n";
  const std::string most =
      std::isfinite(moves) ? "each moves at most " + pixels(moves) : "some move without limit";
  return line + fmt::format("; {}, left out together at most {}\n", most, pixels(bound));
}

std::string lens_table(const Shot& shot, const PlannedFrame& planned) {
  std::vector<LensPlan> lenses = lenses_of(planned);
  if (lenses.empty()) return "";
  std::vector<LensPlan> rest;
  if (lenses.size() > kManyLenses) {
    std::stable_sort(lenses.begin(), lenses.end(),
                     [](const LensPlan& a, const LensPlan& b) { return a.moves_px > b.moves_px; });
    rest.assign(lenses.begin() + kLensesShown, lenses.end());
    lenses.resize(kLensesShown);
  }
  Rows rows = {{"lens", "mass", "distance", "law", "moves at most", "left out at most", "why"}};
  for (const LensPlan& lens : lenses) rows.push_back(row_of(shot, planned, lens));
  return "\n" + text_from_rows(rows) + (rest.empty() ? "" : summary_of(planned, rest));
}

std::string state_of(const EffectPlan& effect) {
  if (effect.on) return "on";
  if (effect.name == kCurvedEffect && effect.share > 0) return "near bodies";
  return effect.share > 0 ? "near masses" : "off";
}

std::string effect_table(const Plan& plan) {
  if (plan.choices.empty()) return "";
  Rows rows = {{"effect", "", "left out at most", "why"}};
  for (const EffectPlan& effect : plan.choices) {
    const std::string left_out = effect.bound_px > 0 ? pixels(effect.bound_px) : "-";
    rows.push_back({effect.name, state_of(effect), left_out, effect.reason});
  }
  return "\n" + text_from_rows(rows);
}

/// One row for all recipes that read the same.
std::string recipe_table(const PlannedFrame& planned) {
  const Plan& plan = planned.plan;
  const std::vector<double> shares = recipe_shares(plan, planned.scene.camera);
  std::vector<std::pair<std::vector<std::string>, double>> kinds;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    if (!(shares[i] > 0)) continue;
    const Deflectors& recipe = plan.recipes[i];
    const std::vector<std::string> cells = {recipe.finite_distance ? "on" : "off", laws_of(recipe)};
    const auto known =
        std::find_if(kinds.begin(), kinds.end(), [&](const auto& k) { return k.first == cells; });
    if (known == kinds.end()) {
      kinds.emplace_back(cells, shares[i]);
    } else {
      known->second += shares[i];
    }
  }
  if (kinds.empty()) return "";
  Rows rows = {{"share of the film", "finite distance", "lenses by their laws"}};
  for (const auto& [cells, share] : kinds) rows.push_back({in_percent(share), cells[0], cells[1]});
  return "\n" + text_from_rows(rows);
}

/// Nothing of a shot that is not blurred.
std::string shutter_line(const PlannedFrame& planned) {
  const bool still = planned.shutter.samples == 1 && !planned.shutter.automatic;
  return still ? "" : "\n" + line_of(planned.shutter) + "\n";
}

std::string plate_table(const PlannedFrame& planned) {
  if (planned.margins.empty()) return "";
  Rows rows = {{"plate", "pixels that look outside", "margin for 99.9 %", "margin for all"}};
  for (const PlateMargin& m : planned.margins) {
    rows.push_back({m.layer, in_percent(m.outside), fmt::format("{} px", m.most),
                    m.all < kFarthestMargin ? fmt::format("{} px", m.all) : "no limit"});
  }
  return "\n" + text_from_rows(rows);
}

}  // namespace

std::string laws_of(const Deflectors& recipe) {
  std::array<std::size_t, kLaws.size()> counts{};
  for (const DeflectorPlane& plane : recipe.planes) {
    for (const Deflector& deflector : plane.deflectors) ++counts[static_cast<std::size_t>(deflector.law)];
  }
  std::string text;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", kLaws[i].name, counts[i]);
  }
  return text.empty() ? "nothing bends" : text;
}

std::string text_from_plan(const Shot& shot, const PlannedFrame& planned) {
  const Plan& plan = planned.plan;
  std::string head =
      fmt::format("shot {}, frame {:04}: method {}", shot.name, planned.frame, name_of(plan.method));
  if (plan.method == Method::Planes) {
    head += fmt::format(", tolerance {}, left out at most {}", pixels(planned.settings.tolerance_px),
                        pixels(plan.bound_px));
    head += "\n(how far aside pixels look; where light is stretched, points lie farther off on the film)";
  }
  if (plan.method == Method::Geodesic) head += fmt::format(", to {:.3g} rad", plan.geodesic_tolerance);
  return head + "\n" + lens_table(shot, planned) + effect_table(plan) + recipe_table(planned) +
         plate_table(planned) + shutter_line(planned);
}

}  // namespace lensplane
