// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/amplification.h"

#include <fmt/format.h>

#include <charconv>
#include <sstream>

#include "pipeline/composite/sphere_coverage.h"
#include "pipeline/sequence/shutter.h"
#include "pipeline/shot/shot_scene.h"

namespace lensplane {

std::vector<Amplification> amplifications_of(const Shot& shot, int frame,
                                             const std::vector<double>& covered) {
  const std::vector<LayerSurface> surfaces = surfaces_of(shot);
  std::vector<std::size_t> spheres;
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    if (std::holds_alternative<SphereLayer>(shot.layers[surfaces[k].layer].kind)) spheres.push_back(k);
  }
  if (spheres.empty()) return {};
  std::vector<double> unlensed(spheres.size(), 0.0);
  const std::vector<Moment> moments = moments_of(shot, frame);
  for (const Moment& moment : moments) {
    const Scene scene = scene_at(shot, moment.time);
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      const auto& sphere = std::get<Sphere>(scene.surfaces[spheres[i]]);
      unlensed[i] +=
          covered_without_lenses(scene.camera, sphere, moment.sampling) / static_cast<double>(moments.size());
    }
  }
  std::vector<Amplification> amplifications;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    Amplification a{shot.layers[surfaces[spheres[i]].layer].name, std::nullopt};
    if (unlensed[i] > 0) a.factor = covered[spheres[i]] / unlensed[i];
    amplifications.push_back(std::move(a));
  }
  return amplifications;
}

/// "earth 4.46 moon -": as the picture's header keeps the factors.
std::string text_from_amplifications(const std::vector<Amplification>& amplifications) {
  std::string text;
  for (const Amplification& a : amplifications) {
    text += fmt::format("{}{} {}", text.empty() ? "" : " ", a.layer,
                        a.factor ? fmt::format("{}", *a.factor) : "-");
  }
  return text;
}

std::vector<Amplification> amplifications_from_text(const std::string& text) {
  std::vector<Amplification> amplifications;
  std::istringstream words(text);
  for (std::string layer, factor; words >> layer >> factor;) {
    double value = 0;
    const auto parsed = std::from_chars(factor.data(), factor.data() + factor.size(), value);
    const bool known = parsed.ec == std::errc();
    amplifications.push_back({layer, known ? std::optional(value) : std::nullopt});
  }
  return amplifications;
}

}  // namespace lensplane
