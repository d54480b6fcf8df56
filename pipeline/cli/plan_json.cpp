// SPDX-License-Identifier: Apache-2.0

#include "pipeline/cli/plan_json.h"

#include <nlohmann/json.hpp>

#include "pipeline/image/version.h"
#include "src/constants.h"
#include "src/plan_words.h"

namespace lensplane {
namespace {

// Writes doubles with as many digits as bring them back, infinities as null.
using Json = nlohmann::ordered_json;

Json json_from_lens(const Shot& shot, const PlannedFrame& planned, const LensPlan& lens) {
  const double m = planned.scene.lenses[lens.lens].m;
  const bool has_law = !lens.culled && planned.plan.method != Method::Geodesic;
  return {{"name", shot.lenses[lens.lens].name},
          {"mass_kg", m / geometric_mass_from_kg(1.0)},
          {"m", m},
          {"distance", distance_of(planned, lens)},
          {"culled", lens.culled},
          {"law", has_law ? Json(name_of(lens.law)) : Json(nullptr)},
          {"moves_px", lens.moves_px},
          {"bound_px", lens.bound_px},
          {"reason", lens.reason}};
}

Json json_from_recipe(const Shot& shot, const Deflectors& recipe, double share) {
  Json deflectors = Json::array();
  for (const DeflectorPlane& plane : recipe.planes) {
    for (const Deflector& deflector : plane.deflectors) {
      deflectors.push_back({{"lens", shot.lenses[deflector.lens].name},
                            {"law", name_of(deflector.law)},
                            {"index", deflector.index}});
    }
  }
  return {{"share", share},
          {"planes", recipe.planes.size()},
          {"finite_distance", recipe.finite_distance},
          {"deflectors", deflectors}};
}

Json json_from_plan(const Shot& shot, const PlannedFrame& planned) {
  const Plan& plan = planned.plan;
  Json json = {{"frame", planned.frame},
               {"method", name_of(plan.method)},
               {"law", planned.settings.law ? name_of(*planned.settings.law) : "auto"},
               {"tolerance_px", planned.settings.tolerance_px},
               {"bound_px", plan.bound_px},
               {"near_masses", plan.near_masses},
               {"summary", describe(plan)}};
  if (plan.method == Method::Geodesic) json["geodesic_tolerance"] = plan.geodesic_tolerance;
  for (const char* list : {"lenses", "effects", "recipes", "plates"}) json[list] = Json::array();
  for (const PlateMargin& margin : planned.margins) {
    json["plates"].push_back({{"layer", margin.layer},
                              {"outside", margin.outside},
                              {"margin_px", margin.most},
                              {"margin_for_all_px", margin.all}});
  }
  for (const LensPlan& lens : lenses_of(planned))
    json["lenses"].push_back(json_from_lens(shot, planned, lens));
  for (const EffectPlan& effect : plan.choices) {
    json["effects"].push_back({{"name", effect.name},
                               {"on", effect.on},
                               {"share", effect.share},
                               {"bound_px", effect.bound_px},
                               {"reason", effect.reason}});
  }
  const std::vector<double> shares = recipe_shares(plan, planned.scene.camera);
  for (std::size_t i = 0; i < plan.recipes.size(); ++i)
    json["recipes"].push_back(json_from_recipe(shot, plan.recipes[i], shares[i]));
  const ShutterSampling& shutter = planned.shutter;
  json["shutter"] = {{"samples", shutter.samples},
                     {"auto", shutter.automatic},
                     {"motion_px", shutter.motion_px},
                     {"apart_px", shutter.apart_px()},
                     {"needed", shutter.needed}};
  json["tiles"] = {{"size", plan.tiles.size},     {"columns", plan.tiles.columns},
                   {"rows", plan.tiles.rows},     {"level", plan.tiles.level},
                   {"curved", plan.tiles.curved}, {"chords_px", plan.tiles.chords_px}};
  return json;
}

}  // namespace

std::string json_from_plans(const Shot& shot, const std::vector<PlannedFrame>& plans) {
  Json json = {{"lensplane", kVersion}, {"shot", shot.name}, {"frames", Json::array()}};
  for (const PlannedFrame& planned : plans) json["frames"].push_back(json_from_plan(shot, planned));
  return json.dump(2) + "\n";
}

}  // namespace lensplane
