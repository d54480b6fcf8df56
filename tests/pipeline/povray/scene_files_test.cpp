// SPDX-License-Identifier: Apache-2.0

#include "pipeline/povray/scene_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/pipeline/expect_failure.h"
#include "tests/pipeline/temporary_folder.h"

namespace lensplane {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string kRight =
    "#version 3.7; global_settings { assumed_gamma 1.0 }\n#include \"lensplane.inc\"\ncamera { "
    "lensplane_camera }\n";

TEST(SceneFiles, AreWhatASceneNames) {
  const TemporaryFolder folder;
  folder.write("parts.inc", "#include \"more/deep.inc\" // #include \"no.inc\"\n");
  folder.write("no.inc", "");
  folder.write("picture.png", "x");
  std::filesystem::create_directories(folder / "more");
  folder.write("more/deep.inc", "pigment { image_map { png \"picture.png\" } } // lensplane_frame");
  const auto scene = folder.write(
      "scene.pov", kRight + "#include \"parts.inc\" #include \"colors.inc\" /* a /* b */ lensplane_time */");
  const SceneFiles files = read_scene_files(scene);
  EXPECT_THAT(files.files,
              ElementsAre(folder / "more/deep.inc", folder / "parts.inc", folder / "picture.png", scene));
  EXPECT_TRUE(files.complete);
  EXPECT_TRUE(files.says("image_map"));
  EXPECT_TRUE(files.says("lensplane_camera"));
  EXPECT_FALSE(files.says("lensplane_time")) << "in a comment";
  EXPECT_FALSE(files.says("lensplane_frame")) << "in a comment";
  EXPECT_FALSE(files.says("camer")) << "part of a word";
}

TEST(SceneFiles, AreNotAllKnownWhereNamesAreMadeUp) {
  EXPECT_TRUE(parse_scene_text("#include \"a.inc\"").complete);
  EXPECT_TRUE(parse_scene_text("#include\n \"a.inc\"").quotes.front().included);
  EXPECT_FALSE(parse_scene_text("#include concat(\"a\", \".inc\")").complete);
  EXPECT_FALSE(parse_scene_text("image_map { png \"a.png\" }").quotes.front().included);
  EXPECT_EQ(parse_scene_text("a \"b // \\\" /*\" c /* open").code, "a \"\" c  ");
}

TEST(SceneFiles, RefuseScenesWhosePictureCouldNotBeUsed) {
  const TemporaryFolder folder;
  const auto line = [&](const std::string& text) {
    const auto scene = folder.write("s.pov", text);
    return refusal_of([&] { read_scene_files(scene); });
  };
  EXPECT_EQ(line(kRight).line, "");
  const char* gammas[] = {
      "#version 3.7; #include \"lensplane.inc\" camera { lensplane_camera }",
      "#version 3.7; global_settings { assumed_gamma 2.2 } camera { lensplane_camera }",
      "#version 3.7; global_settings { assumed_gamma 1.8 } camera { lensplane_camera }",
      "#version 3.7; // global_settings { assumed_gamma 1.0 }\ncamera { lensplane_camera }",
      "#version 3.6; global_settings { assumed_gamma 1.0 } camera { lensplane_camera }",
      "global_settings { assumed_gamma 1.0 } camera { lensplane_camera }"};
  for (const char* text : gammas) {
    EXPECT_THAT(line(text).line, HasSubstr("write: #version 3.7; global_settings { assumed_gamma 1.0 }"))
        << text;
    EXPECT_EQ(line(text).code, ExitCode::BadInput);
  }
  EXPECT_THAT(line("#version 3.7; global_settings { assumed_gamma 1 } camera { location 0 }").line,
              HasSubstr("write: #include \"lensplane.inc\" camera { lensplane_camera }"));
  const Refusal missing = refusal_of([&] { read_scene_files(folder / "none.pov"); });
  EXPECT_EQ(missing.line, (folder / "none.pov").string() + ": no such scene");
}

}  // namespace
}  // namespace lensplane
