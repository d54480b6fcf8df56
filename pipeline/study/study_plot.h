// SPDX-License-Identifier: Apache-2.0
//
// The plot of a study: error against time, both in powers of ten, a point for each trace, and the front of
// those that are worth their time.

#pragma once

#include <string>

#include "pipeline/study/study.h"

namespace lensplane {

/// An SVG element, with a point (class "point") for every trace, whose title says it in full. Errors below
/// 1e-10 px stand on the lower edge.
std::string plot_of(const Study& study);

/// A text as HTML and SVG write it.
std::string escaped(const std::string& text);

}  // namespace lensplane
