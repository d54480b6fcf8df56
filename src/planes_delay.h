// SPDX-License-Identifier: Apache-2.0
//
// The arrival time of a batch of rays by the method `planes`: arrival_time.h and path_excess.h for kernels.
// Only where it is asked for; the kernels that turn the rays keep nothing of what it needs.

#pragma once

#include "src/planes_batch.h"

namespace lensplane {

/// Adds to LineBatch::shapiro and LineBatch::excess what a plane does to rays that it has not turned yet.
template <class Number>
void add_delay(const DeflectorPlane& plane, bool finite_distance, Reach reach, LineBatch<Number>& rays);

}  // namespace lensplane
