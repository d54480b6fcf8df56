// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/star_images.h"

#include <cmath>
#include <unordered_map>
#include <utility>

namespace lensplane {

std::vector<Rgb> star_light(const std::vector<Star>& stars, double exposure) {
  std::unordered_map<double, Rgb> colours;  // catalogues have few different ones, and each is an integral
  std::vector<Rgb> lights;
  for (const Star& star : stars) {
    const auto [colour, is_new] = colours.try_emplace(star.b_minus_v);
    if (is_new) colour->second = star_colour(star.b_minus_v);
    const double flux = kLightOfMagnitudeZero * std::exp2(exposure) * std::pow(10.0, -0.4 * star.v_mag);
    Rgb light = colour->second;
    for (double& channel : light) channel *= flux;
    lights.push_back(light);
  }
  return lights;
}

StarField star_field(const std::vector<Star>& stars, double exposure) {
  std::vector<Vec3> directions;
  for (const Star& star : stars) directions.push_back(star.direction);
  return {DirectionIndex(std::move(directions)), star_light(stars, exposure)};
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
