// SPDX-License-Identifier: Apache-2.0
//
// What the hard cases share: a small film, whose middle pixel lies on the axis, and what has to hold of every
// map.

#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "src/constants.h"
#include "src/lens_map.h"
#include "src/probe.h"

namespace lensplane {

inline constexpr double kDegree = kPi / 180.0;

inline constexpr Effects kAllEffects{true, true, true, true, true, true, true};

inline Scene view_of(std::vector<Lens> lenses, double fov_rad = 20 * kDegree) {
  Scene scene;
  scene.camera.width = 25;  // odd: a pixel centre lies on the axis
  scene.camera.height = 15;
  scene.camera.fov_rad = fov_rad;
  scene.lenses = std::move(lenses);
  scene.surfaces = {Plate{}, LatLong{}, Sphere{{0, 0, -2e9}, 3e8, {}}, Card{1e9}, Card{3e9, 1}};
  for (const int crossing : {0, 1, 2}) {
    scene.surfaces.push_back(Ring{{0, 0, -1e9}, basis_from_zxy({0.2, 0, 0}), 0, 1e8, crossing});
  }
  return scene;
}

inline constexpr FilmPosition kMiddle{12.5, 7.5};

inline TraceSettings with_everything(Method method) {
  return {method, std::nullopt, 0.05, Choice::Auto, kAllEffects};
}

/// Every number of every map of `scene`, by all methods, is finite; s and t are zero where nothing is seen.
inline void expect_finite_maps(const Scene& scene) {
  for (const MethodName& entry : kMethodNames) {
    const Tracer tracer(scene, plan_trace(scene, with_everything(entry.method)));
    for (const LensMap& map : trace_maps(tracer)) {
      for (std::size_t i = 0; i < map.s.size(); ++i) {
        ASSERT_TRUE(std::isfinite(map.s[i]) && std::isfinite(map.t[i])) << entry.name << " pixel " << i;
        ASSERT_TRUE(map.valid[i] == 1.0F || (map.valid[i] == 0.0F && map.s[i] == 0.0F && map.t[i] == 0.0F))
            << entry.name << " pixel " << i;
        for (const Pass& pass : map.passes) {
          ASSERT_TRUE(std::isfinite(pass.values[i])) << entry.name << " " << pass.channel << " pixel " << i;
        }
      }
    }
  }
}

inline Plan planned(const Scene& scene) {
  return plan_trace(scene, TraceSettings{});
}

inline Probe probed(const Scene& scene, FilmPosition film) {
  return probe(scene, planned(scene), film);
}

/// The largest angle between what two scenes show at the same film positions, where both show the sky.
inline double largest_difference(const Scene& a, const Scene& b) {
  const Plan plan_a = planned(a), plan_b = planned(b);
  double most = 0.0;
  for (double y = 0.5; y < a.camera.height; y += 1.0) {
    for (double x = 0.5; x < a.camera.width; x += 1.0) {
      const Probe p = probe(a, plan_a, {x, y}), q = probe(b, plan_b, {x, y});
      EXPECT_EQ(p.captured, q.captured) << x << " " << y;
      if (p.captured || q.captured) continue;
      most = std::max(most, angle_between(p.last, q.last));
    }
  }
  return most;
}

}  // namespace lensplane
