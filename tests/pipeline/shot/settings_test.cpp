// SPDX-License-Identifier: Apache-2.0

#include "pipeline/shot/settings.h"

#include <gtest/gtest.h>

#include "tests/pipeline/expect_failure.h"

namespace lensplane {
namespace {

YamlNode example() {
  return parse_yaml(
      "camera: {fov: 3 deg}\nlenses:\n  - {name: near, mass: 1 kg}\n  - {name: far, mass: 2 kg}\n", "s");
}

TEST(Settings, ReplaceValuesByKeyNameAndNumber) {
  YamlNode root = example();
  apply_setting("camera.fov=2 deg", root);
  apply_setting("lenses.far.mass=5 Msun", root);
  apply_setting("lenses.0.mass=7 kg", root);
  apply_setting("camera.resolution=[20, 10]", root);
  apply_setting("trace.method=kishi", root);
  EXPECT_EQ(root.find("camera")->find("fov")->text, "2 deg");
  EXPECT_EQ(root.find("lenses")->items[1].find("mass")->text, "5 Msun");
  EXPECT_EQ(root.find("lenses")->items[0].find("mass")->text, "7 kg");
  EXPECT_EQ(root.find("camera")->find("resolution")->items.size(), 2U);
  EXPECT_EQ(root.find("trace")->find("method")->text, "kishi");
  EXPECT_EQ(*root.find("camera")->find("fov")->location.file, "--set camera.fov");
}

TEST(Settings, SayWhatIsWrong) {
  const auto line = [](const std::string& setting) {
    YamlNode root = example();
    return refusal_of([&] { apply_setting(setting, root); }).line;
  };
  EXPECT_EQ(line("camera.fov"),
            "--set \"camera.fov\": no value; write key.path=value, like camera.fov=2 deg");
  EXPECT_EQ(
      line("lenses.middle.mass=1 kg"),
      "--set \"lenses.middle.mass=1 kg\": \"middle\" is neither a name in this list nor a number in it");
  EXPECT_NE(line("=3"), "");
  EXPECT_NE(line("a..b=3"), "");
  EXPECT_NE(line("camera.fov.=3 deg"), "");
  EXPECT_NE(line("camera.fov=[1, 2"), "");
}

}  // namespace
}  // namespace lensplane
