// SPDX-License-Identifier: Apache-2.0
//
// The names that parts of a shot may refer to.

#pragma once

#include <string>
#include <vector>

namespace lensplane {

/// In file order.
struct ShotNames {
  std::vector<std::string> lenses;
  std::vector<std::string> layers;
};

}  // namespace lensplane
