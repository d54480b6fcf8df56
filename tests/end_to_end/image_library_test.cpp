// SPDX-License-Identifier: Apache-2.0
//
// The library that OpenImageIO is used by: when the program loads it, and what it says when it cannot.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/end_to_end/run_program.h"

namespace lensplane {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kShot = R"(lensplane: 1
shot: small
frames: 1
camera: {resolution: [16, 16], fov: 3 deg}
lenses: [{name: a, mass: 1.989e31 kg, position: [0 m, 0 m, -4.36e8 m]}]
layers: [{name: earth, type: sphere, centre: [0 m, 0 m, -1.09e9 m], radius: 6371 km, image: "lensplane:textures/rings.png"}]
output: {directory: out, review: none}
)";

TEST(ImageLibrary, IsLoadedOnlyWhereThereAreImages) {
  const TemporaryFolder folder;
  const std::string shot = folder.write("small.yaml", kShot).string();
  const auto libraries_of = [](const std::vector<std::string>& words) {
    const ProgramResult result = lensplane(words, {"LD_DEBUG=files"});
    EXPECT_EQ(result.exit_code, 0) << words[0];
    return result.err;
  };
  for (const char* command : {"check", "plan", "map"}) {
    EXPECT_THAT(libraries_of({command, shot}), Not(HasSubstr("libOpenImageIO.so"))) << command;
  }
  EXPECT_THAT(libraries_of({"--version"}), Not(HasSubstr("libOpenImageIO.so")));
  EXPECT_THAT(libraries_of({"render", shot}), HasSubstr("libOpenImageIO.so"));
}

/// The program, installed by hand, its library being whatever `library` is.
TEST(ImageLibrary, SaysWhatIsWrongInOneLine) {
  const TemporaryFolder folder;
  const std::string shot = folder.write("small.yaml", kShot).string();
  for (const char* name : {"bin", "lib/lensplane", "share/lensplane/textures"})
    std::filesystem::create_directories(folder / name);
  std::filesystem::copy_file(LENSPLANE_PROGRAM, folder / "bin/lensplane");
  std::filesystem::copy_file(LENSPLANE_SOURCE_DIR "/textures/rings.png",
                             folder / "share/lensplane/textures/rings.png");
  const std::string library = (folder / "lib/lensplane/liblensplane_oiio.so").string();
  const auto expect = [&](const std::string& reason) {
    const ProgramResult result = run_program({(folder / "bin/lensplane").string(), "render", shot});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, HasSubstr(library + ": " + reason));
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "out/small.0001.exr"));
  };
  expect("cannot be loaded: cannot open");
  folder.write("lib/lensplane/liblensplane_oiio.so", "no library");
  expect("cannot be loaded: file too short");
  std::filesystem::copy_file("/lib/x86_64-linux-gnu/libz.so.1", library,
                             std::filesystem::copy_options::overwrite_existing);
  expect("it is not lensplane's image library");
}

}  // namespace
}  // namespace lensplane
