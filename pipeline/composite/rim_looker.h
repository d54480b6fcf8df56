// SPDX-License-Identifier: Apache-2.0
//
// What the pixels on the rim of a shadow see: all images of what lies around the mass, however thin, by the
// lines of rim_lines.h.

#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "pipeline/composite/layering.h"
#include "pipeline/composite/rim_lines.h"
#include "pipeline/composite/thin_light.h"
#include "src/tracer.h"

namespace lensplane {

/// A pixel that the rim may run through.
struct RimPixel {
  FilmPosition centre;
  double x, y;  // unit vector across the rim
};

/// What it sees.
struct RimLight {
  bool holds_rim = false;  // else there is nothing here, and the pixel is like any other
  SeenLight seen;
  std::vector<double> shares;  // of its light, per surface, that meets it
};

/// Looks at such pixels, many at a time; one for each thread.
class RimLooker {
 public:
  /// All three have to outlive it.
  RimLooker(const Tracer& tracer, const Sampling& sampling, Viewer& viewer);

  /// Takes off what a ray meets whose light is known already. True when there is any: the ray does not count.
  using TakeOff = std::function<bool(FilmPosition, std::span<SeenPoint>)>;

  /// What rays that count see, in the order of the pixels.
  std::vector<RimLight> look(const std::vector<RimPixel>& pixels, const TakeOff& take_off);

  /// All rays that it has traced.
  std::int64_t rays() const { return rays_; }

  /// Whether light is captured at film positions, each by its own.
  std::vector<std::uint8_t> captured_at(const std::vector<FilmPosition>& films);

 private:
  std::vector<RimRay> rays_over(const std::vector<RimPixel>& pixels, std::vector<RimLight>& lights);
  void find_rims(const std::vector<RimPixel>& pixels, std::vector<RimLine>& lines);
  std::vector<std::uint8_t> captured_on(const std::vector<RimPixel>& pixels,
                                        const std::vector<RimLine*>& lines, const std::vector<double>& along);

  const Tracer& tracer_;
  const Sampling& sampling_;
  Viewer& viewer_;
  Tracer plain_;
  TraceBatch batch_, plain_batch_;
  std::vector<SeenPoint> points_;  // of one ray
  std::int64_t rays_ = 0;
};

}  // namespace lensplane
