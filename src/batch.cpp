// SPDX-License-Identifier: Apache-2.0

#include "src/batch.h"

#include <bit>
#include <cstdint>

namespace lensplane {

LENSPLANE_KERNEL
bool any_of(const BatchArray& flags) {
  std::uint64_t bits = 0;
  for (const double flag : flags) bits |= std::bit_cast<std::uint64_t>(flag);
  return bits != 0;
}

}  // namespace lensplane
