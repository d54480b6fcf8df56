// SPDX-License-Identifier: Apache-2.0
//
// The normal distribution, for places and weights under the Gaussian pixel filter. In standard deviations.

#pragma once

#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <numbers>

namespace lensplane {

/// The share of it below x; x may be infinite.
inline double normal_share(double x) {
  return 0.5 * std::erfc(-x / std::numbers::sqrt2);
}

/// Where that is `share`, which lies between 0 and 1.
inline double normal_quantile(double share) {
  return std::numbers::sqrt2 * boost::math::erf_inv(2.0 * share - 1.0);
}

}  // namespace lensplane
