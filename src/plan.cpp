// SPDX-License-Identifier: Apache-2.0

#include "src/plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>

#include "src/plan_bounds.h"

namespace lensplane {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// How the tolerance is shared out: a quarter each for lenses left out, for the laws of single tiles, for the
// laws of single lenses, and for finite distances.
constexpr double kShare = 0.25;

std::string counted(std::size_t count, std::string_view noun) {
  return std::to_string(count) + " " + std::string(noun) + (count == 1 ? "" : "s");
}

std::string in_pixels(double px) {
  if (!(px < kInfinity)) return "without limit";
  char text[32];
  std::snprintf(text, sizeof text, "%.2g px", px);
  return text;
}

TileLevels tiles_of(const Camera& camera) {
  TileLevels tiles;
  tiles.columns = (camera.full_width() + tiles.size - 1) / tiles.size;
  tiles.rows = (camera.full_height() + tiles.size - 1) / tiles.size;
  return tiles;
}

/// The deflectors of `all` that `keeps(lens)` keeps, each with the law that `law(lens)` gives it.
template <class Keeps, class LawOf>
Deflectors recipe(const Deflectors& all, Keeps keeps, LawOf law_of) {
  Deflectors result = all;
  const auto thin_out = [&](std::size_t begin, std::size_t end) {
    std::vector<DeflectorPlane> planes;
    for (std::size_t k = begin; k < end; ++k) {
      DeflectorPlane plane = all.planes[k];
      std::erase_if(plane.deflectors, [&](const Deflector& d) { return !keeps(d.lens); });
      for (Deflector& d : plane.deflectors) d.law = law_of(d.lens);
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
    lens.bound_px = lens.law == Law::Weak ? bound.weak_px : bound.second_order_px;
    if (lens.law == Law::Exact) lens.bound_px = 0.0;
  }
}

std::string reason_of(const LensPlan& lens, const LensBound& bound) {
  if (lens.culled) return "would move no pixel by more than " + in_pixels(lens.moves_px);
  const std::string near = bound.wild ? "; exact near it" : "";
  if (lens.law == Law::Weak)
    return "more terms would move no pixel by more than " + in_pixels(bound.weak_px) + near;
  if (lens.law == Law::SecondOrder) {
    return "the weak law would be up to " + in_pixels(bound.weak_px) + " off, this one " +
           in_pixels(bound.second_order_px) + near;
  }
  return "the second order would be up to " + in_pixels(bound.second_order_px) + " off" + near;
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

EffectPlan finite_distance_plan(const TraceSettings& settings, bool flat, const FilmBounds& bounds) {
  EffectPlan effect{"finite distance", settings.finite_distance == Choice::On, 0.0, "asked for"};
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
  return effect;
}

std::vector<EffectPlan> called_for(const Effects& effects) {
  std::vector<EffectPlan> plans;
  for (const EffectName& entry : kEffectNames) {
    const bool on = effects.*entry.effect;
    plans.push_back({std::string(entry.name), on, 0.0, on ? "asked for" : "no output asks for it"});
  }
  return plans;
}

/// The law and the finite distance as the settings say, for every lens and tile.
void plan_as_told(const Scene& scene, const TraceSettings& settings, const EffectPlan& finite,
                  const FilmBounds& bounds, Plan& plan) {
  const Law law = *settings.law;
  plan.recipes = {deflectors_of(scene, law, finite.on)};
  for (std::size_t i = 0; i < plan.lenses.size(); ++i) {
    LensPlan& lens = plan.lenses[i];
    const LensBound& bound = bounds.lenses[i];
    lens.law = law;
    lens.bound_px = law == Law::Weak ? bound.weak_px : law == Law::SecondOrder ? bound.second_order_px : 0.0;
    if (law != Law::Exact && bound.wild) lens.bound_px = kInfinity;
    lens.reason = "the law is given";
    plan.bound_px += lens.bound_px;
  }
  if (!finite.on) plan.bound_px += finite.bound_px;
}

void plan_within_tolerance(const Scene& scene, const TraceSettings& settings, const EffectPlan& finite,
                           const Deflectors& everything, const FilmBounds& bounds, Plan& plan) {
  const double share = kShare * settings.tolerance_px;
  cull(bounds, share, plan.lenses);
  choose_laws(bounds, share, plan.lenses);
  plan.tiles = tiles_of(scene.camera);
  choose_levels(bounds, share, plan.tiles);
  const Deflectors all = finite.on ? everything : deflectors_of(scene, Law::Exact, false);
  const auto keeps = [&](std::size_t lens) { return !plan.lenses[lens].culled; };
  const auto at_most = [&](Law most) {
    return [&plan, most](std::size_t lens) { return std::min(plan.lenses[lens].law, most); };
  };
  const bool given_off = settings.finite_distance == Choice::Off;
  plan.recipes = {recipe(all, keeps, at_most(Law::Weak)), recipe(all, keeps, at_most(Law::SecondOrder)),
                  recipe(all, keeps, at_most(Law::Exact)), given_off ? all : everything};
  double culled = 0.0, laws = 0.0, tiles = 0.0;
  for (std::size_t i = 0; i < plan.lenses.size(); ++i) {
    LensPlan& lens = plan.lenses[i];
    if (scene.lenses[i].m > 0.0) lens.reason = reason_of(lens, bounds.lenses[i]);
    (lens.culled ? culled : laws) += lens.bound_px;
  }
  for (std::size_t i = 0; i < bounds.tiles.size(); ++i) {
    const std::uint8_t level = plan.tiles.level[i];
    if (level == 0) tiles = std::max(tiles, bounds.tiles[i].weak_px);
    if (level == 1) tiles = std::max(tiles, bounds.tiles[i].second_order_px);
  }
  plan.bound_px = culled + laws + tiles + (finite.on ? 0.0 : finite.bound_px);
}

void plan_planes(const Scene& scene, const TraceSettings& settings, Plan& plan) {
  const Deflectors everything = deflectors_of(scene, Law::Exact, true);
  const FilmBounds bounds = bounds_of(scene, everything, tiles_of(scene.camera));
  const bool flat = scene.camera.projection == Projection::Perspective;
  for (std::size_t i = 0; i < scene.lenses.size(); ++i) {
    const double moves = bounds.lenses[i].wild ? kInfinity : bounds.lenses[i].moves_px;
    plan.lenses.push_back({i, false, Law::Weak, moves, 0.0, "it has no mass"});
  }
  const EffectPlan finite = finite_distance_plan(settings, flat, bounds);
  plan.choices.insert(plan.choices.begin(), finite);
  if (settings.law) {
    plan_as_told(scene, settings, finite, bounds, plan);
  } else {
    plan_within_tolerance(scene, settings, finite, everything, bounds, plan);
  }
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
  return plan;
}

Plan plan_trace(const Scene& scene, Method method) {
  return plan_trace(scene, TraceSettings{method, Law::Exact, 1e-3, Choice::On, {}});
}

std::size_t level_at(const Plan& plan, const Camera& camera, FilmPosition film) {
  const TileLevels& tiles = plan.tiles;
  if (tiles.level.empty()) return plan.recipes.size() - 1;
  const auto tile = [&](double position, int count) {
    const double index = std::floor((position + camera.overscan) / tiles.size);
    return static_cast<std::size_t>(std::clamp(index, 0.0, count - 1.0));
  };
  return tiles.level[tile(film.y, tiles.rows) * static_cast<std::size_t>(tiles.columns) +
                     tile(film.x, tiles.columns)];
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

std::string describe(const Plan& plan) {
  std::string text(name_of(plan.method));
  if (plan.method == Method::Geodesic) {
    char tolerance[32];
    std::snprintf(tolerance, sizeof tolerance, "%.2g", plan.geodesic_tolerance);
    std::size_t sources = 0;
    for (const LensPlane& plane : plan.planes) sources += plane.sources.size();
    return text + ": " + std::to_string(sources) + (sources == 1 ? " lens" : " lenses") +
           ", curved rays to " + tolerance + " rad";
  }
  if (plan.method != Method::Planes) {
    std::size_t sources = 0;
    for (const LensPlane& plane : plan.planes) sources += plane.sources.size();
    return text + ": weak law, " + counted(sources, "source") + " on " + counted(plan.planes.size(), "plane");
  }
  std::array<std::size_t, 3> by_law{};
  std::size_t culled = 0;
  for (const LensPlan& lens : plan.lenses) {
    ++(lens.culled ? culled : by_law[static_cast<std::size_t>(lens.law)]);
  }
  text += ": " + std::to_string(plan.lenses.size()) + (plan.lenses.size() == 1 ? " lens" : " lenses");
  for (const LawEntry& entry : kLaws) {
    const std::size_t count = by_law[static_cast<std::size_t>(entry.law)];
    if (count > 0) text += ", " + std::to_string(count) + " " + std::string(entry.name);
  }
  if (culled > 0) text += ", " + std::to_string(culled) + " culled";
  text += plan.recipes.front().finite_distance ? "; finite distance on" : "; finite distance off";
  return text + "; within " + in_pixels(plan.bound_px);
}

}  // namespace lensplane
