// SPDX-License-Identifier: Apache-2.0

#include "src/nystrom.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lensplane {
namespace {

double moment(const NystromWeights& weights, int power) {
  double sum = 0.0;
  for (int i = 0; i < kNystromStages; ++i) sum += weights[i] * std::pow(kNystromNodes[i], power);
  return sum;
}

TEST(Nystrom, WeightsIntegratePolynomialsUpToTheirOrder) {
  for (int k = 0; k < 8; ++k) EXPECT_NEAR(moment(kNystromVelocity, k), 1.0 / (k + 1), 1e-15) << k;
  for (int k = 0; k < 7; ++k) {
    EXPECT_NEAR(moment(kNystromMatrix.back(), k), 1.0 / ((k + 1) * (k + 2)), 1e-15) << k;
  }
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(moment(kNystromVelocity6, k), 1.0 / (k + 1), 1e-15) << k;
  for (int k = 0; k < 5; ++k)
    EXPECT_NEAR(moment(kNystromPosition6, k), 1.0 / ((k + 1) * (k + 2)), 1e-15) << k;
  EXPECT_GT(std::abs(moment(kNystromVelocity6, 6) - 1.0 / 7), 1e-6);  // of order 6, not more
}

TEST(Nystrom, StagesStandAtTheirNodes) {
  for (int i = 2; i < kNystromStages; ++i) {
    for (int k = 0; k < 3; ++k) {
      const double exact = std::pow(kNystromNodes[i], k + 2) / ((k + 1) * (k + 2));
      EXPECT_NEAR(moment(kNystromMatrix[i], k), exact, 4e-15) << i;
    }
  }
}

/// x'' = -x^3 from x = 1 at rest to t = 1, in `steps` steps: x there.
double swing(int steps) {
  double x = 1.0, v = 0.0;
  const double h = 1.0 / steps;
  for (int n = 0; n < steps; ++n) {
    NystromWeights force{};
    double dv = 0.0, shift = 0.0;
    for (int i = 0; i < kNystromStages; ++i) {
      shift = 0.0;
      for (int j = 0; j < i; ++j) shift += kNystromMatrix[i][j] * force[j];
      const double stage = x + kNystromNodes[i] * h * v + h * h * shift;
      force[i] = -stage * stage * stage;
      dv += kNystromVelocity[i] * force[i];
    }
    x += h * v + h * h * shift;
    v += h * dv;
  }
  return x;
}

TEST(Nystrom, IsOfOrderEight) {
  // x is a Jacobian elliptic function: cn(t | 1/2).
  const double exact = 0.5959765676721407;
  EXPECT_NEAR(swing(64), exact, 1e-15);
  EXPECT_NEAR(std::log2(std::abs(swing(2) - exact) / std::abs(swing(4) - exact)), 8.0, 1.0);
}

}  // namespace
}  // namespace lensplane
