// SPDX-License-Identifier: Apache-2.0
//
// Company: what several masses do to light together, to second order, without a step of its own along the
// ray.
//
// Two masses bend light by more than the sum of what each does alone, by terms of the order of m1 m2 over
// distances squared. Nearly all of that is two things:
//
// - Light does not come to a mass along its asymptote, from which the impact parameter is measured: the other
//   masses have pulled it aside by up to twice their geometric masses (finite_shift.h). The mass stands by as
//   much on the other side of the asymptote. The pull is taken for the light that meets the mass itself.
// - A mass in the potential of another bends more: near it by 1 + (7/4) m2/s, s being their distance. From
// afar
//   both are one body, whose bend has the cross term (15 pi/2) m1 m2/b^2. In between
//
//     alpha = law(b) (1 + sum of (7/4) m_j/sqrt(s_j^2 + c b^2)),    c = (28/(15 pi))^2,
//
//   which has both limits; the sum is taken as one term of the same value and curvature at b = 0.
//
// 7/4: n^2/2 = 1/2 + 4 S + 15 S^2, so that S_2 = m2/(2 s) makes the pull of the mass 1 + (15/4) m2/s of
// itself, while light that runs by 1 + 2 m2/s faster is exposed to it for so much less.

#pragma once

#include <cstddef>
#include <numbers>

#include "src/dual.h"
#include "src/inlining.h"

namespace lensplane {

/// The other masses as one mass feels them.
struct Company {
  double weight = 0;   // (7/4) mu, metres; 0 for a mass alone
  double spread2 = 1;  // sigma^2, square metres: the bend grows by weight/sqrt(sigma^2 + c b^2)
  double aside = 0;    // metres by which the mass has been moved against the light's asymptote

  friend bool operator==(const Company&, const Company&) = default;
};

/// How much of m_j/s_j the bend of a mass grows near it.
inline constexpr double kCompanyGain = 7.0 / 4.0;

/// How soon that falls off with b.
inline constexpr double kCompanyReach =
    (28.0 / (15.0 * std::numbers::pi)) * (28.0 / (15.0 * std::numbers::pi));

/// What two masses do together is at most so much of the sizes of both masses' company_bend(), added up; and
/// company leaves at most so much of it out.
inline constexpr double kCompanySize = 1.2;
inline constexpr double kCompanyError = 0.35;

/// More masses than this are not looked at in pairs: what they do together is left out.
inline constexpr std::size_t kMostInCompany = 10000;

/// Share of its bend that a mass gains by its company, for light with impact parameter sqrt(b2).
template <class Number>
LENSPLANE_ALWAYS_INLINE inline Number gain_in(const Company& company, const Number& b2) {
  return company.weight * reciprocal(sqrt(company.spread2 + kCompanyReach * b2));
}

/// How much the company of a mass changes its bend at b, at most: what it gains, and what its being moved
/// does. Radians; falls with b.
double company_bend(double m, const Company& company, double b);

struct Deflectors;

/// The same deflectors in one another's company. Runs in parallel.
Deflectors in_company(const Deflectors& deflectors);

}  // namespace lensplane
