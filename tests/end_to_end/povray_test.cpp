// SPDX-License-Identifier: Apache-2.0
//
// Layers that POV-Ray renders, with the real POV-Ray: where things are in its plates, what bent rays see,
// when it runs, and what is said when it fails.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/stat.h>
#include <cmath>

#include "pipeline/image/picture.h"
#include "pipeline/shot/shot_reader.h"
#include "pipeline/shot/shot_scene.h"
#include "src/projection.h"
#include "src/surfaces.h"
#include "tests/end_to_end/read_picture.h"
#include "tests/end_to_end/run_program.h"

namespace lensplane {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kHead =
    "#version 3.7;\nglobal_settings { assumed_gamma 1.0 }\n#include \"lensplane.inc\"\ncamera { "
    "lensplane_camera }\n";
constexpr const char* kGlowing = "pigment { rgb 1 } finish { ambient 0 diffuse 0 emission 1 }";

/// A shot of one POV-Ray layer `set` of the scene set.pov; `rest`: lenses, for example.
std::string shot_of(const std::string& camera, const std::string& layer, const std::string& rest = "") {
  return "lensplane: 1\nshot: pov\nframes: 1-2\ncamera: {resolution: [96, 64], " + camera + "}\n" + rest +
         "\nlayers: [{name: set, type: povray, scene: set.pov, " + layer +
         "}]\noutput: {directory: out, image: {type: float}, review: none}\n";
}

ProgramResult render(const std::filesystem::path& shot, std::vector<std::string> more = {},
                     const std::vector<std::string>& environment = {}) {
  std::vector<std::string> words = {"render", shot.string(), "-f", "1"};
  words.insert(words.end(), more.begin(), more.end());
  return lensplane(words, environment);
}

/// Small glowing balls in the directions (right, up, 1) before the camera.
const std::vector<Vec3> kLandmarks = {
    {0, 0, -1}, {0.4, 0.3, -1}, {-0.5, 0.2, -1}, {0.3, -0.25, -1}, {-0.2, -0.3, -1}};

std::string landmark_scene(const Camera& camera, double unit_m) {
  std::string text = kHead;
  for (const Vec3& landmark : kLandmarks) {
    const Vec3 local = landmark.normalized();
    const Vec3 at = (camera.position + camera.axes.parent_from_local(local) * 1000.0) / unit_m;
    text += "sphere { <" + std::to_string(at.x) + ", " + std::to_string(at.y) + ", " + std::to_string(-at.z) +
            ">, " + std::to_string(2.5 * pixel_angle(camera) * 1000.0 / unit_m) + " " + kGlowing + " }\n";
  }
  return text;
}

/// The middle of the alpha within a few pixels of a place, both counted from the upper left of the frame.
FilmPosition middle_near(const OIIO::ImageBuf& plate, double x, double y) {
  constexpr int kReach = 6;
  double sum = 0, sum_x = 0, sum_y = 0;
  for (int row = static_cast<int>(y) - kReach; row <= static_cast<int>(y) + kReach; ++row) {
    for (int column = static_cast<int>(x) - kReach; column <= static_cast<int>(x) + kReach; ++column) {
      const double alpha = plate.getchannel(column, row, 0, 3);
      sum += alpha, sum_x += alpha * (column + 0.5), sum_y += alpha * (row + 0.5);
    }
  }
  return {sum_x / sum, sum_y / sum};
}

/// How far a landmark may be from where it ought to be, in pixels.
constexpr double kLandmarkError_px = 0.05;

TEST(PovRay, SeesWhatTheShotsCameraSees) {
  for (const std::string camera :
       {"fov: 60 deg, position: [3 m, -2 m, 7 m], rotation: [12 deg, 130 deg, 25 deg]",
        "fov: 75 deg, position: [-40 m, 0 m, 1 m], look_at: [0 m, 300 m, -20 m], overscan: 10",
        "projection: fisheye, fov: 170 deg, rotation: [-30 deg, 200 deg, 5 deg]"}) {
    const TemporaryFolder folder;
    const auto path = folder.write("pov.yaml", shot_of(camera, "unit: 2 m, antialias: 8"));
    const std::string large = "camera.resolution=[480, 320]";  // a ball's middle is not that of its picture
    const Camera seen = scene_at(read_shot(path, {large}), 1).camera;
    folder.write("set.pov", landmark_scene(seen, 2.0));
    const ProgramResult result = render(path, {"--set", large});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const OIIO::ImageBuf plate = read_picture(folder / "out/pov.set.plate.0001.exr");
    EXPECT_EQ(plate.oriented_full_width(), 480);
    for (const Vec3& landmark : kLandmarks) {
      const auto film = *film_from_direction<double>(seen, landmark);
      const FilmPosition found = middle_near(plate, film.x, film.y);
      EXPECT_NEAR(found.x, film.x, kLandmarkError_px) << camera;
      EXPECT_NEAR(found.y, film.y, kLandmarkError_px) << camera;
    }
  }
}

TEST(PovRay, SeesAllAroundTheCamera) {
  const TemporaryFolder folder;
  const auto path = folder.write(
      "pov.yaml", shot_of("fov: 60 deg, position: [3 m, -2 m, 7 m], rotation: [0 deg, 90 deg, 0 deg]",
                          "as: latlong, width: 256, antialias: 4"));
  // To the right of -z in the world, and above.
  folder.write("set.pov", std::string(kHead) + "sphere { <3, -2, -7> + 1000 * vnormalize(<1, 0.5, 1>), 40 " +
                              kGlowing + " }");
  ASSERT_EQ(render(path).err, "");
  const OIIO::ImageBuf plate = read_picture(folder / "out/pov.set.plate.0001.exr");
  ASSERT_EQ(plate.spec().width, 256);
  ASSERT_EQ(plate.spec().height, 128);
  const auto st = st_from_sky_direction(Vec3(1, 0.5, -1));
  const FilmPosition found = middle_near(plate, st.s * 256, (1 - st.t) * 128);
  EXPECT_NEAR(found.x, st.s * 256, kLandmarkError_px);
  EXPECT_NEAR(found.y, (1 - st.t) * 128, 3 * kLandmarkError_px);  // a ball is no disc on a lat-long
}

/// How many pixels of two pictures are not the same, in any channel.
int different(const OIIO::ImageBuf& a, const OIIO::ImageBuf& b) {
  int count = 0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 96; ++x) {
      bool same = true;
      for (int c = 0; c < 4; ++c) same = same && a.getchannel(x, y, 0, c) == b.getchannel(x, y, 0, c);
      count += same ? 0 : 1;
    }
  }
  return count;
}

const std::string kSet = std::string(kHead) + R"(
light_source { <50, 80, 60> rgb 1.2 }
plane { y, -3 pigment { rgb <0.3, 0.5, 0.2> } finish { diffuse 0.8 } }
sphere { <0, 0, 40>, 6 pigment { rgb <0.8, 0.4, 0.2> } finish { diffuse 0.7 reflection 0.2 } }
box { <-20, -3, 50>, <-12, 9, 58> pigment { rgb <0.2, 0.3, 0.8> } rotate 2 * lensplane_frame * y }
)";

TEST(PovRay, BentRaysThatNothingBendsAreItsOwnCamera) {
  const TemporaryFolder folder;
  folder.write("set.pov", kSet);
  const auto path =
      folder.write("pov.yaml", shot_of("fov: 50 deg, position: [1 m, 2 m, 0 m]", "as: bent, antialias: 1",
                                       "lenses: [{name: a, mass: 0 kg, position: [0 m, 0 m, -20 m]}]"));
  const auto picture = [&](const std::vector<std::string>& settings, const char* out) {
    std::vector<std::string> words = {"--output", (folder / out).string()};
    for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
    EXPECT_EQ(render(path, words).err, "");
    return read_picture(folder / (std::string(out) + "/pov.set.plate.0001.exr"));
  };
  const OIIO::ImageBuf plate = picture({"layers.set.as=plate"}, "plate");
  EXPECT_EQ(different(picture({}, "bent"), plate), 0);
  // Through the mesh of rays: its normals are single floats, and a pixel in some thousands falls on the other
  // side of an edge, or of a step between two half floats.
  constexpr int kFlips = 6;  // of 6144
  const OIIO::ImageBuf mesh = picture({"lenses.a.mass=1 kg", "trace={law: weak}"}, "mesh");
  EXPECT_LE(different(mesh, plate), kFlips);
}

TEST(PovRay, BentRaysAgreeWithPlatesOfWhatIsFar) {
  // By as: plate pixels are filtered twice, on POV-Ray's film and on ours.
  constexpr double kMean = 0.004, kMost = 0.06;
  const TemporaryFolder folder;
  folder.write(
      "set.pov",
      std::string(kHead) +
          "sky_sphere { pigment { function { 0.5 + 0.25 * sin(25 * x) + 0.25 * sin(31 * y) } color_map "
          "{ [0 rgb <0.1, 0.2, 0.9>] [1 rgb <0.9, 0.5, 0.1>] } } }");
  const auto path =
      folder.write("pov.yaml", shot_of("fov: 50 deg", "as: bent, antialias: 3",
                                       "lenses: [{name: a, radius: 5 cm, position: [2 m, 1 m, -20 m]}]"));
  ASSERT_EQ(render(path).err, "");
  ASSERT_EQ(
      render(path, {"--set", "layers.set={name: set, type: povray, scene: set.pov, as: latlong, width: 1024}",
                    "--output", (folder / "sky").string()})
          .err,
      "");
  const OIIO::ImageBuf bent = read_picture(folder / "out/pov.0001.exr"),
                       sky = read_picture(folder / "sky/pov.0001.exr");
  double sum = 0;
  int counted = 0;
  const double hole_x = 48 + 0.1 * 96 / (2 * std::tan(25 * M_PI / 180)),
               hole_y = 32 - 0.05 * 96 / (2 * std::tan(25 * M_PI / 180));
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 96; ++x) {
      if (std::hypot(x + 0.5 - hole_x, y + 0.5 - hole_y) < 8)
        continue;  // light from all around, many times smaller
      const double apart = std::abs(bent.getchannel(x, y, 0, 0) - sky.getchannel(x, y, 0, 0));
      EXPECT_LT(apart, kMost) << x << " " << y;
      sum += apart, ++counted;
    }
  }
  EXPECT_LT(sum / counted, kMean);
}

TEST(PovRay, BentRaysSeeWhatStandsBeforeBetweenAndBehindMasses) {
  const TemporaryFolder folder;
  folder.write("set.pov", std::string(kHead) + R"(
#declare Glow = finish { ambient 0 diffuse 0 emission 1 }
sphere { <-3, 0, 10>, 0.8 pigment { rgb <1, 0, 0> } finish { Glow } }
sphere { <4, 2, 25>, 1 pigment { rgb <0, 1, 0> } finish { Glow } }
sphere { <0, 0, 500>, 200 pigment { rgb <0, 0, 1> } finish { Glow } })");
  const auto path =
      folder.write("pov.yaml", shot_of("fov: 50 deg", "as: bent, antialias: 1",
                                       "lenses: [{name: a, radius: 20 cm, position: [0 m, 0 m, -20 m]}, "
                                       "{name: b, radius: 1 mm, position: [5 m, -5 m, -30 m]}]"));
  ASSERT_EQ(render(path).err, "");
  const OIIO::ImageBuf plate = read_picture(folder / "out/pov.set.plate.0001.exr");
  const double focal = 48 / std::tan(25 * M_PI / 180);
  const auto expect = [&](double right, double up, const Rgba& colour, const char* what) {
    const int x = static_cast<int>(48 + right * focal), y = static_cast<int>(32 - up * focal);
    for (int c = 0; c < 4; ++c)
      EXPECT_NEAR(plate.getchannel(x, y, 0, c), colour[c], 1e-3) << what << " " << c;
  };
  expect(-0.3, 0.0, {1, 0, 0, 1}, "straight, before the first mass");
  expect(0.0, 0.0, {0, 0, 0, 0}, "the shadow");
  expect(0.08, 0.08, {0, 0, 1, 1}, "behind both");
  // Between the masses things are seen by light that the first has bent: farther out.
  const Shot shot = read_shot(path, {});
  double green_x = 0, green = 0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 48; x < 96; ++x) {
      const double g = plate.getchannel(x, y, 0, 1);
      green += g, green_x += g * (x + 0.5);
    }
  }
  ASSERT_GT(green, 3);
  EXPECT_GT(green_x / green, 48 + 4.0 / 25 * focal + 1.0);
}

TEST(PovRay, RendersNothingTwice) {
  const TemporaryFolder folder;
  folder.write("set.pov", kSet);
  folder.write("still.pov", std::string(kHead) + "sphere { <0, 0, 40>, 6 " + kGlowing + " }");
  const auto path = folder.write("pov.yaml", shot_of("fov: 50 deg", "antialias: 1"));
  const auto both = [&](const std::vector<std::string>& more = {}) {
    std::vector<std::string> words = {"render", path.string()};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult result = lensplane(words);
    EXPECT_EQ(result.err, "");
    return result.out;
  };
  EXPECT_THAT(both(), HasSubstr("0002: set rendered by POV-Ray"));
  const std::string first = contents_of(folder / "out/pov.set.plate.0001.exr");
  EXPECT_NE(first, contents_of(folder / "out/pov.set.plate.0002.exr")) << "the box turns";
  EXPECT_THAT(both(), HasSubstr("0001: set rendered already"));
  // What the scene does not ask for does not matter; what it is made of does, and what is broken.
  EXPECT_THAT(both({"--set", "lenses=[{name: b, mass: 0 kg, position: [1 m, 2 m, -30 m]}]"}),
              Not(HasSubstr("rendered by POV-Ray")));
  folder.write("out/pov.set.plate.0001.exr", first.substr(0, first.size() / 2));
  EXPECT_THAT(both(), testing::AllOf(HasSubstr("0001: set rendered by POV-Ray"),
                                     HasSubstr("0002: set rendered already")));
  EXPECT_EQ(contents_of(folder / "out/pov.set.plate.0001.exr"), first);
  folder.write("set.pov", kSet + "// changed\n");
  EXPECT_THAT(both(), HasSubstr("0001: set rendered by POV-Ray"));
  EXPECT_THAT(both({"--redo"}), HasSubstr("0001: set rendered by POV-Ray"));
  // Frames in which nothing is different.
  const std::string still = both({"--set", "layers.set.scene=still.pov"});
  EXPECT_THAT(still, HasSubstr("0002: set is as in another frame"));
  EXPECT_EQ(contents_of(folder / "out/pov.set.plate.0001.exr"),
            contents_of(folder / "out/pov.set.plate.0002.exr"));
  for (const auto& file : std::filesystem::directory_iterator(folder / "out"))
    EXPECT_TRUE(file.is_regular_file()) << file.path() << " was left behind";
}

TEST(PovRay, RendersAsMuchMoreThanTheFrameAsIsSeen) {
  const TemporaryFolder folder;
  folder.write("set.pov", kSet);
  const auto path =
      folder.write("pov.yaml", shot_of("fov: 50 deg", "antialias: 1",
                                       "lenses: [{name: a, radius: 2 cm, position: [8 m, 0 m, -20 m]}]"));
  const ProgramResult result = render(path);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("pixels more on each side"));
  const OIIO::ImageBuf plate = read_picture(folder / "out/pov.set.plate.0001.exr");
  EXPECT_GT(plate.spec().width, 98);
  EXPECT_EQ(plate.spec().x, -(plate.spec().width - 96) / 2);
  EXPECT_EQ(plate.spec().get_string_attribute("colorInteropID"), "lin_rec709_scene");
  ASSERT_EQ(render(path, {"--set", "lenses.a.radius=0 m", "--output", (folder / "straight").string()}).err,
            "");
  EXPECT_EQ(read_picture(folder / "straight/pov.set.plate.0001.exr").spec().width, 96);
}

/// A program `povray` of our own, in a folder that comes first in $PATH.
std::string path_with(const TemporaryFolder& folder, const std::string& script) {
  std::filesystem::create_directories(folder / "bin");
  const auto program = folder.write("bin/povray", "#!/bin/sh\n" + script);
  ::chmod(program.c_str(), 0755);
  return "PATH=" + (folder / "bin").string() + ":/usr/bin:/bin";
}

void expect_refusal(const TemporaryFolder& folder, const ProgramResult& result, int code,
                    const std::string& reason) {
  EXPECT_EQ(result.exit_code, code) << reason;
  EXPECT_THAT(result.err, HasSubstr(reason));
  EXPECT_THAT(result.err, HasSubstr("layers.set.scene: "));
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  std::error_code error;
  for (std::filesystem::recursive_directory_iterator file(folder / "out", error), end; file != end; ++file)
    ADD_FAILURE() << file->path() << " was left behind: " << reason;
}

TEST(PovRay, SaysWhatIsWrongWithAScene) {
  const TemporaryFolder folder;
  const auto path = folder.write("pov.yaml", shot_of("fov: 50 deg", "antialias: 1"));
  expect_refusal(folder, render(path), 2, "set.pov: no such scene");
  folder.write("set.pov", std::string(kHead) + "sphere { <0, 0, 40>, 6 pigment { rgb 1 }\nbox {");
  expect_refusal(folder, render(path), 2, "set.pov' line 6: Parse Error: No matching }");
  folder.write("set.pov", std::string(kHead) + "#include \"nowhere.inc\"");
  expect_refusal(folder, render(path), 2, "include file nowhere.inc");
  folder.write("set.pov", "#version 3.7; camera { location 0 }");
  expect_refusal(folder, render(path), 2, "assumed_gamma 1.0");
  folder.write("set.pov", kSet);
  folder.write("file", "");
  const ProgramResult unwritable = render(path, {"--output", (folder / "file/x").string()});
  EXPECT_EQ(unwritable.exit_code, 3) << unwritable.err;
  EXPECT_EQ(lensplane({"check", path.string()}).exit_code, 0) << "check needs no POV-Ray";
}

TEST(PovRay, SaysWhatIsWrongWithPovRay) {
  const TemporaryFolder folder;
  folder.write("set.pov", kSet);
  const auto path = folder.write("pov.yaml", shot_of("fov: 50 deg", "antialias: 1"));
  expect_refusal(folder, render(path, {}, {"PATH=/nowhere"}), 2, "povray: no such program");
  const auto with = [&](const std::string& script, const char* timeout = "10 min") {
    return render(path, {"--set", std::string("layers.set.timeout=") + timeout}, {path_with(folder, script)});
  };
  expect_refusal(folder, with("echo 'POV-Ray 3.6.1' >&2"), 2, "version 3.6.1; needed: POV-Ray 3.7 or later");
  expect_refusal(folder, with("echo hello >&2"), 2, "does not say its version");
  const std::string right =
      "[ \"$1\" = --version ] && { echo 'POV-Ray 3.7.0 x' >&2; exit 0; }\necho 'at work' >&2\n";
  expect_refusal(folder, with(right + "sleep 100", "2 s"), 2,
                 "made no progress for 2 s and was ended; its last words: at work");
  expect_refusal(folder,
                 with(right + "while true; do echo 'Rendered 5 of 9 pixels' >&2; sleep 0.1; done", "2 s"), 2,
                 "made no progress");
  expect_refusal(folder, with(right + "kill -KILL $$"), 2, "was ended by signal 9; its last words: at work");
  expect_refusal(folder, with(right + "exit 1"), 2, "POV-Ray says: at work");
  expect_refusal(folder, with(right + "exit 0"), 2, "POV-Ray's picture cannot be read");
  expect_refusal(folder, with(right + "echo half > picture.exr"), 2, "POV-Ray's picture cannot be read");
}

TEST(PovRay, IsEndedWhenLensplaneIs) {
  const TemporaryFolder folder, files;
  folder.write("set.pov", kSet);
  const auto path = folder.write("pov.yaml", shot_of("fov: 50 deg", "antialias: 1"));
  const std::string search =
      path_with(folder, "[ \"$1\" = --version ] && { echo 'POV-Ray 3.7.0 x' >&2; exit 0; }\necho $$ > " +
                            (folder / "process").string() + "\nexec sleep 100");
  const pid_t program =
      start_program({LENSPLANE_PROGRAM, "render", path.string(), "-f", "1"}, files, {search});
  while (contents_of(folder / "process").empty()) ::usleep(20000);
  ::kill(program, SIGTERM);
  const ProgramResult result = wait_for(program, files);
  EXPECT_EQ(result.exit_code, 75) << result.err;
  EXPECT_THAT(result.err, HasSubstr("interrupted"));
  EXPECT_NE(::kill(std::stoi(contents_of(folder / "process")), 0), 0) << "it goes on";
}

}  // namespace
}  // namespace lensplane
