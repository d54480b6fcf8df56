// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/empty_space.h"

#include <gtest/gtest.h>

namespace lensplane {
namespace {

using Known = EmptySpace::Known;

/// A batch that looks at two places by turns.
TraceBatch batch_of(double x, double y, double other_x, double other_y) {
  TraceBatch batch;
  for (int i = 0; i < kBatchSize; ++i) {
    batch.x[i] = i % 2 == 0 ? x : other_x;
    batch.y[i] = i % 2 == 0 ? y : other_y;
  }
  return batch;
}

/// Some rows of a map that is valid where `valid` is 1.
LensMap map_of(int width, const std::vector<float>& valid) {
  LensMap map;
  map.width = width;
  map.height = static_cast<int>(valid.size()) / width;
  map.valid.resize(valid.size());
  std::copy(valid.begin(), valid.end(), map.valid.begin());
  return map;
}

TEST(EmptySpace, KnowsWhatMapsHaveSeenAndNoMore) {
  Camera camera;
  camera.width = 3;
  camera.height = 2;
  camera.overscan = 1;
  EmptySpace empty(camera);  // 5 x 4 pixels from (-1, -1)
  EXPECT_EQ(empty.known_of(batch_of(0.5, 0.5, 1.5, 0.5)), Known::Nothing);
  // Two surfaces, of rows 1 and 2: one is met at (0, 0), the other at (2, 1).
  empty.learn(
      std::vector{map_of(5, {0, 1, 0, 0, 0, 0, 0, 0, 0, 0}), map_of(5, {0, 0, 0, 0, 0, 0, 0, 0, 1, 0})}, 0,
      {1, 3});
  EXPECT_EQ(empty.known_of(batch_of(0.5, 0.5, 1.5, 0.5)), Known::MeetsSomething);
  EXPECT_EQ(empty.known_of(batch_of(1.5, 0.5, 2.5, 1.5)), Known::MeetsSomething);
  EXPECT_EQ(empty.known_of(batch_of(1.5, 0.5, 1.5, 1.5)), Known::MeetsNothing);
  EXPECT_EQ(empty.known_of(batch_of(-0.5, 0.5, 3.5, 1.5)), Known::MeetsNothing);  // in the overscan
  EXPECT_EQ(empty.known_of(batch_of(1.5, 0.5, 1.5, 2.5)), Known::Nothing);        // a row that is not known
  EXPECT_EQ(empty.known_of(batch_of(1.5, 0.5, -1.5, 0.5)), Known::Nothing);       // outside of the overscan
  EXPECT_EQ(empty.known_of(batch_of(2.5, 1.5, 4.5, 0.5)), Known::MeetsSomething);
}

TEST(EmptySpace, OfNoCameraKnowsNothing) {
  EXPECT_EQ(EmptySpace().known_of(batch_of(0.5, 0.5, 1.5, 0.5)), Known::Nothing);
}

}  // namespace
}  // namespace lensplane
