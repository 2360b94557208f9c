#include "launchsafe/report/table.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <functional>
#include <limits>
#include <optional>
#include <string>

namespace launchsafe::report {
namespace {

Table verdicts() {
  Table table;
  table.title = "Verdicts";
  table.columns = {{"gap", "gap", keys::fixed(3, centimetre)},
                   {"t_max", "T max", keys::fixed(1, kelvin)},
                   {"at", "at"},
                   {"steps", "steps", count()},
                   {"verdict", "verdict"}};
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

TEST(Table, IsPrintedInPartsThatFitWhereItIsTooWide) {
  EXPECT_EQ(to_text(verdicts(), 39), to_text(verdicts()));
  EXPECT_EQ(to_text(verdicts(), 24),
            "Verdicts\n"
            "\n"
            "gap [cm]  T max [K]  at\n"
            "--------  ---------  --\n"
            "   0.000      416.1  G2\n"
            "   0.040        n/a\n"
            "\n"
            "gap [cm]  steps  verdict\n"
            "--------  -----  -------\n"
            "   0.000  36000  SAFE\n"
            "   0.040      9  UNSAFE\n");
  const std::string narrow = to_text(verdicts(), 1);
  EXPECT_NE(narrow.find("gap [cm]  verdict\n"), std::string::npos)
      << "one column beside the first at the least";
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
  table.columns = {{"a_b", "a|b"}};
  table.rows = {{"x|y \\ *z* _u_ `v` <b> & \nnew"}};
  const std::string text = to_markdown(table);
  EXPECT_NE(text.find("| a\\|b "), std::string::npos) << text;
  EXPECT_NE(text.find("x\\|y \\\\ \\*z\\* \\_u\\_ \\`v\\` \\<b\\> &amp; <br>new"), std::string::npos) << text;
}

TEST(Table, BoundsAreRoundedToTheSafeSideForPeopleAndWholeForPrograms) {
  const Table table{"",
                    {{"low", "low", down(keys::significant(3, centimetre))},
                     {"high", "high", up(keys::significant(3, centimetre))},
                     {"off", "off", up(keys::significant(2))},
                     {"margin", "margin", down(keys::fixed(1, kelvin))}},
                    {{0.017699, 0.053601, 141.0, -0.01}, {0.02, 0.05, 0.0, 30.0}}};
  EXPECT_EQ(to_text(table),
            "low [cm]  high [cm]  off  margin [K]\n"
            "--------  ---------  ---  ----------\n"
            "  0.0176     0.0537  150        -0.1\n"
            "    0.02       0.05    0        30.0\n");
  EXPECT_NE(to_csv(table).find("0.017699,0.053601,141,-0.01"), std::string::npos);
}

TEST(Table, HtmlEscapesItsCellsAndHasTheVerdictAsAClass) {
  Table table = verdicts();
  table.rows[0][2] = std::string("<b>");
  const std::string html = to_html(table, "verdicts");
  for (const char* part : {"<table id=\"verdicts-table\">", "&lt;b&gt;", ">416.1</td>",
                           "<td class=\"UNSAFE\" data-heading=\"verdict\">UNSAFE</td>"})
    EXPECT_NE(html.find(part), std::string::npos) << part << " in " << html;
}

TEST(Table, CsvFollowsRfc4180) {
  Table table;
  table.columns = {{"case", "case"}, {"t_max", "T max", keys::fixed(1, kelvin)}};
  table.rows = {{"plain", 1.0 / 3},
                {"with, comma", 0.1},
                {"a \"quote\"", 1e300},
                {"two\nlines", std::monostate{}},
                {"", std::numeric_limits<double>::quiet_NaN()}};
  EXPECT_EQ(to_csv(table),
            "case,t_max_K\r\n"
            "plain,0.3333333333333333\r\n"
            "\"with, comma\",0.1\r\n"
            "\"a \"\"quote\"\"\",1e+300\r\n"
            "\"two\nlines\",\r\n"
            ",NaN\r\n");
}

TEST(Table, JsonKeepsNumbersExactlyAndOrder) {
  const nlohmann::ordered_json rows = json_rows(verdicts());
  EXPECT_EQ(rows[0].dump(), R"({"gap_cm":0.0,"t_max_K":416.149,"at":"G2","steps":36000,"verdict":"SAFE"})");
  EXPECT_TRUE(rows[1]["t_max_K"].is_null());
  EXPECT_TRUE(rows[1]["at"].is_null());
}

/// A row as results have it, in SI.
struct Measured {
  std::string name;
  double gap;                  ///< m
  std::optional<double> peak;  ///< Pa
  double drift;                ///< share
  std::size_t steps;
  bool sound;
};
struct Outer {
  const Measured* part;
};

Quantities<Measured> measured_quantities() {
  return {{{"case", "case", keys::text(), "The case."}, &Measured::name},
          {{"gap", "gap", keys::significant(6, centimetre), "Its gap."}, &Measured::gap},
          {{"peak", "p max", keys::fixed(1, megapascal), "Its peak."}, &Measured::peak},
          {{"drift", "drift", keys::fixed(2, percent), "Its drift."}, &Measured::drift},
          {{"steps", "steps", count(), "Its steps."}, &Measured::steps},
          {{"sound", "sound", keys::text(), "Whether it is."}, &Measured::sound}};
}

TEST(Quantity, RowsInSiAreShownInTheUnitsOfTheirQuantities) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const Table table =
      table_of("Cases", measured_quantities(),
               {{"a", 0.00039, 496e6, 0.0123, 12, true}, {"b", 0.07, std::nullopt, nan, 0, false}});
  EXPECT_EQ(to_csv(table),
            "case,gap_cm,peak_MPa,drift_percent,steps,sound\r\n"
            "a,0.039,496,1.23,12,yes\r\n"
            "b,7,,,0,no\r\n")
      << "a decimal number stays one to the last digit: 0.00039 m is 0.039 cm";
}

TEST(Quantity, ANumberThatIsNotThereIsToldOnlyWhereItAlwaysIs) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const Column column{"u", "u", keys::fixed(1, kelvin), "Uncertainty."};
  const Quantities<double> quantities{{column, std::identity{}},
                                      {named("v", always(column)), std::identity{}}};
  EXPECT_EQ(to_csv(table_of({}, quantities, {infinite})), "u_K,v_K\r\n,Infinity\r\n");
}

TEST(Table, AColumnMayBeForPeopleOrForProgramsAlone) {
  Table table = verdicts();
  table.columns[1].audience = Audience::people;
  table.columns[3].audience = Audience::programs;
  EXPECT_EQ(to_text(table).find("steps"), std::string::npos) << to_text(table);
  EXPECT_EQ(to_markdown(table).find("36000"), std::string::npos) << to_markdown(table);
  EXPECT_TRUE(to_csv(table).starts_with("gap_cm,at,steps,verdict\r\n0,G2,36000,SAFE\r\n")) << to_csv(table);
  EXPECT_EQ(json_rows(table)[0].size(), 4u);
  EXPECT_EQ(json_rows(table)[0].dump(), R"({"gap_cm":0.0,"at":"G2","steps":36000,"verdict":"SAFE"})");
}

}  // namespace
}  // namespace launchsafe::report
