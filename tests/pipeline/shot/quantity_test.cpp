// SPDX-License-Identifier: Apache-2.0

#include "pipeline/shot/quantity.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "src/constants.h"

namespace lensplane {
namespace {

using testing::HasSubstr;

double value(std::string_view text, Dimension dimension) {
  const ParsedQuantity parsed = parse_quantity(text, dimension);
  EXPECT_EQ(parsed.error, "") << text;
  return parsed.value;
}

std::string error(std::string_view text, Dimension dimension) {
  return parse_quantity(text, dimension).error;
}

TEST(Quantity, UnitsHaveTheirValues) {
  EXPECT_DOUBLE_EQ(value("35 mm", Dimension::Length), 0.035);
  EXPECT_DOUBLE_EQ(value("1 km", Dimension::Length), 1000);
  EXPECT_DOUBLE_EQ(value("1 AU", Dimension::Length), 149597870700.0);
  EXPECT_DOUBLE_EQ(value("1 ly", Dimension::Length), 9460730472580800.0);
  EXPECT_DOUBLE_EQ(value("1 pc", Dimension::Length), 3.0856775814913673e16);
  EXPECT_DOUBLE_EQ(value("1 Mpc", Dimension::Length), 3.0856775814913673e22);
  EXPECT_DOUBLE_EQ(value("2 Rsun", Dimension::Length), 1.3914e9);
  EXPECT_DOUBLE_EQ(value("1 Rearth", Dimension::Length), 6.3781e6);
  EXPECT_DOUBLE_EQ(value("180 deg", Dimension::Angle), kPi);
  EXPECT_DOUBLE_EQ(value("60 arcmin", Dimension::Angle), kPi / 180);
  EXPECT_DOUBLE_EQ(value("3600 arcsec", Dimension::Angle), kPi / 180);
  EXPECT_DOUBLE_EQ(value("1 rad", Dimension::Angle), 1);
  EXPECT_DOUBLE_EQ(value("0.05 px", Dimension::Pixels), 0.05);
  EXPECT_NEAR(value("1 Msun", Dimension::Mass), 1476.625,
              1e-3);  // half the Sun's Schwarzschild radius, 2953.25 m
  EXPECT_NEAR(value("1.989e31 kg", Dimension::Mass), 14770.63277528, 1e-8);
  EXPECT_DOUBLE_EQ(value("1000 g", Dimension::Mass), value("1 kg", Dimension::Mass));
  EXPECT_NEAR(value("1 Mearth", Dimension::Mass) / 4.4350280e-3, 1, 1e-6);
  EXPECT_NEAR(value("1 Msun", Dimension::Mass) / value("1 Mjup", Dimension::Mass), 1047.57, 0.01);
}

TEST(Quantity, NumbersAreReadInEveryUsualForm) {
  EXPECT_EQ(value("-4.36e8 m", Dimension::Length), -4.36e8);
  EXPECT_EQ(value("+2m", Dimension::Length), 2);
  EXPECT_EQ(value("  7   km ", Dimension::Length), 7000);
  EXPECT_EQ(value(".5", Dimension::Number), 0.5);
  EXPECT_EQ(value("0 m", Dimension::Length), 0);
}

TEST(Quantity, SaysWhatIsWrongAndWhatIsAllowed) {
  EXPECT_EQ(error("3 m", Dimension::Angle),
            "\"3 m\" is a length; an angle is needed, in deg, rad, arcmin, arcsec, mas");
  EXPECT_EQ(error("3", Dimension::Mass), "\"3\" has no unit; a mass is needed, in g, kg, Msun, Mearth, Mjup");
  EXPECT_THAT(error("3 parsecs", Dimension::Length),
              HasSubstr("\"parsecs\" is not a unit; a length is needed, in mm"));
  EXPECT_THAT(error("three m", Dimension::Length), HasSubstr("\"three m\" is not a number"));
  EXPECT_THAT(error("", Dimension::Length), HasSubstr("is not a number"));
  EXPECT_THAT(error("+-3 m", Dimension::Length), HasSubstr("m\" is not a"));
  EXPECT_EQ(error("3 m", Dimension::Number), "\"3 m\" is a length; a plain number is needed");
}

TEST(Quantity, RefusesWhatIsNoOrdinaryNumber) {
  for (const char* text :
       {"nan m", "NaN m", "inf m", "-inf m", "infinity m", "1e999 m", "1e308 Mpc", "1e101 m", "-1e101 m"}) {
    EXPECT_NE(error(text, Dimension::Length), "") << text;
  }
  EXPECT_THAT(error("nan m", Dimension::Length), HasSubstr("is not finite"));
  EXPECT_NE(error("1e-310 m", Dimension::Length), "");  // denormal
  EXPECT_NE(error("1e-320 m", Dimension::Length), "");  // denormal
  EXPECT_NE(error("1e-400 m", Dimension::Length), "");  // out of range
  EXPECT_NE(error("1e-300 g", Dimension::Mass), "");    // denormal once it is in metres
}

}  // namespace
}  // namespace lensplane
