// SPDX-License-Identifier: Apache-2.0

#include "pipeline/cli/probe_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "src/constants.h"

namespace lensplane {
namespace {

using testing::HasSubstr;
using testing::Not;

Shot example_layers() {
  Shot shot;
  shot.name = "example";
  shot.lenses.push_back({"hole", {}, {}});
  shot.layers.push_back({"earth", {}, SphereLayer{}});
  shot.layers.push_back({"sky", {}, LatLongLayer{}});
  return shot;
}

ProbedFrame example_probe() {
  ProbedFrame probed{1001, {}, {}, {}};
  probed.plan.method = Method::Kishi;
  probed.camera.width = probed.camera.height = 100;
  Probe& probe = probed.probe;
  probe.film = {-0.5, 20.25};
  probe.first = {0, 0, -1};
  probe.last = {0, 0.6, -0.8};
  probe.crossings = {{0, 1e9, 100, kPi / 180}};
  probe.surfaces = {{Outcome::Missed, {0, 0}, 0, 0, 0, 0, 0, 0, 0},
                    {Outcome::Hit,
                     {1.0 / 3, 0.75},
                     1e-3,
                     2e-3,
                     3e-3,
                     4e-3,
                     -1.5,
                     2e-4,
                     std::numeric_limits<double>::infinity()}};
  return probed;
}

TEST(ProbeText, TellsTheRaysWay) {
  EXPECT_EQ(text_from_probe(example_layers(), example_probe()),
            "shot example, frame 1001, film (-0.5, 20.25), outside the frame\n"
            "  ray             goes on for ever\n"
            "  looks along     0 0 -1\n"
            "  last direction  0 0.6 -0.8\n"
            "\n"
            "  passes  after    b/m  alpha/rad     alpha/deg\n"
            "  hole    1e+09 m  100  0.0174532925  1\n"
            "\n"
            "layer earth: missed\n"
            "\n"
            "layer sky: hit\n"
            "  s, t           0.333333333, 0.75\n"
            "  ds/dx, ds/dy   0.001, 0.002\n"
            "  dt/dx, dt/dy   0.003, 0.004\n"
            "  magnification  -1.5\n"
            "  delay          0.0002 s\n"
            "  distance       infinite\n");
}

TEST(ProbeText, SaysWhereThereIsNoLight) {
  ProbedFrame probed = example_probe();
  probed.probe.film = {100, 100};
  probed.probe.captured = true;
  EXPECT_THAT(text_from_probe(example_layers(), probed), HasSubstr("captured by a lens"));
  EXPECT_THAT(text_from_probe(example_layers(), probed), Not(HasSubstr("outside the frame")));
  probed.probe.seen = false;
  EXPECT_THAT(text_from_probe(example_layers(), probed), HasSubstr("outside the circle of the fisheye"));
  EXPECT_THAT(text_from_probe(example_layers(), probed), Not(HasSubstr("looks along")));
}

TEST(ProbeJson, BringsEveryNumberBack) {
  const ProbedFrame probed = example_probe();
  const auto json = nlohmann::json::parse(json_from_probe(example_layers(), probed));
  EXPECT_EQ(json["frame"], 1001);
  EXPECT_EQ(json["x"], -0.5);
  EXPECT_EQ(json["in_frame"], false);
  EXPECT_EQ(json["last"], nlohmann::json({0.0, 0.6, -0.8}));
  EXPECT_EQ(json["crossings"][0]["lens"], "hole");
  EXPECT_EQ(json["crossings"][0]["path"], 1e9);
  EXPECT_EQ(json["crossings"][0]["alpha_rad"], kPi / 180);
  EXPECT_EQ(json["layers"][0]["outcome"], "missed");
  EXPECT_EQ(json["layers"][1]["s"], 1.0 / 3);
  EXPECT_EQ(json["layers"][1]["dt_dy"], 4e-3);
  EXPECT_EQ(json["layers"][1]["magnification"], -1.5);
  EXPECT_TRUE(json["layers"][1]["distance"].is_null());
}

}  // namespace
}  // namespace lensplane
