// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/amplification.h"

#include <fmt/format.h>

#include <charconv>
#include <sstream>

#include "pipeline/composite/compositor.h"

namespace lensplane {

std::vector<Amplification> amplifications_of(const Shot& shot, const Scene& scene, Method method,
                                             const Sampling& sampling, const std::vector<double>& covered) {
  Scene without_lenses{scene.camera, {}, {}};
  std::vector<std::size_t> spheres;
  for (std::size_t k = 0; k < scene.surfaces.size(); ++k) {
    if (!std::holds_alternative<Sphere>(scene.surfaces[k])) continue;
    without_lenses.surfaces.push_back(scene.surfaces[k]);
    spheres.push_back(k);
  }
  if (spheres.empty()) return {};
  TraceSettings settings;
  settings.method = method;
  settings.effects.jacobian = true;
  const auto unlensed =
      covered_pixels(Tracer(without_lenses, plan_trace(without_lenses, settings)), sampling);
  std::vector<Amplification> amplifications;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    Amplification a{shot.layers[spheres[i]].name, std::nullopt};
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
