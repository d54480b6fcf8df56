// SPDX-License-Identifier: Apache-2.0
//
// Two pieces of work at once.

#pragma once

#include <tbb/parallel_invoke.h>

#include <exception>

namespace lensplane {

/// Runs both to their ends, side by side where a thread is free, then throws what the first has thrown, or
/// else the second. (TBB by itself would silently cut short the loops of one when the other throws.)
template <class First, class Second>
void side_by_side(First first, Second second) {
  std::exception_ptr of_first, of_second;
  const auto keeping = [](auto& work, std::exception_ptr& failure) {
    try {
      work();
    } catch (...) {
      failure = std::current_exception();
    }
  };
  tbb::parallel_invoke([&] { keeping(first, of_first); }, [&] { keeping(second, of_second); });
  if (of_first) std::rethrow_exception(of_first);
  if (of_second) std::rethrow_exception(of_second);
}

}  // namespace lensplane
