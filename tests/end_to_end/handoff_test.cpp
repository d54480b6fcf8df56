// SPDX-License-Identifier: Apache-2.0
//
// lensplane export --to nuke, blender, oiio: what other programs make of a shot's maps is what lensplane comp
// makes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/end_to_end/read_picture.h"
#include "tests/end_to_end/run_program.h"

namespace lensplane {
namespace {

using testing::HasSubstr;

constexpr int kWidth = 96, kHeight = 64, kOverscan = 4;

// What filters explain: st_warp looks one point up bilinearly and Map UV filters by differences, where
// lensplane filters by the Jacobian and keeps a texel's sharpness. Of pictures that change slowly all show
// the same but for two pixels along the card's edge, 8.5 % of all, those that the mass shrinks, and, by
// differences, the globe's outline. Mirrored, upside down or with another gamma more than half of all pixels
// would be off by more than this.
constexpr double kSameColour = 0.01;
constexpr double kMostDiffer = 0.1;  // share of pixels
constexpr double kMeanDifference = 0.003;

/// A picture that tells left from right and up from down, and changes slowly, with so much overscan beyond
/// its display window. `file` says how it is stored.
void write_smooth(const std::filesystem::path& file, int width, int height, bool with_alpha,
                  int overscan = 0) {
  OIIO::ImageSpec spec(width + 2 * overscan, height + 2 * overscan, with_alpha ? 4 : 3,
                       OIIO::TypeDesc::FLOAT);
  spec.x = spec.y = -overscan;
  spec.full_width = width;
  spec.full_height = height;
  OIIO::ImageBuf image(spec);
  for (int y = -overscan; y < height + overscan; ++y) {
    for (int x = -overscan; x < width + overscan; ++x) {
      const float u = (static_cast<float>(x) + 0.5F) / static_cast<float>(width),
                  v = (static_cast<float>(y) + 0.5F) / static_cast<float>(height);
      const float pixel[] = {0.2F + 0.6F * u, 0.2F + 0.6F * v,
                             0.5F + 0.3F * static_cast<float>(std::sin(3 * u + 2 * v)), 0.3F + 0.4F * u};
      image.setpixel(x, y, pixel);
    }
  }
  if (with_alpha) image.specmod().attribute("oiio:UnassociatedAlpha", 1);
  ASSERT_TRUE(image.write(file.string())) << image.geterror();
}

/// The alpha of a smooth picture that fills the frame, at a column of the frame.
double veil_alpha(int column) {
  return 0.3 + 0.4 * (column + 0.5) / kWidth;
}

/// A mass, a plate behind it, a card that is half transparent, and a globe in front; the globe goes behind
/// the card at frame 2.
struct HandedShot {
  TemporaryFolder folder;
  std::filesystem::path file;

  HandedShot() {
    write_smooth(folder / "bg.exr", 240, 160, false, 16);
    write_smooth(folder / "veil.png", 120, 80, true);
    write_smooth(folder / "globe.png", 120, 60, false);
    file = folder.write("hand.yaml", R"(lensplane: 1
shot: hand
frames: 1-2
camera: {resolution: [96, 64], fov: 4 deg, overscan: 4}
lenses: [{name: hole, mass: 3000 Msun, position: [4e9 m, 2e9 m, -5e11 m]}]
layers:
  - {name: globe, type: sphere, centre: {keys: {1: [-8e9 m, 3e9 m, -3e11 m], 2: [-8e9 m, 3e9 m, -5e11 m]}}, radius: 4e9 m, image: globe.png}
  - {name: bg, type: plate, image: bg.exr, edge: clamp}
  - {name: veil, type: plate, image: veil.png, distance: 4e11 m}
output: {directory: out, image: {type: float}, review: none}
)");
  }
  std::filesystem::path out(const std::string& name) const { return folder / ("out/" + name); }
  ProgramResult run(const std::string& command, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {command, file.string()};
    words.insert(words.end(), more.begin(), more.end());
    return lensplane(words);
  }
};

struct Difference {
  double share = 1;  // of the pixels that differ by more than kSameColour
  double mean = 1;   // of all channels
};

/// Overscan included.
Difference difference(const std::filesystem::path& ours, const std::filesystem::path& theirs) {
  const OIIO::ImageBuf a = read_picture(ours), b = read_picture(theirs);
  const int width = kWidth + 2 * kOverscan, height = kHeight + 2 * kOverscan;
  EXPECT_EQ(b.spec().width, width);
  EXPECT_EQ(b.spec().height, height);
  if (b.spec().width != width || b.spec().height != height) return {};
  int differ = 0;
  double sum = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      double most = 0;
      for (int c = 0; c < 4; ++c) {
        const double by = std::abs(a.getchannel(a.spec().x + x, a.spec().y + y, 0, c) -
                                   b.getchannel(b.spec().x + x, b.spec().y + y, 0, c));
        sum += by;
        most = std::max(most, by);
      }
      if (!(most <= kSameColour)) ++differ;
    }
  }
  const double pixels = width * height;
  return {differ / pixels, sum / (4 * pixels)};
}

void run_commands(const HandedShot& shot, std::size_t frames = 2) {
  const auto list = nlohmann::json::parse(contents_of(shot.out("hand.oiio.json")));
  ASSERT_EQ(list["frames"].size(), frames);
  for (const auto& frame : list["frames"]) {
    for (const auto& command : frame["commands"]) {
      std::vector<std::string> words = {"env", "-C", shot.out("").string()};
      for (const auto& word : command) words.push_back(word);
      const ProgramResult result = run_program(words);
      ASSERT_EQ(result.exit_code, 0) << result.err;
    }
  }
}

TEST(Handoff, OiiotoolMakesOurPicture) {
  const HandedShot shot;
  ASSERT_EQ(shot.run("map", {"--quiet"}).err, "");
  const ProgramResult exported = shot.run("export", {"--to", "oiio"});
  EXPECT_EQ(exported.exit_code, 0) << exported.err;
  EXPECT_EQ(exported.out,
            "left out: what is seen of veil through itself\n" + shot.out("hand.oiio.json").string() + "\n");
  run_commands(shot);
  ASSERT_EQ(shot.run("comp", {"--quiet"}).err, "");
  for (const char* frame : {"0001", "0002"}) {
    const auto theirs = shot.out(std::string("hand.oiio.") + frame + ".exr");
    const Difference by = difference(shot.out(std::string("hand.") + frame + ".exr"), theirs);
    EXPECT_LT(by.share, kMostDiffer) << frame;
    EXPECT_LT(by.mean, kMeanDifference) << frame;
    const OIIO::ImageBuf picture = read_picture(theirs);
    EXPECT_EQ(picture.spec().x, -kOverscan);
    EXPECT_EQ(picture.spec().full_width, kWidth);
    EXPECT_EQ(picture.spec().get_string_attribute("colorInteropID"), "lin_ap1_scene");
    EXPECT_EQ(picture.spec().get_string_attribute("Software"), "");
  }
  // The globe went behind the card: the frames are not the same.
  EXPECT_GT(difference(shot.out("hand.0001.exr"), shot.out("hand.0002.exr")).mean, 2 * kMeanDifference);
}

TEST(Handoff, BlenderMakesOurPicture) {
  if (run_program({"env", "blender", "--version"}).exit_code != 0) GTEST_SKIP() << "there is no blender";
  const HandedShot shot;
  ASSERT_EQ(shot.run("map", {"--quiet"}).err, "");
  const auto scripts = shot.folder / "scripts";
  const ProgramResult exported = shot.run("export", {"--to", "blender", "--output", scripts.string()});
  EXPECT_EQ(exported.exit_code, 0) << exported.err;
  EXPECT_THAT(exported.out, HasSubstr("depth order of the layers changes at frame 2; the script has that of "
                                      "frame 1"));
  const ProgramResult made =
      run_program({"blender", "--background", "--factory-startup", "--python-exit-code", "1", "--python",
                   (scripts / "hand.blender.py").string(), "-a"});
  ASSERT_EQ(made.exit_code, 0) << made.out << made.err;
  ASSERT_EQ(shot.run("comp", {"--quiet"}).err, "");
  const Difference by = difference(shot.out("hand.0001.exr"), scripts / "hand.blender.0001.exr");
  EXPECT_LT(by.share, kMostDiffer);
  EXPECT_LT(by.mean, kMeanDifference);
  EXPECT_TRUE(std::filesystem::exists(scripts / "hand.blender.0002.exr"));
}

/// A node of a Nuke script: its class and its knobs, as they are written.
struct NukeNode {
  std::string kind;
  std::map<std::string, std::string> knobs;
};

/// Reads what the scripts consist of: nodes with a knob in each line, and commands for the stack. Ends the
/// test where braces or quotes are not closed.
std::vector<NukeNode> read_nuke(const std::string& script) {
  std::vector<NukeNode> nodes;
  std::istringstream lines(script);
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    const auto unquoted = [](const std::string& text) {
      bool open = false;
      for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\\') {
          ++i;
        } else if (text[i] == '"') {
          open = !open;
        }
      }
      return !open;
    };
    for (std::string more; !unquoted(line) && std::getline(lines, more);) line += "\n" + more;
    EXPECT_TRUE(unquoted(line)) << line;
    const std::size_t space = line.find(' ', inside ? 1 : 0);
    if (line == "}") {
      EXPECT_TRUE(inside);
      inside = false;
    } else if (inside) {
      EXPECT_EQ(line[0], ' ') << line;
      nodes.back().knobs[line.substr(1, space - 1)] = line.substr(space + 1);
    } else if (line.ends_with(" {")) {
      nodes.push_back({line.substr(0, space), {}});
      inside = true;
    } else if (!line.starts_with('#') && !line.starts_with("version ")) {
      nodes.push_back({line, {}});
    }
  }
  EXPECT_FALSE(inside);
  return nodes;
}

/// What a node is made from, written as KIND(INPUT0, INPUT1), by playing the script on a stack as Nuke does.
std::string graph_of(const std::vector<NukeNode>& nodes) {
  std::vector<std::string> stack;
  std::map<std::string, std::string> kept;
  for (const NukeNode& node : nodes) {
    if (node.kind == "Root" || node.kind == "StickyNote") continue;
    if (node.kind.starts_with("set ")) {
      kept[node.kind.substr(4, node.kind.find(' ', 4) - 4)] = stack.back();
      continue;
    }
    if (node.kind.starts_with("push $")) {
      stack.push_back(kept.at(node.kind.substr(6)));
      continue;
    }
    const auto knob = node.knobs.find("inputs");
    const int inputs = knob == node.knobs.end() ? 1 : std::stoi(knob->second);
    std::string text = node.kind == "Read" ? node.knobs.at("name") : node.kind;
    if (node.kind == "Merge2") text = node.knobs.at("operation");
    for (int i = 0; i < inputs; ++i) {
      if (stack.empty()) return "an empty stack before " + text;
      text += (i == 0 ? "(" : ", ") + stack.back();
      stack.pop_back();
    }
    stack.push_back(inputs > 0 ? text + ")" : text);
  }
  return stack.size() == 1 ? stack.back() : std::to_string(stack.size()) + " nodes are left";
}

TEST(Handoff, NukeLaysLayersOverOneAnotherByTheirMaps) {
  const HandedShot shot;
  const ProgramResult exported = shot.run("export", {"--to", "nuke", "--set", "layers.bg.edge=mirror"});
  EXPECT_EQ(exported.exit_code, 0) << exported.err;
  const auto nodes = read_nuke(contents_of(shot.out("hand.nk")));
  // Input 0 of STMap is the image; of a merge it is B, what lies below, and what a mask keeps.
  EXPECT_EQ(
      graph_of(nodes),
      "Write(Clamp(plus(Shuffle(shadow), over(mask(STMap(image_bg, Expression(map_bg)), Shuffle(map_bg)), "
      "over(mask(STMap(BlackOutside(Premult(image_veil)), map_veil), Shuffle(map_veil)), "
      "mask(STMap(image_globe, map_globe), Shuffle(map_globe)))))))");
  for (const NukeNode& node : nodes) {
    if (node.kind == "Root") {
      EXPECT_EQ(node.knobs.at("project_directory"), "\"\\[python \\{nuke.script_directory()\\}]\"");
      EXPECT_EQ(node.knobs.at("first_frame") + node.knobs.at("last_frame") + node.knobs.at("fps"), "1224");
      EXPECT_EQ(node.knobs.at("format"), "\"96 64 0 0 96 64 1 lensplane_hand\"");
    }
    if (node.kind == "STMap") {
      EXPECT_EQ(node.knobs.at("channels") + " " + node.knobs.at("uv"), "rgba rgb");
    }
    if (node.kind != "Read") continue;
    const bool is_map = node.knobs.at("name").starts_with("map_") || node.knobs.at("name") == "shadow";
    EXPECT_EQ(node.knobs.contains("raw"), is_map);
    EXPECT_EQ(node.knobs.contains("auto_alpha"), !is_map && node.knobs.at("name") != "image_veil");
    if (node.knobs.at("name") == "map_bg") {
      EXPECT_EQ(node.knobs.at("file"), "\"hand.bg.map.####.exr\"");
    }
    if (node.knobs.at("name") == "image_bg") {
      EXPECT_EQ(node.knobs.at("file"), "\"../bg.exr\"");
    }
  }
}

TEST(Handoff, ShadowsAreAsOpaqueAsInOurPicture) {
  const HandedShot shot;
  struct Case {
    const char *shadow, *veil;  // the half-transparent card stands before the hole, or behind it
    float alpha;
  };
  for (const Case& c :
       {Case{"opaque", "6e11 m", 1}, Case{"opaque", "4e11 m", 1}, Case{"transparent", "6e11 m", 0}}) {
    SCOPED_TRACE(std::string(c.shadow) + " " + c.veil);
    // Without an opaque background, so that alpha tells; the shadow has a radius of 10 pixels.
    const std::vector<std::string> settings = {"--set", "lenses.hole.mass=500000 Msun",
                                               "--set", "layers.bg.image=veil.png",
                                               "-f",    "1",
                                               "--set", std::string("trace.shadow=") + c.shadow,
                                               "--set", std::string("layers.veil.distance=") + c.veil};
    const auto run = [&](const char* command, std::vector<std::string> more) {
      more.insert(more.end(), settings.begin(), settings.end());
      ASSERT_EQ(shot.run(command, more).err, "");
    };
    run("render", {"--quiet"});
    const OIIO::ImageBuf rendered = read_picture(shot.out("hand.0001.exr"));
    run("comp", {"--quiet"});
    run("export", {"--to", "oiio"});
    run_commands(shot, 1);
    const OIIO::ImageBuf composed = read_picture(shot.out("hand.0001.exr")),
                         theirs = read_picture(shot.out("hand.oiio.0001.exr"));
    const int x = 59, y = 26;
    for (const OIIO::ImageBuf* picture : {&rendered, &composed, &theirs})
      EXPECT_NEAR(picture->getchannel(x, y, 0, 3), c.alpha, 1e-6);
    for (const OIIO::ImageBuf* picture : {&rendered, &composed}) {
      ASSERT_EQ(picture->spec().channelindex("lensing.shadow"), 4);
      const bool covered = c.veil == std::string("4e11 m");
      EXPECT_NEAR(picture->getchannel(x, y, 0, 4), covered ? 1 - veil_alpha(x) : 1, 0.01);
      double most = 0;
      for (int row = 0; row < kHeight; ++row) {
        for (int column = 0; column < kWidth; ++column)
          most = std::max<double>(most, picture->getchannel(column, row, 0, 3));
      }
      EXPECT_LE(most, 1 + 1e-6);
    }
  }
}

TEST(Handoff, ExposuresMultiplyTheSameEverywhere) {
  const HandedShot shot;
  const auto run = [&](const char* command, std::vector<std::string> more) {
    for (const char* word : {"-f", "1", "--set", "layers.veil.exposure={keys: {1: 1, 2: 3}}"})
      more.push_back(word);
    ASSERT_EQ(shot.run(command, more).err, "");
  };
  run("render", {"--quiet"});
  const OIIO::ImageBuf plain = read_picture(shot.out("hand.0001.exr"));
  const std::vector<std::string> camera = {"--set", "camera.exposure=-2"};
  run("render", {"--quiet", camera[0], camera[1]});
  const OIIO::ImageBuf darker = read_picture(shot.out("hand.0001.exr"));
  for (int x = 0; x < kWidth; x += 5) {
    for (int c = 0; c < 4; ++c)
      EXPECT_EQ(darker.getchannel(x, 20, 0, c), plain.getchannel(x, 20, 0, c) * (c < 3 ? 0.25F : 1.0F));
  }
  run("comp", {"--quiet", camera[0], camera[1]});
  run("export", {"--to", "oiio", camera[0], camera[1]});
  run_commands(shot, 1);
  const Difference by = difference(shot.out("hand.0001.exr"), shot.out("hand.oiio.0001.exr"));
  EXPECT_LT(by.share, kMostDiffer);
  EXPECT_LT(by.mean, kMeanDifference);
  run("export", {"--to", "nuke", camera[0], camera[1]});
  for (const NukeNode& node : read_nuke(contents_of(shot.out("hand.nk")))) {
    if (node.kind == "Multiply") {
      EXPECT_EQ(node.knobs.at("value"),
                node.knobs.at("name") == "exposure_veil" ? "{{curve x1 0.5}}" : "{{curve x1 0.25}}");
    }
  }
}

TEST(Handoff, SaysWhatOthersLeaveOut) {
  const HandedShot shot;
  const ProgramResult exported = shot.run(
      "export", {"--to", "oiio", "--set", "layers.globe.light=[0, 0, 1]", "--set",
                 "camera.glow={strength: 0.1, radius: 2 %}", "--set",
                 "camera.shutter={open: -0.25, close: 0.25, samples: 4}", "--set", "layers.bg.edge=repeat"});
  EXPECT_EQ(exported.exit_code, 0) << exported.err;
  EXPECT_THAT(exported.out,
              HasSubstr("left out: the light on globe, what is seen of veil through itself, glow, "
                        "motion blur, what lies outside of bg (its outermost pixels go on)\n"));
}

TEST(Handoff, RefusesInOneLine) {
  const HandedShot shot;
  const auto expect = [&](std::vector<std::string> words, int code, const std::string& reason) {
    const ProgramResult result = shot.run("export", words);
    EXPECT_EQ(result.exit_code, code) << reason;
    EXPECT_THAT(result.err, HasSubstr(reason));
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  };
  expect({"--to", "nuke", "--set", "output.maps=none"}, 1,
         "output.maps: there is no map of the layer \"globe\", and other programs need it; write maps: all");
  expect({"--to", "oiio", "--set", "output.maps=[globe, veil]"}, 1, "no map of the layer \"bg\"");
  for (const char* program : {"nuke", "blender"})
    expect({"--to", program, "--set", "layers.bg.image={file: bg.exr, part: \"0\"}"}, 1, "layers.bg.image");
  expect({"--to", "blender", "--set", "layers.bg.image=none.exr"}, 2, "none.exr");
  std::filesystem::create_directories(shot.folder / "out");
  std::filesystem::copy(shot.folder / "bg.exr", shot.out("hand.oiio.0001.exr"));
  expect({"--to", "oiio", "--set", "layers.bg.image=out/hand.oiio.####.exr"}, 1,
         "the shot reads this file and would overwrite it");
}

}  // namespace
}  // namespace lensplane
