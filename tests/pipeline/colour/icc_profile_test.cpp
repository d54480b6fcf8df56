// SPDX-License-Identifier: Apache-2.0

#include "pipeline/colour/icc_profile.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>

namespace lensplane {
namespace {

std::uint32_t number_at(const std::vector<unsigned char>& icc, std::size_t place) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i) number = number << 8 | icc[place + i];
  return number;
}

/// The place of a tag's data.
std::size_t find_tag(const std::vector<unsigned char>& icc, const std::string& name) {
  for (std::size_t i = 0; i < number_at(icc, 128); ++i) {
    const std::size_t entry = 132 + 12 * i;
    if (std::string(icc.begin() + static_cast<long>(entry), icc.begin() + static_cast<long>(entry) + 4) ==
        name)
      return number_at(icc, entry + 4);
  }
  ADD_FAILURE() << name;
  return 0;
}

std::array<double, 3> xyz_of(const std::vector<unsigned char>& icc, const std::string& name) {
  const std::size_t place = find_tag(icc, name) + 8;
  std::array<double, 3> xyz{};
  for (std::size_t i = 0; i < 3; ++i)
    xyz[i] = static_cast<std::int32_t>(number_at(icc, place + 4 * i)) / 65536.0;
  return xyz;
}

void expect_xyz(const std::vector<unsigned char>& icc, const std::string& name,
                const std::array<double, 3>& xyz) {
  const auto got = xyz_of(icc, name);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(got[i], xyz[i], 2e-4) << name;
}

// The numbers of the ICC's own sRGB profile, and of Display P3's.
TEST(IccProfile, HasThePrimariesUnderD50) {
  const auto srgb = icc_profile("srgb_rec709_display");
  EXPECT_EQ(number_at(srgb, 0), srgb.size());
  expect_xyz(srgb, "rXYZ", {.4361, .2225, .0139});
  expect_xyz(srgb, "gXYZ", {.3851, .7169, .0971});
  expect_xyz(srgb, "bXYZ", {.1431, .0606, .7141});
  expect_xyz(icc_profile("g26_p3d65_display"), "rXYZ", {.5151, .2412, -.0011});
}

TEST(IccProfile, HasTheCurve) {
  const auto icc = icc_profile("g24_rec709_display");
  EXPECT_EQ(number_at(icc, find_tag(icc, "gTRC") + 8), 0U);
  EXPECT_NEAR(number_at(icc, find_tag(icc, "gTRC") + 12) / 65536.0, 2.4, 1e-4);
}

TEST(IccProfile, IsEmptyWhereThereIsNone) {
  for (const char* id : {"pq_rec2020_display", "lin_ap1_scene", "data", ""})
    EXPECT_TRUE(icc_profile(id).empty()) << id;
}

}  // namespace
}  // namespace lensplane
