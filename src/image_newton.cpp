// SPDX-License-Identifier: Apache-2.0

#include "src/image_newton.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "src/film_cell.h"

namespace lensplane {
namespace {

/// Steps after which a search that has nearly come to rest ends; from then on it only follows noise.
constexpr int kRegularSteps = 10, kSteps = 30;

/// Directions are not known better than this, in radians.
constexpr double kDirectionRounding = 2e-15;

enum class State { Searching, Found, Lost };

struct Search {
  const ImageSearchStart* start;
  FilmPosition film;
  State state = State::Searching;
  double magnification = 0;
};

double distance_from_centre(const Search& search) {
  return std::max(std::abs(search.film.x - search.start->centre.x),
                  std::abs(search.film.y - search.start->centre.y));
}

/// One step towards the image; `ray` is what search.film sees.
State advance(const SkyRay& ray, int step, Search& search) {
  const ImageSearchStart& start = *search.start;
  if (!ray.seen || !(ray.direction.dot(start.direction) > 0.0)) return State::Lost;
  search.magnification = ray.magnification;
  const Vec3 away = start.direction - ray.direction;
  if (away.length() < kDirectionRounding) return State::Found;
  const TangentPlane plane = tangent_plane(start.direction);
  const FilmJacobian jacobian = jacobian_on(plane, ray);
  if (jacobian.determinant() == 0.0) return State::Lost;
  FilmPosition shift = film_shift(jacobian, plane.u.dot(away), plane.v.dot(away));
  const double length = std::hypot(shift.x, shift.y);
  if (!std::isfinite(length)) return State::Lost;
  const double shorter = std::min(1.0, start.size / length);
  search.film.x += shift.x * shorter, search.film.y += shift.y * shorter;
  if (length < start.last_step) return State::Found;
  if (distance_from_centre(search) > start.size * (start.regular ? 1.0 : 2.0)) return State::Lost;
  if (step + 1 < (start.regular ? kRegularSteps : kSteps)) return State::Searching;
  return length < kSameImage ? State::Found : State::Lost;
}

}  // namespace

std::vector<PointImage> find_by_newton(const SkyRays& rays, std::span<const ImageSearchStart> starts) {
  std::vector<Search> searches;
  for (const ImageSearchStart& start : starts) searches.push_back({&start, start.film});
  std::vector<std::size_t> active(searches.size());
  for (std::size_t i = 0; i < active.size(); ++i) active[i] = i;
  for (int step = 0; !active.empty(); ++step) {
    std::vector<FilmPosition> films;
    for (const std::size_t i : active) films.push_back(searches[i].film);
    const std::vector<SkyRay> traced = rays.trace(films);
    std::vector<std::size_t> still;
    for (std::size_t k = 0; k < active.size(); ++k) {
      Search& search = searches[active[k]];
      search.state = advance(traced[k], step, search);
      if (search.state == State::Searching) still.push_back(active[k]);
    }
    active = std::move(still);
  }
  std::vector<PointImage> images;
  for (const Search& search : searches) {
    if (search.state != State::Found) continue;
    if (distance_from_centre(search) > search.start->size / 2.0 + kSameImage) continue;
    images.push_back({search.start->point, search.film, search.magnification});
  }
  return images;
}

}  // namespace lensplane
