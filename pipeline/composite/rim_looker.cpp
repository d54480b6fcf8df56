// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/rim_looker.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/composite/ray_batches.h"

namespace lensplane {
namespace {

FilmPosition place(const RimPixel& pixel, double aside, double along) {
  return {pixel.centre.x + along * pixel.x - aside * pixel.y,
          pixel.centre.y + along * pixel.y + aside * pixel.x};
}

/// Footprints of the rays are at most so many times as long as wide. The sky lies round a shadow many hundred
/// times narrower than long; longer ones would cost as many lookups.
constexpr double kLongest = 8;

/// Rays are parts of a pixel as small as this, in units of the pixel filter: lookups cost accordingly.
constexpr double kPart = 0.1;

/// Light that runs beside the rim is spread so many times more across it than along it.
constexpr double kSpread = 4;

struct Step {
  double x, y;  // a unit vector of the film
};

/// Across the rim at one ray, as its light tells: the direction in which that is spread most. The pixel's own
/// is too far aside where it is spread a thousandfold.
Step across_at(const Footprint& f, const RimPixel& pixel) {
  const Axes axes = axes_of({f.ds_dx * f.ds_dx + f.dt_dx * f.dt_dx, f.ds_dx * f.ds_dy + f.dt_dx * f.dt_dy,
                             f.ds_dy * f.ds_dy + f.dt_dy * f.dt_dy});
  if (axes.major > kSpread * kSpread * axes.minor) return {axes.x, axes.y};
  return {pixel.x, pixel.y};
}

/// A footprint of the pixel filter, narrowed to `across` of it across the rim and to `along` of it along the
/// rim.
Footprint narrowed(const Footprint& f, Step to, double across, double along) {
  const double s_across = (f.ds_dx * to.x + f.ds_dy * to.y) * across;
  const double t_across = (f.dt_dx * to.x + f.dt_dy * to.y) * across;
  double s_along = (f.ds_dy * to.x - f.ds_dx * to.y) * along;
  double t_along = (f.dt_dy * to.x - f.dt_dx * to.y) * along;
  const double wide = std::hypot(s_along, t_along), least = std::hypot(s_across, t_across) / kLongest;
  if (wide > 0 && wide < least) s_along *= least / wide, t_along *= least / wide;
  Footprint narrow = f;
  narrow.ds_dx = s_across * to.x - s_along * to.y, narrow.ds_dy = s_across * to.y + s_along * to.x;
  narrow.dt_dx = t_across * to.x - t_along * to.y, narrow.dt_dy = t_across * to.y + t_along * to.x;
  return narrow;
}

/// Colour, what ends in a mass and is not covered, and their weight.
struct Sum {
  std::array<double, 4> colour{};
  double shadow = 0, weight = 0;
};

void add(const Rgba& colour, bool captured, double weight, Sum& sum) {
  for (std::size_t c = 0; c < 4; ++c) sum.colour[c] += weight * double(colour[c]);
  if (captured) sum.shadow += weight * std::max(0.0, 1.0 - double(colour[3]));
  sum.weight += weight;
}

void finish(const Sum& sum, RimLight& light) {
  if (!(sum.weight > 0)) return;
  for (std::size_t c = 0; c < 4; ++c) light.seen.colour[c] = static_cast<float>(sum.colour[c] / sum.weight);
  light.seen.shadow = static_cast<float>(sum.shadow / sum.weight);
  for (double& share : light.shares) share /= sum.weight;
}

}  // namespace

RimLooker::RimLooker(const Tracer& tracer, const Sampling& sampling, Viewer& viewer)
    : tracer_(tracer),
      sampling_(sampling),
      viewer_(viewer),
      plain_(tracer.without_passes()),
      batch_(tracer.make_batch()),
      plain_batch_(plain_.make_batch()),
      points_(tracer.surfaces().size()) {}

std::vector<std::uint8_t> RimLooker::captured_at(const std::vector<FilmPosition>& films) {
  std::vector<std::uint8_t> captured(films.size(), 0);
  rays_ += static_cast<std::int64_t>(films.size());
  trace_in_batches(
      films.size(), plain_batch_, [&](std::size_t n) { return films[n]; },
      [&](TraceBatch& batch, std::size_t) {
        plain_.trace(batch);
        return true;
      },
      [&](std::size_t n, std::size_t i) { captured[n] = plain_batch_.captured[i] != 0.0 ? 1 : 0; });
  return captured;
}

std::vector<std::uint8_t> RimLooker::captured_on(const std::vector<RimPixel>& pixels,
                                                 const std::vector<RimLine*>& lines,
                                                 const std::vector<double>& along) {
  std::vector<FilmPosition> films;
  for (std::size_t n = 0; n < lines.size(); ++n) {
    films.push_back(place(pixels[lines[n]->pixel], lines[n]->aside, along[n]));
  }
  return captured_at(films);
}

/// By bisection, on all lines at once.
void RimLooker::find_rims(const std::vector<RimPixel>& pixels, std::vector<RimLine>& lines) {
  std::vector<RimLine*> open;
  for (RimLine& line : lines) open.push_back(&line);
  const std::vector<double> near(lines.size(), -kLineReach), far(lines.size(), kLineReach);
  const std::vector<std::uint8_t> at_near = captured_on(pixels, open, near);
  const std::vector<std::uint8_t> at_far = captured_on(pixels, open, far);
  for (std::size_t n = 0; n < lines.size(); ++n) {
    lines[n].crosses = at_near[n] != at_far[n];
    if (at_far[n] != 0) std::swap(lines[n].captured, lines[n].free);
  }
  for (double width = 2 * kLineReach; width > kRimWidth; width /= 2) {
    std::erase_if(open, [](const RimLine* line) { return !line->crosses; });
    std::vector<double> middles;
    for (const RimLine* line : open) middles.push_back((line->captured + line->free) / 2);
    const std::vector<std::uint8_t> captured = captured_on(pixels, open, middles);
    for (std::size_t n = 0; n < open.size(); ++n) {
      (captured[n] != 0 ? open[n]->captured : open[n]->free) = middles[n];
    }
  }
}

std::vector<RimRay> RimLooker::rays_over(const std::vector<RimPixel>& pixels, std::vector<RimLight>& lights) {
  std::vector<RimLine> lines;
  for (std::size_t p = 0; p < pixels.size(); ++p) {
    for (const RimLine& line : lines_across(p, pixels[p].centre, sampling_)) lines.push_back(line);
  }
  find_rims(pixels, lines);
  for (const RimLine& line : lines) lights[line.pixel].holds_rim |= line.crosses;
  std::vector<RimRay> rays;
  for (const RimLine& line : lines) {
    if (lights[line.pixel].holds_rim) add_rays(line, rays);
  }
  return rays;
}

std::vector<RimLight> RimLooker::look(const std::vector<RimPixel>& pixels, const TakeOff& take_off) {
  std::vector<RimLight> lights(pixels.size());
  for (RimLight& light : lights) light.shares.assign(points_.size(), 0.0);
  const std::vector<RimRay> rays = rays_over(pixels, lights);
  // The stretches of one line lie between those of the others: each ray is filtered by what is left to it.
  const int count = rim_lines_of(sampling_.max);
  const double line_width = rim_line_width(count) / kPart;
  std::vector<Sum> sums(pixels.size());
  rays_ += static_cast<std::int64_t>(rays.size());
  trace_in_batches(
      rays.size(), batch_,
      [&](std::size_t n) { return place(pixels[rays[n].pixel], rays[n].aside, rays[n].along); },
      [&](TraceBatch& batch, std::size_t) {
        tracer_.trace(batch);
        return true;
      },
      [&](std::size_t n, std::size_t i) {
        const RimRay& ray = rays[n];
        const double across = ray.length / (2 * count) / kPixelSigma / kPart;
        for (std::size_t k = 0; k < points_.size(); ++k) {
          points_[k] = seen_point(batch_.surfaces[k], i);
          const Footprint whole = points_[k].footprint;
          points_[k].footprint = narrowed(whole, across_at(whole, pixels[ray.pixel]), across, line_width);
        }
        if (take_off({batch_.x[i], batch_.y[i]}, points_)) return;
        for (std::size_t k = 0; k < points_.size(); ++k) {
          lights[ray.pixel].shares[k] += points_[k].hit ? ray.weight : 0.0;
        }
        add(viewer_.see(points_, kPart), batch_.captured[i] != 0.0, ray.weight, sums[ray.pixel]);
      });
  for (std::size_t p = 0; p < pixels.size(); ++p) finish(sums[p], lights[p]);
  return lights;
}

}  // namespace lensplane
