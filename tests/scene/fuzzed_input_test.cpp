// What the fuzzers of tests/fuzz found, made small.
#include "launchsafe/scene/load.hpp"
#include "launchsafe/scene/read_scene.hpp"
#include "scene/scene_text.hpp"

#include <gtest/gtest.h>

#include <string>

namespace launchsafe::scene {
namespace {

// toml++ asserts that a key begins as one may, also where a file does not; see toml_reader.cpp.
TEST(FuzzedInput, WhatBeginsLikeNoKeyIsAnErrorWithItsLine) {
  for (const std::string text :
       {"[;]", "[[;;input]]\nkey = 1", "[&", "[[[a]]]", "[=", "[\x01]", "[[]]", "[a.;]"}) {
    const auto table = parse_toml("title = 'x'\n" + text, "shell.toml");
    ASSERT_FALSE(table) << text;
    EXPECT_EQ(table.error().line, 2) << table.error().message();
  }
}

// A list of small numbers where one number is asked: toml++ took the logarithm of 4.9e-324, of which 5e-324
// is the shortest name, for a length.
TEST(FuzzedInput, AListOfTinyNumbersIsQuotedAsItIs) {
  const auto table = parse_toml("a = [4.9e-324, 0.01]", "shell.toml");
  ASSERT_TRUE(table);
  EXPECT_EQ(found_text(*table->get("a")), "[ 5e-324, 0.01 ]");
}

// Likewise of a value.
TEST(FuzzedInput, WhatBeginsLikeNoValueIsAnError) {
  for (const std::string text :
       {"a = [ } ]", "a = [ # ]", "a = { b = }", "a = [\v1]", "a = ]", "a = { b = , }", "a ="})
    EXPECT_FALSE(parse_toml(text, "shell.toml")) << text;
}

// Letters beyond ASCII outside of a text lead toml++ to a place that it calls unreachable.
TEST(FuzzedInput, LettersBeyondAsciiAreAnErrorOutsideOfATextAndKeptInside) {
  for (const std::string text :
       {"d = 1979-05-27T0\u00e9", "\u00e9 = 1", "a = \u4e2d", "a = 1 \u00b5", "[\u0416]"})
    EXPECT_FALSE(parse_toml(text, "shell.toml")) << text;
  const auto table =
      parse_toml("a = \"caf\u00e9\" # na\u00efve\nb = \"\"\"x \\\n \u00e9\"\"\"\n'\u00b5' = 1", "shell.toml");
  ASSERT_TRUE(table) << table.error().message();
  EXPECT_EQ((*table)["a"].value<std::string>(), "caf\u00e9");
  EXPECT_EQ((*table)["b"].value<std::string>(), "x \u00e9");
  EXPECT_EQ((*table)["\u00b5"].value<int>(), 1);
}

// What a curve file may hold and a scene may not could be computed, but not read back from its case.
TEST(FuzzedInput, ACurveFileHasTheLimitsOfACurveInTheScene) {
  const auto curve = parse_pressure_curve("time_ms,pressure_GPa\n0,0\n1,10.1\n", "gun.csv");
  ASSERT_FALSE(curve);
  EXPECT_EQ(curve.error().line, 3);
  EXPECT_NE(curve.error().allowed.find("10 GPa"), std::string::npos) << curve.error().message();
  EXPECT_TRUE(parse_pressure_curve("time_ms,pressure_GPa\n0,0\n1,10\n", "gun.csv"));
}

}  // namespace
}  // namespace launchsafe::scene
