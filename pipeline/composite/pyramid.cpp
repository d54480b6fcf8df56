// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/pyramid.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "pipeline/composite/cubic_spline.h"
#include "src/batch.h"

namespace lensplane {
namespace {

/// A coarse texel's weights of the finer level's texels along one axis, from `first` on; they sum up to 1.
struct Taps {
  int first = 0;
  std::vector<float> weights;
};

/// Along one axis: where a coarse level's texels are stored, and what each is made of.
struct Reduction {
  int display = 0;         // texels of the coarse display window
  int x = 0;               // the first that is stored
  std::vector<Taps> taps;  // for each that is stored
};

Taps taps_of(double centre, double ratio) {
  Taps taps{static_cast<int>(std::ceil(centre - 2 * ratio)), {}};
  double sum = 0;
  for (int i = taps.first; i <= centre + 2 * ratio; ++i) sum += cubic_spline((i - centre) / ratio);
  for (int i = taps.first; i <= centre + 2 * ratio; ++i) {
    taps.weights.push_back(static_cast<float>(cubic_spline((i - centre) / ratio) / sum));
  }
  return taps;
}

/// Halves an axis of `display` texels of which [x, x + stored) are stored. The spline carries light two
/// texels beyond these; where the picture begins anew at its edges it has no beyond.
Reduction halve(int display, int x, int stored, Wrap wrap) {
  if (display == 1) {  // a single texel stays
    Reduction same{1, x, {}};
    for (int i = x; i < x + stored; ++i) same.taps.push_back({i, {1.0F}});
    return same;
  }
  Reduction reduction{std::max(1, display / 2), 0, {}};
  const double ratio = static_cast<double>(display) / reduction.display;
  int begin = static_cast<int>(std::floor(x / ratio)) - 2;
  int end = static_cast<int>(std::ceil((x + stored) / ratio)) + 2;
  if (wrap != Wrap::Black && wrap != Wrap::Clamp) {
    if (x >= 0) begin = std::max(begin, 0);
    if (x + stored <= display) end = std::min(end, reduction.display);
  }
  reduction.x = begin;
  for (int i = begin; i < end; ++i) reduction.taps.push_back(taps_of((i + 0.5) * ratio - 0.5, ratio));
  return reduction;
}

Rgba texel(const Picture& picture, Wrap wrap, int column, int row) {
  const TexelPlace place = place_of(picture, wrap, column, row);
  return place.count > 0 ? picture.at(place.column - picture.x, place.row - picture.y) : Rgba{0, 0, 0, 0};
}

/// Adds `weight` times each of `count` texels to another.
LENSPLANE_KERNEL void add_texels(const Rgba* texels, float weight, int count, Rgba* sums) {
  const float* from = texels->data();
  float* to = sums->data();
#pragma GCC ivdep
  for (int i = 0; i < 4 * count; ++i) to[i] += weight * from[i];
}

/// Adds `weight` times the texels of a row, stored or not, to sums that begin at `column`.
void add_row(const Picture& fine, Wrap wrap, int column, int row, float weight, std::vector<Rgba>& sums) {
  const int end = column + static_cast<int>(sums.size());
  const bool is_stored = row >= fine.y && row < fine.y + fine.height;
  const int first = is_stored ? std::clamp(fine.x, column, end) : end;
  const int last = is_stored ? std::clamp(fine.x + fine.width, first, end) : end;
  const auto sum = [&](int i) { return &sums[static_cast<std::size_t>(i - column)]; };
  const auto add_texel = [&](int i) {
    const Rgba one = texel(fine, wrap, i, row);
    add_texels(&one, weight, 1, sum(i));
  };
  for (int i = column; i < first; ++i) add_texel(i);
  if (last > first) add_texels(&fine.at(first - fine.x, row - fine.y), weight, last - first, sum(first));
  for (int i = last; i < end; ++i) add_texel(i);
}

Rgba weighed(const Rgba* texels, const std::vector<float>& weights) {
  Rgba sum{0, 0, 0, 0};
  for (std::size_t i = 0; i < weights.size(); ++i) {
    for (std::size_t c = 0; c < 4; ++c) sum[c] += weights[i] * texels[i][c];
  }
  return sum;
}

void for_each_row(const Picture& picture, auto work) {
  tbb::parallel_for(tbb::blocked_range<int>(0, picture.height), [&](const tbb::blocked_range<int>& rows) {
    for (int row = rows.begin(); row != rows.end(); ++row) work(row);
  });
}

/// Rows first, into a buffer of one row: what lies between the two steps never leaves the processor's cache.
Picture halved(const Picture& fine, Wrap wrap) {
  const Reduction columns = halve(fine.display_width, fine.x, fine.width, wrap);
  const Reduction rows = halve(fine.display_height, fine.y, fine.height, wrap);
  Picture coarse{static_cast<int>(columns.taps.size()),
                 static_cast<int>(rows.taps.size()),
                 columns.x,
                 rows.x,
                 columns.display,
                 rows.display,
                 {}};
  coarse.pixels.resize(columns.taps.size() * rows.taps.size());
  const int first = columns.taps.front().first;
  const int end = columns.taps.back().first + static_cast<int>(columns.taps.back().weights.size());
  for_each_row(coarse, [&](int row) {
    std::vector<Rgba> sums(static_cast<std::size_t>(end - first), Rgba{0, 0, 0, 0});
    const Taps& taps = rows.taps[static_cast<std::size_t>(row)];
    for (std::size_t i = 0; i < taps.weights.size(); ++i) {
      add_row(fine, wrap, first, taps.first + static_cast<int>(i), taps.weights[i], sums);
    }
    for (int column = 0; column < coarse.width; ++column) {
      const Taps& across = columns.taps[static_cast<std::size_t>(column)];
      coarse.at(column, row) = weighed(&sums[static_cast<std::size_t>(across.first - first)], across.weights);
    }
  });
  return coarse;
}

/// The variance along an axis of a level that is half as long as the finer one, or as long when that is 1.
double coarser_variance(double variance, int fine, int coarse) {
  const double ratio = static_cast<double>(fine) / coarse;
  return fine == coarse ? variance : variance / (ratio * ratio) + kCubicSplineVariance;
}

void add_level(Pyramid& pyramid, Picture picture, double variance_x, double variance_y) {
  pyramid.pictures.push_back(std::move(picture));
  const Picture& kept = pyramid.pictures.back();
  pyramid.levels.push_back({kept, variance_x, variance_y, kept.pixels.data()});
}

}  // namespace

Pyramid make_pyramid(Picture picture, Wrap wrap) {
  Pyramid pyramid;
  add_level(pyramid, std::move(picture), 0, 0);
  for (;;) {
    const Picture& fine = pyramid.pictures.back();
    if (fine.display_width <= 1 && fine.display_height <= 1) return pyramid;
    Picture coarse = halved(fine, wrap);
    const TexelLevel& last = pyramid.levels.back();
    const double variance_x = coarser_variance(last.variance_x, fine.display_width, coarse.display_width);
    const double variance_y = coarser_variance(last.variance_y, fine.display_height, coarse.display_height);
    add_level(pyramid, std::move(coarse), variance_x, variance_y);
  }
}

}  // namespace lensplane
