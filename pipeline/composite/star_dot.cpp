// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/star_dot.h"

#include <algorithm>
#include <cmath>

#include "src/constants.h"

namespace lensplane {
namespace {

/// No dot is drawn longer than this many times the one in the frame's middle: straight backwards, a fisheye
/// shows a point as a circle.
constexpr double kLongest = 32;

/// Lengths and angles on the sky, in radians, of a step of a pixel to the right and of one down.
struct PixelOnSky {
  double right2, both, down2;

  double solid_angle() const { return std::sqrt(std::max(0.0, right2 * down2 - both * both)); }
};

PixelOnSky pixel_on_sky(const Camera& camera, FilmPosition film) {
  const Vector<Dual> d = direction_from_film<Dual>(camera, film);
  return {d.x.dx * d.x.dx + d.y.dx * d.y.dx + d.z.dx * d.z.dx,
          d.x.dx * d.x.dy + d.y.dx * d.y.dy + d.z.dx * d.z.dy,
          d.x.dy * d.x.dy + d.y.dy * d.y.dy + d.z.dy * d.z.dy};
}

/// How much longer dots are at worst than in the frame's middle.
double longest(const Camera& camera) {
  switch (camera.projection) {
    case Projection::LatLong:
      return 1 / std::sin(std::min(kPolarPixels / camera.height * kPi, kPi / 2));
    case Projection::Fisheye: {
      const double edge = std::min(camera.fov_rad / 2, 0.97 * kPi);
      return std::min(edge / std::sin(edge), kLongest);
    }
    case Projection::Perspective:
      return 1;
  }
  return 1;
}

}  // namespace

double PointSpread::reach_px(const Camera& camera) const {
  return kDotReach * sigma_px * longest(camera) + 1;
}

bool is_polar(const Camera& camera, FilmPosition film) {
  if (camera.projection != Projection::LatLong) return false;
  const double latitude = std::abs(0.5 - film.y / camera.height);  // in turns of half a circle
  return (0.5 - latitude) * camera.height < kPolarPixels;
}

SkySpread sky_spread(const Camera& camera, const PointSpread& spread) {
  const double pixel = pixel_on_sky(camera, {0.5 * camera.width, 0.5 * camera.height}).solid_angle();
  return {spread.sigma_px * std::sqrt(pixel), pixel};
}

StarDot dot_of(const StarImage& image, const Camera& camera, const SkySpread& sky) {
  if (camera.projection == Projection::Perspective) {
    const double variance = sky.sigma * sky.sigma / sky.pixel;
    return {image.film, variance, 0, variance, image.light};
  }
  const PixelOnSky pixel = pixel_on_sky(camera, image.film);
  const double solid_angle = std::max(pixel.solid_angle(), sky.pixel / kLongest);
  const double by = sky.sigma * sky.sigma / (solid_angle * solid_angle), more = sky.pixel / solid_angle;
  StarDot dot{image.film, by * pixel.down2, -by * pixel.both, by * pixel.right2, image.light};
  for (double& channel : dot.light) channel *= more;
  return dot;
}

}  // namespace lensplane
