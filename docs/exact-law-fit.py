#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Prints the coefficients in src/exact_law.h, and how far each fit is from the exact angle.

Needs mpmath (Debian: python3-mpmath). Takes a few minutes.

The exact angle is Darwin's closed form in elliptic integrals, as a function of x = b_c/b. It grows like -ln(1 - x)
towards x = 1, so polynomials A and B with alpha = x A(x) - B(x) ln(1 - x) follow it from 0 to 1, and one polynomial F
with alpha = x F(x) is enough well below 1. What the angle is more than the weak law, integrated from b to infinity, is
b_c g(x), g(x) = x A'(x) - B'(x) (1 - x) ln(1 - x). Each fit minimises the sum of the squares of the relative errors at the nodes
of a Chebyshev polynomial, which comes within a small factor of the smallest possible worst error; the errors printed
are the worst ones on another, finer grid that runs to 1 - x = 1e-16.
"""

from functools import cache

from mpmath import acos, asin, cos, ellipf, ellipk, factorial, gamma, log, lu_solve, matrix, mp, mpf, nstr, pi, quad, sqrt

mp.dps = 70  # powers of x are a poor basis: solving for their coefficients costs some 40 digits


@cache
def alpha(x):
    """Darwin (1959), for m = 1 and b = 3 sqrt(3)/x."""
    b = 3 * sqrt(mpf(3)) / x
    p = 2 * b / sqrt(mpf(3)) * cos(acos(-x) / 3)  # closest approach
    q = sqrt((p - 2) * (p + 6))
    k2 = (q - p + 6) / (2 * q)
    z = asin(sqrt((q - p + 2) / (q - p + 6)))
    return 4 * sqrt(p / q) * (ellipk(k2) - ellipf(z, k2)) - pi


def nodes(count, end):
    """The zeros of a Chebyshev polynomial, between 0 and end."""
    return [end * (1 - cos(pi * (2 * i + 1) / (2 * count))) / 2 for i in range(count)]


def fit(basis, target, points, grid):
    """The coefficients with which the sum of the basis follows target(x), and the worst error relative to alpha(x)."""
    rows = [[value / alpha(x) for value in basis(x)] for x in points]
    coefficients = list(lu_solve(matrix(rows), matrix([target(x) / alpha(x) for x in points])))

    def error(x):
        return abs(sum(c * v for c, v in zip(coefficients, basis(x))) - target(x)) / alpha(x)

    return coefficients, max(error(x) for x in grid)


def fit_near(terms):
    """A and B in powers of x - 1/2: in powers of x a digit would be lost to cancellation at x = 1."""

    def basis(x):
        powers = [(x - mpf(1) / 2) ** j for j in range(terms)]
        return [x * p for p in powers] + [-log(1 - x) * p for p in powers]

    ends = [mpf(10) ** (-mpf(i) / 10) for i in range(4, 161)]
    grid = ends + [1 - u for u in ends] + [(i + mpf(1) / 3) / 400 for i in range(400)]
    c, error = fit(basis, alpha, nodes(120, mpf(1)), grid)
    return c[:terms], c[terms:], error


def fit_far(percent, terms):
    """F in powers of x up to percent/100. Its first coefficient is exact: at infinity the weak law is met."""
    end = mpf(percent) / 100
    first = 4 / (3 * sqrt(mpf(3)))

    def basis(x):
        return [x ** (j + 1) for j in range(1, terms)]

    c, error = fit(basis, lambda x: alpha(x) - first * x, nodes(60, end), [end * i / 300 for i in range(1, 301)])
    return [first] + c, error


@cache
def excess_beyond(x):
    """g(x): up to the middle by the series of alpha, then by quadrature."""
    critical_ratio, half = 3 * sqrt(mpf(3)), mpf(1) / 2
    if x > half:
        return excess_beyond(half) + quad(lambda y: (alpha(y) - 4 * y / critical_ratio) / y**2, [half, (half + x) / 2, x])
    total, n = mpf(0), 2
    while True:
        a = sqrt(pi) * mpf(2) ** n * gamma((3 * n + 1) / mpf(2)) / (factorial(n) * gamma(n / mpf(2) + 1))
        term = a / critical_ratio**n * x ** (n - 1) / (n - 1)
        total, n = total + term, n + 1
        if term < mpf(10) ** -45:
            return total


def fit_delay(terms):
    """A' and B' in powers of x - 1/2, and the worst error over x."""

    def basis(x):
        powers = [(x - mpf(1) / 2) ** j for j in range(terms)]
        return [x * p for p in powers] + [-(1 - x) * log(1 - x) * p for p in powers]

    points = nodes(64, mpf(1))
    rows = [[value / x for value in basis(x)] for x in points]
    c = list(lu_solve(matrix(rows), matrix([excess_beyond(x) / x for x in points])))
    grid = [(i + mpf(1) / 3) / 60 for i in range(60)] + [1 - mpf(10) ** (-mpf(i) / 2) for i in range(2, 30)]
    error = max(abs(sum(k * v for k, v in zip(c, basis(x))) - excess_beyond(x)) / x for x in grid)
    return c[:terms], c[terms:], error


def show(name, coefficients):
    print(f"{name} = {{" + ", ".join(repr(float(c)) for c in coefficients) + "};")


if __name__ == "__main__":
    a, b, error = fit_near(12)
    print(f"// near: worst relative error {nstr(error, 2)}")
    show("kNearA", a)
    show("kNearB", b)
    far, error = fit_far(15, 11)
    print(f"// far: worst relative error {nstr(error, 2)}")
    show("kFar", far)
    a, b, error = fit_delay(10)
    print(f"// delay: worst error {nstr(error, 2)} x")
    show("kDelayA", a)
    show("kDelayB", b)
    critical_ratio = 3 * sqrt(mpf(3))
    print(f"kRest = {float(critical_ratio - mpf(float(critical_ratio)))!r};")
    for percent in (5, 15, 25):
        for terms in range(7, 14, 2):
            print(f"// F up to x = {percent} %, {terms} terms: {nstr(fit_far(percent, terms)[1], 2)}")
