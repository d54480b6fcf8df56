// SPDX-License-Identifier: Apache-2.0

#include "src/unset_allocator.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <numeric>

namespace lensplane {
namespace {

TEST(UnsetAllocator, HoldsSmallAndLargePieces) {
  UnsetVector<std::int32_t> numbers;
  for (const std::size_t count :
       {std::size_t{0}, std::size_t{3}, std::size_t{1} << 19, (std::size_t{3} << 20) + 1}) {
    numbers.resize(count);
    std::iota(numbers.begin(), numbers.end(), 0);
    UnsetVector<std::int32_t> other(numbers);  // a piece of its own
    other.push_back(7);
    numbers = std::move(other);
    ASSERT_EQ(numbers.size(), count + 1);
    EXPECT_EQ(numbers.back(), 7);
    EXPECT_EQ(numbers.front(), count > 0 ? 0 : 7);
    EXPECT_EQ(numbers[count / 2], count > 0 ? static_cast<std::int32_t>(count / 2) : 7);
  }
}

TEST(UnsetAllocator, RefusesMoreThanThereCanBe) {
  UnsetAllocator<double> allocator;
  EXPECT_THROW(static_cast<void>(allocator.allocate(std::numeric_limits<std::size_t>::max() / 4)),
               std::bad_array_new_length);
}

}  // namespace
}  // namespace lensplane
