// SPDX-License-Identifier: Apache-2.0

#include "pipeline/povray/ray_mesh.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <vector>

#include "pipeline/povray/camera_include.h"

namespace lensplane {
namespace {

/// Three corners round `middle` whose normal, (second - first) x (third - first), is along `direction`. Along
/// the axis that the ray runs along most, the corners are as small numbers as the ray's slopes: rounding them
/// to floats does the least harm.
std::array<Vec3, 3> triangle(const Vec3& middle, const Vec3& direction, double size) {
  const Vec3 a(std::abs(direction.x), std::abs(direction.y), std::abs(direction.z));
  const unsigned k = a.z >= a.x && a.z >= a.y ? 2 : a.y >= a.x ? 1 : 0, i = (k + 1) % 3, j = (k + 2) % 3;
  // The plane with the normal (p, q, 1) in the axes (i, j, k).
  const double p = direction[i] / direction[k], q = direction[j] / direction[k];
  Vec3 first(0), second(0), third(0);
  first[i] = -size, first[j] = -size, first[k] = size * (p + q);
  second[i] = size, second[k] = -size * p;
  third[j] = size, third[k] = -size * q;
  if (direction[k] < 0.0) std::swap(second, third);
  return {middle + first, middle + second, middle + third};
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Where most rays start: how deep, as a camera's z, and how far from its axis. Triangles no smaller than
/// that lose nothing by what is left of a ray's depth.
struct Starts {
  double depth = 0, aside = 0;  // metres
};

/// Starts this near to the common depth, as a share of it, are moved there along their rays: nothing stands
/// so near to a plane of masses that it would be lost.
constexpr double kSameDepth = 1e-3;

/// Where a ray starts, from the common depth.
Vec3 start_of(const OutgoingRay& ray, double depth) {
  const double off = depth - ray.start.z;
  const bool near = ray.direction.z < 0.0 && std::abs(off) <= kSameDepth * std::abs(depth);
  const Vec3 start = near ? ray.start + ray.direction * (off / ray.direction.z) : ray.start;
  return {start.x, start.y, near ? 0.0 : start.z - depth};
}

Starts starts_of(std::span<const OutgoingRay> rays) {
  std::vector<double> depths, asides;
  for (const OutgoingRay& ray : rays) {
    if (ray.lightless) continue;
    depths.push_back(ray.start.z);
    asides.push_back(std::max(std::abs(ray.start.x), std::abs(ray.start.y)));
  }
  return {median(std::move(depths)), median(std::move(asides))};
}

void append(const Vec3& v, fmt::memory_buffer& text) {
  fmt::format_to(std::back_inserter(text), "<{},{},{}>", static_cast<float>(v.x), static_cast<float>(v.y),
                 static_cast<float>(v.z));
}

/// Writes text that is made of pieces in parallel, some at a time: fresh memory would take longer than all
/// else.
template <class Piece>
void write_pieces(std::size_t count, Piece piece, std::ostream& to) {
  constexpr std::size_t kPiece = 1024, kAtOnce = 256;
  const std::size_t pieces = (count + kPiece - 1) / kPiece;
  std::vector<fmt::memory_buffer> buffers(kAtOnce);
  for (std::size_t first = 0; first < pieces; first += kAtOnce) {
    const std::size_t present = std::min(kAtOnce, pieces - first);
    tbb::parallel_for(std::size_t{0}, present, [&](std::size_t n) {
      buffers[n].clear();
      const std::size_t begin = (first + n) * kPiece;
      for (std::size_t i = begin; i < std::min(count, begin + kPiece); ++i) piece(i, buffers[n]);
    });
    for (std::size_t n = 0; n < present; ++n)
      to.write(buffers[n].data(), static_cast<std::streamsize>(buffers[n].size()));
  }
}

/// From camera axes, at a depth, into the world, as POV-Ray has it: both axes are mirrored in z.
std::string matrix_of(const Camera& camera, double depth, double unit_m) {
  const auto row = [](const Vec3& v) {
    const std::string vector = povray_vector(v);
    return vector.substr(1, vector.size() - 2);
  };
  const std::string origin = povray_vector(camera.position + camera.axes.z * depth, unit_m);
  return fmt::format("matrix <{}, {}, {}, {}>", row(camera.axes.x), row(camera.axes.y), row(-camera.axes.z),
                     origin.substr(1, origin.size() - 2));
}

}  // namespace

void write_ray_mesh(const Camera& camera, std::span<const OutgoingRay> rays, double unit_m,
                    std::ostream& to) {
  const Starts starts = starts_of(rays);
  to << "// The rays of a frame, written by lensplane: a triangle for each pixel.\n";
  to << fmt::format("#declare lensplane_rays = mesh2 {{\nvertex_vectors {{ {},\n", 3 * rays.size());
  write_pieces(
      rays.size(),
      [&](std::size_t i, fmt::memory_buffer& text) {
        const OutgoingRay& ray = rays[i];
        Vec3 middle = start_of(ray, starts.depth) / unit_m, direction = ray.direction;
        if (ray.lightless) middle = Vec3(0), direction = Vec3(0, 0, -1);
        const double far =
            std::max({std::abs(middle.x), std::abs(middle.y), std::abs(middle.z), starts.aside / unit_m});
        const double size = far > 0.0 ? far : 1.0;
        // Mirrored, corners run the other way round.
        const auto mirrored = [](const Vec3& v) { return Vec3(v.x, v.y, -v.z); };
        for (const Vec3& corner : triangle(mirrored(middle), mirrored(direction), size)) {
          append(corner, text);
          text.push_back(',');
        }
        text.push_back('\n');
      },
      to);
  to << fmt::format("}}\nface_indices {{ {},\n", rays.size());
  write_pieces(
      rays.size(),
      [](std::size_t i, fmt::memory_buffer& text) {
        fmt::format_to(std::back_inserter(text), "<{},{},{}>,\n", 3 * i, 3 * i + 1, 3 * i + 2);
      },
      to);
  to << "}\n" << matrix_of(camera, starts.depth, unit_m) << "\n}\n";
}

}  // namespace lensplane
