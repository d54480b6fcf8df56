// SPDX-License-Identifier: Apache-2.0
//
// Effects: what a trace may compute beside where light comes from. Each is computed only when it is called
// for.

#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace lensplane {

/// The passes of a data file, each called for or not.
struct Effects {
  bool jacobian = false;       // derivatives of (s, t) by the film position, per pixel
  bool magnification = false;  // solid angle seen over solid angle there, negative where mirrored
  bool delay = false;          // arrival time, seconds after light in empty space
  bool direction = false;      // of the ray after its last bend, in the world
  bool shadow = false;         // 1 where the light ends in a mass
  bool bends = false;          // number of planes that bent the ray
  bool depth = false;          // metres along the ray

  /// Do any need derivatives along the rays?
  constexpr bool derivatives() const { return jacobian || magnification; }
  constexpr bool any() const { return derivatives() || delay || direction || shadow || bends || depth; }
};

struct EffectName {
  bool Effects::*effect;
  std::string_view name;
};

inline constexpr std::array kEffectNames = {
    EffectName{&Effects::jacobian, "jacobian"}, EffectName{&Effects::magnification, "magnification"},
    EffectName{&Effects::delay, "delay"},       EffectName{&Effects::direction, "direction"},
    EffectName{&Effects::shadow, "shadow"},     EffectName{&Effects::bends, "bends"},
    EffectName{&Effects::depth, "depth"},
};

/// All effects that are called for in either.
constexpr Effects operator|(Effects a, const Effects& b) {
  for (const EffectName& entry : kEffectNames) a.*entry.effect = a.*entry.effect || b.*entry.effect;
  return a;
}

}  // namespace lensplane
