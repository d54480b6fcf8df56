// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/screen_motion.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "pipeline/shot/shot_scene.h"
#include "src/bodies.h"
#include "src/constants.h"
#include "src/projection.h"

namespace lensplane {
namespace {

constexpr int kMoments = 5;       // while the shutter is open, at which speeds are taken
constexpr double kStep = 1e-3;    // of the time that it is open, over which they are taken
constexpr int kGrid = 9;          // points of the frame along each side
constexpr int kOutline = 16;      // points of an outline
constexpr double kBeside = 0.05;  // of the frame's width: what lies as far outside of it is followed, too

/// What the shot shows at an instant.
struct Instant {
  double time;
  Scene scene;

  Instant(const Shot& shot, double at) : time(at), scene(scene_at(shot, at)) {}
  const Camera& camera() const { return scene.camera; }

  std::optional<FilmPosition> film_of_direction(const Vec3& world) const {
    const auto film = film_from_direction<double>(camera(), camera().axes.local_from_parent(world));
    return film ? std::optional(FilmPosition{film->x, film->y}) : std::nullopt;
  }
  std::optional<FilmPosition> film_of_point(const Vec3& world) const {
    return film_of_direction(world - camera().position);
  }
  Vec3 direction_of(FilmPosition film) const {
    return camera().axes.parent_from_local(direction_from_film<double>(camera(), film));
  }
};

/// Points all over the frame; of a lat-long camera not those at its poles, where all moves without limit.
std::vector<FilmPosition> grid_of(const Camera& camera) {
  const bool latlong = camera.projection == Projection::LatLong;
  std::vector<FilmPosition> grid;
  for (int row = 0; row < kGrid; ++row) {
    for (int column = 0; column < kGrid; ++column) {
      const double u = double(column) / (kGrid - 1), v = (row + 0.5) / kGrid;
      const FilmPosition film{u * camera.width, (latlong ? v : double(row) / (kGrid - 1)) * camera.height};
      if (sees(camera, film)) grid.push_back(film);
    }
  }
  return grid;
}

// What stands still is computed twice in the same way: rounding does not move it.

/// Two instants that follow one another closely, and the longest way between them.
class Follower {
 public:
  Follower(const Shot& shot, double time, double step)
      : shot_(shot), before_(shot, time), after_(shot, time + step), grid_(grid_of(before_.camera())) {}

  double farthest() {
    follow_infinity();
    for (std::size_t i = 0; i < before_.scene.lenses.size(); ++i) follow_lens(i);
    const std::vector<LayerSurface> surfaces = surfaces_of(shot_);
    for (std::size_t k = 0; k < surfaces.size(); ++k) {
      if (surfaces[k].crossing > 0) continue;
      if (std::holds_alternative<Sphere>(before_.scene.surfaces[k])) follow_sphere(surfaces[k].layer, k);
      if (std::holds_alternative<Ring>(before_.scene.surfaces[k])) follow_ring(surfaces[k].layer, k);
    }
    return farthest_;
  }

 private:
  /// In the frame, or close beside it.
  bool matters(FilmPosition film) const {
    const Camera& camera = before_.camera();
    const double beside = kBeside * camera.width;
    return film.x >= -beside && film.x <= camera.width + beside && film.y >= -beside &&
           film.y <= camera.height + beside;
  }

  void follow(const std::optional<FilmPosition>& from, const std::optional<FilmPosition>& to) {
    if (!from || !to || !matters(*from)) return;
    const Camera& camera = before_.camera();
    double x = to->x - from->x;
    if (camera.projection == Projection::LatLong) x -= camera.width * std::round(x / camera.width);
    farthest_ = std::max(farthest_, std::hypot(x, to->y - from->y));
  }

  void follow_points(const Vec3& from, const Vec3& to) {
    follow(before_.film_of_point(from), after_.film_of_point(to));
  }

  /// Skies stand still in the world; stars turn as their layer does. Plates move with the camera.
  void follow_infinity() {
    for (const Layer& layer : shot_.layers) {
      const auto* stars = std::get_if<StarsLayer>(&layer.kind);
      const bool turns_with_camera = std::holds_alternative<PlateLayer>(layer.kind);
      const bool is_sky =
          std::holds_alternative<LatLongLayer>(layer.kind) || (turns_with_camera && layer.povray);
      if (!stars && !is_sky) continue;
      const auto turned = [&](const Instant& instant, const Vec3& there) {
        const Vec3 angles = stars ? value_at(stars->rotation, instant.time) : Vec3(0);
        return instant.film_of_direction(basis_from_zxy(angles).parent_from_local(there));
      };
      const Vec3 first = stars ? value_at(stars->rotation, before_.time) : Vec3(0);
      for (const FilmPosition film : grid_) {
        const Vec3 there = basis_from_zxy(first).local_from_parent(before_.direction_of(film));
        follow(turned(before_, there), turned(after_, there));
      }
    }
  }

  /// A lens, and points round it where a point behind it is seen as a ring.
  void follow_lens(std::size_t i) {
    const auto around = [i](const Instant& instant, double turn) {
      const Lens& lens = instant.scene.lenses[i];
      const Vec3 to = lens.position - instant.camera().position;
      const double distance = to.length();
      const double angle = std::min(std::sqrt(4.0 * lens.m / distance), 1.0);
      const Basis& axes = instant.camera().axes;
      const Vec3 side = axes.x * std::cos(turn) + axes.y * std::sin(turn);
      return instant.film_of_direction(to / distance + side * std::tan(angle));
    };
    follow_points(before_.scene.lenses[i].position, after_.scene.lenses[i].position);
    for (int n = 0; n < 4; ++n) {
      const double turn = 0.5 * kPi * n;
      follow(around(before_, turn), around(after_, turn));
    }
  }

  /// The point of the outline at `turn`, as the camera sees it.
  static Vec3 outline(const Instant& instant, const Sphere& sphere, double turn) {
    const Vec3 to = sphere.centre - instant.camera().position;
    const Basis& axes = instant.camera().axes;
    const Vec3 side = axes.x * std::cos(turn) + axes.y * std::sin(turn);
    const Vec3 across = (side - to * (side.dot(to) / to.length2())).normalized();
    const double inward = std::min(sphere.radius * sphere.radius / to.length2(), 1.0);
    return sphere.centre - to * inward + across * (sphere.radius * std::sqrt(1.0 - inward));
  }

  void follow_sphere(std::size_t layer, std::size_t k) {
    const auto& a = std::get<Sphere>(before_.scene.surfaces[k]);
    const auto& b = std::get<Sphere>(after_.scene.surfaces[k]);
    follow_points(a.centre, b.centre);
    for (int n = 0; n < kOutline; ++n) {
      const double turn = 2.0 * kPi * n / kOutline;
      follow_points(outline(before_, a, turn), outline(after_, b, turn));
    }
    const auto follow_normal = [&](const Vec3& normal) {
      const Vec3 there = a.axes.local_from_parent(normal);
      const auto point = [&](const Sphere& s) {
        return s.centre + s.axes.parent_from_local(there) * s.radius;
      };
      if (normal.dot(before_.camera().position - point(a)) > 0) follow_points(point(a), point(b));
    };
    for (const Vec3& axis : {before_.camera().axes.x, before_.camera().axes.y, before_.camera().axes.z}) {
      follow_normal(axis);
      follow_normal(-axis);
    }
    for (const FilmPosition film : grid_) {
      const Vec3 along = before_.direction_of(film), to = a.centre - before_.camera().position;
      const double way = sphere_entry<double>(Vec3(0), along, to, a.radius);
      if (std::isfinite(way) && way >= 0) follow_normal((along * way - to).normalized());
    }
    const auto before = light_at(shot_.layers[layer], before_.time),
               after = light_at(shot_.layers[layer], after_.time);
    if (before && after) follow_shadow(a.centre, a.radius, *before, *after);
  }

  /// The edge of a shadow on a body turns with the light.
  void follow_shadow(const Vec3& centre, double radius, const Vec3& before, const Vec3& after) {
    const Vec3 across = before_.camera().axes.x * (radius * angle_between(before, after));
    follow(before_.film_of_point(centre), before_.film_of_point(centre + across));
  }

  void follow_ring(std::size_t layer, std::size_t k) {
    const auto& a = std::get<Ring>(before_.scene.surfaces[k]);
    const auto& b = std::get<Ring>(after_.scene.surfaces[k]);
    for (int n = 0; n < kOutline; ++n) {
      const double turn = 2.0 * kPi * n / kOutline;
      const auto point = [turn](const Ring& ring, double radius) {
        return ring.centre +
               ring.axes.parent_from_local({radius * std::cos(turn), 0, radius * std::sin(turn)});
      };
      follow_points(point(a, a.inner), point(b, b.inner));
      follow_points(point(a, a.outer), point(b, b.outer));
    }
    for (const FilmPosition film : grid_) {
      const Vec3 along = before_.direction_of(film), to = a.centre - before_.camera().position;
      const double way = to.dot(a.axes.y) / along.dot(a.axes.y);
      if (!std::isfinite(way) || way <= 0) continue;
      const Vec3 from_centre = along * way - to;
      if (from_centre.length() < a.inner || from_centre.length() > a.outer) continue;
      const Vec3 there = a.axes.local_from_parent(from_centre);
      follow_points(a.centre + a.axes.parent_from_local(there), b.centre + b.axes.parent_from_local(there));
    }
    const auto before = shadow_at(shot_, layer, before_.time), after = shadow_at(shot_, layer, after_.time);
    if (before && after) follow_shadow(a.centre, a.outer, before->light, after->light);
  }

  const Shot& shot_;
  Instant before_, after_;
  std::vector<FilmPosition> grid_;
  double farthest_ = 0;
};

}  // namespace

double screen_motion(const Shot& shot, int frame) {
  const double open = value_at(shot.camera.shutter.open, frame),
               close = value_at(shot.camera.shutter.close, frame);
  const double span = close - open;
  if (!(span > 0)) return 0;
  double farthest = 0;
  for (int i = 0; i < kMoments; ++i) {
    const double time = frame + open + span * (i + 0.5 * (1.0 - kStep * kMoments)) / kMoments;
    farthest = std::max(farthest, Follower(shot, time, kStep * span).farthest() / kStep);
  }
  return farthest;
}

}  // namespace lensplane
