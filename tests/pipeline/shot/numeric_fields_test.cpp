// SPDX-License-Identifier: Apache-2.0
//
// Every number of a shot file: what is no number, not finite, too large or too small for full precision is
// refused in one line that names the key, wherever it stands.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "tests/pipeline/expect_failure.h"
#include "tests/pipeline/shot/example_shot.h"

namespace lensplane {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// A number of the shot: the settings that lead to it, in the last of which # stands for the number.
struct Field {
  const char* key;  // by which errors name it
  const char* good;
  std::vector<std::string> settings;
};

const std::vector<Field> kFields = {
    {"lensplane", "1", {"lensplane=#"}},
    {"frames", "1001", {"frames=#"}},
    {"fps", "24", {"fps=#"}},
    {"fps", "24000", {"fps=#/1001"}},
    {"fps", "1001", {"fps=24000/#"}},
    {"camera.resolution.0", "40", {"camera.resolution=[#, 20]"}},
    {"camera.resolution.1", "20", {"camera.resolution=[40, #]"}},
    {"camera.fov", "3", {"camera.fov=# deg"}},
    {"camera.fov.keys.1001", "3", {"camera.fov={keys: {1001: # deg}}"}},
    {"camera.fov", "180", {"camera.projection=fisheye", "camera.fov=# deg"}},
    {"camera.focal_length", "35", {"camera.fov=null", "camera.film_width=36 mm", "camera.focal_length=# mm"}},
    {"camera.film_width", "36", {"camera.fov=null", "camera.focal_length=35 mm", "camera.film_width=# mm"}},
    {"camera.position.0", "1", {"camera.position=[# m, 0 m, 0 m]"}},
    {"camera.position.1", "1", {"camera.position=[0 m, # m, 0 m]"}},
    {"camera.position.2", "1", {"camera.position=[0 m, 0 m, # m]"}},
    {"camera.position.keys", "7", {"camera.position={keys: {#: [0 m, 0 m, 0 m]}}"}},
    {"camera.position.keys.7.2", "1", {"camera.position={keys: {7: [0 m, 0 m, # m]}}"}},
    {"camera.look_at.1", "1", {"camera.look_at=[0 m, # m, -1 m]"}},
    {"camera.up.0", "1", {"camera.look_at=earth", "camera.up=[#, 1, 0]"}},
    {"camera.rotation.2", "1", {"camera.rotation=[0 deg, 0 deg, # deg]"}},
    {"camera.overscan", "8", {"camera.overscan=#"}},
    {"camera.shutter.open", "-0.25", {"camera.shutter={open: #, close: 0.25}"}},
    {"camera.shutter.close", "0.25", {"camera.shutter={open: -0.25, close: #}"}},
    {"camera.shutter.samples", "1", {"camera.shutter={samples: #}"}},
    {"lenses.near.mass", "1", {"lenses.near.mass=# kg"}},
    {"lenses.near.mass.keys.1002", "1", {"lenses.near.mass={keys: {1001: 1 kg, 1002: # kg}}"}},
    {"lenses.near.radius", "1", {"lenses.near.mass=null", "lenses.near.radius=# km"}},
    {"lenses.near.position.2", "-1", {"lenses.near.position=[0 m, 0 m, # m]"}},
    {"layers.earth.centre.0", "1", {"layers.earth.centre=[# m, 0 m, -1e9 m]"}},
    {"layers.earth.radius", "1", {"layers.earth.radius=# m"}},
    {"layers.earth.rotation.1", "1", {"layers.earth.rotation=[0 deg, # deg, 0 deg]"}},
    {"layers.earth.light.1", "1", {"layers.earth.light=[0, #, 1]"}},
    {"layers.background.distance", "1", {"layers.background.distance=# m"}},
    {"layers.s.exposure",
     "1",
     {"layers=[{name: s, type: stars, catalogue: s.csv, exposure: 0}]", "layers.s.exposure=#"}},
    {"layers.r.centre.0",
     "1",
     {"layers=[{name: r, type: ring, image: r.png, normal: [0, 1, 0], inner: 1 m, outer: 2 m}]",
      "layers.r.centre=[# m, 0 m, 0 m]"}},
    {"layers.r.normal.0",
     "1",
     {"layers=[{name: r, type: ring, image: r.png, centre: [0 m, 0 m, 0 m], inner: 1 m, outer: 2 m}]",
      "layers.r.normal=[#, 1, 0]"}},
    {"layers.r.inner",
     "1",
     {"layers=[{name: r, type: ring, image: r.png, centre: [0 m, 0 m, 0 m], normal: [0, 1, 0], outer: 2 m}]",
      "layers.r.inner=# m"}},
    {"layers.r.outer",
     "2",
     {"layers=[{name: r, type: ring, image: r.png, centre: [0 m, 0 m, 0 m], normal: [0, 1, 0], inner: 1 m}]",
      "layers.r.outer=# m"}},
    {"layers.p.distance",
     "1",
     {"layers=[{name: p, type: povray, scene: p.pov, as: plate}]", "layers.p.distance=# m"}},
    {"trace.tolerance", "0.1", {"trace={method: planes}", "trace.tolerance=# px"}},
    {"trace.tolerance.keys.9", "0.1", {"trace={method: planes}", "trace.tolerance={keys: {9: # px}}"}},
};

/// As YAML and C write them, and numbers that a double holds not at all, or not in full.
constexpr std::array kBad = {".inf",     "-.inf",  "+.inf", ".nan",   ".NaN",   "inf",    "-inf",
                             "infinity", "nan",    "-nan",  "nan(1)", "1e999",  "-1e999", "5e-324",
                             "-5e-324",  "1e-310", "1e200", "0x10",   "1e-999", "1e"};

/// The line that refuses the example with `number` in the field; empty when it is fine, or only asks for what
/// is not available yet.
std::string line_for(const Field& field, const std::string& number) {
  std::vector<std::string> settings = field.settings;
  std::string& last = settings.back();
  last.replace(last.find('#'), 1, number);
  const Refusal refusal = refusal_of([&] { example_shot(settings); });
  if (refusal.line.empty() || refusal.line.find("not available yet") != std::string::npos) return "";
  EXPECT_EQ(refusal.code, ExitCode::BadShot) << refusal.line;
  return refusal.line;
}

TEST(NumericFields, TakeNumbersAndRefuseEverythingElse) {
  for (const Field& field : kFields) {
    SCOPED_TRACE(field.settings.back());
    EXPECT_EQ(line_for(field, field.good), "");
    for (const char* bad : kBad) {
      const std::string line = line_for(field, bad);
      EXPECT_THAT(line, StartsWith("--set ")) << bad;
      EXPECT_THAT(line, HasSubstr(std::string(": ") + field.key + ": ")) << bad;
      EXPECT_EQ(line.find('\n'), std::string::npos) << bad;
    }
  }
}

}  // namespace
}  // namespace lensplane
