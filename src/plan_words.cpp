// SPDX-License-Identifier: Apache-2.0

#include "src/plan_words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

namespace lensplane {
namespace {

std::string counted(std::size_t count, std::string_view noun) {
  return std::to_string(count) + " " + std::string(noun) + (count == 1 ? "" : "s");
}

std::string shortened(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", number);
  return text;
}

std::size_t count_sources(const Plan& plan) {
  std::size_t count = 0;
  for (const LensPlane& plane : plan.planes) count += plane.sources.size();
  return count;
}

std::string lenses(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " lens" : " lenses");
}

/// "3 lenses, 2 weak, 1 exact; finite distance off; within 0.021 px".
std::string describe_planes(const Plan& plan) {
  std::array<std::size_t, kLaws.size()> by_law{};
  std::size_t culled = 0;
  for (const LensPlan& lens : plan.lenses) {
    ++(lens.culled ? culled : by_law[static_cast<std::size_t>(lens.law)]);
  }
  std::string text = lenses(plan.lenses.size());
  for (const LawEntry& entry : kLaws) {
    const std::size_t count = by_law[static_cast<std::size_t>(entry.law)];
    if (count > 0) text += ", " + std::to_string(count) + " " + std::string(entry.name);
  }
  if (culled > 0) text += ", " + std::to_string(culled) + " culled";
  if (!plan.choices.empty()) {
    const EffectPlan& finite = plan.choices.front();
    text += std::string("; finite distance ") + (finite.on ? "on" : "off");
    if (plan.near_masses > 0.0 && plan.near_masses < 1.0)
      text += "; nothing left out near masses (" + in_percent(plan.near_masses) + " of the film)";
  }
  for (const EffectPlan& effect : plan.choices) {
    if (effect.name == kCurvedEffect && effect.share > 0.0)
      text += "; bodies by curved rays (" + in_percent(effect.share) + " of the film)";
  }
  const bool bounded = plan.bound_px < std::numeric_limits<double>::infinity();
  return text + "; " + (bounded ? "within " : "") + in_pixels(plan.bound_px);
}

}  // namespace

std::string in_pixels(double px) {
  if (px >= 100.0 && px < 1e6) return std::to_string(std::lround(px)) + " px";
  return px < std::numeric_limits<double>::infinity() ? shortened(px) + " px" : "without limit";
}

std::string in_percent(double share) {
  const double percent = 100.0 * share;
  if (percent > 0.0 && percent < 0.1) return "less than 0.1 %";
  if (percent < 100.0 && percent > 99.9) return "more than 99.9 %";
  char text[32];
  std::snprintf(text, sizeof text, "%.1f %%", percent);
  return text;
}

std::string reason_of(const LensPlan& lens, const LensBound& bound, double near_masses) {
  if (near_masses == 1.0) return "the whole film is near masses";
  const std::string near =
      near_masses > 0.0 ? "; exact near masses (" + in_percent(near_masses) + " of the film)" : "";
  if (lens.culled) return "would move no pixel by more than " + in_pixels(lens.moves_px) + near;
  if (lens.law == Law::Weak)
    return "more terms would move no pixel by more than " + in_pixels(bound.weak_px) + near;
  if (lens.law == Law::SecondOrder) {
    return "the weak law would be up to " + in_pixels(bound.weak_px) + " off, this one " +
           in_pixels(bound.second_order_px) + near;
  }
  return "the second order would be up to " + in_pixels(bound.second_order_px) + " off" +
         (lens.company ? ", a mass by itself " + in_pixels(bound.gain_px) : "");
}

std::string reason_near_masses(double near_masses, double elsewhere_px) {
  if (near_masses == 1.0) return "the whole film is near masses";
  return "on near masses (" + in_percent(near_masses) +
         " of the film); elsewhere it would move no pixel by more than " + in_pixels(elsewhere_px);
}

std::string reason_of_curves(double curved, double there_px, double elsewhere_px) {
  const bool bounded = there_px < std::numeric_limits<double>::infinity();
  const std::string there =
      "chords would misplace bodies " + (bounded ? "by up to " + in_pixels(there_px) : "without limit");
  const bool all_bounded = elsewhere_px < std::numeric_limits<double>::infinity();
  const std::string chords = all_bounded ? "chords misplace bodies by no more than " + in_pixels(elsewhere_px)
                                         : std::string("chords misplace bodies without limit");
  if (curved == 1.0) return there;
  return curved > 0.0 ? there + " on " + in_percent(curved) + " of the film; elsewhere " + chords : chords;
}

std::string describe(const Plan& plan) {
  const std::string method = std::string(name_of(plan.method)) + ": ";
  switch (plan.method) {
    case Method::Geodesic:
      return method + lenses(count_sources(plan)) + ", curved rays to " + shortened(plan.geodesic_tolerance) +
             " rad";
    case Method::Planes:
      return method + describe_planes(plan);
    case Method::Kishi:
    case Method::ShinotsukaMakino:
      break;
  }
  return method + "weak law, " + counted(count_sources(plan), "source") + " on " +
         counted(plan.planes.size(), "plane");
}

}  // namespace lensplane
