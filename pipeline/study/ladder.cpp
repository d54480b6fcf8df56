// SPDX-License-Identifier: Apache-2.0

#include "pipeline/study/ladder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace lensplane {
namespace {

constexpr std::array kTolerances = {1.0, 0.1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6};  // pixels, of the open law
constexpr std::array kGeodesicTolerances = {1.0, 1e-2, 1e-4, 1e-6};

std::string_view name_of(Choice choice) {
  return choice == Choice::On ? "on" : choice == Choice::Off ? "off" : "auto";
}

TraceSettings by(Method method, double tolerance_px = TraceSettings().tolerance_px) {
  TraceSettings settings;
  settings.method = method;
  settings.tolerance_px = tolerance_px;
  return settings;
}

/// Does the tolerance change what is traced?
bool uses_tolerance(const TraceSettings& s) {
  return s.method == Method::Geodesic ||
         (s.method == Method::Planes && (!s.law || s.finite_distance == Choice::Auto));
}

bool same(const TraceSettings& a, const TraceSettings& b) {
  if (a.method != b.method) return false;
  if (uses_tolerance(a) && a.tolerance_px != b.tolerance_px) return false;
  return a.method != Method::Planes || (a.law == b.law && a.finite_distance == b.finite_distance);
}

void add_planes(const Camera& camera, std::vector<Rung>& ladder) {
  for (const Choice finite : {Choice::Off, Choice::On}) {
    if (finite == Choice::Off && camera.projection != Projection::Perspective) continue;
    TraceSettings settings = by(Method::Planes);
    settings.finite_distance = finite;
    for (const LawEntry& entry : kLaws) {
      settings.law = entry.law;
      ladder.push_back({settings});
    }
    settings.law = std::nullopt;
    for (const double tolerance : kTolerances) {
      settings.tolerance_px = tolerance;
      ladder.push_back({settings});
    }
  }
}

}  // namespace

std::string name_of(const TraceSettings& settings) {
  std::string name(name_of(settings.method));
  if (settings.method == Method::Planes)
    name += fmt::format(", law {}", settings.law ? name_of(*settings.law) : "auto");
  if (uses_tolerance(settings)) name += fmt::format(", {} px", settings.tolerance_px);
  if (settings.method == Method::Planes)
    name += fmt::format(", finite distance {}", name_of(settings.finite_distance));
  return name;
}

std::vector<Rung> ladder_of(const Camera& camera, const TraceSettings& of_shot) {
  std::vector<Rung> ladder;
  for (const Method method : {Method::Kishi, Method::ShinotsukaMakino}) ladder.push_back({by(method)});
  add_planes(camera, ladder);
  for (const double tolerance : kGeodesicTolerances) ladder.push_back({by(Method::Geodesic, tolerance)});
  TraceSettings own = of_shot;
  own.effects = {};
  const auto known =
      std::find_if(ladder.begin(), ladder.end(), [&](const Rung& rung) { return same(rung.settings, own); });
  if (known == ladder.end()) {
    ladder.push_back({own, true});
  } else {
    known->of_shot = true;
  }
  return ladder;
}

}  // namespace lensplane
