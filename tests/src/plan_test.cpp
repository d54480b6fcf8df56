// SPDX-License-Identifier: Apache-2.0

#include "src/plan.h"

#include <gtest/gtest.h>

#include "tests/src/scenes.h"

namespace lensplane {
namespace {

TEST(Plan, SaysInOneLineWhatIsSimulated) {
  const Scene scene = seed_fig6(100);
  EXPECT_EQ(describe(plan_trace(scene, Method::ShinotsukaMakino)),
            "shinotsuka-makino: weak law, 3 sources on 3 planes");
  EXPECT_EQ(describe(plan_trace(scene, Method::Kishi)), "kishi: weak law, 3 sources on 1 plane");
}

TEST(Plan, MethodsHaveTheirNames) {
  for (const MethodName& entry : kMethodNames) {
    EXPECT_EQ(method_named(entry.name), entry.method);
    EXPECT_EQ(name_of(entry.method), entry.name);
  }
  EXPECT_FALSE(method_named("newton"));
}

}  // namespace
}  // namespace lensplane
