// SPDX-License-Identifier: Apache-2.0
//
// Vectors and orthonormal bases: how the orientation of cameras and bodies is stored.
//
// A `Basis` holds the three axes of a frame, expressed in its parent frame (nearly always the world). The
// world is right-handed with y up; a camera in its own axes looks along -z with +x to its right.

#pragma once

#include <Imath/ImathVec.h>

namespace lensplane {

using Vec3 = Imath::V3d;

/// Three orthonormal axes in the coordinates of the parent frame.
struct Basis {
  Vec3 x{1, 0, 0};
  Vec3 y{0, 1, 0};
  Vec3 z{0, 0, 1};

  /// The vector in parent coordinates whose coordinates along the axes are `v`.
  Vec3 parent_from_local(const Vec3& v) const { return x * v.x + y * v.y + z * v.z; }

  /// Inverse of parent_from_local.
  Vec3 local_from_parent(const Vec3& v) const { return {x.dot(v), y.dot(v), z.dot(v)}; }
};

/// `inner`, given in the axes of `outer`, expressed in the parent of `outer`.
Basis parent_from_local(const Basis& outer, const Basis& inner);

/// The inverse of the above: `basis`, given in the parent of `frame`, expressed in the axes of `frame`.
Basis local_from_parent(const Basis& frame, const Basis& basis);

/// Radians between two unit vectors, with all digits however near or far from one another they are.
double angle_between(const Vec3& a, const Vec3& b);

/// Rotation about z first, then x, then y (order ZXY, as film cameras are exchanged). Angles in radians,
/// counter-clockwise when looking against the axis.
Basis basis_from_zxy(const Vec3& angles_rad);

/// A camera's axes: -z along `forward`, y as near to `up` as possible. Both need not be of unit length.
/// Returns a basis of zero vectors when `forward` is zero or parallel to `up`.
Basis basis_looking_along(const Vec3& forward, const Vec3& up);

/// False for the outcome of basis_looking_along that has no direction.
bool is_valid(const Basis& basis);

}  // namespace lensplane
