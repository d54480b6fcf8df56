// SPDX-License-Identifier: Apache-2.0

#include "src/thin_images.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

namespace lensplane {
namespace {

/// Sides of squares in pixels: where the search begins, where it ends near masses, and where maps that are
/// not linear are no longer divided.
constexpr double kFirstSquare = 64, kLeastNearMass = 0.25, kLeastSquare = 1.0 / 16.0;

/// How far an image may be from where the middle of a square expects it, in half diagonals and in pixels.
constexpr double kReach = 2.0, kReachPixels = 0.25;

/// Curved light is followed to this share of a pixel.
constexpr double kFollowed = 1e-4;

/// A square's half diagonal is less than this share of the way to the next mass, or it is divided. Masses
/// that bend light by less than this share of a pixel do not count.
constexpr double kCalm = 0.5, kCalmBend = 0.05;

/// An image's middle is taken for found after a step of so few pixels, and after so many steps.
constexpr double kFound = 0.01;
constexpr int kMostSteps = 5;

/// By how much a square's map may be off in it: pixels, and shares of the image's thickness.
constexpr double kMostOff = 0.02, kMostOffThickness = 0.1;

double thin(const Surface& body) {
  return std::holds_alternative<Sphere>(body) ? kThinSphere : kThinRing;
}

/// A square, and the bodies that may have thin images in it.
struct Node {
  FilmSquare square;
  std::vector<std::size_t> bodies;
};

void divide(const FilmSquare& square, const std::vector<std::size_t>& bodies, std::vector<Node>& into) {
  const double half = square.size / 2;
  for (const double y : {0.0, half}) {
    for (const double x : {0.0, half}) {
      into.push_back({{{square.corner.x + x, square.corner.y + y}, half}, bodies});
    }
  }
}

/// Searches one of the first squares.
class Search {
 public:
  explicit Search(const Tracer& tracer) : tracer_(tracer), pixel_(pixel_angle(tracer.camera())) {}

  std::vector<ThinImage> search(const FilmSquare& square, const std::vector<std::size_t>& bodies) {
    std::vector<Node> nodes = {{square, bodies}};
    while (!nodes.empty()) {
      std::vector<FilmPosition> centres;
      for (const Node& node : nodes) centres.push_back(node.square.centre());
      const PassingLight light(tracer_, centres);
      std::vector<Node> next;
      for (std::size_t i = 0; i < nodes.size(); ++i) look(light, i, nodes[i], next);
      nodes = std::move(next);
    }
    return std::move(found_);
  }

 private:
  /// Notes what is thin in a square, or divides it.
  void look(const PassingLight& light, std::size_t i, const Node& node, std::vector<Node>& next) {
    const double size = node.square.size, half = size / std::sqrt(2.0);
    const double deep = light.deep_in_field(i);
    if (deep > half * pixel_) return;
    const bool calm = half * pixel_ <= kCalm * light.clear_of_masses(i, kCalmBend * pixel_);
    const bool least = size <= (calm || light.is_captured(i) ? 1.0 : kLeastNearMass);
    if (least && deep > 0.0) return;
    std::vector<std::size_t> left;
    for (const std::size_t k : node.bodies) {
      const std::optional<LightLine> line = light.past(i, k);
      const Surface& body = tracer_.surfaces()[k];
      const auto passes = line ? approach(body, *line, half * pixel_) : std::nullopt;
      if (calm || least) {
        if (!passes || passes->gap > kReach * half + kReachPixels) continue;
        if (passes->least_thickness > 2 * thin(body)) continue;
      }
      if (!least) {
        left.push_back(k);
      } else if (!note(k, node.square, passes->shift)) {
        divide(node.square, {k}, next);
      }
    }
    if (!left.empty()) divide(node.square, left, next);
  }

  /// False when the map is not linear in the square, which then has to be divided. `shift`: to about where
  /// the image is, from the centre.
  bool note(std::size_t k, const FilmSquare& square, FilmPosition shift) {
    const Surface& body = tracer_.surfaces()[k];
    const bool may_divide = square.size > kLeastSquare;
    FilmPosition film = moved(square, square.centre(), shift);
    std::optional<LightLine> line;
    std::optional<Approach> passes;
    for (int step = 0; step < kMostSteps; ++step) {
      line = light_at(film, k);
      passes = line ? approach(body, *line, 0.0) : std::nullopt;
      if (!passes) return !may_divide;
      const FilmPosition next = moved(square, film, passes->shift);
      if (std::hypot(next.x - film.x, next.y - film.y) < kFound) break;
      if (step + 1 == kMostSteps) return !may_divide;
      film = next;
    }
    if (passes->thickness > thin(body)) return true;
    const std::optional<BodyImage> image = body_image(body, *line, film);
    if (!image) return true;
    const std::vector<ImageRay> rays = rays_over(*image, square);
    if (rays.empty()) return true;
    if (may_divide && !is_linear(k, *image, rays, passes->thickness)) return false;
    found_.push_back({k, square, *image});
    return true;
  }

  /// `film` moved by `shift`, but to no farther away than the square's neighbours.
  static FilmPosition moved(const FilmSquare& square, FilmPosition film, FilmPosition shift) {
    const FilmPosition centre = square.centre();
    const double x = film.x + shift.x - centre.x, y = film.y + shift.y - centre.y;
    const double by = square.size / std::max(square.size, std::hypot(x, y));
    return {centre.x + by * x, centre.y + by * y};
  }

  std::optional<LightLine> light_at(FilmPosition film, std::size_t k) const {
    return PassingLight(tracer_, {&film, 1}).past(0, k);
  }

  /// Is the image, where it is farthest away, seen where the map says?
  bool is_linear(std::size_t k, const BodyImage& image, const std::vector<ImageRay>& rays, double thickness) {
    const auto away = [&](const ImageRay& ray) {
      return std::hypot(ray.film.x - image.at.x, ray.film.y - image.at.y);
    };
    const ImageRay& ray = *std::max_element(
        rays.begin(), rays.end(), [&](const ImageRay& a, const ImageRay& b) { return away(a) < away(b); });
    const std::optional<LightLine> line = light_at(ray.film, k);
    const auto there = line ? body_image(tracer_.surfaces()[k], *line, ray.film) : std::nullopt;
    return there && apart(image, *there, ray.film) <= std::min(kMostOff, kMostOffThickness * thickness);
  }

  const Tracer& tracer_;
  double pixel_;  // radians
  std::vector<ThinImage> found_;
};

bool comes_first(const ThinImage& a, const ThinImage& b) {
  const auto key = [](const ThinImage& t) {
    return std::tuple(std::floor(t.square.corner.y), std::floor(t.square.corner.x), t.square.corner.y,
                      t.square.corner.x, t.surface);
  };
  return key(a) < key(b);
}

/// A surface in camera axes moved to the world.
Surface world_from_camera(const Camera& camera, const Surface& surface) {
  const auto placed = [&camera](auto body) {
    body.centre = camera.axes.parent_from_local(body.centre) + camera.position;
    body.axes = parent_from_local(camera.axes, body.axes);
    return Surface(body);
  };
  if (const auto* sphere = std::get_if<Sphere>(&surface)) return placed(*sphere);
  if (const auto* ring = std::get_if<Ring>(&surface)) return placed(*ring);
  return surface;
}

}  // namespace

Tracer exact_enough_for_thin(const Tracer& tracer) {
  if (tracer.plan().method != Method::Geodesic) return tracer;
  Scene scene;
  scene.camera = tracer.camera();
  for (const Surface& surface : tracer.surfaces())
    scene.surfaces.push_back(world_from_camera(scene.camera, surface));
  Plan plan = tracer.plan();
  plan.geodesic_tolerance = std::min(plan.geodesic_tolerance, kFollowed * pixel_angle(scene.camera));
  return {scene, std::move(plan)};
}

std::vector<ThinImage> find_thin_images(const Tracer& tracer, int margin) {
  std::vector<std::size_t> bodies;
  for (std::size_t k = 0; k < tracer.surfaces().size(); ++k) {
    const Surface& surface = tracer.surfaces()[k];
    if (std::holds_alternative<Sphere>(surface) || std::holds_alternative<Ring>(surface)) bodies.push_back(k);
  }
  if (bodies.empty()) return {};
  const Camera& camera = tracer.camera();
  const double first = -camera.overscan - margin;
  const auto squares = [&](int pixels) {
    return static_cast<std::size_t>(std::ceil((pixels + 2 * margin) / kFirstSquare));
  };
  const std::size_t columns = squares(camera.full_width()), rows = squares(camera.full_height());
  std::vector<std::vector<ThinImage>> found(columns * rows);
  tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t i) {
    const FilmPosition corner{first + kFirstSquare * static_cast<double>(i % columns),
                              first + kFirstSquare * static_cast<double>(i / columns)};
    found[i] = Search(tracer).search({corner, kFirstSquare}, bodies);
  });
  std::vector<ThinImage> images;
  for (const auto& of_square : found) images.insert(images.end(), of_square.begin(), of_square.end());
  std::sort(images.begin(), images.end(), comes_first);
  return images;
}

}  // namespace lensplane
