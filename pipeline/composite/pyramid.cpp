// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/pyramid.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "pipeline/composite/cubic_spline.h"

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

void add(Rgba& sum, float weight, const Rgba& texel) {
  for (std::size_t c = 0; c < 4; ++c) sum[c] += weight * texel[c];
}

void for_each_row(const Picture& picture, auto work) {
  tbb::parallel_for(tbb::blocked_range<int>(0, picture.height), [&](const tbb::blocked_range<int>& rows) {
    for (int row = rows.begin(); row != rows.end(); ++row) work(row);
  });
}

Picture narrowed(const Picture& fine, Wrap wrap) {
  const Reduction columns = halve(fine.display_width, fine.x, fine.width, wrap);
  Picture coarse{static_cast<int>(columns.taps.size()),
                 fine.height,
                 columns.x,
                 fine.y,
                 columns.display,
                 fine.display_height,
                 {}};
  coarse.pixels.resize(columns.taps.size() * static_cast<std::size_t>(coarse.height));
  for_each_row(coarse, [&](int row) {
    for (int column = 0; column < coarse.width; ++column) {
      const Taps& taps = columns.taps[static_cast<std::size_t>(column)];
      const auto count = static_cast<int>(taps.weights.size());
      const bool inside = taps.first >= fine.x && taps.first + count <= fine.x + fine.width;
      const Rgba* stored = inside ? &fine.at(taps.first - fine.x, row) : nullptr;
      Rgba sum{0, 0, 0, 0};
      for (int i = 0; i < count; ++i) {
        add(sum, taps.weights[static_cast<std::size_t>(i)],
            stored ? stored[i] : texel(fine, wrap, taps.first + i, row + fine.y));
      }
      coarse.at(column, row) = sum;
    }
  });
  return coarse;
}

Picture lowered(const Picture& fine, Wrap wrap) {
  const Reduction rows = halve(fine.display_height, fine.y, fine.height, wrap);
  Picture coarse{
      fine.width, static_cast<int>(rows.taps.size()), fine.x, rows.x, fine.display_width, rows.display, {}};
  coarse.pixels.resize(static_cast<std::size_t>(coarse.width) * rows.taps.size(), Rgba{0, 0, 0, 0});
  for_each_row(coarse, [&](int row) {
    const Taps& taps = rows.taps[static_cast<std::size_t>(row)];
    for (std::size_t i = 0; i < taps.weights.size(); ++i) {
      const int from = taps.first + static_cast<int>(i);
      const bool inside = from >= fine.y && from < fine.y + fine.height;
      for (int column = 0; column < coarse.width; ++column) {
        add(coarse.at(column, row), taps.weights[i],
            inside ? fine.at(column, from - fine.y) : texel(fine, wrap, column + fine.x, from));
      }
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
    Picture coarse = fine.display_width > 1 ? narrowed(fine, wrap) : fine;
    if (coarse.display_height > 1) coarse = lowered(coarse, wrap);
    const TexelLevel& last = pyramid.levels.back();
    const double variance_x = coarser_variance(last.variance_x, fine.display_width, coarse.display_width);
    const double variance_y = coarser_variance(last.variance_y, fine.display_height, coarse.display_height);
    add_level(pyramid, std::move(coarse), variance_x, variance_y);
  }
}

}  // namespace lensplane
