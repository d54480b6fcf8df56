// SPDX-License-Identifier: Apache-2.0

#include "pipeline/shot/yaml_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "tests/pipeline/expect_failure.h"
#include "tests/pipeline/temporary_folder.h"

namespace lensplane {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string line_for(const std::string& text) {
  const Refusal refusal = refusal_of([&] { parse_yaml(text, "shot.yaml"); });
  if (!refusal.line.empty()) {
    EXPECT_EQ(refusal.code, ExitCode::BadShot);
  }
  EXPECT_EQ(refusal.line.find('\n'), std::string::npos);
  return refusal.line;
}

TEST(YamlTree, KnowsWhereEveryKeyAndValueStands) {
  const YamlNode root = parse_yaml("a: 1\nb:\n  - x\n  - {c: \"y z\"}\n", "shot.yaml");
  ASSERT_EQ(root.keys.size(), 2U);
  EXPECT_EQ(root.keys[1].name, "b");
  EXPECT_EQ(root.keys[1].location.line, 2);
  EXPECT_EQ(*root.keys[1].location.file, "shot.yaml");
  const YamlNode* b = root.find("b");
  ASSERT_TRUE(b);
  EXPECT_EQ(b->items[0].text, "x");
  EXPECT_EQ(b->items[0].location.line, 3);
  EXPECT_EQ(b->items[0].location.column, 5);
  EXPECT_EQ(b->items[1].find("c")->text, "y z");
  EXPECT_EQ(root.find("none"), nullptr);
}

TEST(YamlTree, AliasesStandForWhatTheyName) {
  const YamlNode root = parse_yaml("a: &m {mass: 3 kg}\nb: *m\n", "shot.yaml");
  EXPECT_EQ(root.find("b")->find("mass")->text, "3 kg");
}

TEST(YamlTree, RefusesWhatNoShotIs) {
  EXPECT_EQ(line_for("a: 1\nb: 2\na: 3\n"), "shot.yaml:3:1: a: this key stands here twice");
  EXPECT_EQ(line_for(""), "shot.yaml:1:1: the file is empty");
  EXPECT_THAT(line_for("a: [1, 2\nb: 3"), HasSubstr("not valid YAML"));
  EXPECT_THAT(line_for("a: 1\n---\nb: 2\n"), HasSubstr("second YAML document"));
  EXPECT_THAT(line_for("[1, 2]: 3\n"), HasSubstr("a key has to be plain text"));
  EXPECT_THAT(line_for("a: !!python/object 3\n"), HasSubstr("tag"));
  EXPECT_THAT(line_for("a: *nothing\n"), StartsWith("shot.yaml:1:"));
  EXPECT_EQ(line_for(std::string("a: 1\nb: \0 2\n", 11)),
            "shot.yaml:2:4: byte 0x00: a shot is plain UTF-8 text");
  EXPECT_EQ(line_for("a: \xff\xfe\n"), "shot.yaml:1:4: byte 0xff: a shot is plain UTF-8 text");
  EXPECT_EQ(line_for("a: caf\xc3\xa9\n"), "");
}

/// Seconds until `text` is refused.
double seconds_to_refuse(const std::string& text) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_NE(line_for(text), "") << text.substr(0, 40);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Not a measurement: a hundred times what it takes, far below what exponential growth would.
constexpr double kQuickly = 20;

TEST(YamlTree, HostileTextEndsQuickly) {
  std::string bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 20; ++i) {
    bomb += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [";
    for (int k = 0; k < 10; ++k) bomb += (k ? ", *a" : "*a") + std::to_string(i - 1);
    bomb += "]\n";
  }
  EXPECT_LT(seconds_to_refuse(bomb), kQuickly);
  EXPECT_THAT(line_for(bomb), HasSubstr("more than 500000 values"));

  // The same with few values but much text, and with anchors around anchors.
  std::string heavy = "a: &a \"" + std::string(20000, 'x') + "\"\nb: [";
  for (int i = 0; i < 20000; ++i) heavy += "*a, ";
  EXPECT_LT(seconds_to_refuse(heavy + "]"), kQuickly);
  std::string nested;
  for (int i = 0; i < 28; ++i) nested += "- &n" + std::to_string(i) + " ";
  for (int i = 0; i < 100000; ++i) nested += i ? ", x" : "- [x";
  EXPECT_LT(seconds_to_refuse(nested + "]"), kQuickly);

  EXPECT_LT(seconds_to_refuse(std::string(10000, '[')), kQuickly);
  EXPECT_LT(seconds_to_refuse("a: " + std::string(10000, '{')), kQuickly);
  std::string block;
  for (int i = 0; i < 2000; ++i) block += std::string(static_cast<std::size_t>(i), ' ') + "a:\n";
  EXPECT_LT(seconds_to_refuse(block), kQuickly);
  EXPECT_THAT(line_for(block), HasSubstr("nested more than 32 levels deep"));
  std::string dashes;
  for (int i = 0; i < 10000; ++i) dashes += "- ";
  EXPECT_LT(seconds_to_refuse(dashes), kQuickly);
  EXPECT_LT(seconds_to_refuse("a: \"" + std::string(1 << 22, 'x')), kQuickly);
  EXPECT_LT(seconds_to_refuse("a: &b [*b]"), kQuickly);
}

TEST(YamlTree, HugeAndOddFilesAreRefusedByName) {
  const TemporaryFolder folder;
  const auto huge = folder.write("huge.yaml", "");
  std::filesystem::resize_file(huge, 1ULL << 30);  // a hole of 1 GiB
  const Refusal large = refusal_of([&] { read_yaml(huge); });
  EXPECT_EQ(large.code, ExitCode::BadShot);
  EXPECT_EQ(large.line, huge.string() + ":1:1: the file is larger than 4 MiB; is it a shot?");

  const Refusal missing = refusal_of([&] { read_yaml(folder / "none.yaml"); });
  EXPECT_EQ(missing.code, ExitCode::BadInput);
  EXPECT_EQ(missing.line, (folder / "none.yaml").string() + ": no such shot file");
  EXPECT_EQ(refusal_of([&] { read_yaml(folder.path()); }).code, ExitCode::BadInput);
  EXPECT_EQ(refusal_of([&] { read_yaml("/dev/zero"); }).code, ExitCode::BadInput);
  const auto empty = folder.write("void.yaml", "");
  const Refusal nothing = refusal_of([&] { read_yaml(empty); });
  EXPECT_EQ(nothing.code, ExitCode::BadShot);
  EXPECT_EQ(nothing.line, empty.string() + ":1:1: the file is empty");
}

}  // namespace
}  // namespace lensplane
