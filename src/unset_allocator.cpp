// SPDX-License-Identifier: Apache-2.0

#include "src/unset_allocator.h"

#include <sys/mman.h>

namespace lensplane {
namespace {

constexpr std::size_t kLargePage = std::size_t{2} << 20;  // of the processors that this runs on
constexpr std::size_t kManyPages = 2 * kLargePage;        // from here on they are worth it

}  // namespace

void* allocate_unset(std::size_t bytes) {
  if (bytes < kManyPages) return ::operator new(bytes);
  void* memory = ::operator new (bytes, std::align_val_t{kLargePage});
  // No more than a hint: where there are none, small pages do.
  ::madvise(memory, bytes, MADV_HUGEPAGE);
  return memory;
}

void deallocate_unset(void* memory, std::size_t bytes) noexcept {
  if (bytes < kManyPages) {
    ::operator delete(memory);
  } else {
    ::operator delete (memory, std::align_val_t{kLargePage});
  }
}

}  // namespace lensplane
