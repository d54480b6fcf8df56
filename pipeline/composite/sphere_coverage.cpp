// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/sphere_coverage.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "pipeline/composite/thin_bodies.h"
#include "src/projection.h"
#include "src/surfaces.h"

namespace lensplane {
namespace {

/// The cone of directions in which the camera sees the sphere.
class Cone {
 public:
  /// What `thin` images of it cover is not seen here.
  Cone(const Camera& camera, const Sphere& sphere, const ThinBodies& thin) : camera_(camera), thin_(thin) {
    const Vec3 centre = std::get<Sphere>(camera_from_world(camera, sphere)).centre;
    const double distance = centre.length();
    inside_ = distance <= sphere.radius;
    if (inside_) return;
    axis_ = centre / distance;
    // Half the chord between directions at the cone's edge and its axis: exact for the smallest spheres.
    half_chord_ = std::sin(0.5 * std::asin(sphere.radius / distance));
  }

  bool sees(FilmPosition film) const {
    if (!lensplane::sees(camera_, film) || outside(film) > 0.0) return false;
    const SeenPoint hit{true, 0, {}, {}};
    return thin_.image_of(film, {&hit, 1}) < 0;
  }

  /// How many pixels lie between a film position and the sphere, at least; 0 or less on it.
  double pixels_outside(FilmPosition film) const {
    return camera_.projection == Projection::Perspective ? outside(film) / slope_per_pixel(camera_) : 0.0;
  }

 private:
  /// By how much a direction is farther from the axis than the edge is, as chords. Within a pixel of a flat
  /// film directions turn by its slope at most.
  double outside(FilmPosition film) const {
    if (inside_) return 0.0;
    return (direction_from_film<double>(camera_, film) - axis_).length() - 2.0 * half_chord_;
  }

  const Camera& camera_;
  const ThinBodies& thin_;
  bool inside_ = false;
  Vec3 axis_{0};
  double half_chord_ = 0;
};

/// One row of pixels, and one more on either side of it, with a pixel before and after.
using RowOfHits = std::vector<std::uint8_t>;

RowOfHits hits_in_row(const Cone& cone, int width, int row) {
  RowOfHits hits(static_cast<std::size_t>(width) + 2, 0);
  for (int column = -1, missed = 0; column <= width; column += 1 + missed) {
    const FilmPosition film{column + 0.5, row + 0.5};
    hits[static_cast<std::size_t>(column + 1)] = cone.sees(film);
    missed = static_cast<int>(std::clamp(cone.pixels_outside(film), 0.0, static_cast<double>(width)));
  }
  return hits;
}

double share_of_rays(const Cone& cone, int column, int row, const Sampling& sampling) {
  int hits = 0;
  for (int n = 0; n < sampling.max; ++n) {
    const SampleOffset offset = sample_offsets()[static_cast<std::size_t>(n)];
    hits += cone.sees({column + 0.5 + offset.x, row + 0.5 + offset.y});
  }
  return static_cast<double>(hits) / sampling.max;
}

double covered_in_row(const Cone& cone, int row, const std::array<const RowOfHits*, 3>& rows,
                      const Sampling& sampling) {
  double covered = 0;
  const RowOfHits& here = *rows[1];
  for (std::size_t k = 1; k + 1 < here.size(); ++k) {
    bool edge = false;
    for (const RowOfHits* of : rows) {
      for (std::size_t n = k - 1; n <= k + 1; ++n) edge |= (*of)[n] != here[k];
    }
    const auto column = static_cast<int>(k) - 1;
    covered += edge && sampling.max > 1 ? share_of_rays(cone, column, row, sampling) : here[k];
  }
  return covered;
}

ThinBodies thin_without_lenses(const Camera& camera, const Sphere& sphere) {
  Scene scene;
  scene.camera = camera;
  scene.surfaces = {sphere};
  return ThinBodies(Tracer(scene, plan_trace(scene, Method::Planes)));
}

/// Pixels of the frame that thin images cover: what of each ray counts for pixels in the frame.
double covered_by_thin(const Camera& camera, const ThinBodies& thin) {
  const auto share = [](double place, int pixels) {
    double sum = 0;
    const int first = std::max(0, static_cast<int>(std::floor(place)) - kThinReach);
    for (int pixel = first; pixel < std::min(pixels, first + 2 * kThinReach + 2); ++pixel) {
      sum += pixel_weight(place - (pixel + 0.5));
    }
    return sum;
  };
  double covered = 0;
  for (const ThinRay& ray : thin.rays_around(0, 0, camera.width, camera.height)) {
    if (sees(camera, ray.film))
      covered += ray.area * share(ray.film.x, camera.width) * share(ray.film.y, camera.height);
  }
  return covered;
}

}  // namespace

double covered_without_lenses(const Camera& camera, const Sphere& sphere, const Sampling& sampling) {
  const ThinBodies thin = sampling.max > 1 ? thin_without_lenses(camera, sphere) : ThinBodies();
  const Cone cone(camera, sphere, thin);
  std::vector<RowOfHits> hits(static_cast<std::size_t>(camera.height) + 2);
  tbb::parallel_for(std::size_t{0}, hits.size(), [&](std::size_t k) {
    hits[k] = hits_in_row(cone, camera.width, static_cast<int>(k) - 1);
  });
  std::vector<double> covered(static_cast<std::size_t>(camera.height));
  tbb::parallel_for(std::size_t{0}, covered.size(), [&](std::size_t k) {
    covered[k] = covered_in_row(cone, static_cast<int>(k), {&hits[k], &hits[k + 1], &hits[k + 2]}, sampling);
  });
  return std::accumulate(covered.begin(), covered.end(), covered_by_thin(camera, thin));
}

}  // namespace lensplane
