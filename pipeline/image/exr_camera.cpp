// SPDX-License-Identifier: Apache-2.0

#include "pipeline/image/exr_camera.h"

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <fmt/format.h>

#include <cmath>

#include "pipeline/image/failure.h"

namespace lensplane {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& reason) {
  throw Failure(ExitCode::BadInput, fmt::format("{}: {}", path.string(), reason));
}

struct Matrices {
  Imath::M44d camera;
  std::optional<Imath::M44d> ndc;
};

std::optional<Imath::M44d> matrix_of(const Imf::Header& header, const char* name) {
  if (const auto* single = header.findTypedAttribute<Imf::M44fAttribute>(name))
    return Imath::M44d(single->value());
  if (const auto* exact = header.findTypedAttribute<Imf::M44dAttribute>(name)) return exact->value();
  return std::nullopt;
}

int part_of(const std::filesystem::path& path, const Imf::MultiPartInputFile& file, const std::string& part) {
  if (part.empty()) return 0;
  for (int i = 0; i < file.parts(); ++i) {
    const Imf::Header& header = file.header(i);
    if (std::to_string(i) == part || (header.hasName() && header.name() == part)) return i;
  }
  refuse(path, fmt::format("it has no part \"{}\"", part));
}

Matrices read_matrices(const std::filesystem::path& path, const std::string& part) try {
  Imf::MultiPartInputFile file(path.c_str());
  const Imf::Header& header = file.header(part_of(path, file, part));
  const auto camera = matrix_of(header, "worldToCamera");
  if (!camera) refuse(path, "its header has no worldToCamera; needed: an EXR whose renderer wrote it");
  return {*camera, matrix_of(header, "worldToNDC")};
} catch (const Failure&) {
  throw;
} catch (const std::exception& error) {
  refuse(path, fmt::format("cannot be read as an EXR: {}", error.what()));
}

/// Columns of the matrix are the camera's axes in the world.
ExrCamera camera_from(const std::filesystem::path& path, const Imath::M44d& m) {
  const auto column = [&m](int j) { return Vec3(m[0][j], m[1][j], m[2][j]); };
  const Basis columns{column(0), column(1), column(2)};
  double error = std::abs(m[3][3] - 1);
  for (int i = 0; i < 3; ++i) error = std::max(error, std::abs(m[i][3]));
  const Vec3 axes[] = {columns.x, columns.y, columns.z};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) error = std::max(error, std::abs(axes[i].dot(axes[j]) - (i == j ? 1 : 0)));
    if (!std::isfinite(m[3][i])) error = std::numeric_limits<double>::infinity();
  }
  if (!(error <= kCameraMatrixError))
    refuse(
        path,
        "its worldToCamera is no rotation and shift; allowed: a matrix without scale, shear or projection");
  ExrCamera camera;
  camera.position = -(columns.x * m[3][0] + columns.y * m[3][1] + columns.z * m[3][2]);
  // float32 is not quite orthonormal.
  const Vec3 x = columns.x.normalized();
  const Vec3 y = (columns.y - x * x.dot(columns.y)).normalized();
  camera.axes = {x, y, x.cross(y)};
  return camera;
}

/// The field of view from the projection that leads from camera space to NDC.
void add_projection(const std::filesystem::path& path, const Matrices& matrices, ExrCamera& camera) {
  const Imath::M44d projection = matrices.camera.inverse() * *matrices.ndc;
  const bool looks_along_z = matrices.camera.determinant() < 0;
  const double forward = looks_along_z ? 1 : -1;
  const double w = forward * projection[2][3];
  const double across = projection[0][0] / w, up = projection[1][1] / w;
  const auto where_axis_is = [&](int j) { return forward * projection[2][j] / w + 0.0; };  // no -0
  const auto is_near = [](double a, double b) { return std::abs(a - b) <= 1e-3; };
  const bool is_perspective =
      w > 0 && std::abs(across) > 0 && std::abs(up) > 0 && std::isfinite(across) && std::isfinite(up);
  if (!is_perspective) refuse(path, "its worldToNDC is no perspective; allowed: one, or none and camera.fov");
  double half = 0;  // of the picture
  if (is_near(where_axis_is(0), 0) && is_near(where_axis_is(1), 0)) half = 1;
  if (is_near(where_axis_is(0), 0.5) && is_near(where_axis_is(1), 0.5)) half = 0.5;
  if (half == 0) {
    refuse(path,
           fmt::format("its worldToNDC has the camera's axis at ({:.4g}, {:.4g}); allowed: the middle of the "
                       "frame, (0, 0) or (0.5, 0.5)",
                       where_axis_is(0), where_axis_is(1)));
  }
  camera.half_width_tan = half / std::abs(across);
  camera.height_to_width = std::abs(across / up);
}

}  // namespace

ExrCamera read_exr_camera(const std::filesystem::path& path, const std::string& part) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) refuse(path, "no such image");
  const Matrices matrices = read_matrices(path, part);
  ExrCamera camera = camera_from(path, matrices.camera);
  if (matrices.ndc) add_projection(path, matrices, camera);
  return camera;
}

}  // namespace lensplane
