// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/star_images.h"

#include <cmath>
#include <utility>

namespace lensplane {

StarField star_field(const std::vector<Star>& stars, double exposure) {
  std::vector<Vec3> directions;
  std::vector<Rgb> lights;
  for (const Star& star : stars) {
    directions.push_back(star.direction);
    const double flux = kLightOfMagnitudeZero * std::exp2(exposure) * std::pow(10.0, -0.4 * star.v_mag);
    Rgb light = star_colour(star.b_minus_v);
    for (double& channel : light) channel *= flux;
    lights.push_back(light);
  }
  return {DirectionIndex(std::move(directions)), std::move(lights)};
}

std::vector<StarImage> find_star_images(const Tracer& tracer, const StarField& field,
                                        const ImageSearch& search) {
  std::vector<StarImage> images;
  for (const PointImage& image : find_point_images(tracer, field.index, search)) {
    Rgb light = field.light[image.point];
    for (double& channel : light) channel *= std::abs(image.magnification);
    images.push_back({image.point, image.film, image.magnification, light});
  }
  return images;
}

}  // namespace lensplane
