#include "launchsafe/scene/toml_reader.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace launchsafe::scene {
namespace {

enum class Colour { red, green };

struct Thing {
  double length = 2.5e-3;
  int count = 3;
  bool flag = true;
  Colour colour = Colour::red;
  std::vector<double> times;
  double share = 0.5;
};

std::vector<Key<Thing>> thing_keys() {
  return {
      number_key("length", Dimension::length, above(0), Standing::paper, "A length.", &Thing::length),
      number_key("part.count", Dimension::count, between(1, 9), Standing::assumed, "A count.", &Thing::count),
      flag_key("part.flag", Standing::assumed, "A flag.", &Thing::flag),
      word_key("colour", Standing::assumed, "A word.", {{"red", Colour::red}, {"green", Colour::green}},
               &Thing::colour),
      list_key("times", Dimension::time, at_least(0), Standing::assumed, "A list.", &Thing::times) |
          may_be_empty(),
      number_key("share", Dimension::number, between(0, 1), Standing::assumed, "A share.", &Thing::share),
  };
}

Expected<Thing> read_thing(std::string_view text) {
  return caught([&] {
    Thing thing;
    read_table(parse_toml(text, "thing.toml"), thing_keys(), {"other"}, "thing.toml", thing);
    return thing;
  });
}

TEST(TomlReader, FillsTheBoundMembers) {
  const auto thing = read_thing(R"(
length = "11.8 cm"
colour = "green"
times = ["1 ms", "20 us"]
share = 1
part = { count = 7, flag = false }
[other]
anything = "is read by others"
)");
  ASSERT_TRUE(thing) << thing.error().message();
  EXPECT_EQ(thing->length, 0.118);
  EXPECT_EQ(thing->count, 7);
  EXPECT_FALSE(thing->flag);
  EXPECT_EQ(thing->colour, Colour::green);
  EXPECT_EQ(thing->times, (std::vector<double>{1e-3, 2e-5}));
  EXPECT_EQ(thing->share, 1.0);
}

// -0 equals 0, and yet "-0" would stand in tables, and in the text by which a stored run is found.
TEST(TomlReader, MinusZeroIsZero) {
  const auto thing = read_thing("times = \"-0 ms, -0.0 s, 1 ms\"\nshare = -0.0\n");
  ASSERT_TRUE(thing) << thing.error().message();
  EXPECT_FALSE(std::signbit(thing->share));
  for (const double time : thing->times) EXPECT_FALSE(std::signbit(time));
  const KeyDescription share{.name = "share", .dimension = Dimension::share};
  const auto varied = read_values(toml::value<std::string>("-0 %, 5 %"), share, "thing.toml");
  EXPECT_FALSE(std::signbit(std::get<double>(varied.front())));
}

TEST(TomlReader, ExactTextReadsBackToTheSameDouble) {
  for (const double value : {0.1 + 0.2, 1.0 / 3.0, 5e-324, 1.7976931348623157e308, 0.118}) {
    const auto thing = read_thing("length = " + exact_toml(thing_keys()[0], value));
    ASSERT_TRUE(thing) << thing.error().message();
    EXPECT_EQ(thing->length, value);
  }
}

TEST(TomlReader, ReportsTheFirstFaultByLine) {
  const auto thing = read_thing("share = 2\nlength = \"5 ms\"\n");
  ASSERT_FALSE(thing);
  EXPECT_EQ(thing.error().line, 1);
  EXPECT_EQ(thing.error().key, "share");
}

TEST(TomlReader, RefusesWrongTypes) {
  const std::vector<std::pair<const char*, const char*>> wrong{
      {"length = 12", "length"},         {"length = true", "length"},
      {"length = [1]", "length"},        {"length = \"nan cm\"", "length"},
      {"share = nan", "share"},          {"share = \"0.5\"", "share"},
      {"share = 1.5", "share"},          {"part.count = 2.5", "part.count"},
      {"part.count = 10", "part.count"}, {"part.flag = 1", "part.flag"},
      {"colour = \"gren\"", "colour"},   {"colour = 3", "colour"},
      {"times = [\"1 cm\"]", "times"},   {"part = 3", "part"},
      {"length = 1979-05-27", "length"}};
  for (const auto& [text, key] : wrong) {
    const auto thing = read_thing(text);
    ASSERT_FALSE(thing) << text;
    EXPECT_EQ(thing.error().key, key) << thing.error().message();
    EXPECT_EQ(thing.error().line, 1);
  }
}

TEST(TomlReader, SuggestsTheNearestWordAndKey) {
  EXPECT_EQ(read_thing("colour = \"gren\"").error().suggestion, "\"green\"");
  EXPECT_EQ(read_thing("lenght = \"1 cm\"").error().suggestion, "length");
  EXPECT_EQ(read_thing("[prat]\ncount = 2").error().suggestion, "part.count");
  EXPECT_EQ(read_thing("[colours]").error().suggestion, "colour");
  EXPECT_EQ(read_thing("quite_different = 1").error().suggestion, "");
}

TEST(TomlReader, SuggestsOneNameWithinTwoLetters) {
  const std::vector<std::string> words{"normal", "uniform", "G1", "body.x", "body.r"};
  for (const char* word : {"lognormal", "G2", "body.z", "unifrmmm"})
    EXPECT_EQ(nearest_of(word, words), "") << word;
  EXPECT_EQ(nearest_of("Normal", words), "normal");
  EXPECT_EQ(nearest_of("unifrom", words), "uniform");
}

TEST(TomlReader, ReadsSeveralValuesForASweep) {
  const toml::table table =
      parse_toml("a = \"0.1, 0.2 mm\"\nb = [\"red\", \"green\"]\nc = [0.1, 0.2]\nd = \"0, -1 mm\"", "s");
  const auto keys = thing_keys();
  EXPECT_EQ(read_values(*table.get("a"), keys[0], "s"), (std::vector<Value>{1e-4, 2e-4}));
  EXPECT_EQ(read_values(*table.get("b"), keys[3], "s"),
            (std::vector<Value>{std::string("red"), std::string("green")}));
  EXPECT_EQ(read_values(*table.get("c"), keys[5], "s").size(), 2u);
  EXPECT_FALSE(caught([&] { return read_values(*table.get("d"), keys[0], "s"); }));
}

TEST(TomlReader, WritesAShareAsItReadsIt) {
  KeyDescription key;
  key.dimension = Dimension::share;
  EXPECT_EQ(exact_toml(key, 0.04), "\"4 %\"");
  EXPECT_NE(allowed_text(key).find("\"5 %\""), std::string::npos);
}

TEST(TomlReader, AReasonHasTwoWordsAndEightLetters) {
  const auto is_refused = [](const std::string& text) {
    return !caught([&] { return check_reason(text, {"study.toml", 3, 1}, "accept.steel"), true; });
  };
  for (const char* text : {"", "...", "x", "because", "12345678 9012345", "accordingly", "a b c d e f g"})
    EXPECT_TRUE(is_refused(text)) << text;
  for (const char* text : {"our trials agree", "změřený přetlak"}) EXPECT_FALSE(is_refused(text)) << text;
}

}  // namespace
}  // namespace launchsafe::scene
