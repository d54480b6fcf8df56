// SPDX-License-Identifier: Apache-2.0

#include "src/line_batch.h"

#include <cmath>
#include <cstring>
#include <type_traits>

namespace lensplane {
namespace {

template <class Number>
LENSPLANE_KERNEL void start_perspective(const Camera& camera, const BatchArray& x, const BatchArray& y,
                                        LineBatch<Number>& rays) {
  const double slope = slope_per_pixel(camera);
  const double centre_x = camera.width / 2.0;
  const double centre_y = camera.height / 2.0;
#pragma GCC ivdep
  for (int i = 0; i < kBatchSize; ++i) {
    const double right = (x[i] - centre_x) * slope;
    const double up = (centre_y - y[i]) * slope;
    Number dual_right = right;
    Number dual_up = up;
    if constexpr (std::is_same_v<Number, Dual>) {
      dual_right.dx = slope;
      dual_up.dy = -slope;
    }
    const Number scale = reciprocal(sqrt(dual_right * dual_right + dual_up * dual_up + Number(1.0)));
    rays.direction.set(i, {dual_right * scale, dual_up * scale, -scale});
  }
}

template <class Number>
void start_panorama(const Camera& camera, const BatchArray& x, const BatchArray& y, LineBatch<Number>& rays) {
  for (int i = 0; i < kBatchSize; ++i) {
    rays.direction.set(i, direction_from_film<Number>(camera, {x[i], y[i]}));
    rays.first.set(i, value_of(rays.direction.get(i)));
  }
}

}  // namespace

template <class Number>
void start_lines(const Camera& camera, const BatchArray& x, const BatchArray& y, LineBatch<Number>& rays) {
  // All of it numbers: no bit set is zero.
  std::memset(&rays.start, 0, sizeof rays.start);
  std::memset(&rays.path, 0, sizeof rays.path);
  std::memset(&rays.shapiro, 0, sizeof rays.shapiro);
  std::memset(rays.irregular, 0, sizeof rays.irregular);
  std::memset(rays.captured, 0, sizeof rays.captured);
  if (camera.projection == Projection::Perspective) {
    start_perspective(camera, x, y, rays);
  } else {
    start_panorama(camera, x, y, rays);
  }
}

template void start_lines(const Camera&, const BatchArray&, const BatchArray&, LineBatch<double>&);
template void start_lines(const Camera&, const BatchArray&, const BatchArray&, LineBatch<Dual>&);

}  // namespace lensplane
