#include "launchsafe/scene/quantity.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace launchsafe::scene {
namespace {

TEST(Quantity, IsTheDoubleNearestToTheDecimal) {
  EXPECT_EQ(*parse_quantity("11.8 cm", Dimension::length), 0.118);
  EXPECT_EQ(*parse_quantity("67.75cm", Dimension::length), 0.6775);
  EXPECT_EQ(*parse_quantity(" 30 um ", Dimension::length), 30e-6);
  EXPECT_EQ(*parse_quantity("18 ms", Dimension::time), 18e-3);
  EXPECT_EQ(*parse_quantity("2.5e2 us", Dimension::time), 2.5e-4);
  EXPECT_EQ(*parse_quantity("4.96E+2 MPa", Dimension::pressure), 496e6);
  EXPECT_EQ(*parse_quantity("-5.031 GPa", Dimension::pressure), -5.031e9);
  EXPECT_EQ(*parse_quantity("778.1 Mbar", Dimension::pressure), 778.1e11);
  EXPECT_EQ(*parse_quantity("+300 K", Dimension::temperature), 300.0);
}

TEST(Quantity, UnderstandsCompoundUnitsWithAndWithoutBlanks) {
  EXPECT_EQ(*parse_quantity("1.717 g/cm3", Dimension::density), 1717.0);
  EXPECT_EQ(*parse_quantity("4.61 km/s", Dimension::speed), 4610.0);
  EXPECT_EQ(*parse_quantity("1780 J/(kg K)", Dimension::specific_heat), 1780.0);
  EXPECT_EQ(*parse_quantity("1780 J/kgK", Dimension::specific_heat), 1780.0);
  EXPECT_EQ(*parse_quantity("0.246 W/(m K)", Dimension::conductivity), 0.246);
  EXPECT_EQ(*parse_quantity("0.5 MPa m^0.5", Dimension::toughness), 5e5);
  EXPECT_EQ(*parse_quantity("5.82 MJ/kg", Dimension::specific_energy), 5.82e6);
  EXPECT_EQ(*parse_quantity("2 1/us", Dimension::frequency), 2e6);
}

TEST(Quantity, NamesTheDimensionThatAWrongUnitHas) {
  const auto value = parse_quantity("5 ms", Dimension::length);
  ASSERT_FALSE(value);
  EXPECT_EQ(value.error().found, "\"5 ms\", which is a time");
  EXPECT_NE(value.error().allowed.find("a length"), std::string::npos);
  EXPECT_NE(value.error().allowed.find("mm"), std::string::npos);
}

TEST(Quantity, SuggestsTheNearestUnit) {
  EXPECT_EQ(parse_quantity("496 Mpa", Dimension::pressure).error().suggestion, "\"496 MPa\"");
  EXPECT_EQ(parse_quantity("5 mmm", Dimension::length).error().suggestion, "\"5 mm\"");
  EXPECT_EQ(parse_quantity("5", Dimension::length).error().suggestion, "\"5 cm\"");
  EXPECT_NE(parse_quantity("5", Dimension::length).error().found.find("without a unit"), std::string::npos);
  EXPECT_NE(parse_quantity("5 furlong", Dimension::length).error().found.find("unknown unit"),
            std::string::npos);
}

TEST(Quantity, RefusesWhatIsNoFiniteNumber) {
  for (const char* text : {"nan cm", "inf cm", "-inf cm", "1e400 cm", "1e308 Mbar"}) {
    const Dimension dimension =
        std::string_view(text).ends_with("bar") ? Dimension::pressure : Dimension::length;
    const auto value = parse_quantity(text, dimension);
    ASSERT_FALSE(value) << text;
    EXPECT_NE(value.error().found.find("not a finite number"), std::string::npos) << text;
  }
  EXPECT_FALSE(parse_quantity("", Dimension::length));
  EXPECT_FALSE(parse_quantity("cm", Dimension::length));
  EXPECT_FALSE(parse_quantity("1 2 cm", Dimension::length));
  EXPECT_FALSE(parse_quantity("0.5 m", Dimension::number));
}

TEST(Quantity, RangeTakesItsUnitFromTheEnd) {
  EXPECT_EQ(*parse_range("0 to 11.8 cm", Dimension::length), (std::vector<double>{0.0, 0.118}));
  EXPECT_EQ(*parse_range("5 mm to 11.8 cm", Dimension::length), (std::vector<double>{0.005, 0.118}));
  EXPECT_FALSE(parse_range("11.8 cm", Dimension::length));
  EXPECT_FALSE(parse_range("11.8 to 11.8 cm", Dimension::length));
  EXPECT_FALSE(parse_range("11.8 to 0 cm", Dimension::length));
  EXPECT_FALSE(parse_range("0 to 11.8 ms", Dimension::length));
  EXPECT_FALSE(parse_range("0 cm to 11.8", Dimension::length));
}

TEST(Quantity, ListTakesMissingUnitsFromTheNextOne) {
  EXPECT_EQ(*parse_list("0, 0.01, 0.02 cm", Dimension::length), (std::vector<double>{0.0, 1e-4, 2e-4}));
  EXPECT_EQ(*parse_list("0 cm, 0.1, 0.2 mm", Dimension::length), (std::vector<double>{0.0, 1e-4, 2e-4}));
  EXPECT_FALSE(parse_list("0, , 0.02 cm", Dimension::length));
  EXPECT_FALSE(parse_list("0, 0.01, 0.02", Dimension::length));
}

TEST(Quantity, IsShownInTheUnitThatReadsBest) {
  EXPECT_EQ(format_quantity(0.118, Dimension::length), "11.8 cm");
  EXPECT_EQ(format_quantity(2.5e-3, Dimension::length), "0.25 cm");
  EXPECT_EQ(format_quantity(30e-6, Dimension::length), "30 um");
  EXPECT_EQ(format_quantity(0.0, Dimension::length), "0 cm");
  EXPECT_EQ(format_quantity(18e-3, Dimension::time), "18 ms");
  EXPECT_EQ(format_quantity(496e6, Dimension::pressure), "496 MPa");
  EXPECT_EQ(format_quantity(80e9, Dimension::pressure), "80 GPa");
  EXPECT_EQ(format_quantity(525.0, Dimension::temperature), "525 K");
  EXPECT_EQ(format_quantity(0.35, Dimension::number), "0.35");
}

TEST(Quantity, ExactTextReadsBackToTheSameDouble) {
  for (const double value : {0.1 + 0.2, 1.0 / 3.0, 5e-324, 1.7976931348623157e308, 0.118, 0.0}) {
    EXPECT_EQ(*parse_quantity(exact_quantity(value, Dimension::length), Dimension::length), value);
  }
}

TEST(Quantity, EveryUnitReadsBackThroughIt) {
  for (int i = 0; i <= static_cast<int>(Dimension::toughness); ++i) {
    const auto dimension = static_cast<Dimension>(i);
    for (const std::string& unit : units_of(dimension)) {
      const auto value = parse_quantity("1.5 " + unit, dimension);
      ASSERT_TRUE(value) << unit;
      EXPECT_NEAR(in_unit(*value, dimension, unit), 1.5, 1e-14) << unit;
    }
  }
  EXPECT_TRUE(std::isnan(in_unit(1.0, Dimension::length, "ms")));
}

}  // namespace
}  // namespace launchsafe::scene
