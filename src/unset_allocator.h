// SPDX-License-Identifier: Apache-2.0
//
// Memory for maps and pictures: numbers that are all written before they are read. Their first value is
// whatever memory holds, so that no time is spent on zeros, and each thread is the first to touch what it
// writes.

#pragma once

#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace lensplane {

template <class T>
struct UnsetAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = UnsetAllocator<U>;
  };
  UnsetAllocator() = default;
  template <class U>
  UnsetAllocator(const UnsetAllocator<U>&) {}  // as containers demand

  template <class U>
  void construct(U* at) {
    ::new (static_cast<void*>(at)) U;
  }
  template <class U, class... Arguments>
  void construct(U* at, Arguments&&... arguments) {
    ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
  }
};

template <class T>
using UnsetVector = std::vector<T, UnsetAllocator<T>>;

}  // namespace lensplane
