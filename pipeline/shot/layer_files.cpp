// SPDX-License-Identifier: Apache-2.0

#include "pipeline/shot/layer_files.h"

#include <utility>

namespace lensplane {

std::vector<const LayerImage*> images_of(const Layer& layer) {
  if (std::holds_alternative<StarsLayer>(layer.kind)) return {};
  const auto* sphere = std::get_if<SphereLayer>(&layer.kind);
  if (!sphere || !sphere->night) return {&layer.image};
  return {&layer.image, &*sphere->night};
}

std::vector<const LocatedText*> files_of(const Layer& layer) {
  if (const auto* stars = std::get_if<StarsLayer>(&layer.kind)) return {&stars->catalogue};
  std::vector<const LocatedText*> files;
  for (const LayerImage* image : images_of(layer)) files.push_back(&image->pattern);
  return files;
}

std::vector<LocatedText*> files_of(Layer& layer) {
  std::vector<LocatedText*> files;
  // What they point to is the layer's, which may be changed.
  for (const LocatedText* file : files_of(std::as_const(layer))) {
    files.push_back(const_cast<LocatedText*>(file));
  }
  return files;
}

}  // namespace lensplane
