// SPDX-License-Identifier: Apache-2.0
//
// The half of effect_prices.h that needs no images.

#include <algorithm>

#include "pipeline/shot/shot_scene.h"
#include "pipeline/study/effect_prices.h"
#include "pipeline/study/trace_study.h"

namespace lensplane {
namespace {

/// Tracing the frame by `plan`, in seconds.
double seconds_of(const Scene& scene, const Plan& plan, const StudyEffort& effort) {
  const FilmGrid grid = grid_of(scene.camera, rays_of(effort, scene.lenses.size()));
  return time_trace(Tracer(scene, plan), grid, effort.repeats).median_s;
}
double seconds_of(const Scene& scene, const TraceSettings& settings, const StudyEffort& effort) {
  return seconds_of(scene, plan_trace(scene, settings), effort);
}

TraceSettings with(TraceSettings settings, bool Effects::*effect) {
  settings.effects = {};
  settings.effects.*effect = true;
  return settings;
}

/// Why an effect is on or off, in the plan's own words; the picture itself is filtered by the Jacobian.
Price price_of(const EffectPlan& plan) {
  Price price{plan.name, plan.on, 0, 0, plan.on ? 0 : plan.bound_px, plan.reason};
  if (plan.name == "jacobian" && !plan.on)
    price.why = "no file asks for it, but the picture is filtered by it";
  return price;
}

Price finite_distance(const Scene& scene, TraceSettings settings, const EffectPlan& plan, double plain_s,
                      const StudyEffort& effort) {
  Price price = price_of(plan);
  settings.finite_distance = Choice::Off;
  price.base_s = seconds_of(scene, settings, effort);
  settings.finite_distance = Choice::On;
  price.seconds = (plan.on ? plain_s : seconds_of(scene, settings, effort)) - price.base_s;
  return price;
}

/// Bodies met by curved rays where the plan says so, against chords everywhere.
Price curved_rays(const Scene& scene, const TraceSettings& settings, const EffectPlan& effect, double plain_s,
                  const StudyEffort& effort) {
  Price price = price_of(effect);
  price.on = effect.share > 0;
  Plan chords = plan_trace(scene, settings);
  chords.tiles.curved.clear();
  price.base_s = seconds_of(scene, chords, effort);
  price.seconds = plain_s - price.base_s;
  return price;
}

/// All lenses with the exact law and finite distance, against the shot's own plan.
Price everything(const Scene& scene, const Plan& plan, double plain_s, const StudyEffort& effort) {
  TraceSettings settings;
  settings.law = Law::Exact;
  settings.finite_distance = Choice::On;
  Price price{"all that the plan leaves out",
              false,
              0,
              plain_s,
              plan.bound_px,
              "every lens, everywhere by the exact law, with finite distance"};
  price.seconds = seconds_of(scene, settings, effort) - plain_s;
  return price;
}

Price overscan(const Scene& scene, const TraceSettings& settings, double plain_s, const StudyEffort& effort) {
  Price price{"overscan", true, 0, 0, 0, "pixels outside of the frame, for what comes after"};
  Scene without = scene;
  without.camera.overscan = 0;
  price.base_s = seconds_of(without, settings, effort);
  price.seconds = plain_s - price.base_s;
  return price;
}

}  // namespace

void price_traces(const Shot& shot, int frame, const StudyEffort& effort, const StudyHooks& hooks,
                  Study& study) {
  const Scene scene = study_scene(shot, frame);
  TraceSettings settings = trace_at(shot, frame);
  const Plan plan = plan_trace(scene, settings);
  study.left_out_px = plan.bound_px;
  for (const LensPlan& lens : plan.lenses) study.lenses.push_back({shot.lenses[lens.lens].name, lens});
  settings.effects = {};
  hooks.doing("prices: the plain trace");
  const double plain_s = seconds_of(scene, settings, effort);
  const auto stopped = [&] { return study.interrupted = hooks.stop(); };
  for (const EffectPlan& effect : plan.choices) {
    if (stopped()) return;
    hooks.doing("prices: " + effect.name);
    const auto entry = std::find_if(kEffectNames.begin(), kEffectNames.end(),
                                    [&](const EffectName& e) { return e.name == effect.name; });
    if (effect.name == kJointEffect) continue;  // it comes with the exact law
    if (effect.name == kCurvedEffect) {
      study.prices.push_back(curved_rays(scene, settings, effect, plain_s, effort));
      continue;
    }
    if (entry == kEffectNames.end()) {
      const bool can_be_off = scene.camera.projection == Projection::Perspective;
      if (can_be_off) study.prices.push_back(finite_distance(scene, settings, effect, plain_s, effort));
      continue;
    }
    Price price = price_of(effect);
    price.base_s = plain_s;
    price.seconds = seconds_of(scene, with(settings, entry->effect), effort) - plain_s;
    study.prices.push_back(price);
  }
  if (stopped()) return;
  if (settings.method == Method::Planes) study.prices.push_back(everything(scene, plan, plain_s, effort));
  if (scene.camera.overscan > 0) study.prices.push_back(overscan(scene, settings, plain_s, effort));
}

}  // namespace lensplane
