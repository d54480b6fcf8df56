// SPDX-License-Identifier: Apache-2.0

#include "pipeline/povray/ray_mesh.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <sstream>

#include "src/basis.h"

namespace lensplane {
namespace {

/// A mesh as POV-Ray keeps it: single floats, and the matrix that moves it.
struct Mesh {
  std::vector<Vec3> corners;
  Basis axes;
  Vec3 origin{0};

  Vec3 moved(const Vec3& v) const { return axes.parent_from_local(v); }
  /// The ray of a face: its middle and its normal, which POV-Ray rounds once more.
  Vec3 start(std::size_t face) const {
    return moved((corners[3 * face] + corners[3 * face + 1] + corners[3 * face + 2]) / 3.0) + origin;
  }
  Vec3 direction(std::size_t face) const {
    const Vec3& a = corners[3 * face];
    const Vec3 normal = (corners[3 * face + 1] - a).cross(corners[3 * face + 2] - a).normalized();
    return moved(Vec3(Imath::V3f(normal))).normalized();
  }
};

Mesh parsed(const std::string& text) {
  Mesh mesh;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line) && !line.starts_with("face_indices");) {
    float v[9];
    if (std::sscanf(line.c_str(), "<%g,%g,%g>,<%g,%g,%g>,<%g,%g,%g>", v, v + 1, v + 2, v + 3, v + 4, v + 5,
                    v + 6, v + 7, v + 8) != 9)
      continue;
    for (int i = 0; i < 9; i += 3) mesh.corners.push_back({v[i], v[i + 1], v[i + 2]});
  }
  double m[12];
  const char* matrix = text.c_str() + text.find("matrix <") + 8;
  EXPECT_EQ(std::sscanf(matrix, "%lf, %lf, %lf, %lf, %lf, %lf, %lf, %lf, %lf, %lf, %lf, %lf", m, m + 1, m + 2,
                        m + 3, m + 4, m + 5, m + 6, m + 7, m + 8, m + 9, m + 10, m + 11),
            12);
  mesh.axes = {{m[0], m[1], m[2]}, {m[3], m[4], m[5]}, {m[6], m[7], m[8]}};
  mesh.origin = {m[9], m[10], m[11]};
  return mesh;
}

Mesh mesh_of(const Camera& camera, const std::vector<OutgoingRay>& rays, double unit_m) {
  std::ostringstream text;
  write_ray_mesh(camera, rays, unit_m, text);
  return parsed(text.str());
}

/// POV-Ray's axes from the world's, and back.
Vec3 mirrored(const Vec3& v) {
  return {v.x, v.y, -v.z};
}

void expect_rays(const Camera& camera, const std::vector<OutgoingRay>& rays, double unit_m,
                 double widest_slope, double aside) {
  const Mesh mesh = mesh_of(camera, rays, unit_m);
  ASSERT_EQ(mesh.corners.size(), 3 * rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Vec3 start = camera.axes.local_from_parent(mirrored(mesh.start(i)) * unit_m - camera.position);
    const Vec3 direction = camera.axes.local_from_parent(mirrored(mesh.direction(i)));
    const Vec3 sideways = rays[i].direction.cross(direction);
    EXPECT_LT(sideways.length(), kMeshError * widest_slope) << i;
    EXPECT_GT(rays[i].direction.dot(direction), 0.0) << i;
    EXPECT_LT((start - rays[i].start).cross(rays[i].direction).length(), kMeshError * aside) << i;
  }
}

Camera turned_camera() {
  Camera camera;
  camera.width = 4;
  camera.height = 2;
  camera.position = {3, -2, 5};
  camera.axes = basis_from_zxy({0.3, 0.7, -0.4});
  return camera;
}

TEST(RayMesh, HoldsRaysOfNarrowViewsBehindDeepPlanes) {
  constexpr double kSlope = 5e-4, kDepth = 1e6;
  std::vector<OutgoingRay> rays;
  for (int i = 0; i < 400; ++i) {
    const double right = kSlope * std::sin(i * 1.7), up = kSlope * std::cos(i * 0.9);
    // Bent at about the plane's depth, as masses do that turn rays about themselves.
    rays.push_back({Vec3(right * kDepth, up * kDepth, -kDepth * (1.0 + 1e-5 * std::sin(i * 2.3))),
                    Vec3(right * 0.3, -up * 0.8, -1).normalized(), false});
  }
  Camera camera = turned_camera();
  expect_rays(camera, rays, 1.0, kSlope, kSlope * kDepth);
  expect_rays(camera, rays, 1000.0, kSlope, kSlope * kDepth);
}

TEST(RayMesh, HoldsRaysInAllDirections) {
  std::vector<OutgoingRay> rays;
  for (int i = 0; i < 400; ++i) {
    const Vec3 direction(std::sin(i * 1.1), std::cos(i * 2.3), std::sin(i * 0.7 + 1));
    rays.push_back(
        {Vec3(std::sin(i * 3.1), std::cos(i * 1.3), -20 + std::sin(i * 0.3)), direction.normalized(), false});
  }
  expect_rays(turned_camera(), rays, 1.0, 1.0, 1.0);
}

TEST(RayMesh, RaysWithoutBendsStartAtTheCameraItself) {
  std::vector<OutgoingRay> rays;
  for (int i = 0; i < 50; ++i)
    rays.push_back({Vec3(0), Vec3(0.5 * std::sin(i * 1.7), 0.3 * std::cos(i * 0.9), -1).normalized(), false});
  rays.push_back({});  // without light: any triangle keeps its place
  const Mesh mesh = mesh_of(turned_camera(), rays, 2.0);
  ASSERT_EQ(mesh.corners.size(), 3 * rays.size());
  for (std::size_t i = 0; i + 1 < rays.size(); ++i)
    EXPECT_LT((mirrored(mesh.start(i)) * 2.0 - turned_camera().position).length(), 1e-7);
}

}  // namespace
}  // namespace lensplane
