// SPDX-License-Identifier: Apache-2.0

#include "pipeline/cli/threads.h"

#include <OpenEXR/ImfThreading.h>

#include <algorithm>
#include <thread>

namespace lensplane {

Threads::Threads(int wanted)
    : count_(wanted > 0 ? wanted : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()))),
      limit_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count_)) {
  Imf::setGlobalThreadCount(count_ > 1 ? count_ : 0);
}

}  // namespace lensplane
