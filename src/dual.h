// SPDX-License-Identifier: Apache-2.0
//
// Dual numbers: a value together with its derivatives by the film position, per pixel.
//
// Code that is a template over its number type computes a result with `double` and the same result together
// with its analytic derivatives with `Dual` (forward differentiation: every operation applies its own rule of
// the calculus). So the Jacobian is exact to rounding, and costs nothing where nobody asks for it.

#pragma once

#include <Imath/ImathVec.h>

#include <cmath>

#include "src/inlining.h"

namespace lensplane {

struct Dual {
  double v = 0;   // the value
  double dx = 0;  // its derivative by film x, per pixel
  double dy = 0;  // its derivative by film y, per pixel

  constexpr Dual() = default;
  // Written out so that compilers copy three numbers, not one object: loops over batches depend on it.
  constexpr Dual(const Dual& a) : v(a.v), dx(a.dx), dy(a.dy) {}
  constexpr Dual& operator=(const Dual& a) {
    v = a.v, dx = a.dx, dy = a.dy;
    return *this;
  }
  constexpr Dual(double value) : v(value) {}  // a constant
  constexpr Dual(double value, double by_x, double by_y) : v(value), dx(by_x), dy(by_y) {}

  constexpr Dual& operator+=(const Dual& b) { return *this = {v + b.v, dx + b.dx, dy + b.dy}; }
  constexpr Dual& operator-=(const Dual& b) { return *this = {v - b.v, dx - b.dx, dy - b.dy}; }
};

constexpr Dual operator-(const Dual& a) {
  return {-a.v, -a.dx, -a.dy};
}
constexpr Dual operator+(const Dual& a, const Dual& b) {
  return {a.v + b.v, a.dx + b.dx, a.dy + b.dy};
}
constexpr Dual operator-(const Dual& a, const Dual& b) {
  return {a.v - b.v, a.dx - b.dx, a.dy - b.dy};
}
constexpr Dual operator*(const Dual& a, const Dual& b) {
  return {a.v * b.v, a.v * b.dx + a.dx * b.v, a.v * b.dy + a.dy * b.v};
}
constexpr Dual operator+(double a, const Dual& b) {
  return {a + b.v, b.dx, b.dy};
}
constexpr Dual operator-(double a, const Dual& b) {
  return {a - b.v, -b.dx, -b.dy};
}
constexpr Dual operator*(double a, const Dual& b) {
  return {a * b.v, a * b.dx, a * b.dy};
}
constexpr Dual operator*(const Dual& a, double b) {
  return b * a;
}

/// f(a), where `f` is the value there and `slope` the derivative df/da.
constexpr Dual chained(const Dual& a, double f, double slope) {
  return {f, slope * a.dx, slope * a.dy};
}
constexpr double chained(double, double f, double) {
  return f;
}

constexpr Dual reciprocal(const Dual& a) {
  const double r = 1.0 / a.v;
  return chained(a, r, -r * r);
}
constexpr double reciprocal(double a) {
  return 1.0 / a;
}
constexpr Dual operator/(const Dual& a, double b) {
  return {a.v / b, a.dx / b, a.dy / b};
}
constexpr Dual operator/(double a, const Dual& b) {
  return a * reciprocal(b);
}
constexpr Dual operator/(const Dual& a, const Dual& b) {
  return a * reciprocal(b);
}

/// The value without its derivatives.
constexpr double value_of(double a) {
  return a;
}
constexpr double value_of(const Dual& a) {
  return a.v;
}

inline Dual sqrt(const Dual& a) {
  const double root = std::sqrt(a.v);
  return chained(a, root, 0.5 / root);
}
inline Dual sin(const Dual& a) {
  return chained(a, std::sin(a.v), std::cos(a.v));
}
inline Dual cos(const Dual& a) {
  return chained(a, std::cos(a.v), -std::sin(a.v));
}
inline Dual log(const Dual& a) {
  return chained(a, std::log(a.v), 1.0 / a.v);
}
inline Dual atan2(const Dual& y, const Dual& x) {
  const double r2 = x.v * x.v + y.v * y.v;
  const double by_y = x.v / r2, by_x = -y.v / r2;
  return {std::atan2(y.v, x.v), by_y * y.dx + by_x * x.dx, by_y * y.dy + by_x * x.dy};
}

inline double sqrt(double a) {
  return std::sqrt(a);
}

/// `a` where `condition` holds, else `b`: without a branch, so that loops over batches stay loops.
constexpr double select(bool condition, double a, double b) {
  return condition ? a : b;
}
constexpr Dual select(bool condition, const Dual& a, const Dual& b) {
  return {condition ? a.v : b.v, condition ? a.dx : b.dx, condition ? a.dy : b.dy};
}

/// A vector of numbers of either kind.
template <class Number>
using Vector = Imath::Vec3<Number>;
using DualVec3 = Vector<Dual>;

/// A vector that does not depend on the film position, as numbers of either kind.
template <class Number>
LENSPLANE_ALWAYS_INLINE inline Vector<Number> constant(const Imath::V3d& v) {
  return {Number(v.x), Number(v.y), Number(v.z)};
}

inline Imath::V3d value_of(const DualVec3& a) {
  return {a.x.v, a.y.v, a.z.v};
}
inline const Imath::V3d& value_of(const Imath::V3d& a) {
  return a;
}

/// The length of a vector; unlike a root of a sum of squares it neither overflows nor underflows. Its
/// derivatives at zero are zero.
inline double length(const Imath::V3d& a) {
  return std::hypot(a.x, a.y, a.z);
}
inline Dual length(const DualVec3& a) {
  const double l = std::hypot(a.x.v, a.y.v, a.z.v);
  if (l == 0.0) return 0.0;
  const Imath::V3d u = value_of(a) / l;
  return {l, u.x * a.x.dx + u.y * a.y.dx + u.z * a.z.dx, u.x * a.x.dy + u.y * a.y.dy + u.z * a.z.dy};
}

/// `a` with derivatives `by_x` and `by_y`.
inline DualVec3 dual_vector(const Imath::V3d& a, const Imath::V3d& by_x, const Imath::V3d& by_y) {
  return {Dual(a.x, by_x.x, by_y.x), Dual(a.y, by_x.y, by_y.y), Dual(a.z, by_x.z, by_y.z)};
}
inline Imath::V3d derivative_by_x(const DualVec3& a) {
  return {a.x.dx, a.y.dx, a.z.dx};
}
inline Imath::V3d derivative_by_y(const DualVec3& a) {
  return {a.x.dy, a.y.dy, a.z.dy};
}

}  // namespace lensplane
