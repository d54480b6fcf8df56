// SPDX-License-Identifier: Apache-2.0

#include "pipeline/cli/table.h"

#include <gtest/gtest.h>

#include "src/constants.h"

namespace lensplane {
namespace {

TEST(Table, ColumnsStandUnderOneAnother) {
  EXPECT_EQ(text_from_rows({{"lens", "mass", "why"}, {"a", "10 Msun"}, {"long name", "1 kg", "near"}}),
            "  lens       mass     why\n"
            "  a          10 Msun\n"
            "  long name  1 kg     near\n");
  EXPECT_EQ(text_from_rows({}), "");
}

TEST(Table, QuantitiesHaveTheUnitThatFitsThem) {
  EXPECT_EQ(readable_length(0), "0 m");
  EXPECT_EQ(readable_length(12.5), "12.5 m");
  EXPECT_EQ(readable_length(4.36e8), "4.36e+05 km");
  EXPECT_EQ(readable_length(1.5 * kAstronomicalUnit), "1.5 AU");
  EXPECT_EQ(readable_length(2 * kParsec), "2 pc");
  EXPECT_EQ(readable_length(8.5e3 * kParsec), "8.5 kpc");
  EXPECT_EQ(readable_length(1e6 * kParsec), "1 Mpc");
  EXPECT_EQ(readable_mass(geometric_mass_from_gm(10 * kSunGM)), "10 Msun");
  EXPECT_EQ(readable_mass(geometric_mass_from_kg(5.972e24)), "5.972e+24 kg");
  EXPECT_EQ(readable_mass(0), "0 kg");
}

}  // namespace
}  // namespace lensplane
