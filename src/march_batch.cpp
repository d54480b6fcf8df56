// SPDX-License-Identifier: Apache-2.0

#include "src/march_batch.h"

#include <cmath>
#include <limits>

#include "src/deflection.h"
#include "src/inlining.h"

namespace lensplane {
namespace {

// Taylor series in q = a^2, whose remainders are below 1e-16 for a <= kBatchAlpha = 0.5. Horner's form.

/// sin(a)/a
LENSPLANE_ALWAYS_INLINE inline double sine_ratio(double q) {
  double sum = 1.0 / 6227020800.0;   // 1/13!
  sum = sum * q - 1.0 / 39916800.0;  // 1/11!
  sum = sum * q + 1.0 / 362880.0;    // 1/9!
  sum = sum * q - 1.0 / 5040.0;      // 1/7!
  sum = sum * q + 1.0 / 120.0;       // 1/5!
  sum = sum * q - 1.0 / 6.0;         // 1/3!
  return sum * q + 1.0;
}

/// cos(a)
LENSPLANE_ALWAYS_INLINE inline double cosine(double q) {
  double sum = -1.0 / 87178291200.0;  // 1/14!
  sum = sum * q + 1.0 / 479001600.0;  // 1/12!
  sum = sum * q - 1.0 / 3628800.0;    // 1/10!
  sum = sum * q + 1.0 / 40320.0;      // 1/8!
  sum = sum * q - 1.0 / 720.0;        // 1/6!
  sum = sum * q + 1.0 / 24.0;         // 1/4!
  sum = sum * q - 0.5;
  return sum * q + 1.0;
}

}  // namespace

LENSPLANE_KERNEL
void advance_rays(double distance, LineBatch<double>& rays) {
#pragma GCC ivdep
  for (int i = 0; i < kBatchSize; ++i) {
    const double length = (-distance - rays.start.z.v[i]) / rays.direction.z.v[i];
    rays.start.x.v[i] += rays.direction.x.v[i] * length;
    rays.start.y.v[i] += rays.direction.y.v[i] * length;
    rays.start.z.v[i] = -distance;
    rays.path.v[i] += length;
  }
}

LENSPLANE_KERNEL
void bend_rays(const Source& source, LineBatch<double>& rays) {
  const double m4 = weak_deflection(source.m, 1.0);
  const double m4_squared = m4 * m4;
  const double smallest_b2 = m4_squared / (kBatchAlpha * kBatchAlpha);
#pragma GCC ivdep
  for (int i = 0; i < kBatchSize; ++i) {
    const double vx = rays.direction.x.v[i], vy = rays.direction.y.v[i], vz = rays.direction.z.v[i];
    const double to_x = source.position.x - rays.start.x.v[i];
    const double to_y = source.position.y - rays.start.y.v[i];
    // The part of P_g - Q across the ray: V_rot of equation (3) times its length.
    const double along = to_x * vx + to_y * vy;
    const double across_x = to_x - along * vx;
    const double across_y = to_y - along * vy;
    const double across_z = -along * vz;
    const double across2 = across_x * across_x + across_y * across_y + across_z * across_z;
    const double b2 = to_x * to_x + to_y * to_y;
    // cos(alpha) and sin(alpha)/|across| from alpha^2 = (4m)^2/b^2, with one root and one division, which are
    // what this loop waits for: product = 1/(b^2 |b across|).
    const double b_across = std::sqrt(b2 * across2);
    const double product = 1.0 / (b2 * b_across);
    const double alpha2 = m4_squared * (product * b_across);
    const double cos_alpha = cosine(alpha2);
    const double sin_alpha = m4 * sine_ratio(alpha2) * (product * b2);
    const double new_z = cos_alpha * vz + sin_alpha * across_z;
    rays.direction.x.v[i] = cos_alpha * vx + sin_alpha * across_x;
    rays.direction.y.v[i] = cos_alpha * vy + sin_alpha * across_y;
    rays.direction.z.v[i] = new_z;
    // Written so that whatever over- or underflows, or is a NaN, is irregular, too.
    const bool regular = (b2 >= smallest_b2) & (product > 0.0) &
                         (product < std::numeric_limits<double>::max()) & (new_z < 0.0);
    rays.irregular[i] = regular ? rays.irregular[i] : 1.0;
  }
}

}  // namespace lensplane
