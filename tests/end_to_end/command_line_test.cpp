// SPDX-License-Identifier: Apache-2.0
//
// The program as its users meet it: commands, exit codes, what is written and what is not.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "pipeline/image/exr_writer.h"
#include "tests/end_to_end/run_program.h"

namespace lensplane {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const std::string kScenes = LENSPLANE_SOURCE_DIR "/scenes/";

/// A small shot of the Earth, its texture taken from the project, two frames.
const std::string kSmallShot = R"(lensplane: 1
shot: small
frames: 1001-1002
camera: {resolution: [60, 40], fov: 3 deg}
lenses:
  - {name: near, mass: 1.989e31 kg, position: [1e6 m, 0 m, -4.36e8 m]}
layers:
  - name: earth
    type: sphere
    centre: [0 m, 0 m, -1.09e9 m]
    radius: 6371 km
    image: lensplane:textures/earth_night.jpg
trace: {method: shinotsuka-makino}
output: {directory: out}
)";

std::map<std::string, std::string> files_of(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    if (!file.is_regular_file()) continue;
    files[file.path().filename().string()] = contents_of(file.path());
  }
  return files;
}

std::vector<std::string> names_of(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& [name, text] : files_of(folder)) names.push_back(name);
  return names;
}

void expect_refused(const ProgramResult& result, int exit_code, const std::string& reason) {
  EXPECT_EQ(result.exit_code, exit_code) << result.err;
  EXPECT_THAT(result.err, HasSubstr(reason));
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
}

TEST(CommandLine, HelpAndVersion) {
  const ProgramResult help = lensplane({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out, HasSubstr("Examples:"));
  EXPECT_THAT(help.out, HasSubstr("render"));
  EXPECT_THAT(lensplane({"render", "--help"}).out, HasSubstr("--proxy"));
  EXPECT_EQ(lensplane({"--version"}).out, "lensplane 0.1.0\n");
}

TEST(CommandLine, WrongCommandLinesAreExitOne) {
  expect_refused(lensplane({}), 1, "see lensplane --help");
  expect_refused(lensplane({"paint", "x.yaml"}), 1, "lensplane: ");
  expect_refused(lensplane({"render"}), 1, "SHOT");
  expect_refused(lensplane({"render", "x.yaml", "--proxy", "0"}), 1, "--proxy");
  expect_refused(lensplane({"render", "x.yaml", "--threads", "many"}), 1, "--threads");
  expect_refused(lensplane({"render", kScenes + "seed-fig5.yaml", "-f", "9-1"}), 1,
                 "-f: \"9-1\" ends before it starts");
}

TEST(CommandLine, CheckReadsNoImage) {
  const TemporaryFolder folder;
  std::string text = kSmallShot;
  text.replace(text.find("lensplane:textures/earth_night.jpg"), 34, "there_is_no_such_image.jpg");
  const auto shot = folder.write("small.yaml", text).string();
  const ProgramResult result = lensplane({"check", shot});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, shot + ": right: 2 frames of 60 x 40, 1 lens, 1 layer\n");
  EXPECT_EQ(names_of(folder.path()), std::vector<std::string>{"small.yaml"});
  expect_refused(lensplane({"render", shot}), 2, "there_is_no_such_image.jpg: no such image");
}

TEST(CommandLine, ShippedScenesAreRight) {
  int checked = 0;
  for (const auto& scene : std::filesystem::directory_iterator(kScenes)) {
    if (scene.path().extension() != ".yaml") continue;
    ++checked;
    EXPECT_EQ(lensplane({"check", scene.path().string()}).exit_code, 0) << scene.path();
  }
  EXPECT_GE(checked, 5);
}

TEST(CommandLine, MistakesAreLocatedAndMissingFilesAreExitTwo) {
  const TemporaryFolder folder;
  const auto shot = folder.write("small.yaml", kSmallShot).string();
  expect_refused(lensplane({"check", shot, "--set", "camera.fov=3 m"}), 1,
                 "--set camera.fov:1:1: camera.fov: \"3 m\" is a");
  expect_refused(lensplane({"check", (folder / "none.yaml").string()}), 2, "none.yaml: no such shot file");
  expect_refused(lensplane({"check", shot}, {"OCIO=/nowhere.ocio"}), 2,
                 "/nowhere.ocio: the OCIO config that $OCIO names");
  expect_refused(lensplane({"check", shot, "--set", "colour.config=none.ocio"}), 2,
                 "none.ocio: the OCIO config");
  expect_refused(lensplane({"render", shot, "--set", "colour.view=None"}), 1,
                 "colour.view: \"None\" is no view");
}

TEST(CommandLine, RenderWritesMapsPictureAndReview) {
  const TemporaryFolder folder;
  const auto shot = folder.write("small.yaml", kSmallShot).string();
  const ProgramResult result = lensplane({"render", shot, "--stats", (folder / "stats.json").string()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, StartsWith("1001: "));
  EXPECT_THAT(result.out, HasSubstr("A(earth) = "));
  EXPECT_EQ(
      names_of(folder / "out"),
      (std::vector<std::string>{"small.1001.exr", "small.1002.exr", "small.earth.map.1001.exr",
                                "small.earth.map.1002.exr", "small.review.1001.png", "small.review.1002.png",
                                "small.shadow.1001.exr", "small.shadow.1002.exr"}));
  const auto stats = nlohmann::json::parse(contents_of(folder / "stats.json"));
  EXPECT_EQ(stats["frames"].size(), 2U);
  EXPECT_GT(stats["frames"][0]["amplification"]["earth"].get<double>(), 1.0);
  EXPECT_GT(stats["phases"]["write"]["bytes"].get<int>(), 1000);
}

TEST(CommandLine, FilesCarryNoPathsNamesOrDates) {
  const TemporaryFolder folder;
  const auto shot = folder.write("small.yaml", kSmallShot).string();
  ASSERT_EQ(lensplane({"render", shot, "-f", "1001"}).exit_code, 0);
  std::array<char, 256> host{};
  ASSERT_EQ(::gethostname(host.data(), host.size()), 0);
  for (const auto& [name, text] : files_of(folder / "out")) {
    EXPECT_EQ(text.find(folder.path().string()), std::string::npos) << name;
    for (const char* date : {"capDate", "DateTime", "tIME"})
      EXPECT_EQ(text.find(date), std::string::npos) << name;
    EXPECT_EQ(text.find(host.data()), std::string::npos) << name;
    EXPECT_EQ(text.find("textures/"), std::string::npos) << name;
  }
}

TEST(CommandLine, SameBytesForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  const auto shot = folder.write("small.yaml", kSmallShot).string();
  for (const char* threads : {"1", "2", "7"}) {
    ASSERT_EQ(
        lensplane({"render", shot, "--threads", threads, "--output", (folder / threads).string()}).exit_code,
        0);
  }
  EXPECT_EQ(files_of(folder / "1"), files_of(folder / "2"));
  EXPECT_EQ(files_of(folder / "1"), files_of(folder / "7"));
}

TEST(CommandLine, MapWritesOnlyMaps) {
  const TemporaryFolder folder;
  const auto shot = folder.write("small.yaml", kSmallShot).string();
  ASSERT_EQ(lensplane({"map", shot, "-f", "1002", "--quiet"}).exit_code, 0);
  EXPECT_EQ(names_of(folder / "out"),
            (std::vector<std::string>{"small.earth.map.1002.exr", "small.shadow.1002.exr"}));
}

TEST(CommandLine, SecondRunSkipsWhatIsDoneAndRedoesWhatIsNot) {
  const TemporaryFolder folder;
  const auto shot = folder.write("small.yaml", kSmallShot).string();
  lensplane({"render", shot});
  const auto files = files_of(folder / "out");
  const auto map_time = std::filesystem::last_write_time(folder / "out/small.earth.map.1001.exr");
  const std::string second = lensplane({"render", shot}).out;
  EXPECT_THAT(second, HasSubstr("1001: already done, A(earth) = "));
  EXPECT_THAT(second, HasSubstr("1002: already done"));
  // A file that is cut off and one that is missing are made again, the same; what is right stays as it is.
  std::filesystem::resize_file(folder / "out/small.1001.exr", 700);
  std::filesystem::remove(folder / "out/small.review.1002.png");
  EXPECT_EQ(lensplane({"render", shot}).out.find("already done"), std::string::npos);
  EXPECT_EQ(files_of(folder / "out"), files);
  EXPECT_EQ(std::filesystem::last_write_time(folder / "out/small.earth.map.1001.exr"), map_time);
}

TEST(CommandLine, EveryChangeOfWhatIsSeenIsRenderedAnew) {
  const TemporaryFolder folder;
  folder.write("night.ppm", "P3 2 1 255  9 8 7  1 2 3");
  folder.write("day.ppm", "P3 2 1 255  99 80 70  10 20 30");
  const std::string shipped = "lensplane:textures/earth_night.jpg";
  std::string text = kSmallShot;
  const auto shot =
      folder.write("small.yaml", text.replace(text.find(shipped), shipped.size(), "night.ppm")).string();
  const std::vector<std::string> render = {"render", shot, "-f", "1001"};
  ASSERT_EQ(lensplane(render).exit_code, 0);
  for (const char* change :
       {"lenses.near.mass=2e31 kg", "lenses.near.position=[1e6 m, 1 m, -4.36e8 m]",
        "camera.resolution=[60, 42]", "camera.fov=3.01 deg", "camera.overscan=2",
        "camera.rotation=[0.1 deg, 0 deg, 0 deg]", "fps=25", "trace.method=kishi",
        "layers.earth.radius=6372 km", "layers.earth.centre=[1 m, 0 m, -1.09e9 m]",
        "layers.earth.rotation=[0 deg, 1 deg, 0 deg]", "layers.earth.light=[0, 0, 1]",
        "layers.earth.image=day.ppm", "layers.earth.image={file: night.ppm, space: ACES2065-1}",
        "output.image={type: float}", "output.image={compression: piz}", "output.locator=beside",
        "colour.view=Un-tone-mapped", "colour.working=ACES2065-1"}) {
    auto words = render;
    words.insert(words.end(), {"--set", change});
    const ProgramResult changed = lensplane(words);
    EXPECT_EQ(changed.exit_code, 0) << change << changed.err;
    EXPECT_EQ(changed.out.find("already done"), std::string::npos) << change;
    EXPECT_EQ(lensplane(render).out.find("already done"), std::string::npos) << change;  // and back
  }
}

TEST(CommandLine, ProxiesDoNotOverwriteTheFramesThatTheyAreOf) {
  const TemporaryFolder folder;
  const auto shot = folder.write("small.yaml", kSmallShot).string();
  ASSERT_EQ(lensplane({"render", shot}).exit_code, 0);
  const auto files = files_of(folder / "out");
  ASSERT_EQ(lensplane({"render", shot, "--proxy", "2"}).exit_code, 0);
  auto with_folder = files_of(folder / "out/proxy2");
  EXPECT_EQ(with_folder.size(), files.size());
  EXPECT_THAT(lensplane({"render", shot}).out, HasSubstr("already done"));
}

TEST(CommandLine, InputsAndDevicesAreNeverOverwritten) {
  const TemporaryFolder folder;
  const auto shot = folder.write("small.yaml", kSmallShot).string();
  const auto plate = folder.write("bg.1001.exr", "a plate").string();
  const auto with_plate = [&](const std::string& name) {
    return lensplane({"render", shot, "-f", "1001", "--output", folder.path().string(), "--set",
                      "shot=" + name, "--set",
                      "layers.earth={name: earth, type: plate, image: bg.####.exr}"});
  };
  expect_refused(with_plate("bg"), 1, "bg.1001.exr: the shot reads this file and would overwrite it");
  EXPECT_EQ(contents_of(plate), "a plate");
  expect_refused(lensplane({"render", shot, "--stats", shot}), 1,
                 "the shot reads this file and --stats would overwrite it");
  expect_refused(lensplane({"render", shot, "--stats", (folder / "out/small.1001.exr").string()}), 1,
                 "the shot writes");
  expect_refused(lensplane({"render", shot, "--quiet", "--stats", (folder.path()).string()}), 3,
                 "it is not a file");
}

TEST(CommandLine, LostOutputIsAnError) {
  const TemporaryFolder folder;
  const auto shot = folder.write("small.yaml", kSmallShot).string();
  const TemporaryFolder streams;
  std::filesystem::create_symlink("/dev/full", streams / "out");
  EXPECT_EQ(exit_code_of(start_program({LENSPLANE_PROGRAM, "check", shot}, streams)), 3);
  EXPECT_THAT(contents_of(streams / "err"), HasSubstr("standard output: cannot be written"));
  // With nowhere to say what is wrong the exit code still does.
  const TemporaryFolder deaf;
  std::filesystem::create_symlink("/dev/full", deaf / "err");
  EXPECT_EQ(exit_code_of(start_program({LENSPLANE_PROGRAM, "check", "none.yaml"}, deaf)), 2);
}

TEST(CommandLine, BadPixelsStayWhereTheyAre) {
  // A plate with a pixel that is no number and one that is infinite.
  const TemporaryFolder folder;
  std::vector<float> samples(16 * 16, 0.5F);
  samples[40] = std::numeric_limits<float>::quiet_NaN();
  samples[200] = std::numeric_limits<float>::infinity();
  write_exr(folder / "bad.exr", {16, 16, 0},
            {{"R", samples.data()}, {"G", samples.data()}, {"B", samples.data()}},
            {PixelType::Float, ExrCompression::Zip}, {});
  const auto shot = folder.write("small.yaml", kSmallShot).string();
  ASSERT_EQ(lensplane({"render", shot, "-f", "1001", "--set", "output.image={type: float}", "--set",
                       "layers.earth={name: earth, type: plate, image: bad.exr}"})
                .err,
            "");
  const ProgramResult stats = run_program({"oiiotool", "--stats", (folder / "out/small.1001.exr").string()});
  EXPECT_THAT(stats.out, HasSubstr("Stats NanCount: 0 0 0 0"));
  EXPECT_THAT(stats.out, HasSubstr("Stats InfCount: 0 0 0 0"));
}

TEST(CommandLine, MapOfAShotWithoutMapsIsRefused) {
  const TemporaryFolder folder;
  const auto shot = folder.write("small.yaml", kSmallShot).string();
  expect_refused(lensplane({"map", shot, "--set", "output.maps=none"}), 1, "nothing to do");
}

TEST(CommandLine, UnwritableOutputIsExitThree) {
  const TemporaryFolder folder;
  const auto shot = folder.write("small.yaml", kSmallShot).string();
  folder.write("file", "in the way");
  expect_refused(lensplane({"render", shot, "--quiet", "--output", (folder / "file/out").string()}), 3,
                 "cannot be written");
}

TEST(CommandLine, InterruptedRunIsExit75AndGoesOnLater) {
  const TemporaryFolder folder, output;
  const auto shot = folder.write("small.yaml", kSmallShot).string();
  const std::vector<std::string> words = {
      LENSPLANE_PROGRAM, "render", shot, "-f", "1001-9000", "--set", "camera.resolution=[200, 200]"};
  const pid_t process = start_program(words, output);
  const auto first_frame = folder / "out/small.1001.exr";
  for (int i = 0; i < 600 && !std::filesystem::exists(first_frame); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  ::kill(process, SIGTERM);
  const ProgramResult result = wait_for(process, output);
  expect_refused(result, 75, "the same command goes on from there");
  for (const std::string& name : names_of(folder / "out"))
    EXPECT_EQ(name.find(".part"), std::string::npos) << name;
  const ProgramResult again =
      lensplane({"render", shot, "-f", "1001", "--set", "camera.resolution=[200, 200]"});
  EXPECT_THAT(again.out, HasSubstr("1001: already done"));
}

}  // namespace
}  // namespace lensplane
