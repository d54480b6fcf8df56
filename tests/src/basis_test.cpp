// SPDX-License-Identifier: Apache-2.0

#include "src/basis.h"

#include <gtest/gtest.h>

#include "src/constants.h"

namespace lensplane {
namespace {

void expect_near(const Vec3& a, const Vec3& b, double tolerance = 1e-15) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

void expect_orthonormal_and_right_handed(const Basis& b) {
  expect_near(b.x.cross(b.y), b.z, 1e-14);
  expect_near(b.y.cross(b.z), b.x, 1e-14);
  EXPECT_NEAR(b.x.length(), 1.0, 1e-14);
}

TEST(Basis, QuarterTurnsGoCounterClockwise) {
  const double quarter = kPi / 2.0;
  expect_near(basis_from_zxy({quarter, 0, 0}).parent_from_local({0, 1, 0}), {0, 0, 1});
  expect_near(basis_from_zxy({0, quarter, 0}).parent_from_local({0, 0, 1}), {1, 0, 0});
  expect_near(basis_from_zxy({0, 0, quarter}).parent_from_local({1, 0, 0}), {0, 1, 0});
}

TEST(Basis, RotationsAreAppliedAboutZThenXThenY) {
  const double quarter = kPi / 2.0;
  // x --(about z)--> y --(about x)--> z --(about y)--> x
  expect_near(basis_from_zxy({quarter, quarter, quarter}).parent_from_local({1, 0, 0}), {1, 0, 0});
  // y --(about z)--> -x --(about x)--> -x --(about y)--> z
  expect_near(basis_from_zxy({quarter, quarter, quarter}).parent_from_local({0, 1, 0}), {0, 0, 1});
}

TEST(Basis, CameraWithoutRotationIsACameraThatLooksAlongMinusZ) {
  const Basis looking = basis_looking_along({0, 0, -1}, {0, 1, 0});
  expect_near(looking.x, {1, 0, 0});
  expect_near(looking.y, {0, 1, 0});
  expect_near(looking.z, {0, 0, 1});
}

TEST(Basis, LookingAlongPutsTheTargetAheadAndUpUpwards) {
  for (const double scale : {1e-200, 1.0, 1e200}) {
    const Vec3 forward(1, -2, 3), up(0.2, 1, 0.1);
    const Basis axes = basis_looking_along(forward * scale, up);
    expect_orthonormal_and_right_handed(axes);
    const Vec3 seen = axes.local_from_parent(forward.normalized());
    expect_near(seen, {0, 0, -1});
    EXPECT_GT(axes.local_from_parent(up).y, 0);
    EXPECT_NEAR(axes.local_from_parent(up).x, 0, 1e-15);
  }
}

TEST(Basis, LookingNowhereOrStraightUpIsNotValid) {
  EXPECT_FALSE(is_valid(basis_looking_along({0, 0, 0}, {0, 1, 0})));
  EXPECT_FALSE(is_valid(basis_looking_along({0, 5, 0}, {0, 1, 0})));
  EXPECT_FALSE(is_valid(basis_looking_along({0, -5, 0}, {0, 1, 0})));
  EXPECT_TRUE(is_valid(basis_looking_along({1e-6, -5, 0}, {0, 1, 0})));
}

TEST(Basis, LocalFromParentUndoesParentFromLocal) {
  const Basis a = basis_from_zxy({0.3, -1.2, 2.5}), b = basis_from_zxy({-2, 0.1, 0.7});
  expect_orthonormal_and_right_handed(a);
  const Vec3 v(0.1, -4, 2);
  expect_near(a.local_from_parent(a.parent_from_local(v)), v, 1e-14);
  const Basis there_and_back = local_from_parent(a, parent_from_local(a, b));
  expect_near(there_and_back.x, b.x, 1e-15);
  expect_near(there_and_back.z, b.z, 1e-15);
  expect_near(parent_from_local(a, b).parent_from_local(v), a.parent_from_local(b.parent_from_local(v)),
              1e-14);
}

}  // namespace
}  // namespace lensplane
