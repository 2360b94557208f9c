#include "launchsafe/scene/quantity.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace launchsafe::scene {
namespace {

TEST(Quantity, IsTheDoubleNearestToTheDecimal) {
  for (const auto& [text, dimension, value] : {std::tuple{"11.8 cm", Dimension::length, 0.118},
                                               {"67.75cm", Dimension::length, 0.6775},
                                               {" 30 um ", Dimension::length, 30e-6},
                                               {"18 ms", Dimension::time, 18e-3},
                                               {"2.5e2 us", Dimension::time, 2.5e-4},
                                               {"4.96E+2 MPa", Dimension::pressure, 496e6},
                                               {"-5.031 GPa", Dimension::pressure, -5.031e9},
                                               {"778.1 Mbar", Dimension::pressure, 778.1e11},
                                               {"+300 K", Dimension::temperature, 300.0},
                                               {"1.717 g/cm3", Dimension::density, 1717.0},
                                               {"4.61 km/s", Dimension::speed, 4610.0},
                                               {"1780 J/(kg K)", Dimension::specific_heat, 1780.0},
                                               {"1780 J/kgK", Dimension::specific_heat, 1780.0},
                                               {"0.246 W/(m K)", Dimension::conductivity, 0.246},
                                               {"0.5 MPa m^0.5", Dimension::toughness, 5e5},
                                               {"5.82 MJ/kg", Dimension::specific_energy, 5.82e6},
                                               {"2 1/us", Dimension::frequency, 2e6}})
    EXPECT_EQ(parse_quantity(text, dimension), value) << text;
}

// 1 psi is 0.45359237 kg times 9.80665 m/s2 over (0.0254 m)^2, 1 atm 101325 Pa, both by definition.
TEST(Quantity, UnderstandsUnitsThatAreNoPowersOfTen) {
  EXPECT_NEAR(parse_quantity("1 psi", Dimension::pressure), 6894.757293168361, 1e-9);
  EXPECT_NEAR(parse_quantity("72 ksi", Dimension::pressure), 72e3 * 6894.757293168361, 1e-6);
  EXPECT_EQ(parse_quantity("2 atm", Dimension::pressure), 202650.0);
  EXPECT_EQ(parse_quantity("30 \u00b5m", Dimension::length), 30e-6);  // micro sign
}

// 0 degrees Celsius are 273.15 K, 0 degrees Fahrenheit 459.67 Rankine.
TEST(Quantity, ATemperatureMayStandOnTheScaleOfCelsiusOrFahrenheit) {
  for (const char* text : {"27 \u00b0C", "27\u00b0C", "27 degC", "27 C", "300.15 K"})
    EXPECT_EQ(parse_quantity(text, Dimension::temperature), 300.15) << text;
  EXPECT_EQ(parse_quantity("-40 \u00b0C", Dimension::temperature), 233.15);
  EXPECT_NEAR(parse_quantity("-40 degF", Dimension::temperature), 233.15, 1e-12);
  EXPECT_NEAR(parse_quantity("32 \u00b0F", Dimension::temperature), 273.15, 1e-12);
  EXPECT_EQ(parse_range("20 to 27 \u00b0C", Dimension::temperature), (std::vector<double>{293.15, 300.15}));
}

TEST(Quantity, AShareIsReadAndWrittenInPercent) {
  EXPECT_EQ(parse_quantity("4 %", Dimension::share), 0.04);
  EXPECT_EQ(parse_quantity("12.5%", Dimension::share), 0.125);
  EXPECT_FALSE(caught([&] { return parse_quantity("0.04", Dimension::share); }));
  EXPECT_EQ(format_quantity(0.04, Dimension::share), "4 %");
  EXPECT_EQ(format_quantity(5e-4, Dimension::share), "0.05 %");
}

TEST(Quantity, ADifferenceOfTemperaturesIsInKelvinOnly) {
  EXPECT_EQ(parse_quantity("5 K", Dimension::temperature_difference), 5.0);
  for (const char* text : {"5 \u00b0C", "5 degC", "5 C", "5 degF"}) {
    EXPECT_FALSE(caught([&] { return parse_quantity(text, Dimension::temperature_difference); })) << text;
  }
  EXPECT_EQ(difference_of(Dimension::temperature), Dimension::temperature_difference);
  EXPECT_EQ(difference_of(Dimension::length), Dimension::length);
}

TEST(Quantity, ADecimalCommaIsAFault) {
  for (const char* text : {"0,5 mm", "1,000 mm", "1.250,5 mm", "0,0.01 mm", "1,2,3 mm"}) {
    EXPECT_FALSE(caught([&] { return parse_quantity(text, Dimension::length); })) << text;
    EXPECT_FALSE(caught([&] { return parse_list(text, Dimension::length); })) << text;
  }
  EXPECT_FALSE(caught([&] { return parse_range("0,5 to 1,5 mm", Dimension::length); }));
  EXPECT_FALSE(caught([&] { return parse_list("0,5, 1,5 mm", Dimension::length); }));
}

TEST(Quantity, CommasThatCanOnlyBeThoseOfAListStay) {
  const std::vector<double> three{0.0, 1e-4, 2e-4};
  for (const char* text :
       {"0, 0.01, 0.02 cm", "0 cm,0.1 mm,0.2 mm", "0 , 0.01 , 0.02 cm", "0, 1e-2, 2e-2 cm", "0,.01,.02 cm"})
    EXPECT_EQ(parse_list(text, Dimension::length), three) << text;
  EXPECT_EQ(parse_list("0, 5 mm", Dimension::length), (std::vector<double>{0.0, 5e-3}));
}

TEST(Quantity, InAnUnknownUnitOrNoneIsRefusedWithAllUnitsAndNoOtherQuantity) {
  for (const char* text : {"5", "5 ms", "5 mmm", "5 Mm", "5 furlong"}) {
    const auto value = caught([&] { return parse_quantity(text, Dimension::length); });
    ASSERT_FALSE(value) << text;
    EXPECT_EQ(value.error().suggestion, "") << text;
    for (const std::string& unit : units_of(Dimension::length))
      EXPECT_NE(value.error().allowed.find(unit), std::string::npos) << unit;
  }
}

TEST(Quantity, RefusesWhatIsNoFiniteNumber) {
  for (const char* text : {"nan cm", "inf cm", "-inf cm", "1e400 cm", "1e308 Mbar"}) {
    const Dimension dimension =
        std::string_view(text).ends_with("bar") ? Dimension::pressure : Dimension::length;
    EXPECT_FALSE(caught([&] { return parse_quantity(text, dimension); })) << text;
  }
  EXPECT_FALSE(caught([&] { return parse_quantity("", Dimension::length); }));
  EXPECT_FALSE(caught([&] { return parse_quantity("cm", Dimension::length); }));
  EXPECT_FALSE(caught([&] { return parse_quantity("1 2 cm", Dimension::length); }));
  EXPECT_FALSE(caught([&] { return parse_quantity("+-2 cm", Dimension::length); }));
  EXPECT_FALSE(caught([&] { return parse_quantity("0.5 m", Dimension::number); }));
}

TEST(Quantity, RangeTakesItsUnitFromTheEnd) {
  EXPECT_EQ(parse_range("0 to 11.8 cm", Dimension::length), (std::vector<double>{0.0, 0.118}));
  EXPECT_EQ(parse_range("5 mm to 11.8 cm", Dimension::length), (std::vector<double>{0.005, 0.118}));
  EXPECT_FALSE(caught([&] { return parse_range("11.8 cm", Dimension::length); }));
  EXPECT_FALSE(caught([&] { return parse_range("11.8 to 11.8 cm", Dimension::length); }));
  EXPECT_FALSE(caught([&] { return parse_range("11.8 to 0 cm", Dimension::length); }));
  EXPECT_FALSE(caught([&] { return parse_range("0 to 11.8 ms", Dimension::length); }));
  EXPECT_FALSE(caught([&] { return parse_range("0 cm to 11.8", Dimension::length); }));
}

TEST(Quantity, ListTakesMissingUnitsFromTheLastOne) {
  EXPECT_EQ(parse_list("0, 0.01, 0.02 cm", Dimension::length), (std::vector<double>{0.0, 1e-4, 2e-4}));
  EXPECT_EQ(parse_list("0 cm, 0.1 mm, 0.2 mm", Dimension::length), (std::vector<double>{0.0, 1e-4, 2e-4}));
  // A bare number beside several units, or before an end without one, may be meant in any.
  EXPECT_FALSE(caught([&] { return parse_list("0.03, 0.04 mm, 0.03 cm", Dimension::length); }));
  EXPECT_FALSE(caught([&] { return parse_list("0 mm, 0.01", Dimension::length); }));
  EXPECT_FALSE(caught([&] { return parse_list("0, , 0.02 cm", Dimension::length); }));
  EXPECT_FALSE(caught([&] { return parse_list("0, 0.01, 0.02", Dimension::length); }));
}

TEST(Quantity, IsShownInTheUnitThatReadsBest) {
  EXPECT_EQ(format_quantity(0.118, Dimension::length), "11.8 cm");
  EXPECT_EQ(format_quantity(2.5e-3, Dimension::length), "0.25 cm");
  EXPECT_EQ(format_quantity(30e-6, Dimension::length), "30 µm");
  EXPECT_EQ(format_quantity(0.0, Dimension::length), "0 cm");
  EXPECT_EQ(format_quantity(18e-3, Dimension::time), "18 ms");
  EXPECT_EQ(format_quantity(496e6, Dimension::pressure), "496 MPa");
  EXPECT_EQ(format_quantity(80e9, Dimension::pressure), "80 GPa");
  EXPECT_EQ(format_quantity(525.0, Dimension::temperature), "525 K");
  EXPECT_EQ(format_quantity(0.35, Dimension::number), "0.35");
}

TEST(Quantity, EveryUnitReadsBackThroughIt) {
  for (int i = 0; i <= static_cast<int>(Dimension::duration); ++i) {
    const auto dimension = static_cast<Dimension>(i);
    for (const std::string& unit : units_of(dimension)) {
      const auto value = parse_quantity("1.5 " + unit, dimension);
      // A shift of some hundred takes digits.
      EXPECT_NEAR(in_unit(value, dimension, unit), 1.5, dimension == Dimension::temperature ? 1e-13 : 1e-14)
          << unit;
    }
  }
  EXPECT_TRUE(std::isnan(in_unit(1.0, Dimension::length, "ms")));
}

}  // namespace
}  // namespace launchsafe::scene
