// SPDX-License-Identifier: Apache-2.0
//
// Which of the pictures in a file is meant: EXR files hold several.

#pragma once

#include <string>

namespace lensplane {

struct ImageChoice {
  std::string layer;  // its channels are layer.R, layer.G, ...; empty: R, G, B
  std::string part;   // by its name or its number from 0; empty: the first
};

}  // namespace lensplane
