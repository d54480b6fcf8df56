// SPDX-License-Identifier: Apache-2.0
//
// Cameras that a plate's EXR headers say, in all the ways in which renderers write them.

#include <Imath/ImathMatrix.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfOutputFile.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/shot/shot_reader.h"
#include "pipeline/shot/shot_scene.h"
#include "src/constants.h"
#include "tests/pipeline/expect_failure.h"
#include "tests/pipeline/temporary_folder.h"

namespace lensplane {
namespace {

using testing::HasSubstr;

using Matrix = Imath::M44f;

/// An EXR of one pixel, with these matrices in its header.
void write_exr(const std::filesystem::path& path, const std::optional<Matrix>& camera,
               const std::optional<Matrix>& ndc) {
  Imf::Header header(1, 1);
  header.channels().insert("R", Imf::Channel(Imf::FLOAT));
  if (camera) header.insert("worldToCamera", Imf::M44fAttribute(*camera));
  if (ndc) header.insert("worldToNDC", Imf::M44fAttribute(*ndc));
  float pixel = 0;
  Imf::FrameBuffer frame;
  frame.insert("R", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(&pixel), sizeof(float), sizeof(float)));
  Imf::OutputFile file(path.c_str(), header);
  file.setFrameBuffer(frame);
  file.writePixels(1);
}

// At (1, 2, 3), turned by a quarter about y: it looks along -x, and its right is -z.
const Matrix kTurned(0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, 3, -2, -1, 1);

/// The same camera in a space of the other hand, which looks along its +z.
const Matrix kLeftHanded = kTurned * Matrix(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1);

/// To a frame twice as wide as high, of which half the width is seen under the tangent 0.5; from -1 to 1, y
/// up.
const Matrix kScreen(2, 0, 0, 0, 0, 4, 0, 0, 0, 0, -1, -1, 0, 0, -1, 0);

/// The same from 0 to 1, y down, from a space that looks along +z.
const Matrix kNdcOfLeftHanded(1, 0, 0, 0, 0, -2, 0, 0, 0.5, 0.5, 1, 1, 0, 0, -1, 0);

struct PlateShot {
  TemporaryFolder folder;
  std::filesystem::path file;

  explicit PlateShot(const std::string& camera, const std::string& layers = {}) {
    file = folder.write("shot.yaml",
                        "lensplane: 1\nshot: tracked\nframes: 1-2\ncamera:\n  resolution: [200, 100]\n  " +
                            camera + "\nlayers:\n  - {name: bg, type: plate, image: bg.####.exr}\n" + layers);
  }
  void frames(const std::optional<Matrix>& camera, const std::optional<Matrix>& ndc) const {
    for (const char* name : {"bg.0001.exr", "bg.0002.exr"}) write_exr(folder / name, camera, ndc);
  }
  Shot shot() const { return read_shot(file); }
  std::string refusal(ExitCode code = ExitCode::BadInput) const {
    const auto refused = refusal_of([&] { shot(); });
    EXPECT_TRUE(refused.line.empty() || refused.code == code) << refused.line;
    return refused.line;
  }
};

void expect_turned(const Camera& camera) {
  EXPECT_LT(length(camera.position - Vec3(1, 2, 3)), 1e-6);
  EXPECT_LT(length(camera.axes.parent_from_local({0, 0, -1}) - Vec3(-1, 0, 0)), 1e-6);
  EXPECT_LT(length(camera.axes.x - Vec3(0, 0, -1)), 1e-6);
  EXPECT_LT(length(camera.axes.y - Vec3(0, 1, 0)), 1e-6);
}

TEST(PlateCamera, BothHandsAndBothKindsOfNdcSayTheSame) {
  const PlateShot plate("from: plate");
  const std::pair<Matrix, Matrix> kinds[] = {{kTurned, kTurned * kScreen},
                                             {kLeftHanded, kLeftHanded * kNdcOfLeftHanded}};
  for (const auto& [camera, ndc] : kinds) {
    plate.frames(camera, ndc);
    const Camera seen = scene_at(plate.shot(), 2).camera;
    expect_turned(seen);
    EXPECT_NEAR(seen.fov_rad, 2 * std::atan(0.5), 1e-6);
  }
}

TEST(PlateCamera, WithoutNdcTheShotSaysTheFieldOfView) {
  const PlateShot plate("from: {plate: bg, unit: 1 km}\n  fov: 3 deg",
                        "  - {name: other, type: plate, image: other.exr}\n");
  plate.frames(kTurned, {});
  const Camera camera = scene_at(plate.shot(), 1).camera;
  EXPECT_LT(length(camera.position - Vec3(1000, 2000, 3000)), 1e-3);
  EXPECT_NEAR(camera.fov_rad, 3 * kPi / 180, 1e-15);
}

TEST(PlateCamera, RefusesWhatSaysNoCamera) {
  const PlateShot plate("from: plate"), given("from: plate\n  fov: 3 deg");
  EXPECT_THAT(plate.refusal(), HasSubstr("bg.0001.exr: no such image"));
  EXPECT_THAT(plate.refusal(), HasSubstr(":6:9: camera.from: "));
  plate.frames({}, {});
  EXPECT_THAT(plate.refusal(), HasSubstr("bg.0001.exr: its header has no worldToCamera"));
  plate.frames(kTurned, {});
  EXPECT_THAT(plate.refusal(), HasSubstr("it has no field of view; needed: camera.fov"));
  given.frames(kTurned, kTurned * kScreen);
  EXPECT_THAT(given.refusal(), HasSubstr("it has a field of view; allowed: no camera.fov beside it"));
  plate.frames(kTurned * 1.01F, {});
  EXPECT_THAT(plate.refusal(), HasSubstr("its worldToCamera is no rotation and shift"));
  const Matrix shifted = kScreen * Matrix(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.25, 0, 0, 1);
  plate.frames(kTurned, kTurned * shifted);
  EXPECT_THAT(plate.refusal(), HasSubstr("has the camera's axis at (0.25, 0)"));
  plate.frames(kTurned, kTurned);
  EXPECT_THAT(plate.refusal(), HasSubstr("its worldToNDC is no perspective"));
  const Matrix square(2, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1, -1, 0, 0, -1, 0);
  plate.frames(kTurned, kTurned * square);
  EXPECT_THAT(plate.refusal(), HasSubstr("of a frame 1 times as high as wide"));
  plate.frames(kTurned, kTurned * kScreen);
  EXPECT_EQ(plate.refusal(), "");
  write_exr(plate.folder / "bg.0002.exr", kTurned, {});
  EXPECT_THAT(plate.refusal(), HasSubstr("some frames of this plate have a worldToNDC"));
  plate.folder.write("bg.0001.exr", "no picture");
  EXPECT_THAT(plate.refusal(), HasSubstr("cannot be read as an EXR"));
}

TEST(PlateCamera, RefusesLayersThatCannotSayIt) {
  const std::string more =
      "  - {name: other, type: plate, image: other.exr}\n  - {name: sky, type: latlong, "
      "image: sky.exr}\n";
  const auto refusal = [&](const std::string& camera) {
    return PlateShot(camera, more).refusal(ExitCode::BadShot);
  };
  EXPECT_THAT(refusal("from: plate"), HasSubstr("the shot has 2 plates with EXR images"));
  EXPECT_THAT(refusal("from: {plate: sky}"), HasSubstr("\"sky\" is no plate with EXR images"));
  EXPECT_THAT(refusal("from: {plate: none}"),
              HasSubstr("camera.from.plate: \"none\" is no layer of this shot"));
  EXPECT_THAT(refusal("from: {plate: bg, file: a.chan}"), HasSubstr("given together with file"));
  EXPECT_THAT(refusal("from: {unit: 1 m}"), HasSubstr("camera.from.file"));
}

}  // namespace
}  // namespace lensplane
