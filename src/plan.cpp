// SPDX-License-Identifier: Apache-2.0

#include "src/plan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "src/bodies.h"
#include "src/plan_bounds.h"
#include "src/plan_words.h"

namespace lensplane {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// How the tolerance is shared out: a quarter each for lenses left out, for the laws of single tiles, for the
// laws of single lenses, and for finite distances.
constexpr double kShare = 0.25;

/// The deflectors of `all` that `keeps(lens)` keeps, each with the law that `law(lens)` gives it, in company
/// where `company(lens)` says so.
template <class Keeps, class LawOf, class CompanyOf>
Deflectors recipe(const Deflectors& all, Keeps keeps, LawOf law_of, CompanyOf company_of) {
  Deflectors result = all;
  const auto thin_out = [&](std::size_t begin, std::size_t end) {
    std::vector<DeflectorPlane> planes;
    for (std::size_t k = begin; k < end; ++k) {
      DeflectorPlane plane = all.planes[k];
      std::erase_if(plane.deflectors, [&](const Deflector& d) { return !keeps(d.lens); });
      for (Deflector& d : plane.deflectors) {
        d.law = law_of(d.lens);
        if (!company_of(d.lens)) d.company = {};
      }
      if (!plane.deflectors.empty()) planes.push_back(std::move(plane));
    }
    return planes;
  };
  result.planes = thin_out(0, all.outward);
  result.outward = result.planes.size();
  for (DeflectorPlane& plane : thin_out(all.outward, all.planes.size())) {
    result.planes.push_back(std::move(plane));
  }
  return result;
}

/// Leaves out the lenses that move the least, as long as all of them together stay within `budget_px`.
void cull(const FilmBounds& bounds, double budget_px, std::vector<LensPlan>& lenses) {
  std::vector<std::size_t> order(lenses.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return bounds.lenses[a].moves_px < bounds.lenses[b].moves_px;
  });
  double sum = 0.0;
  for (const std::size_t i : order) {
    const LensBound& bound = bounds.lenses[i];
    if (bound.wild || sum + bound.moves_px > budget_px) continue;
    sum += bound.moves_px;
    lenses[i].culled = true;
    lenses[i].bound_px = bound.moves_px;
  }
}

/// The cheapest law of each lens that leaves out no more than its equal part of `budget_px`.
void choose_laws(const FilmBounds& bounds, double budget_px, std::vector<LensPlan>& lenses) {
  const auto kept = std::count_if(lenses.begin(), lenses.end(), [](const LensPlan& l) { return !l.culled; });
  const double part = budget_px / static_cast<double>(std::max<std::ptrdiff_t>(kept, 1));
  for (std::size_t i = 0; i < lenses.size(); ++i) {
    LensPlan& lens = lenses[i];
    const LensBound& bound = bounds.lenses[i];
    if (lens.culled) continue;
    lens.law = bound.weak_px <= part           ? Law::Weak
               : bound.second_order_px <= part ? Law::SecondOrder
                                               : Law::Exact;
    lens.company = lens.law == Law::Exact && bound.gain_px > part;
    lens.bound_px = lens.law == Law::Weak          ? bound.weak_px
                    : lens.law == Law::SecondOrder ? bound.second_order_px
                    : lens.company                 ? 0.0
                                                   : bound.gain_px;
  }
}

/// Which recipe serves each tile: 0 all weak, 1 at most second order, 2 every lens by its own law, 3
/// everything.
void choose_levels(const FilmBounds& bounds, double budget_px, TileLevels& tiles) {
  for (const TileBound& tile : bounds.tiles) {
    tiles.level.push_back(tile.wild                           ? 3
                          : tile.weak_px <= budget_px         ? 0
                          : tile.second_order_px <= budget_px ? 1
                                                              : 2);
  }
}

std::size_t count_masses(const Deflectors& deflectors) {
  std::size_t count = 0;
  for (const DeflectorPlane& plane : deflectors.planes) count += plane.deflectors.size();
  return count;
}

bool any_wild(const FilmBounds& bounds) {
  return std::any_of(bounds.tiles.begin(), bounds.tiles.end(),
                     [](const TileBound& tile) { return tile.wild; });
}

EffectPlan finite_distance_plan(const TraceSettings& settings, bool flat, const FilmBounds& bounds) {
  EffectPlan effect{"finite distance", settings.finite_distance == Choice::On, 0.0, "asked for", 0.0};
  for (const LensBound& lens : bounds.lenses) effect.bound_px += lens.finite_px;
  if (!flat) {
    effect.on = true;
    effect.reason = "without a flat screen bends are continuous only with it";
  } else if (settings.finite_distance == Choice::Off) {
    effect.reason = "switched off; it would move pixels by up to " + in_pixels(effect.bound_px);
  } else if (settings.finite_distance == Choice::Auto) {
    effect.on = effect.bound_px > kShare * settings.tolerance_px;
    effect.reason = effect.on ? "it moves pixels by up to " + in_pixels(effect.bound_px)
                              : "it would move no pixel by more than " + in_pixels(effect.bound_px);
  }
  effect.share = effect.on ? 1.0 : 0.0;
  if (effect.on) effect.bound_px = 0.0;
  // Only with the law left open it is on there nevertheless.
  if (any_wild(bounds) && !effect.on && (settings.law || settings.finite_distance == Choice::Off)) {
    effect.bound_px = kInfinity;
    effect.reason += "; near masses there is no limit";
  }
  return effect;
}

/// What masses do together: of that the bends in company (company.h) leave something out everywhere. Near
/// masses nothing is known of how much.
EffectPlan joint_plan(const TraceSettings& settings, std::size_t masses, const FilmBounds& bounds) {
  EffectPlan effect{std::string(kJointEffect), masses > 1, 0.0, "there is one mass at most", 0.0};
  if (!effect.on) return effect;
  const bool by_law = settings.law.value_or(Law::Exact) == Law::Exact;
  double gain = 0.0;
  for (const TileBound& tile : bounds.tiles) {
    effect.bound_px = std::max(effect.bound_px, tile.joint_px);
    gain = std::max(gain, tile.gain_px);
  }
  effect.share = 1.0;
  effect.reason = by_law ? "each mass bends as the others let it: by up to " + in_pixels(gain) + " more"
                         : "the law is given, and knows each mass for itself";
  return effect;
}

/// Which tiles meet bodies by curved rays: where chords would misplace them by more than `budget_px`. What
/// that is, and what is left out.
EffectPlan choose_curves(const Camera& camera, double budget_px, double tolerance_px,
                         const FilmBounds& bounds, TileLevels& tiles) {
  double there = 0.0, elsewhere = 0.0;
  for (const TileBound& tile : bounds.tiles) {
    const bool curved = tile.chords_px > budget_px;
    tiles.curved.push_back(curved ? 1 : 0);
    tiles.chords_px.push_back(tile.chords_px);
    double& most = curved ? there : elsewhere;
    most = std::max(most, tile.chords_px);
  }
  const double share = shares_of(tiles, camera, tiles.curved, 2)[1];
  const std::string reason = reason_of_curves(share, there, elsewhere);
  // Curved rays are themselves followed to a share of the tolerance.
  const double left_out = share > 0.0 ? std::max(elsewhere, kGeodesicShare * tolerance_px) : elsewhere;
  return {std::string(kCurvedEffect), share == 1.0, left_out, reason, share};
}

/// What chords misplace where curved rays are not taken, for the reason `why`.
EffectPlan stay_with_chords(const std::string& why, const FilmBounds& bounds, TileLevels& tiles) {
  double most = 0.0;
  for (const TileBound& tile : bounds.tiles) {
    tiles.chords_px.push_back(tile.chords_px);
    most = std::max(most, tile.chords_px);
  }
  return {std::string(kCurvedEffect), false, most, why + "; " + reason_of_curves(0.0, 0.0, most), 0.0};
}

/// The masses of a scene that `keeps(lens)` keeps, as curved rays meet them.
template <class Keeps>
std::vector<PointMass> masses_of(const Scene& scene, Keeps keeps) {
  std::vector<PointMass> masses;
  for (const DeflectorPlane& plane : deflectors_of(scene, Law::Exact, true).planes) {
    for (const Deflector& d : plane.deflectors) {
      if (keeps(d.lens)) masses.push_back({d.m, d.position});
    }
  }
  return masses;
}

bool meets_bodies(const Scene& scene) {
  return std::any_of(scene.surfaces.begin(), scene.surfaces.end(), is_body) &&
         std::any_of(scene.lenses.begin(), scene.lenses.end(), [](const Lens& lens) { return lens.m > 0.0; });
}

/// What meets the bodies: curved rays where the plan is free to choose.
void plan_curves(const Scene& scene, const TraceSettings& settings, const EffectPlan& finite,
                 const FilmBounds& bounds, Plan& plan) {
  const bool told = settings.law || settings.finite_distance == Choice::Off;
  TileLevels& tiles = plan.tiles;
  if (tiles.columns == 0) tiles = tiles_of(scene.camera);
  plan.masses = masses_of(scene, [&](std::size_t lens) { return !plan.lenses[lens].culled; });
  const bool many = plan.masses.size() > kMostCurvedMasses;
  const double budget = kShare * settings.tolerance_px - (finite.on ? 0.0 : finite.bound_px);
  const EffectPlan curves = told ? stay_with_chords("not with a given law or distance", bounds, tiles)
                            : many
                                ? stay_with_chords("too many masses", bounds, tiles)
                                : choose_curves(scene.camera, budget, settings.tolerance_px, bounds, tiles);
  if (!(curves.share > 0.0)) plan.masses.clear();
  plan.choices.insert(plan.choices.begin() + 2, curves);
  plan.bound_px += curves.bound_px;
}

std::vector<EffectPlan> called_for(const Effects& effects) {
  std::vector<EffectPlan> plans;
  for (const EffectName& entry : kEffectNames) {
    const bool on = effects.*entry.effect;
    plans.push_back(
        {std::string(entry.name), on, 0.0, on ? "asked for" : "no output asks for it", on ? 1.0 : 0.0});
  }
  return plans;
}

/// The law and the finite distance as the settings say, for every lens and tile.
void plan_as_told(const Scene& scene, const TraceSettings& settings, const EffectPlan& finite,
                  const FilmBounds& bounds, Plan& plan) {
  const Law law = *settings.law;
  plan.recipes = {in_company(deflectors_of(scene, law, finite.on))};
  for (std::size_t i = 0; i < plan.lenses.size(); ++i) {
    LensPlan& lens = plan.lenses[i];
    const LensBound& bound = bounds.lenses[i];
    lens.law = law;
    lens.bound_px = law == Law::Weak ? bound.weak_px : law == Law::SecondOrder ? bound.second_order_px : 0.0;
    lens.company = law == Law::Exact && bound.gain_px > 0.0;
    if (law != Law::Exact && bound.wild) lens.bound_px = kInfinity;
    lens.reason = "the law is given";
    plan.bound_px += lens.bound_px;
  }
  if (!finite.on) plan.bound_px += finite.bound_px;
  if (law != Law::Exact && any_wild(bounds)) plan.bound_px = kInfinity;
}

/// Where the whole film lies near masses nothing is left out, no law but the exact one is used, and no bound
/// is known.
void say_all_exact(const Scene& scene, std::vector<LensPlan>& lenses) {
  for (LensPlan& lens : lenses) {
    if (scene.lenses[lens.lens].m == 0.0) continue;
    lens.culled = false;
    lens.law = Law::Exact;
    lens.company = scene.lenses.size() > 1;
    lens.moves_px = kInfinity;
    lens.bound_px = 0.0;
  }
}

/// Says of the finite distance, which is off elsewhere, that it is on near masses.
void say_finite_near_masses(double near_masses, EffectPlan& finite) {
  finite.reason = reason_near_masses(near_masses, finite.bound_px);
  finite.share = near_masses;
  finite.on = near_masses == 1.0;
}

void plan_within_tolerance(const Scene& scene, const TraceSettings& settings, const EffectPlan& finite,
                           const Deflectors& everything, const FilmBounds& bounds, Plan& plan) {
  const double share = kShare * settings.tolerance_px;
  cull(bounds, share, plan.lenses);
  choose_laws(bounds, share, plan.lenses);
  plan.tiles = tiles_of(scene.camera);
  choose_levels(bounds, share, plan.tiles);
  const Deflectors all = finite.on ? everything : in_company(deflectors_of(scene, Law::Exact, false));
  const auto keeps = [&](std::size_t lens) { return !plan.lenses[lens].culled; };
  const auto at_most = [&](Law most) {
    return [&plan, most](std::size_t lens) { return std::min(plan.lenses[lens].law, most); };
  };
  const bool given_off = settings.finite_distance == Choice::Off;
  const auto company = [&](std::size_t lens) { return plan.lenses[lens].company; };
  plan.recipes = {recipe(all, keeps, at_most(Law::Weak), company),
                  recipe(all, keeps, at_most(Law::SecondOrder), company),
                  recipe(all, keeps, at_most(Law::Exact), company), given_off ? all : everything};
  const double near_masses = recipe_shares(plan, scene.camera).back();
  plan.near_masses = near_masses;
  if (near_masses == 1.0) say_all_exact(scene, plan.lenses);
  if (!finite.on && !given_off && near_masses > 0.0)
    say_finite_near_masses(near_masses, plan.choices.front());
  std::vector<bool> stands(scene.lenses.size());  // for itself, and perhaps for others at its place
  for (const DeflectorPlane& plane : everything.planes) {
    for (const Deflector& deflector : plane.deflectors) stands[deflector.lens] = true;
  }
  double culled = 0.0, laws = 0.0, tiles = 0.0;
  for (std::size_t i = 0; i < plan.lenses.size(); ++i) {
    LensPlan& lens = plan.lenses[i];
    if (scene.lenses[i].m > 0.0) lens.reason = reason_of(lens, bounds.lenses[i], near_masses);
    if (scene.lenses[i].m > 0.0 && !stands[i]) lens.reason = "one body with a lens at its place";
    (lens.culled ? culled : laws) += lens.bound_px;
  }
  for (std::size_t i = 0; i < bounds.tiles.size(); ++i) {
    const std::uint8_t level = plan.tiles.level[i];
    if (level == 0) tiles = std::max(tiles, bounds.tiles[i].weak_px);
    if (level == 1) tiles = std::max(tiles, bounds.tiles[i].second_order_px);
  }
  plan.bound_px = culled + laws + tiles + (plan.choices.front().on ? 0.0 : finite.bound_px);
}

void plan_planes(const Scene& scene, const TraceSettings& settings, Plan& plan) {
  const Deflectors everything = in_company(deflectors_of(scene, Law::Exact, true));
  const FilmBounds bounds = bounds_of(scene, everything, tiles_of(scene.camera));
  const bool flat = scene.camera.projection == Projection::Perspective;
  for (std::size_t i = 0; i < scene.lenses.size(); ++i) {
    const double moves = bounds.lenses[i].wild ? kInfinity : bounds.lenses[i].moves_px;
    plan.lenses.push_back({i, false, Law::Weak, moves, 0.0, "it has no mass"});
  }
  const EffectPlan finite = finite_distance_plan(settings, flat, bounds);
  const EffectPlan joint = joint_plan(settings, count_masses(everything), bounds);
  plan.choices.insert(plan.choices.begin(), {finite, joint});
  if (settings.law) {
    plan_as_told(scene, settings, finite, bounds, plan);
  } else {
    plan_within_tolerance(scene, settings, finite, everything, bounds, plan);
  }
  plan.bound_px += joint.bound_px;
  if (meets_bodies(scene)) plan_curves(scene, settings, finite, bounds, plan);
}

}  // namespace

Plan plan_trace(const Scene& scene, const TraceSettings& settings) {
  Plan plan;
  plan.method = settings.method;
  plan.effects = settings.effects;
  plan.choices = called_for(settings.effects);
  plan.geodesic_tolerance = settings.tolerance_px * pixel_angle(scene.camera) * kGeodesicShare;
  if (settings.method == Method::Planes) {
    plan_planes(scene, settings, plan);
  } else {
    plan.planes = lens_planes(scene, settings.method);
  }
  if (settings.method == Method::Geodesic) {
    for (const LensPlane& plane : plan.planes) {
      for (const Source& source : plane.sources) plan.masses.push_back({source.m, source.position});
    }
  }
  return plan;
}

Plan plan_trace(const Scene& scene, Method method) {
  return plan_trace(scene, TraceSettings{method, Law::Exact, 1e-3, Choice::On, {}});
}

std::size_t level_at(const Plan& plan, const Camera& camera, FilmPosition film) {
  if (plan.tiles.level.empty()) return plan.recipes.size() - 1;
  return plan.tiles.level[tile_at(plan.tiles, camera, film)];
}

bool curves_at(const Plan& plan, const Camera& camera, FilmPosition film) {
  return !plan.tiles.curved.empty() && plan.tiles.curved[tile_at(plan.tiles, camera, film)] != 0;
}

double chords_px_at(const Plan& plan, const Camera& camera, FilmPosition film) {
  return plan.tiles.chords_px.empty() ? 0.0 : plan.tiles.chords_px[tile_at(plan.tiles, camera, film)];
}

std::vector<double> recipe_shares(const Plan& plan, const Camera& camera) {
  const TileLevels& tiles = plan.tiles;
  if (!tiles.level.empty()) return shares_of(tiles, camera, tiles.level, plan.recipes.size());
  std::vector<double> shares(plan.recipes.size(), 0.0);
  if (!shares.empty()) shares.back() = 1.0;
  return shares;
}

LevelRange levels_of(const Plan& plan, const Camera& camera, const BatchArray& x, const BatchArray& y) {
  const std::size_t last = plan.recipes.size() - 1;
  if (plan.tiles.level.empty()) return {last, last};
  const auto [left, right] = std::minmax_element(x, x + kBatchSize);
  const auto [top, bottom] = std::minmax_element(y, y + kBatchSize);
  const double size = plan.tiles.size;
  LevelRange range{last, 0};
  // One step more than there are tiles between the edges: the last falls on the far edge or beyond it.
  for (double v = *top; v < *bottom + size; v += size) {
    for (double u = *left; u < *right + size; u += size) {
      const std::size_t level = level_at(plan, camera, {std::min(u, *right), std::min(v, *bottom)});
      range = {std::min(range.least, level), std::max(range.most, level)};
    }
  }
  return range;
}

}  // namespace lensplane
