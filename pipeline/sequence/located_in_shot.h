// SPDX-License-Identifier: Apache-2.0
//
// Whose fault it is when an input fails: the key of the shot that names it.

#pragma once

#include "pipeline/image/failure.h"
#include "pipeline/shot/shot.h"

namespace lensplane {

/// Runs `work`; when an input fails there, the line says which key of the shot names it.
template <class Work>
auto located_in_shot(const LocatedText& named, Work work) {
  try {
    return work();
  } catch (const Failure& failure) {
    throw Failure(failure.code(), located(named.location, named.key, failure.what()));
  }
}

}  // namespace lensplane
