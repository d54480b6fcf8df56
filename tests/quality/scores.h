// SPDX-License-Identifier: Apache-2.0
//
// How far pictures are apart, in numbers.

#pragma once

#include <vector>

#include "pipeline/image/picture.h"
#include "src/lens_map.h"

namespace lensplane {

/// The mean square of the differences of red, green and blue, a number per pixel.
std::vector<double> squares(const Picture& a, const Picture& b);

/// PSNR in decibels of these squares, over the pixels that `counts`, all where it is empty.
double psnr(const std::vector<double>& squares, double peak = 1, const std::vector<bool>& counts = {});

/// The largest difference of any channel.
double largest_difference(const Picture& a, const Picture& b);

/// The brightest channel of any pixel.
double brightest(const Picture& picture);

/// As a display shows it that knows nothing brighter than 1.
Picture clipped(Picture picture);

/// The sum of a channel over all pixels.
double total(const Picture& picture, std::size_t channel);

/// Where a map is magnified by more than `times`.
std::vector<bool> magnified(const LensMap& map, double times);

/// How much detail a picture has: the mean square of the differences of neighbours, over what `counts`.
double sharpness(const Picture& picture, const std::vector<bool>& counts);

/// Root mean square of how a picture's change from frame to frame differs from the truth's.
class Flicker {
 public:
  void add(const Picture& before, const Picture& after, const Picture& true_before,
           const Picture& true_after);
  double rms() const;

 private:
  double sum_ = 0;
  std::size_t count_ = 0;
};

}  // namespace lensplane
