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
               &Thing::colour) |
          formerly({"verdant", "green"}),
      list_key("times", Dimension::time, at_least(0), Standing::assumed, "A list.", &Thing::times) |
          may_be_empty(),
      number_key("share", Dimension::number, between(0, 1), Standing::assumed, "A share.", &Thing::share),
  };
}

Expected<Thing> read_thing(std::string_view text) {
  const auto table = parse_toml(text, "thing.toml");
  if (!table) return table.error();
  Thing thing;
  const auto places = read_table(*table, thing_keys(), {"other"}, "thing.toml", thing);
  if (!places) return places.error();
  return thing;
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
  const auto written = parse_value("-0 %", share, {});
  ASSERT_TRUE(written);
  EXPECT_FALSE(std::signbit(std::get<double>(*written)));
  const auto varied = read_values(toml::value<std::string>("-0 %, 5 %"), share, "thing.toml");
  ASSERT_TRUE(varied);
  EXPECT_FALSE(std::signbit(std::get<double>(varied->front())));
}

TEST(TomlReader, LeavesDefaultsWhereNothingIsSaid) {
  const auto thing = read_thing("");
  ASSERT_TRUE(thing);
  EXPECT_EQ(thing->length, 2.5e-3);
  EXPECT_EQ(std::get<double>(thing_keys()[0].default_value()), 2.5e-3);
}

TEST(TomlReader, ExactTextReadsBackToTheSameDouble) {
  for (const double value : {0.1 + 0.2, 1.0 / 3.0, 5e-324, 1.7976931348623157e308, 0.118}) {
    const auto thing = read_thing("length = " + exact_toml(thing_keys()[0], value));
    ASSERT_TRUE(thing) << thing.error().message();
    EXPECT_EQ(thing->length, value);
  }
}

TEST(TomlReader, AFormerWordIsReadAsThePresentOneAndKeptInExactText) {
  const auto thing = read_thing("colour = \"verdant\"");
  ASSERT_TRUE(thing) << thing.error().message();
  EXPECT_EQ(thing->colour, Colour::green);
  const Key<Thing> colour = *find_key(thing_keys(), "colour");
  EXPECT_EQ(std::get<std::string>(colour.get(*thing)), "green");
  EXPECT_EQ(exact_toml(colour, colour.get(*thing)), "'verdant'");
  EXPECT_EQ(exact_toml(colour, std::string("red")), "'red'");
}

TEST(TomlReader, KeysOfAPartStandUnderItsPrefix) {
  struct Box {
    Thing thing;
  };
  const auto keys = keys::keys_of_part("box.", &Box::thing, thing_keys());
  const Key<Box>* count = find_key(keys, "box.part.count");
  ASSERT_NE(count, nullptr);
  Box box;
  count->set(box, 7.0);
  EXPECT_EQ(box.thing.count, 7);
  EXPECT_EQ(std::get<double>(count->get(box)), 7.0);
  EXPECT_EQ(std::get<double>(count->default_value()), 3.0);
}

TEST(TomlReader, ReportsTheFirstFaultByLine) {
  const auto thing = read_thing("share = 2\nlength = \"5 ms\"\n");
  ASSERT_FALSE(thing);
  EXPECT_EQ(thing.error().line, 1);
  EXPECT_EQ(thing.error().key, "share");
}

TEST(TomlReader, RefusesWrongTypes) {
  struct Case {
    const char* text;
    const char* key;
    const char* found;
    const char* allowed;
  };
  for (const Case& wrong :
       std::vector<Case>{{"length = 12", "length", "12, without a unit", "a length"},
                         {"length = true", "length", "true", "a length"},
                         {"length = [1]", "length", "[ 1 ]", "a length"},
                         {"length = \"nan cm\"", "length", "not a finite number", "a length"},
                         {"share = nan", "share", "not a finite number", "0 to 1"},
                         {"share = \"0.5\"", "share", "which is a text", "a number"},
                         {"share = 1.5", "share", "1.5", "0 to 1"},
                         {"part.count = 2.5", "part.count", "no whole number", "1 to 9"},
                         {"part.count = 10", "part.count", "10", "1 to 9"},
                         {"part.flag = 1", "part.flag", "1", "true or false"},
                         {"colour = \"gren\"", "colour", "\"gren\"", "\"red\" or \"green\""},
                         {"colour = 3", "colour", "3", "\"red\" or \"green\""},
                         {"times = [\"1 cm\"]", "times", "which is a length", "time"},
                         {"part = 3", "part", "3", "a table, written [part]"},
                         {"length = 1979-05-27", "length", "1979-05-27", "a length"}}) {
    const auto thing = read_thing(wrong.text);
    ASSERT_FALSE(thing) << wrong.text;
    const InputError& error = thing.error();
    EXPECT_EQ(error.key, wrong.key) << error.message();
    EXPECT_NE(error.found.find(wrong.found), std::string::npos) << error.message();
    EXPECT_NE(error.allowed.find(wrong.allowed), std::string::npos) << error.message();
    EXPECT_EQ(error.line, 1);
  }
}

TEST(TomlReader, SaysNumbersInTheFewestDigitsThatReadBack) {
  const InputError wrong = read_thing("length = 496.3").error();
  EXPECT_EQ(wrong.found, "496.3, without a unit");
  EXPECT_EQ(wrong.suggestion, "");
  EXPECT_EQ(read_thing("colour = [0.1, 0.3]").error().found, "[ 0.1, 0.3 ]");
}

TEST(TomlReader, OneNumberInThePlaceOfAListIsReadAsOneValueOfIt) {
  const InputError wrong = read_thing("times = 0.3").error();
  EXPECT_EQ(wrong.found, "0.3, without a unit");
  EXPECT_NE(wrong.allowed.find("(units: ms"), std::string::npos) << wrong.allowed;
}

TEST(TomlReader, SuggestsTheDecimalPointOfANumberAndTheQuotationMarksOfAQuantity) {
  for (const char* text : {"share = 1,3", "length = \"1 cm\"\nshare = 1,3  # a remark\n"})
    EXPECT_EQ(read_thing(text).error().suggestion, "1.3") << text;
  EXPECT_EQ(read_thing("length = 2.5 mm  # a remark").error().suggestion, "\"2.5 mm\"");
  EXPECT_EQ(read_thing("length = 30um").error().suggestion, "\"30um\"");
  EXPECT_EQ(read_thing("times = 0, 0.3 ms").error().suggestion, "\"0, 0.3 ms\"");
  EXPECT_EQ(read_thing("part = { length = 2 cm }").error().suggestion, "\"2 cm\"");
  // What may divide thousands, or belong to a list, is not guessed.
  for (const char* text : {"share = 1,300", "share = 0, 0.01", "share = 0,0.01", "share = ,"})
    EXPECT_EQ(read_thing(text).error().suggestion, "") << text;
}

TEST(TomlReader, AKeyOfTheFileBelowATableIsToldWhereItBelongs) {
  EXPECT_EQ(read_thing("[part]\nlength = \"1 cm\"").error().suggestion,
            "length above the first [table], where it belongs");
  EXPECT_EQ(read_thing("[part]\npart.count = 2").error().suggestion,
            "part.count above the first [table], where it belongs");
  EXPECT_EQ(read_thing("[part]\ncuont = 2").error().suggestion, "part.count");
}

TEST(TomlReader, OfATableWithoutTablesAllKeysAreTold) {
  EXPECT_EQ(unknown_key({}, "set.load.peak", {"gap", "source"}).allowed, "the keys gap, source");
}

TEST(TomlReader, SuggestsTheNearestWordAndKey) {
  EXPECT_EQ(read_thing("colour = \"gren\"").error().suggestion, "\"green\"");
  EXPECT_EQ(read_thing("lenght = \"1 cm\"").error().suggestion, "length");
  EXPECT_EQ(read_thing("[prat]\ncount = 2").error().suggestion, "part.count");
  EXPECT_EQ(read_thing("[colours]").error().suggestion, "colour");
  EXPECT_EQ(read_thing("quite_different = 1").error().suggestion, "");
}

TEST(TomlReader, SuggestsNoWordOfAnotherMeaning) {
  const std::vector<std::string> words{"normal",       "uniform", "elastic",    "load.peak", "station.width",
                                       "gap.pressure", "G1",      "load.width", "body.x",    "body.r"};
  for (const char* word : {"lognormal", "inelastic", "abnormal", "uni", "G2", "width", "body.z", "unifrmmm"})
    EXPECT_EQ(nearest_of(word, words), "") << word;
  EXPECT_EQ(nearest_of("Normal", words), "normal");
  EXPECT_EQ(nearest_of("unifrom", words), "uniform");
  EXPECT_EQ(nearest_of("peak", words), "load.peak");
  EXPECT_EQ(unknown_key({}, "load.pressure_of_gas", words).suggestion, "");
  EXPECT_EQ(unknown_key({}, "charge.pressure", words).suggestion, "gap.pressure");
}

TEST(TomlReader, ReadsSeveralValuesForASweep) {
  const auto table =
      parse_toml("a = \"0.1, 0.2 mm\"\nb = [\"red\", \"green\"]\nc = [0.1, 0.2]\nd = \"0, -1 mm\"", "s");
  ASSERT_TRUE(table);
  const auto keys = thing_keys();
  const auto lengths = read_values(*table->get("a"), keys[0], "s");
  ASSERT_TRUE(lengths);
  EXPECT_EQ(*lengths, (std::vector<Value>{1e-4, 2e-4}));
  const auto words = read_values(*table->get("b"), keys[3], "s");
  ASSERT_TRUE(words);
  EXPECT_EQ(*words, (std::vector<Value>{std::string("red"), std::string("green")}));
  EXPECT_EQ(read_values(*table->get("c"), keys[5], "s")->size(), 2u);
  EXPECT_FALSE(read_values(*table->get("d"), keys[0], "s"));
}

TEST(TomlReader, ParsesValuesAsWrittenOnACommandLine) {
  const auto keys = thing_keys();
  EXPECT_EQ(std::get<double>(*parse_value("2 mm", keys[0], {})), 2e-3);
  EXPECT_EQ(std::get<double>(*parse_value("0.25", keys[5], {})), 0.25);
  EXPECT_EQ(std::get<bool>(*parse_value("false", keys[2], {})), false);
  EXPECT_FALSE(parse_value("-2 mm", keys[0], {}));
  EXPECT_FALSE(parse_value("2.5", keys[1], {}));
  EXPECT_FALSE(parse_value("yes", keys[2], {}));
}

TEST(TomlReader, SyntaxErrorsNameTheirPlace) {
  const auto table = parse_toml("a = 1\nb = = 2\n", "thing.toml");
  ASSERT_FALSE(table);
  EXPECT_TRUE(table.error().message().starts_with("thing.toml:2:")) << table.error().message();
}

}  // namespace
}  // namespace launchsafe::scene
