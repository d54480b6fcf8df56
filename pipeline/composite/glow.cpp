// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/glow.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

namespace lensplane {
namespace {

using Rgb = std::array<float, 3>;

// Binomial kernels: one blurs, the other, between two rows of pixels, halves and doubles.
constexpr std::array<float, 13> kBlur = {1 / 4096.F,   12 / 4096.F,  66 / 4096.F,  220 / 4096.F, 495 / 4096.F,
                                         792 / 4096.F, 924 / 4096.F, 792 / 4096.F, 495 / 4096.F, 220 / 4096.F,
                                         66 / 4096.F,  12 / 4096.F,  1 / 4096.F};
constexpr double kBlurVariance = 3;
constexpr std::array<float, 4> kHalve = {1 / 8.F, 3 / 8.F, 3 / 8.F, 1 / 8.F};
constexpr double kHalveVariance = 0.75;

/// How light goes on beyond the pixels of a level: as the outermost have it, or, where the level is a whole
/// sphere in latitude and longitude, round it and over its poles.
enum class Beyond { Edge, Sphere };

/// Light of the picture at one of its sizes. The width of a sphere is even.
struct Level {
  int width = 0;
  int height = 0;
  int left = 0;  // of the first pixel, in pixels of this level from the picture's corner
  int top = 0;
  Beyond beyond = Beyond::Edge;
  std::vector<Rgb> pixels;

  Level(int width_, int height_, int left_, int top_, Beyond beyond_)
      : width(width_), height(height_), left(left_), top(top_), beyond(beyond_) {
    pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  }
  Rgb& at(int column, int row) {
    return pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(column)];
  }
  /// Column and row as `left` and `top` count them.
  const Rgb& value(int column, int row) const {
    int i = column - left, j = row - top;
    if (i < 0 || i >= width || j < 0 || j >= height) lead_back(i, j);
    return pixels[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(i)];
  }

 private:
  void lead_back(int& i, int& j) const {
    if (beyond == Beyond::Edge) {
      i = std::clamp(i, 0, width - 1);
      j = std::clamp(j, 0, height - 1);
      return;
    }
    const auto wrapped = [](int k, int period) { return (k % period + period) % period; };
    j = wrapped(j, 2 * height);
    const bool over_a_pole = j >= height;
    if (over_a_pole) j = 2 * height - 1 - j;
    i = wrapped(over_a_pole ? i + width / 2 : i, width);
  }
};

/// Fills a level, rows in parallel: `make(column, row)` as `left` and `top` count them.
template <class Make>
Level filled(Level level, Make make) {
  tbb::parallel_for(tbb::blocked_range<int>(0, level.height, 8), [&](const tbb::blocked_range<int>& rows) {
    for (int row = rows.begin(); row != rows.end(); ++row) {
      for (int column = 0; column < level.width; ++column)
        level.at(column, row) = make(column + level.left, row + level.top);
    }
  });
  return level;
}

void add_scaled(Rgb& sum, const Rgb& colour, float weight) {
  for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * colour[c];
}

/// What `kernel` makes of the pixels from (column, row) on, to the right or downward.
template <std::size_t count>
Rgb weighted(const Level& level, int column, int row, bool downward, const std::array<float, count>& kernel) {
  Rgb sum{0, 0, 0};
  for (std::size_t k = 0; k < count; ++k) {
    const int offset = static_cast<int>(k);
    add_scaled(sum, level.value(column + (downward ? 0 : offset), row + (downward ? offset : 0)), kernel[k]);
  }
  return sum;
}

int floor_half(int i) {
  return i >= 0 ? i / 2 : -((1 - i) / 2);
}

/// Half as wide and as high. Not of a sphere: as large as anything differs from what lies beyond.
Level halved(const Level& level) {
  if (level.beyond == Beyond::Sphere) {
    const Level narrow =
        filled(Level(level.width / 2, level.height, 0, 0, level.beyond),
               [&](int column, int row) { return weighted(level, 2 * column - 1, row, false, kHalve); });
    return filled(Level(narrow.width, level.height / 2, 0, 0, level.beyond),
                  [&](int column, int row) { return weighted(narrow, column, 2 * row - 1, true, kHalve); });
  }
  const int left = floor_half(level.left) - 1, right = floor_half(level.left + level.width) + 1;
  const int top = floor_half(level.top) - 1, bottom = floor_half(level.top + level.height) + 1;
  const Level narrow =
      filled(Level(right - left + 1, level.height, left, level.top, level.beyond),
             [&](int column, int row) { return weighted(level, 2 * column - 1, row, false, kHalve); });
  return filled(Level(narrow.width, bottom - top + 1, left, top, level.beyond),
                [&](int column, int row) { return weighted(narrow, column, 2 * row - 1, true, kHalve); });
}

/// What pixel `i` of a level takes from the next smaller one: kHalve backwards. From the pixel that it lies
/// in, and from that pixel's neighbour on its own side.
struct Upward {
  int own, other;
};
Upward upward(int i) {
  const int own = floor_half(i);
  return {own, 2 * own == i ? own - 1 : own + 1};
}

/// `level` with the next smaller one added to it, spread to its size.
Level with_doubled(Level level, const Level& smaller) {
  constexpr float kOwn = 2 * kHalve[1], kOther = 2 * kHalve[0];
  tbb::parallel_for(tbb::blocked_range<int>(0, level.height, 8), [&](const tbb::blocked_range<int>& rows) {
    for (int j = rows.begin(); j != rows.end(); ++j) {
      const Upward y = upward(j + level.top);
      for (int i = 0; i < level.width; ++i) {
        const Upward x = upward(i + level.left);
        Rgb& sum = level.at(i, j);
        add_scaled(sum, smaller.value(x.own, y.own), kOwn * kOwn);
        add_scaled(sum, smaller.value(x.other, y.own), kOther * kOwn);
        add_scaled(sum, smaller.value(x.own, y.other), kOwn * kOther);
        add_scaled(sum, smaller.value(x.other, y.other), kOther * kOther);
      }
    }
  });
  return level;
}

/// Blurred, with a margin around it.
Level blurred(const Level& level, int margin) {
  constexpr int kReach = static_cast<int>(kBlur.size()) / 2;
  const Level wide =
      filled(Level(level.width + 2 * margin, level.height, level.left - margin, level.top, level.beyond),
             [&](int column, int row) { return weighted(level, column - kReach, row, false, kBlur); });
  return filled(Level(wide.width, level.height + 2 * margin, wide.left, level.top - margin, level.beyond),
                [&](int column, int row) { return weighted(wide, column, row - kReach, true, kBlur); });
}

/// A level blurred once and twice, each with its weight, and the margin that the pixels of the next larger
/// level take from.
Level blurred_twice(const Level& level, float weight_once, float weight_twice) {
  constexpr int kMargin = 3, kReach = static_cast<int>(kBlur.size()) / 2;
  const Level once = blurred(level, level.beyond == Beyond::Edge ? kMargin + kReach : 0);
  const Level twice = blurred(once, 0);
  return filled(Level(once.width, once.height, once.left, once.top, once.beyond), [&](int column, int row) {
    Rgb sum{0, 0, 0};
    add_scaled(sum, once.value(column, row), weight_once);
    add_scaled(sum, twice.value(column, row), weight_twice);
    return sum;
  });
}

/// Standard deviation of Gaussian `i` in pixels of the picture: of level i / 2, blurred once or twice, and of
/// halving and doubling on the way there and back.
double width_of(int i) {
  const double scale2 = std::exp2(2.0 * (i / 2));
  return std::sqrt(kBlurVariance * (1 + i % 2) * scale2 + 2 * kHalveVariance * (scale2 - 1) / 3);
}

/// Shares of P in its Gaussians. P is a mixture of Gaussians, of which those up to the width sigma hold the
/// share erfc(r0 / (sqrt(2) sigma)); each of ours stands for those around it, the first for all that are
/// narrower, the last, wider than any picture needs, for all that are wider.
std::vector<float> weights_of(const Glow& glow, int longest_side) {
  const double r0 = glow.radius_px / std::sqrt(3.0);
  std::vector<float> weights;
  double below = 0;
  for (int i = 0;; ++i) {
    const bool last = i % 2 != 0 && width_of(i) > 16.0 * std::max<double>(longest_side, r0);
    const double edge = std::sqrt(width_of(i) * width_of(i + 1));
    const double up_to_here = last ? 1 : std::erfc(r0 / (std::sqrt(2.0) * edge));
    weights.push_back(static_cast<float>(up_to_here - below));
    below = up_to_here;
    if (last) return weights;
  }
}

Rgb mean_of(const Level& level) {
  std::array<double, 3> sum{0, 0, 0};
  for (const Rgb& pixel : level.pixels) {
    for (std::size_t c = 0; c < 3; ++c) sum[c] += pixel[c];
  }
  const auto count = static_cast<double>(level.pixels.size());
  return {static_cast<float>(sum[0] / count), static_cast<float>(sum[1] / count),
          static_cast<float>(sum[2] / count)};
}

/// The narrowest that a sphere becomes; Gaussians that would need fewer pixels are even over all of it.
constexpr int kNarrowestSphere = 16;

/// The scattered light as if all of it were scattered.
Level scattered(const Level& light, const std::vector<float>& weights) {
  std::vector<Level> levels;
  Level level = light;
  std::size_t i = 0;
  for (; i < weights.size(); i += 2) {
    if (i > 0 && level.beyond == Beyond::Sphere && level.width < 2 * kNarrowestSphere) break;
    if (i > 0) level = halved(level);
    levels.push_back(blurred_twice(level, weights[i], weights[i + 1]));
  }
  if (i < weights.size()) {
    const float even = std::accumulate(weights.begin() + static_cast<std::ptrdiff_t>(i), weights.end(), 0.0F);
    const Rgb mean = mean_of(level);
    for (Rgb& pixel : levels.back().pixels) add_scaled(pixel, mean, even);
  }
  Level sum = std::move(levels.back());
  for (std::size_t k = levels.size() - 1; k-- > 0;) sum = with_doubled(std::move(levels[k]), sum);
  return sum;
}

Rgb colour_of(const Rgba& pixel) {
  return {pixel[0], pixel[1], pixel[2]};
}

/// The data window, whose edge goes on.
Level light_of_window(const Picture& picture) {
  return filled(Level(picture.width, picture.height, 0, 0, Beyond::Edge),
                [&](int column, int row) { return colour_of(picture.at(column, row)); });
}

/// The circle of a fisheye, in pixels of the data window.
struct Circle {
  double x, y, radius;

  explicit Circle(const Picture& picture)
      : x(0.5 * picture.display_width - picture.x),
        y(0.5 * picture.display_height - picture.y),
        radius(0.5 * std::min(picture.display_width, picture.display_height)) {}

  double from_centre(int column, int row) const { return std::hypot(column + 0.5 - x, row + 0.5 - y); }
  /// How much of a pixel lies inside.
  float share(int column, int row) const {
    return static_cast<float>(std::clamp(radius + 0.5 - from_centre(column, row), 0.0, 1.0));
  }
};

/// The circle of a fisheye, whose rim goes on outward from the last pixels that are whole.
Level light_of_circle(const Picture& picture, const Circle& circle) {
  const double whole = std::max(circle.radius - 2.0, 0.0);
  return filled(Level(picture.width, picture.height, 0, 0, Beyond::Edge), [&](int column, int row) {
    const double away = circle.from_centre(column, row);
    if (away <= whole) return colour_of(picture.at(column, row));
    const double inward = whole / away;
    const int i = static_cast<int>(std::floor(circle.x + (column + 0.5 - circle.x) * inward));
    const int j = static_cast<int>(std::floor(circle.y + (row + 0.5 - circle.y) * inward));
    return colour_of(picture.at(std::clamp(i, 0, picture.width - 1), std::clamp(j, 0, picture.height - 1)));
  });
}

/// A whole sphere of `width` x `height` samples, bilinear between those of `from`, which is one, too.
Level resampled(const Level& from, int width, int height) {
  if (from.width == width && from.height == height) return from;
  return filled(Level(width, height, 0, 0, Beyond::Sphere), [&](int column, int row) {
    const double x = (column + 0.5) * from.width / width - 0.5, y = (row + 0.5) * from.height / height - 0.5;
    const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
    const auto u = static_cast<float>(x - i), v = static_cast<float>(y - j);
    Rgb sum{0, 0, 0};
    add_scaled(sum, from.value(i, j), (1 - u) * (1 - v));
    add_scaled(sum, from.value(i + 1, j), u * (1 - v));
    add_scaled(sum, from.value(i, j + 1), (1 - u) * v);
    add_scaled(sum, from.value(i + 1, j + 1), u * v);
    return sum;
  });
}

/// The veil of a lat-long picture: of its display window, which is the whole sphere; the overscan shows the
/// same once more. It is scattered at a size that can be halved until few pixels are left.
Level veil_of_sphere(const Picture& picture, const Glow& glow) {
  const int across = picture.display_width + picture.display_width % 2, down = picture.display_height;
  Level light = filled(Level(picture.display_width, down, 0, 0, Beyond::Edge), [&](int column, int row) {
    return colour_of(picture.at(column - picture.x, row - picture.y));
  });
  light.beyond = Beyond::Sphere;
  int step = 1;
  while (across / step >= 2 * kNarrowestSphere && down / step >= kNarrowestSphere) step *= 2;
  const auto rounded_up = [](int size, int to) { return (size + to - 1) / to * to; };
  Level veil = scattered(resampled(light, rounded_up(across, 2 * step), rounded_up(down, step)),
                         weights_of(glow, std::max(picture.display_width, down)));
  veil = resampled(veil, picture.display_width, down);
  veil.left = -picture.x;
  veil.top = -picture.y;
  return veil;
}

}  // namespace

Picture with_glow(const Picture& picture, const Glow& glow) {
  const bool fisheye = glow.projection == Projection::Fisheye;
  const Circle circle(picture);
  const auto weights = [&] { return weights_of(glow, std::max(picture.width, picture.height)); };
  const Level veil = glow.projection == Projection::LatLong ? veil_of_sphere(picture, glow)
                     : fisheye ? scattered(light_of_circle(picture, circle), weights())
                               : scattered(light_of_window(picture), weights());
  Picture result = picture;
  const auto share = static_cast<float>(glow.strength);
  tbb::parallel_for(0, picture.height, [&](int row) {
    for (int column = 0; column < picture.width; ++column) {
      Rgba& pixel = result.at(column, row);
      const Rgb& spread = veil.value(column, row);
      const float inside = fisheye ? circle.share(column, row) : 1.0F;
      for (std::size_t c = 0; c < 3; ++c) pixel[c] += share * (inside * spread[c] - pixel[c]);
    }
  });
  return result;
}

}  // namespace lensplane
