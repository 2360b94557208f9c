#include "launchsafe/report/table.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <string>

namespace launchsafe::report {
namespace {

Table verdicts() {
  Table table;
  table.title = "Verdicts";
  table.columns = {{"gap", "cm", Alignment::right, 3},
                   {"T max", "K", Alignment::right, 1},
                   text_column("at"),
                   {"steps", "", Alignment::right, 0},
                   text_column("verdict")};
  table.rows = {
      {0.0, 416.149, "G2", std::int64_t{36000}, "SAFE"},
      {0.04, std::numeric_limits<double>::quiet_NaN(), std::monostate{}, std::int64_t{9}, "UNSAFE"}};
  return table;
}

TEST(Table, TextAlignsEveryColumn) {
  EXPECT_EQ(to_text(verdicts()),
            "Verdicts\n"
            "\n"
            "gap [cm]  T max [K]  at  steps  verdict\n"
            "--------  ---------  --  -----  -------\n"
            "   0.000      416.1  G2  36000  SAFE\n"
            "   0.040        n/a          9  UNSAFE\n");
}

TEST(Table, TextAlignsByCharactersNotBytes) {
  Table table;
  table.columns = {text_column("\u03c4"), text_column("b")};
  table.rows = {{"\u03b1\u03b2", "x"}, {"ab", "y"}};
  EXPECT_EQ(to_text(table), "\u03c4   b\n--  -\n\u03b1\u03b2  x\nab  y\n");
}

TEST(Table, TextKeepsARowOnItsLine) {
  Table table;
  table.columns = {text_column("reason")};
  table.rows = {{"first\nsecond\tthird"}};
  EXPECT_EQ(to_text(table), "reason\n------------------\nfirst second third\n");
}

TEST(Table, NotesStandUnderIt) {
  Table table = verdicts();
  table.notes = {"One row was calibrated.", "Two were not."};
  EXPECT_TRUE(to_text(table).ends_with("UNSAFE\n\nOne row was calibrated.\nTwo were not.\n"));
  EXPECT_TRUE(to_markdown(table).ends_with("|\n\nOne row was calibrated.\n\nTwo were not.\n"));
}

TEST(Table, MarkdownHasItsRuleAndAlignment) {
  EXPECT_EQ(to_markdown(verdicts()),
            "**Verdicts**\n"
            "\n"
            "| gap \\[cm\\] | T max \\[K\\] | at  | steps | verdict |\n"
            "| ---------: | ----------: | --- | ----: | ------- |\n"
            "|      0.000 |       416.1 | G2  | 36000 | SAFE    |\n"
            "|      0.040 |         n/a |     |     9 | UNSAFE  |\n");
}

TEST(Table, MarkdownEscapesWhatWouldBeMarkup) {
  Table table;
  table.columns = {text_column("a|b")};
  table.rows = {{"x|y \\ *z* _u_ `v` <b> & \nnew"}};
  const std::string text = to_markdown(table);
  EXPECT_NE(text.find("| a\\|b "), std::string::npos) << text;
  EXPECT_NE(text.find("x\\|y \\\\ \\*z\\* \\_u\\_ \\`v\\` \\<b\\> &amp; <br>new"), std::string::npos) << text;
}

TEST(Table, CsvFollowsRfc4180) {
  Table table;
  table.columns = {text_column("case"), {"T max", "K", Alignment::right, 1}};
  table.rows = {{"plain", 1.0 / 3},
                {"with, comma", 0.1},
                {"a \"quote\"", 1e300},
                {"two\nlines", std::monostate{}},
                {"", std::numeric_limits<double>::quiet_NaN()},
                {"short"}};
  EXPECT_EQ(to_csv(table),
            "case,t_max_K\r\n"
            "plain,0.3333333333333333\r\n"
            "\"with, comma\",0.1\r\n"
            "\"a \"\"quote\"\"\",1e+300\r\n"
            "\"two\nlines\",\r\n"
            ",NaN\r\n"
            "short,\r\n");
}

TEST(Table, JsonKeepsNumbersExactlyAndOrder) {
  const nlohmann::ordered_json json = to_json(verdicts());
  EXPECT_EQ(json["title"], "Verdicts");
  EXPECT_EQ(json["columns"][0], (nlohmann::ordered_json{{"key", "gap_cm"}, {"name", "gap"}, {"unit", "cm"}}));
  EXPECT_EQ(json["rows"][0].dump(),
            R"({"gap_cm":0.0,"t_max_K":416.149,"at":"G2","steps":36000,"verdict":"SAFE"})");
  EXPECT_TRUE(json["rows"][1]["t_max_K"].is_null());
  EXPECT_TRUE(json["rows"][1]["at"].is_null());
}

TEST(Table, KeysAreMadeOfNameAndUnitAndAllDifferent) {
  Table table;
  table.columns = {{"T max", "K"},       {"t-max", "K"},
                   {"density", "kg/m3"}, {"GCI", "%"},
                   {"\u03c4", ""},       {"T max", "K", Alignment::right, 1, Notation::fixed, "own"}};
  EXPECT_EQ(keys_of(table), (std::vector<std::string>{"t_max_K", "t_max_K_2", "density_kg_per_m3",
                                                      "gci_percent", "column", "own"}));
}

TEST(Table, AColumnMayBeForPeopleOrForProgramsAlone) {
  Table table = verdicts();
  table.columns[1].audience = Audience::people;
  table.columns[3].audience = Audience::programs;
  EXPECT_EQ(to_text(table).find("steps"), std::string::npos) << to_text(table);
  EXPECT_EQ(to_markdown(table).find("36000"), std::string::npos) << to_markdown(table);
  EXPECT_TRUE(to_csv(table).starts_with("gap_cm,at,steps,verdict\r\n0,G2,36000,SAFE\r\n")) << to_csv(table);
  EXPECT_EQ(to_json(table)["columns"].size(), 4u);
  EXPECT_EQ(to_json(table)["rows"][0].dump(), R"({"gap_cm":0.0,"at":"G2","steps":36000,"verdict":"SAFE"})");
}

TEST(Table, RowsAppendedToAnArrayAreThoseOfTheJson) {
  std::string text = "[";
  append_json_rows(text, verdicts());
  EXPECT_EQ(nlohmann::ordered_json::parse(text + "]"), to_json(verdicts())["rows"]);
  append_json_rows(text, verdicts());
  EXPECT_EQ(nlohmann::ordered_json::parse(text + "]").size(), 4u) << "behind what is there";
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 4) << "a line each";
}

TEST(Table, NotationsRound) {
  Table table;
  table.columns = {{"a", "", Alignment::right, 2, Notation::scientific},
                   {"b", "", Alignment::right, 3, Notation::significant}};
  table.rows = {{1.5e-5, 2.0e-9}};
  EXPECT_NE(to_text(table).find("1.50e-05  2e-09"), std::string::npos) << to_text(table);
}

TEST(Table, WithoutRowsItIsStillATable) {
  Table table = verdicts();
  table.rows.clear();
  EXPECT_NE(to_text(table).find("gap [cm]"), std::string::npos);
  EXPECT_EQ(to_json(table)["rows"], nlohmann::ordered_json::array());
  EXPECT_EQ(to_csv(table), "gap_cm,t_max_K,at,steps,verdict\r\n");
}

}  // namespace
}  // namespace launchsafe::report
