// SPDX-License-Identifier: Apache-2.0
//
// Where on the film something is, in words.

#pragma once

#include <string>

#include "pipeline/shot/shot.h"
#include "src/projection.h"

namespace lensplane {

/// "(203.5, 118.5), 12 px from near" - from the lens that stands nearest to it on the film - or the position
/// alone when there is none.
std::string place_in_words(const Shot& shot, const Scene& scene, FilmPosition film);

}  // namespace lensplane
