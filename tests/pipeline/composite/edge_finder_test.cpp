// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/edge_finder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <set>

namespace lensplane {
namespace {

constexpr int kWidth = 8, kHeight = 6;

/// Of the pixels that surround the rectangle not all edges are found.
using Pixels = std::set<std::pair<int, int>>;

/// What the surface number k of a pixel is seen as.
using See = std::function<SeenPoint(int column, int row, std::size_t k)>;

/// The pixels of some kind or of those that need more.
Pixels edges_of(const std::vector<Surface>& surfaces, const See& see, PixelKind least = PixelKind::Curved) {
  CentreGrid grid(surfaces, kWidth, kHeight);
  for (int row = -1; row <= kHeight; ++row) {
    for (int column = -1; column <= kWidth; ++column) {
      for (std::size_t k = 0; k < surfaces.size(); ++k) {
        grid.points(grid.place(column, row))[k] = see(column, row, k);
      }
    }
  }
  const std::vector<PixelKind> kinds = grid.kinds();
  Pixels found;
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      if (kinds[grid.place(column, row)] >= least) found.insert({column, row});
    }
  }
  return found;
}

/// All pixels of some columns.
Pixels columns(int first, int last) {
  Pixels pixels;
  for (int column = first; column <= last; ++column) {
    for (int row = 0; row < kHeight; ++row) pixels.insert({column, row});
  }
  return pixels;
}

constexpr double kStep = 0.01;  // of s and t from pixel to pixel

/// A plate that is seen as it is.
SeenPoint straight(int column, int row) {
  return {true, 1, {kStep * column, 1 - kStep * row}, {.ds_dx = kStep, .dt_dy = -kStep}};
}

/// A plate with s a function of the column alone.
SeenPoint bent(double s, double ds_dx, int row) {
  return {true, 1, {s, 1 - kStep * row}, {.ds_dx = ds_dx, .dt_dy = -kStep}};
}

const std::vector<Surface> kPlate = {Plate{}};

TEST(EdgeFinder, FindsNothingWhereThePictureIsSmooth) {
  EXPECT_EQ(edges_of(kPlate, [](int x, int y, std::size_t) { return straight(x, y); }), Pixels{});
  EXPECT_EQ(edges_of(kPlate, [](int, int, std::size_t) { return SeenPoint{}; }), Pixels{});
  // Second derivatives are what the neighbours' Jacobians tell.
  EXPECT_EQ(edges_of(kPlate, [](int x, int y,
                                std::size_t) { return bent(0.1 * (x + 9) * (x + 9), 0.2 * (x + 9), y); }),
            Pixels{});
  // One colour from one point, and mirrored all over.
  EXPECT_EQ(edges_of(kPlate,
                     [](int, int, std::size_t) {
                       return SeenPoint{true, 1, {0.5, 0.5}, {}};
                     }),
            Pixels{});
  EXPECT_EQ(edges_of(kPlate, [](int x, int y, std::size_t) { return bent(-kStep * x, -kStep, y); }),
            Pixels{});
}

TEST(EdgeFinder, FindsSilhouettesOnBothSides) {
  const auto until = [](int last) {
    return [last](int x, int y, std::size_t) { return x <= last ? straight(x, y) : SeenPoint{}; };
  };
  EXPECT_EQ(edges_of(kPlate, until(3)), columns(3, 4));
  EXPECT_EQ(edges_of(kPlate, until(3), PixelKind::Silhouette), columns(3, 4));
  EXPECT_EQ(edges_of(kPlate, until(-1)), columns(0, 0));
  EXPECT_EQ(edges_of(kPlate, until(kWidth - 1)), columns(kWidth - 1, kWidth - 1));
  const auto hole = [](int x, int y, std::size_t) { return x == 3 && y == 2 ? SeenPoint{} : straight(x, y); };
  Pixels around;
  for (const int x : {2, 3, 4}) {
    for (const int y : {1, 2, 3}) around.insert({x, y});
  }
  EXPECT_EQ(edges_of(kPlate, hole), around);
}

TEST(EdgeFinder, FindsFoldsByThePictureBeingMirrored) {
  // s = x^2 about the border of columns 3 and 4: the Jacobians put the neighbours where they are.
  const auto fold = [](int x, int y, std::size_t) {
    return bent(kStep * (x - 3.5) * (x - 3.5), 2 * kStep * (x - 3.5), y);
  };
  EXPECT_EQ(edges_of(kPlate, fold), columns(3, 4));
  EXPECT_EQ(edges_of(kPlate, fold, PixelKind::Silhouette), Pixels{});
}

TEST(EdgeFinder, FindsWhereTheOrderInDepthChanges) {
  const std::vector<Surface> two = {Card{1}, Card{2}};
  const auto crossing = [](int x, int y, std::size_t k) {
    SeenPoint point = straight(x, y);
    point.distance = k == 0 ? 10 + x : 13.5;  // crosses between columns 3 and 4
    return point;
  };
  EXPECT_EQ(edges_of(two, crossing), columns(3, 4));
  EXPECT_EQ(edges_of(two, crossing, PixelKind::Silhouette), columns(3, 4));
  const auto apart = [](int x, int y, std::size_t k) {
    SeenPoint point = straight(x, y);
    point.distance = k == 0 ? 10 + x : 100 - x;
    return point;
  };
  EXPECT_EQ(edges_of(two, apart), Pixels{});
  const auto at_infinity = [](int x, int y, std::size_t) {
    SeenPoint point = straight(x, y);
    point.distance = std::numeric_limits<double>::infinity();
    return point;
  };
  EXPECT_EQ(edges_of({Plate{}, Plate{}}, at_infinity), Pixels{});
}

TEST(EdgeFinder, FindsWhatIsMoreCurvedThanItsBound) {
  // s = a x + k x^3 is k/2 beside the mean of the Jacobians for every step; the way to the neighbour is the
  // shortest at x = 0, where the two steps of s and t are a long.
  const auto cubic = [](double k) {
    return [k](int column, int y, std::size_t) {
      const double x = column - 4;
      return bent(kStep * x + k * x * x * x, kStep + 3 * k * x * x, y);
    };
  };
  const double bound = 2 * kMostCurved * std::sqrt(2.0) * kStep;
  EXPECT_EQ(edges_of(kPlate, cubic(0.99 * bound)), Pixels{});
  EXPECT_EQ(edges_of(kPlate, cubic(1.01 * bound)), columns(3, 5));
}

TEST(EdgeFinder, GlobesHaveNoSeam) {
  const auto across_seam = [](int x, int y, std::size_t) {
    SeenPoint point = straight(x, y);
    point.st = {std::fmod(0.965 + kStep * x, 1.0), 0.6 - kStep * y};  // 0.995, 0.005 in columns 3 and 4
    return point;
  };
  EXPECT_EQ(edges_of({LatLong{}}, across_seam), Pixels{});
  EXPECT_EQ(edges_of({Sphere{}}, across_seam), Pixels{});
  EXPECT_EQ(edges_of(kPlate, across_seam), columns(3, 4));
}

TEST(EdgeFinder, MeasuresLongitudesByHowFarTheyLieApart) {
  // A jump of s by 2 thousandths, with a step of t from row to row: far on the equator, nothing near a pole.
  constexpr double kJump = 2e-3, kRow = 1e-5;
  const auto jump_at = [&](double from_pole) {
    return [=](int x, int y, std::size_t) {
      return SeenPoint{true, 1, {x > 3 ? 0.5 + kJump : 0.5, 1 - from_pole - kRow * y}, {.dt_dy = -kRow}};
    };
  };
  // Apart by 2 sin(pi t) kJump, of which kMostCurved kRow is allowed: up to 19.9 rows from the pole.
  EXPECT_EQ(edges_of({LatLong{}}, jump_at(0.5)), columns(3, 4));
  EXPECT_EQ(edges_of({LatLong{}}, jump_at(30 * kRow)), columns(3, 4));
  EXPECT_EQ(edges_of({LatLong{}}, jump_at(2 * kRow)), Pixels{});
  EXPECT_EQ(edges_of(kPlate, jump_at(2 * kRow)), columns(3, 4));
}

TEST(EdgeFinder, TakesWhatIsNoNumberForAnEdge) {
  const auto broken = [](int x, int y, std::size_t) {
    SeenPoint point = straight(x, y);
    if (x == 7) point.footprint.ds_dx = std::numeric_limits<double>::quiet_NaN();
    return point;
  };
  EXPECT_EQ(edges_of(kPlate, broken), columns(6, 7));
}

}  // namespace
}  // namespace lensplane
