// SPDX-License-Identifier: Apache-2.0

#include "pipeline/shot/layer_files.h"

#include <fmt/format.h>

namespace lensplane {
namespace {

/// Of a Layer or a const Layer.
template <class AnyLayer>
auto images_in(AnyLayer& layer) -> std::vector<decltype(&layer.image)> {
  if (std::holds_alternative<StarsLayer>(layer.kind)) return {};
  auto* sphere = std::get_if<SphereLayer>(&layer.kind);
  if (!sphere || !sphere->night) return {&layer.image};
  return {&layer.image, &*sphere->night};
}

template <class AnyLayer>
auto files_in(AnyLayer& layer) -> std::vector<decltype(&layer.image.pattern)> {
  if (auto* stars = std::get_if<StarsLayer>(&layer.kind)) return {&stars->catalogue};
  if (layer.povray) return {&layer.povray->scene};
  std::vector<decltype(&layer.image.pattern)> files;
  for (auto* image : images_in(layer)) files.push_back(&image->pattern);
  return files;
}

}  // namespace

std::vector<const LayerImage*> images_of(const Layer& layer) {
  return images_in(layer);
}

std::vector<const LocatedText*> files_of(const Layer& layer) {
  return files_in(layer);
}

std::vector<LocatedText*> files_of(Layer& layer) {
  return files_in(layer);
}

void put_plates(Shot& shot) {
  for (Layer& layer : shot.layers) {
    if (!layer.povray) continue;
    layer.image.pattern = layer.povray->scene;  // whom to blame
    layer.image.pattern.text =
        (shot.output.directory / fmt::format("{}.{}.plate.####.exr", shot.name, layer.name)).string();
  }
}

}  // namespace lensplane
