// SPDX-License-Identifier: Apache-2.0

#include "src/line_batch.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace lensplane {
namespace {

/// With Dual numbers the derivatives are written out: half of the operations that the rules would take.
template <class Number>
LENSPLANE_KERNEL void start_perspective(const Camera& camera, double slope, const BatchArray& x,
                                        const BatchArray& y, LineBatch<Number>& rays) {
  const double centre_x = camera.width / 2.0;
  const double centre_y = camera.height / 2.0;
#pragma GCC ivdep
  for (int i = 0; i < kBatchSize; ++i) {
    const double right = (x[i] - centre_x) * slope;
    const double up = (centre_y - y[i]) * slope;
    const double scale = 1.0 / std::sqrt(right * right + up * up + 1.0);
    if constexpr (std::is_same_v<Number, Dual>) {
      const double steep = slope * scale, steeper = steep * scale * scale;
      const double twist = steeper * right * up;
      rays.direction.set(i, {Dual(right * scale, steep - steeper * right * right, twist),
                             Dual(up * scale, -twist, steeper * up * up - steep),
                             Dual(-scale, steeper * right, -steeper * up)});
    } else {
      rays.direction.set(i, {right * scale, up * scale, -scale});
    }
    rays.start.set(i, {Number(0.0), Number(0.0), Number(0.0)});
    rays.irregular[i] = 0.0;
    rays.captured[i] = 0.0;
  }
}

template <class Number>
void start_panorama(const Camera& camera, const BatchArray& x, const BatchArray& y, LineBatch<Number>& rays) {
  for (int i = 0; i < kBatchSize; ++i) {
    rays.direction.set(i, direction_from_film<Number>(camera, {x[i], y[i]}));
    rays.first.set(i, value_of(rays.direction.get(i)));
    rays.start.set(i, {Number(0.0), Number(0.0), Number(0.0)});
    rays.irregular[i] = 0.0;
    rays.captured[i] = 0.0;
  }
}

}  // namespace

void clear_excess(ExcessLane& excess) {
  for (int i = 0; i < kBatchSize; ++i) excess.set(i, PathExcess{});
}

template <class Number>
void start_lines(const Camera& camera, double slope, const BatchArray& x, const BatchArray& y, bool measured,
                 LineBatch<Number>& rays) {
  if (measured) {
    std::fill_n(rays.path.v, kBatchSize, 0.0);
    std::fill_n(rays.shapiro.v, kBatchSize, 0.0);
  }
  if (camera.projection == Projection::Perspective) {
    start_perspective(camera, slope, x, y, rays);
  } else {
    start_panorama(camera, x, y, rays);
  }
}

template void start_lines(const Camera&, double, const BatchArray&, const BatchArray&, bool,
                          LineBatch<double>&);
template void start_lines(const Camera&, double, const BatchArray&, const BatchArray&, bool,
                          LineBatch<Dual>&);

}  // namespace lensplane
