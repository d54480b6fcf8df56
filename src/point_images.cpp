// SPDX-License-Identifier: Apache-2.0

#include "src/point_images.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "src/film_area.h"
#include "src/film_cell.h"

namespace lensplane {
namespace {

/// Pixels across a cell before it is divided, and cells across a block, which one thread works on.
constexpr double kCell = 8;
constexpr int kBlock = 16;

/// Wild cells are divided down to this, in pixels, though no point seems near: their corners do not tell how
/// far the sky in them reaches. Larger cells than kFaintCell are not left out for being faint.
constexpr double kWildCell = 0.5, kFaintCell = 4;

/// How much farther from a cell's middle than its corners the sky in it may reach.
constexpr double kTameReach = 2, kWildReach = 3;

/// How far, in chords, the sky in a cell may bow out of the great circle along which it is longest.
constexpr double kBow = 0.15;

/// An image may be brighter than a cell's five rays; cells fainter than this share of the least magnification
/// have none.
constexpr double kFaintShare = 0.3;

/// In cells that are not divided any more: the farthest first step of a search, in cells.
constexpr double kFirstStep = 2;

/// Cells are taken to bend by this at least.
constexpr double kLeastBend = 1e-3;

struct Sky {
  const SkyRays& rays;
  const DirectionIndex& points;
  const ImageSearch& search;
  std::vector<FilmPosition> masses;  // on the film
};

/// Is a mass in the square of the film round `centre` that is `size` pixels wide?
bool holds_mass(const Sky& sky, FilmPosition centre, double size) {
  return std::any_of(sky.masses.begin(), sky.masses.end(), [&](FilmPosition mass) {
    return std::max(std::abs(mass.x - centre.x), std::abs(mass.y - centre.y)) <= size / 2.0;
  });
}

/// Steps after which a regular cell's search ends, in pixels. The next step would be about bend/size times
/// the square of the last one; the magnification changes by about twice bend/size for every pixel.
double last_step(const FilmCell& cell, const CellView& view) {
  const double per_bend = cell.size / std::max(view.bend, kLeastBend);
  return std::min(std::sqrt(kImageError * per_bend), kMagnificationError / 2.0 * per_bend);
}

/// The searches for a regular cell's points, from where they would be if the map were of second order.
void search_regular(const Sky& sky, const FilmCell& cell, const CellView& view,
                    std::vector<ImageSearchStart>& starts) {
  const double reach = cell.size / 2.0 * (1.0 + view.bend) + kSameImage, last = last_step(cell, view);
  const CellMap map = map_of(cell);
  for (const std::size_t point : sky.points.within(grown(view.patch, 1.0 + view.bend, view.bend / 2.0))) {
    const Vec3& direction = sky.points.directions()[point];
    const FilmPosition film = map.film_of(direction);
    const double away = std::max(std::abs(film.x - map.centre.x), std::abs(film.y - map.centre.y));
    if (away <= reach) starts.push_back({point, direction, film, map.centre, cell.size, true, last});
  }
}

/// The searches in a cell that is not divided any more: from each of its rays one step, if that does not lead
/// far out of the cell. Across a critical curve some do not; those on the image's side of it do.
void search_least(const Sky& sky, const FilmCell& cell, const std::vector<std::size_t>& points,
                  std::vector<ImageSearchStart>& starts) {
  const auto from = [&](const SkyRay& ray, std::size_t point) {
    const Vec3& direction = sky.points.directions()[point];
    if (!ray.seen || !(ray.direction.dot(direction) > 0.0)) return;
    const TangentPlane plane = tangent_plane(direction);
    const Vec3 away = direction - ray.direction;
    const FilmPosition shift = film_shift(jacobian_on(plane, ray), plane.u.dot(away), plane.v.dot(away));
    if (!(std::hypot(shift.x, shift.y) <= kFirstStep * cell.size)) return;
    const FilmPosition film{ray.film.x + shift.x, ray.film.y + shift.y};
    starts.push_back({point, direction, film, cell.centre.film, cell.size, false, kImageError});
  };
  for (const std::size_t point : points) {
    from(cell.centre, point);
    for (const SkyRay& corner : cell.corners) from(corner, point);
  }
}

/// Adds what the cell's searches start from. True when it has to be divided instead.
bool search_or_divide(const Sky& sky, const FilmCell& cell, std::vector<ImageSearchStart>& starts) {
  const CellView view = view_of(cell);
  // The rays of a large cell do not show a small mass in it, or just outside.
  const bool near_mass = holds_mass(sky, cell.centre.film, 2.0 * cell.size);
  if (view.regular && !near_mass) {
    search_regular(sky, cell, view, starts);
    return false;
  }
  const double faint = kFaintShare * sky.search.least_magnification;
  if (cell.size <= kFaintCell && view.largest_magnification < faint) return false;
  const bool least = cell.size <= kLeastCell;
  if (!least && view.wild && cell.size > kWildCell) return true;
  if (!least && near_mass && holds_mass(sky, cell.centre.film, cell.size)) return true;
  const double reach = view.wild ? kWildReach : kTameReach;
  const std::vector<std::size_t> points = sky.points.within(grown(view.patch, reach, kBow));
  if (!least) return !points.empty();
  search_least(sky, cell, points, starts);
  return false;
}

/// The images in a block of cells, whose upper left corner is `corner`; some may be there twice.
std::vector<PointImage> images_in_block(Sky sky, FilmPosition corner) {
  const double size = kCell * kBlock;
  const FilmArea block{corner.x - kCell, corner.y - kCell, corner.x + size + kCell, corner.y + size + kCell};
  std::erase_if(sky.masses, [&](FilmPosition mass) { return !block.contains(mass); });
  std::vector<ImageSearchStart> starts;
  std::vector<FilmCell> cells = trace_cells(sky.rays, corner, kCell, kBlock, kBlock);
  while (!cells.empty()) {
    std::vector<FilmCell> divided;
    for (const FilmCell& cell : cells) {
      if (search_or_divide(sky, cell, starts)) divided.push_back(cell);
    }
    cells = trace_quarters(sky.rays, divided);
  }
  return find_by_newton(sky.rays, starts);
}

/// The images that the cells of `area` hold; some may be there twice.
std::vector<PointImage> images_by_cells(const SkyRays& rays, const FilmArea& area,
                                        const DirectionIndex& points, const ImageSearch& search) {
  Sky sky{rays, points, search, {}};
  for (const Vec3& mass : rays.masses()) {
    for (const FilmPosition film : films_of_direction(rays.camera(), area, mass)) sky.masses.push_back(film);
  }
  const double size = kCell * kBlock;
  const auto columns = static_cast<std::size_t>(std::ceil((area.right - area.left) / size));
  const auto rows = static_cast<std::size_t>(std::ceil((area.bottom - area.top) / size));
  std::vector<std::vector<PointImage>> blocks(columns * rows);
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t k) {
    blocks[k] = images_in_block(sky, {area.left + static_cast<double>(k % columns) * size,
                                      area.top + static_cast<double>(k / columns) * size});
  });
  std::vector<PointImage> images;
  for (const std::vector<PointImage>& block : blocks) images.insert(images.end(), block.begin(), block.end());
  return images;
}

/// Without masses: every point where the projection puts it.
std::vector<PointImage> images_by_projection(const Camera& camera, const FilmArea& area,
                                             const DirectionIndex& points) {
  std::vector<PointImage> images;
  for (std::size_t i = 0; i < points.directions().size(); ++i) {
    const Vec3 direction = camera.axes.local_from_parent(points.directions()[i]);
    for (const FilmPosition film : films_of_direction(camera, area, direction)) {
      images.push_back({i, film, 1.0});
    }
  }
  return images;
}

bool is_same(const PointImage& a, const PointImage& b) {
  return (a.magnification > 0) == (b.magnification > 0) &&
         std::hypot(a.film.x - b.film.x, a.film.y - b.film.y) < kSameImage;
}

/// The images of one point, which come from the top, each once, no brighter together than is allowed.
void settle(std::span<const PointImage> found, double largest, std::vector<PointImage>& images) {
  const std::size_t first = images.size();
  double total = 0;
  for (const PointImage& image : found) {
    bool again = false;
    for (std::size_t i = images.size(); i > first && !again; --i) {
      if (image.film.y - images[i - 1].film.y >= kSameImage) break;
      again = is_same(image, images[i - 1]);
    }
    if (again) continue;
    images.push_back(image);
    total += std::abs(image.magnification);
  }
  if (total <= largest) return;
  for (std::size_t i = first; i < images.size(); ++i) images[i].magnification *= largest / total;
}

}  // namespace

std::vector<PointImage> find_point_images(const Tracer& tracer, const DirectionIndex& points,
                                          const ImageSearch& search) {
  if (points.directions().empty()) return {};
  const SkyRays rays(tracer);
  const FilmArea area = film_area(rays.camera(), search.margin_px);
  std::vector<PointImage> found = rays.masses().empty() ? images_by_projection(rays.camera(), area, points)
                                                        : images_by_cells(rays, area, points, search);
  std::erase_if(found, [&](const PointImage& image) {
    return !area.contains(image.film) || !(std::abs(image.magnification) >= search.least_magnification);
  });
  const auto order = [](const PointImage& a) {
    return std::tuple(a.point, a.film.y, a.film.x, a.magnification);
  };
  std::sort(found.begin(), found.end(),
            [&](const PointImage& a, const PointImage& b) { return order(a) < order(b); });
  std::vector<PointImage> images;
  for (auto begin = found.begin(); begin != found.end();) {
    const auto end = std::find_if(begin, found.end(), [&](const auto& a) { return a.point != begin->point; });
    settle({begin, end}, search.largest_magnification, images);
    begin = end;
  }
  return images;
}

}  // namespace lensplane
