// SPDX-License-Identifier: Apache-2.0

#include "pipeline/shot/camera_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/image/exr_camera.h"
#include "pipeline/image/failure.h"
#include "pipeline/image/frame_path.h"
#include "pipeline/image/shipped.h"
#include "pipeline/shot/quantity.h"
#include "pipeline/shot/shot_scene.h"
#include "src/constants.h"

namespace lensplane {
namespace {

constexpr double kDegree = kPi / 180.0;

/// Frames whose heights for the same width differ by no more are taken for the same.
constexpr double kSameShape = 0.01;

/// The field of view across a side that is `ratio` times as long as the one across which it is `fov`.
double fov_across(double fov, double ratio) {
  return 2.0 * std::atan(std::tan(fov / 2.0) * ratio);
}

/// `angle` turned by whole turns to where it is nearest to `before`.
double nearest_turn(double angle, double before) {
  return angle - 360.0 * std::round((angle - before) / 360.0);
}

void take_keys(const std::vector<ChanKey>& keys, double unit, CameraTrack& camera) {
  Keyed<double> fov{{}, {}, Interpolation::Linear};
  Keyed<Vec3> position{{}, {}, Interpolation::Linear}, angles = position;
  Vec3 turned = keys.front().rotation_deg;
  for (const ChanKey& key : keys) {
    for (unsigned axis = 0; axis < 3; ++axis)
      turned[axis] = nearest_turn(key.rotation_deg[axis], turned[axis]);
    for (auto* frames : {&fov.frames, &position.frames, &angles.frames}) frames->push_back(key.frame);
    position.values.push_back(key.position * unit);
    if (!(length(position.values.back()) <= kLargestQuantity))
      throw Failure(ExitCode::BadInput,
                    fmt::format("frame {}: the camera is {} m away; allowed: up to {}", key.frame,
                                length(position.values.back()), kLargestQuantity));
    angles.values.push_back(turned * kDegree);
    if (!key.vertical_fov_deg) continue;
    const double aspect = static_cast<double>(camera.width) / camera.height;
    const double across = fov_across(*key.vertical_fov_deg * kDegree, aspect);
    if (!(across >= kNarrowestFov && across < kPi))
      throw Failure(
          ExitCode::BadInput,
          fmt::format("frame {}: a field of view of {} rad across; allowed: from 1e-15 to less than pi",
                      key.frame, across));
    fov.values.push_back(across);
  }
  camera.position = position;
  camera.orientation = Rotation{angles};
  if (!fov.values.empty()) camera.fov = fov;
}

void check_frames(const std::vector<int>& frames, const std::vector<ChanKey>& keys, const std::string& path) {
  const double first = keys.front().frame, last = keys.back().frame;
  for (const int frame : frames) {
    if (frame < first || frame > last)
      throw Failure(ExitCode::BadInput, fmt::format("{}: it has frames {} to {}, and the shot frame {}", path,
                                                    first, last, frame));
  }
}

void check_fov(const CameraFile& file, const std::vector<ChanKey>& keys) {
  const std::string path = file.is_plate ? "the plate" : file.path.text;
  const bool has_fov = keys.front().vertical_fov_deg.has_value();
  if (!has_fov && !file.fov_is_given)
    throw Failure(ExitCode::BadInput, path + ": it has no field of view; needed: camera.fov");
  if (has_fov && file.fov_is_given)
    throw Failure(ExitCode::BadInput, path + ": it has a field of view; allowed: no camera.fov beside it");
}

/// ZXY; where x is a quarter turn, y takes all of what y and z could share.
Vec3 zxy_deg_from_basis(const Basis& axes) {
  constexpr double kQuarterTurn = 1e-12;
  const double cos_x = std::hypot(axes.z.x, axes.z.z);
  const double x = std::atan2(-axes.z.y, cos_x);
  if (cos_x < kQuarterTurn) return Vec3(x, std::atan2(-axes.x.z, axes.x.x), 0) / kDegree;
  return Vec3(x, std::atan2(axes.z.x, axes.z.z), std::atan2(axes.x.y, axes.y.y)) / kDegree;
}

/// The plate whose images say where the camera is.
const Layer& plate_of(const Shot& shot, const CameraFile& from) {
  std::vector<const Layer*> plates;
  for (std::size_t k = 0; k < shot.layers.size(); ++k) {
    const Layer& layer = shot.layers[k];
    const bool is_plate = std::holds_alternative<PlateLayer>(layer.kind) && !layer.povray &&
                          layer.image.pattern.text.ends_with(".exr");
    if (is_plate && (!from.plate || from.plate->index == k)) plates.push_back(&layer);
  }
  if (plates.size() == 1) return *plates.front();
  if (from.plate) {
    throw Failure(ExitCode::BadShot, in_quotes(shot.layers[from.plate->index].name) +
                                         " is no plate with EXR images, which would say where the camera is");
  }
  throw Failure(
      ExitCode::BadShot,
      fmt::format("the shot has {} plates with EXR images; allowed: plate where it has one, or {{plate: "
                  "LAYER}}",
                  plates.size()));
}

ChanKey key_of(const ExrCamera& exr, int frame, const CameraTrack& camera, const std::string& path) {
  ChanKey key{static_cast<double>(frame), exr.position, zxy_deg_from_basis(exr.axes), {}};
  if (!exr.half_width_tan) return key;
  const double shape = static_cast<double>(camera.height) / camera.width;
  if (std::abs(exr.height_to_width / shape - 1) > kSameShape)
    throw Failure(
        ExitCode::BadInput,
        fmt::format("{}: its worldToNDC is of a frame {:.4g} times as high as wide, and camera.resolution of "
                    "one {:.4g} times",
                    path, exr.height_to_width, shape));
  key.vertical_fov_deg = 2.0 * std::atan(*exr.half_width_tan * shape) / kDegree;
  return key;
}

std::vector<ChanKey> keys_of_plate(const Shot& shot, const CameraFile& from) {
  const LayerImage& image = plate_of(shot, from).image;
  std::vector<ChanKey> keys;
  std::string before;
  ExrCamera camera;
  for (const int frame : shot.frames) {
    const std::string path = resolve_shipped(path_of_frame(image.pattern.text, frame)).string();
    if (path != before) camera = read_exr_camera(path, image.choice.part);
    before = path;
    keys.push_back(key_of(camera, frame, shot.camera, path));
    if (keys.front().vertical_fov_deg.has_value() != keys.back().vertical_fov_deg.has_value())
      throw Failure(ExitCode::BadInput,
                    path + ": some frames of this plate have a worldToNDC and others have none");
  }
  return keys;
}

}  // namespace

void read_camera_file(Shot& shot) {
  if (!shot.camera.from) return;
  const CameraFile file = *shot.camera.from;
  try {
    const std::vector<ChanKey> keys = file.is_plate ? keys_of_plate(shot, file) : read_chan(file.path.text);
    if (!file.is_plate) check_frames(shot.frames, keys, file.path.text);
    check_fov(file, keys);
    take_keys(keys, file.unit, shot.camera);
  } catch (const Failure& failure) {
    throw Failure(failure.code(), located(file.path.location, file.path.key, failure.what()));
  }
}

std::vector<ChanKey> chan_of_camera(const Shot& shot, const std::vector<int>& frames) {
  std::vector<ChanKey> keys;
  Vec3 turned{0};
  for (const int frame : frames) {
    const Camera camera = scene_at(shot, frame).camera;
    const Vec3 angles = zxy_deg_from_basis(camera.axes);
    for (unsigned axis = 0; axis < 3; ++axis) turned[axis] = nearest_turn(angles[axis], turned[axis]);
    const double aspect = static_cast<double>(camera.width) / camera.height;
    keys.push_back({static_cast<double>(frame), camera.position, turned,
                    fov_across(camera.fov_rad, 1.0 / aspect) / kDegree});
  }
  return keys;
}

}  // namespace lensplane
