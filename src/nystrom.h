// SPDX-License-Identifier: Apache-2.0
//
// The Runge-Kutta-Nystroem formula RKN8(6)9FM for x'' = f(x), of order 8 with an embedded one of order 6.
//
// J. R. Dormand, M. E. A. El-Mikkawy, P. J. Prince, "High-order embedded Runge-Kutta-Nystroem formulae",
// IMA Journal of Numerical Analysis 7 (1987), 423-430. Where the force depends on the position alone, it
// needs 8 forces per step, against 12 or 13 for general formulae of that order: stage i stands at
//
//   X_i = x + c_i h v + h^2 sum_j a_ij f_j,
//
// and x' = x + h v + h^2 sum_i a_8i f_i, v' = v + h sum_i b_i f_i. The last stage is the first of the next
// step. The weights b integrate any function of the position along the path to order 8, too.

#pragma once

#include <array>

namespace lensplane {

inline constexpr int kNystromStages = 9;

using NystromWeights = std::array<double, kNystromStages>;

inline constexpr NystromWeights kNystromNodes = {0.0, 0.05, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0, 1.0};  // c

inline constexpr std::array<NystromWeights, kNystromStages> kNystromMatrix = {{
    // a
    {},
    {1. / 800},
    {1. / 600, 1. / 300},
    {9. / 200, -9. / 100, 9. / 100},
    {-66701. / 197352, 28325. / 32892, -2665. / 5482, 2170. / 24669},
    {227015747. / 304251000, -54897451. / 30425100, 12942349. / 10141700, -9499. / 304251, 539. / 9250},
    {-1131891597. / 901789000, 41964921. / 12882700, -6663147. / 3220675, 270954. / 644135, -108. / 5875,
     114. / 1645},
    {13836959. / 3667458, -17731450. / 1833729, 1063919505. / 156478208, -33213845. / 39119552,
     13335. / 28544, -705. / 14272, 1645. / 57088},
    {223. / 7938, 0, 1175. / 8064, 925. / 6048, 41. / 448, 925. / 14112, 1175. / 72576},
}};

inline constexpr NystromWeights kNystromVelocity = {  // b, order 8
    223. / 7938, 0, 5875. / 36288, 4625. / 21168, 41. / 224, 4625. / 21168, 5875. / 36288, 223. / 7938, 0};

/// What the formula of order 6 has in place of the last line of a and of b.
inline constexpr NystromWeights kNystromPosition6 = {7987313. / 109941300, 0,
                                                     1610737. / 44674560,  10023263. / 33505920,
                                                     -497221. / 12409600,  10023263. / 78180480,
                                                     1610737. / 402071040};
inline constexpr NystromWeights kNystromVelocity6 = {7987313. / 109941300,
                                                     0,
                                                     1610737. / 40207104,
                                                     10023263. / 23454144,
                                                     -497221. / 6204800,
                                                     10023263. / 23454144,
                                                     1610737. / 40207104,
                                                     -4251941. / 54970650,
                                                     3. / 20};

constexpr NystromWeights difference(const NystromWeights& a, const NystromWeights& b) {
  NystromWeights result{};
  for (int i = 0; i < kNystromStages; ++i) result[i] = a[i] - b[i];
  return result;
}

/// Weights of the difference between both formulae: their error estimate.
inline constexpr NystromWeights kNystromPositionError = difference(kNystromMatrix.back(), kNystromPosition6);
inline constexpr NystromWeights kNystromVelocityError = difference(kNystromVelocity, kNystromVelocity6);

}  // namespace lensplane
