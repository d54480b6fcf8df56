// SPDX-License-Identifier: Apache-2.0
//
// A study as one page that opens from disk: plot, tables, error maps.

#pragma once

#include <string>

#include "pipeline/study/study.h"

namespace lensplane {

/// HTML with everything in it; nothing is loaded from anywhere. Throws Failure (BadInput) when the library
/// that makes the maps' PNGs is missing.
std::string page_from_study(const Study& study);

}  // namespace lensplane
