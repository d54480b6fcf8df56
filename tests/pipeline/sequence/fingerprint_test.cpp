// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/fingerprint.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/pipeline/expect_failure.h"
#include "tests/pipeline/temporary_folder.h"
#include "tests/src/scenes.h"

namespace lensplane {
namespace {

std::string print_of(const Scene& scene, Method method = Method::ShinotsukaMakino) {
  return fingerprint_of_trace(scene, plan_trace(scene, method)).digest();
}

TEST(Fingerprint, IsTheSameForTheSameAndAnotherForEveryChange) {
  const Scene scene = seed_fig6(100);
  EXPECT_EQ(print_of(scene), print_of(seed_fig6(100)));
  EXPECT_EQ(print_of(scene).size(), 40U);
  std::set<std::string> prints = {print_of(scene), print_of(scene, Method::Kishi)};
  std::vector<Scene> changed(15, scene);
  changed[0].camera.width = 101;
  changed[1].camera.overscan = 2;
  changed[2].camera.fov_rad *= 1 + 1e-15;
  changed[3].camera.position.y = 1e-9;
  changed[4].camera.axes = basis_from_zxy({0, 1e-9, 0});
  changed[5].lenses[1].m *= 1 + 1e-15;
  changed[6].lenses.pop_back();
  changed[7].surfaces.push_back(Plate{});
  changed[8].surfaces.push_back(LatLong{});
  changed[9].camera.height = 101;
  changed[10].lenses[2].position.z *= 1 + 1e-15;
  auto sphere = [&](std::size_t i) -> Sphere& { return std::get<Sphere>(changed[i].surfaces[0]); };
  sphere(11).centre.x = 1e-9;
  sphere(12).radius *= 1 + 1e-15;
  sphere(13).axes = basis_from_zxy({0, 0, 1e-9});
  changed[14].camera.projection = Projection::Fisheye;
  for (const Scene& other : changed) prints.insert(print_of(other));
  EXPECT_EQ(prints.size(), 17U);
}

TEST(Fingerprint, TextsDoNotRunTogether) {
  EXPECT_NE(Fingerprint().add("ab").add("c").digest(), Fingerprint().add("a").add("bc").digest());
}

TEST(Fingerprint, FilesCountByTheirContents) {
  const TemporaryFolder folder;
  const auto a = folder.write("a", "one"), b = folder.write("b", "one"), c = folder.write("c", "two");
  const auto print = [](const std::filesystem::path& path) { return Fingerprint().add_file(path).digest(); };
  EXPECT_EQ(print(a), print(b));
  EXPECT_NE(print(a), print(c));
  EXPECT_EQ(refusal_of([&] { print(folder / "none"); }).code, ExitCode::BadInput);
}

}  // namespace
}  // namespace lensplane
