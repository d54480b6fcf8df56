// SPDX-License-Identifier: Apache-2.0
//
// What a study that is running tells, and asks.

#pragma once

#include <functional>
#include <string>

namespace lensplane {

struct StudyHooks {
  std::function<void(const std::string&)> doing = [](const std::string&) {};  // "3 of 27: kishi"
  std::function<bool()> stop = [] { return false; };                          // asked between rows
};

}  // namespace lensplane
