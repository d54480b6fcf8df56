// SPDX-License-Identifier: Apache-2.0

#include "pipeline/shot/layer_files.h"

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

}  // namespace lensplane
