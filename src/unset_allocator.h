// SPDX-License-Identifier: Apache-2.0
//
// Memory for maps and pictures: numbers that are all written before they are read. Their first value is
// whatever memory holds, so that no time is spent on zeros, and each thread is the first to touch what it
// writes. Large pieces ask the system for large pages: it then gives them in few steps.

#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace lensplane {

/// Memory for so many bytes, aligned for any number, and the end of it. Throws std::bad_alloc.
void* allocate_unset(std::size_t bytes);
void deallocate_unset(void* memory, std::size_t bytes) noexcept;

template <class T>
struct UnsetAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = UnsetAllocator<U>;
  };
  UnsetAllocator() = default;
  template <class U>
  UnsetAllocator(const UnsetAllocator<U>&) {}  // as containers demand

  T* allocate(std::size_t count) {
    if (count > static_cast<std::size_t>(-1) / sizeof(T)) throw std::bad_array_new_length();
    return static_cast<T*>(allocate_unset(count * sizeof(T)));
  }
  void deallocate(T* memory, std::size_t count) noexcept { deallocate_unset(memory, count * sizeof(T)); }

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
