// SPDX-License-Identifier: Apache-2.0
//
// A study as tables for people.

#pragma once

#include <string>

#include "pipeline/study/study.h"

namespace lensplane {

/// Traces, pictures, prices and advice; rows that are worth their time are marked with *.
std::string text_from_study(const Study& study);

}  // namespace lensplane
