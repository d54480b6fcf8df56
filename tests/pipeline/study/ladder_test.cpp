// SPDX-License-Identifier: Apache-2.0

#include "pipeline/study/ladder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace lensplane {
namespace {

Camera camera_of(Projection projection) {
  Camera camera;
  camera.projection = projection;
  return camera;
}

std::size_t count_of_own(const std::vector<Rung>& ladder) {
  return static_cast<std::size_t>(
      std::count_if(ladder.begin(), ladder.end(), [](const Rung& r) { return r.of_shot; }));
}

TEST(Ladder, HasEveryWayOnceAndTheShotsOwn) {
  const auto ladder = ladder_of(camera_of(Projection::Perspective), TraceSettings());
  // Two methods of the paper; three laws and seven tolerances, without and with finite distance; four of
  // curved rays.
  EXPECT_EQ(ladder.size(), 2U + 2 * 10 + 4 + 1);
  std::set<std::string> names;
  for (const Rung& rung : ladder) names.insert(name_of(rung.settings));
  EXPECT_EQ(names.size(), ladder.size());
  EXPECT_EQ(count_of_own(ladder), 1U);
  EXPECT_EQ(name_of(ladder.back().settings), "planes, law auto, 0.05 px, finite distance auto");
  for (const char* name : {"kishi", "planes, law second-order, finite distance off", "geodesic, 0.01 px",
                           "planes, law auto, 1e-06 px, finite distance on"})
    EXPECT_TRUE(names.contains(name)) << name;
}

TEST(Ladder, KnowsTheShotsOwnAmongItsRungs) {
  TraceSettings own;
  own.effects.delay = true;
  own.method = Method::ShinotsukaMakino;
  own.tolerance_px = 0.3;  // of no meaning there
  const auto by_paper = ladder_of(camera_of(Projection::Perspective), own);
  EXPECT_EQ(by_paper.size(), 26U);
  EXPECT_TRUE(by_paper[1].of_shot);
  own.method = Method::Planes;
  own.law = Law::Exact;
  own.finite_distance = Choice::Off;
  EXPECT_EQ(ladder_of(camera_of(Projection::Perspective), own).size(), 26U);
  own.finite_distance = Choice::Auto;
  EXPECT_EQ(ladder_of(camera_of(Projection::Perspective), own).size(), 27U);
  for (const Rung& rung : ladder_of(camera_of(Projection::Perspective), own))
    EXPECT_FALSE(rung.settings.effects.any());
}

TEST(Ladder, WithoutAFlatScreenFiniteDistanceIsAlwaysOn) {
  for (const Projection projection : {Projection::LatLong, Projection::Fisheye}) {
    for (const Rung& rung : ladder_of(camera_of(projection), TraceSettings()))
      EXPECT_NE(rung.settings.finite_distance, Choice::Off);
  }
}

}  // namespace
}  // namespace lensplane
