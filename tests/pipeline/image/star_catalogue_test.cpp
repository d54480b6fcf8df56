// SPDX-License-Identifier: Apache-2.0

#include "pipeline/image/star_catalogue.h"

#include <gtest/gtest.h>

#include <cmath>

#include "src/surfaces.h"
#include "tests/pipeline/expect_failure.h"
#include "tests/pipeline/temporary_folder.h"

namespace lensplane {
namespace {

const std::string kHeader = "ra_deg,dec_deg,v_mag,b_minus_v\n";

TEST(StarCatalogue, ShippedOneIsReadWhole) {
  const auto stars =
      read_star_catalogue(std::filesystem::path(LENSPLANE_SOURCE_DIR) / "textures/stars_hipparcos.csv");
  ASSERT_EQ(stars.size(), 41411U);
  EXPECT_EQ(stars[0].v_mag, -1.44);  // Sirius
  EXPECT_EQ(stars[0].b_minus_v, 0.009);
  for (const Star& star : stars) ASSERT_NEAR(star.direction.length(), 1, 1e-15);
}

TEST(StarCatalogue, PutsStarsWhereTheDrawnSkyHasThem) {
  for (const double ra : {0.0, 37.0, 101.2872, 180.0, 359.0}) {
    for (const double dec : {-90.0, -16.7161, 0.0, 88.0, 90.0}) {
      // make_star_sky.py: x = (0.5 - ra/360) mod 1 of the width, y = 0.5 - dec/180 of the height from the
      // top.
      const double s = std::fmod(1.5 - ra / 360, 1.0), t = 1 - (0.5 - dec / 180);
      EXPECT_LT((direction_from_equatorial(ra, dec) - sky_direction_from_st({s, t})).length(), 1e-14);
    }
  }
  EXPECT_LT((direction_from_equatorial(0, 0) - Vec3(0, 0, -1)).length(), 1e-15);
  EXPECT_LT((direction_from_equatorial(90, 0) - Vec3(-1, 0, 0)).length(), 1e-15);  // falls to the right
  EXPECT_LT((direction_from_equatorial(0, 90) - Vec3(0, 1, 0)).length(), 1e-15);
}

TEST(StarCatalogue, AllowsCommentsEmptyColoursAndLineEndsOfDos) {
  const TemporaryFolder folder;
  const auto path = folder.write(
      "a.csv", "# mine\r\nra_deg,dec_deg,v_mag,b_minus_v\r\n10,20,-1.5,\r\n# two\r\n0,-90,8,1.25");
  const auto stars = read_star_catalogue(path);
  ASSERT_EQ(stars.size(), 2U);
  EXPECT_EQ(stars[0].b_minus_v, kUnknownBMinusV);
  EXPECT_EQ(stars[0].v_mag, -1.5);
  EXPECT_EQ(stars[1].b_minus_v, 1.25);
}

TEST(StarCatalogue, RefusesWhatIsWrongByLine) {
  const TemporaryFolder folder;
  const struct {
    std::string text, line;
  } cases[] = {
      {kHeader + "1,2,3,0.5\n361,2,3,0.5\n",
       ":3: ra_deg: '361' is not allowed; allowed: a number from 0 to 360"},
      {kHeader + "1,-90.5,3,0.5\n", ":2: dec_deg: '-90.5' is not allowed; allowed: a number from -90 to 90"},
      {kHeader + "1,2,x,0.5\n", ":2: v_mag: 'x' is not allowed; allowed: a number from -50 to 50"},
      {kHeader + "1,2,,0.5\n", ":2: v_mag: '' is not allowed; allowed: a number from -50 to 50"},
      {kHeader + "1,2,nan,0.5\n", ":2: v_mag: 'nan' is not allowed; allowed: a number from -50 to 50"},
      {kHeader + "1,2,3,-0.7\n", ":2: b_minus_v: '-0.7' is not allowed; allowed: a number from -0.6 to 10"},
      {kHeader + "1,2,3,0.5 \n", ":2: b_minus_v: '0.5 ' is not allowed; allowed: a number from -0.6 to 10"},
      {kHeader + "1,2,3\n", ":2: '1,2,3' is not a star; needed: ra_deg,dec_deg,v_mag,b_minus_v"},
      {kHeader + "1,2,3,4,5\n", ":2: '1,2,3,4,5' is not a star; needed: ra_deg,dec_deg,v_mag,b_minus_v"},
      {kHeader + "\n1,2,3,0.5\n", ":2: '' is not a star; needed: ra_deg,dec_deg,v_mag,b_minus_v"},
      {"ra,dec\n1,2\n",
       ":1: 'ra,dec' is not the header of a star catalogue; needed: ra_deg,dec_deg,v_mag,b_minus_v"},
      {kHeader, ": holds no stars"},
      {"", ": holds no stars"},
  };
  for (const auto& wrong : cases) {
    const auto path = folder.write("wrong.csv", wrong.text);
    const Refusal refusal = refusal_of([&] { read_star_catalogue(path); });
    EXPECT_EQ(refusal.code, ExitCode::BadInput);
    EXPECT_EQ(refusal.line, path.string() + wrong.line);
  }
  const Refusal missing = refusal_of([&] { read_star_catalogue(folder / "none.csv"); });
  EXPECT_EQ(missing.line, (folder / "none.csv").string() + ": no such star catalogue");
  EXPECT_EQ(refusal_of([&] { read_star_catalogue(folder.path()); }).code, ExitCode::BadInput);
}

}  // namespace
}  // namespace lensplane
