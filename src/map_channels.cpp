// SPDX-License-Identifier: Apache-2.0

#include "src/map_channels.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>

namespace lensplane {
namespace {

/// Whose a value is: that of the point which is seen, or of the ray, wherever it goes.
enum class Of { Surface, Ray };

/// A channel: which effect calls for it, and its value for ray `i`.
struct Channel {
  bool Effects::*effect;
  Of of;
  std::string_view name;
  double (*value)(const SurfaceBatch&, int i);
};

constexpr std::array kChannels = {
    Channel{&Effects::jacobian, Of::Surface, "jacobian.ds_dx",
            [](const SurfaceBatch& b, int i) { return b.passes->ds_dx[i]; }},
    Channel{&Effects::jacobian, Of::Surface, "jacobian.ds_dy",
            [](const SurfaceBatch& b, int i) { return b.passes->ds_dy[i]; }},
    Channel{&Effects::jacobian, Of::Surface, "jacobian.dt_dx",
            [](const SurfaceBatch& b, int i) { return b.passes->dt_dx[i]; }},
    Channel{&Effects::jacobian, Of::Surface, "jacobian.dt_dy",
            [](const SurfaceBatch& b, int i) { return b.passes->dt_dy[i]; }},
    Channel{&Effects::magnification, Of::Surface, "lensing.magnification",
            [](const SurfaceBatch& b, int i) { return b.passes->magnification[i]; }},
    Channel{&Effects::delay, Of::Surface, "lensing.delay",
            [](const SurfaceBatch& b, int i) { return b.passes->delay[i]; }},
    Channel{&Effects::direction, Of::Ray, "dir.x",
            [](const SurfaceBatch& b, int i) { return b.passes->dir_x[i]; }},
    Channel{&Effects::direction, Of::Ray, "dir.y",
            [](const SurfaceBatch& b, int i) { return b.passes->dir_y[i]; }},
    Channel{&Effects::direction, Of::Ray, "dir.z",
            [](const SurfaceBatch& b, int i) { return b.passes->dir_z[i]; }},
    Channel{&Effects::shadow, Of::Ray, kShadowChannel,
            [](const SurfaceBatch& b, int i) { return b.outcome[i] == Outcome::Captured ? 1.0 : 0.0; }},
    Channel{&Effects::bends, Of::Ray, "lensing.bends",
            [](const SurfaceBatch& b, int i) { return b.passes->bends[i]; }},
    Channel{&Effects::depth, Of::Surface, "depth.z",
            [](const SurfaceBatch& b, int i) { return b.outcome[i] == Outcome::Hit ? b.distance[i] : 0.0; }},
};

/// Stores numbers as floats, finite whatever comes.
LENSPLANE_KERNEL void store(const double* from, int count, float* to) {
  constexpr double kLargest = std::numeric_limits<float>::max();
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const double number = from[i] == from[i] ? from[i] : 0.0;
    const double bounded = number < kLargest ? number : kLargest;
    to[i] = static_cast<float>(bounded > -kLargest ? bounded : -kLargest);
  }
}

}  // namespace

void store(const SurfaceBatch& surface, int first, int count, std::size_t at, LensMap& map) {
  store(surface.s + first, count, &map.s[at]);
  store(surface.t + first, count, &map.t[at]);
  const Outcome* outcomes = surface.outcome.data() + first;
  float* valid = &map.valid[at];
  for (int i = 0; i < count; ++i) valid[i] = outcomes[i] == Outcome::Hit ? 1.0F : 0.0F;
  const auto unresolved = std::count(outcomes, outcomes + count, Outcome::Unresolved);
  if (unresolved > 0) std::atomic_ref(map.unresolved) += unresolved;
  std::size_t pass = 0;
  BatchArray values;
  for (const Channel& channel : kChannels) {
    if (pass == map.passes.size() || map.passes[pass].channel != channel.name) continue;
    for (int i = 0; i < count; ++i) values[i] = channel.value(surface, first + i);
    store(values, count, &map.passes[pass++].values[at]);
  }
}

void store_passes(const SurfaceBatch& surface, int ray, std::size_t at, LensMap& map) {
  std::size_t pass = 0;
  for (const Channel& channel : kChannels) {
    if (pass == map.passes.size() || map.passes[pass].channel != channel.name) continue;
    float& sample = map.passes[pass++].values[at];
    const double value = channel.value(surface, ray);
    if (channel.name != kShadowChannel) store(&value, 1, &sample);
  }
}

bool is_of_surface(std::string_view name) {
  return std::any_of(kChannels.begin(), kChannels.end(), [&](const Channel& channel) {
    return channel.name == name && channel.of == Of::Surface;
  });
}

void make_room(int width, int height, const Effects& effects, LensMap& map) {
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  map.width = width;
  map.height = height;
  map.unresolved = 0;
  for (UnsetVector<float>* values : {&map.s, &map.t, &map.valid}) values->resize(pixels);
  std::size_t pass = 0;
  for (const Channel& channel : kChannels) {
    if (!(effects.*channel.effect)) continue;
    if (pass == map.passes.size()) map.passes.emplace_back();
    map.passes[pass].channel = channel.name;
    map.passes[pass++].values.resize(pixels);
  }
  map.passes.resize(pass);
}

}  // namespace lensplane
