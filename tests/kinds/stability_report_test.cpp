// The tables, picture, page and JSON of a stability study made by hand.
#include "facts_in_text.hpp"
#include "kinds/made_studies.hpp"
#include "launchsafe/kinds/stability.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>

namespace launchsafe::kinds {

using namespace study;
using namespace report;
namespace {

using testing::in_order;

StressCaseRow row(const std::string& group, const std::string& name, Outcome outcome,
                  const std::string& finding) {
  StressCaseRow made;
  made.asked.group = group;
  made.asked.name = name;
  made.finding = {outcome, finding};
  return made;
}

/// With one gap.
StressCaseRow launch(StressCaseRow made) {
  made.result.run = {run::RunStatus::completed, 21000, 9207, 4e-5, {}};
  made.end_time = 18e-3;
  GapRow gap;
  gap.gap = 2e-4;
  gap.maximum.temperature = gap.heated = 471.0;
  made.result.gaps = {gap};
  return made;
}

/// One of every outcome.
StabilityResult made_stability() {
  StabilityResult result;
  result.study = bare_study(kinds::traits_of("stability"), {2e-4});
  const std::string off = "off by | 11 K, more than 4 K; 0.02 cm: T max 471.0 K, does not ignite";
  StressCaseRow wrong = launch(row("load", "wrong", Outcome::wrong, off));
  wrong.heated_against = {460.0};
  wrong.deviations = {11.0};
  StressCaseRow late = row("load", "late", Outcome::degraded, "caught late; after 640 steps");
  late.asked.expected = {Outcome::caught};
  StressCaseRow lost = row("load", "lost", Outcome::wrong, "");
  lost.result.outcome = RunOutcome::failed;
  lost.result.failure = "the run failed: no more memory";
  result.rows = {row("load", "reader", Outcome::caught, "refused: \"at least 0\"; load.peak: found -1"),
                 wrong, launch(row("contact", "sound", Outcome::held, "does not ignite")), late, lost};
  return result;
}

TEST(StabilityReport, TheAnswerCountsAndNamesWhatIsWrongUnexpectedAndNotComputed) {
  const std::string text = answer(made_stability());
  EXPECT_TRUE(in_order(text, {"5 stress cases", "1 held", "1 degraded", "1 caught", "1 WRONG"}));
  EXPECT_TRUE(in_order(text, {"load: wrong: WRONG: ", "0.02 cm", "471.0 K", "does not ignite",
                              "load: late: degraded: ", "load: lost: not computed: ", "no more memory"}));
}

TEST(StabilityReport, WhatIsNotHeldIsARowWithItsReasonInAFewWords) {
  const Report report = report_of(made_stability());
  const std::vector<std::vector<Cell>> expected{
      {"load: reader", "caught", "refused: \"at least 0\""},
      {"load: wrong", "WRONG", "off by | 11 K"},
      {"load: late", "degraded", "caught late"},
      {"load: lost", "not computed", "the run failed: no more memory"}};
  EXPECT_EQ(std::get<ReportTable>(report.items[0]).table.rows, expected);
}

TEST(StabilityReport, JsonHoldsCountsAndCasesWithTheirNumbers) {
  const auto json = json_of(made_stability());
  EXPECT_EQ(json["kind"], "stability");
  EXPECT_EQ(json["counts"],
            nlohmann::ordered_json::parse("{\"cases\": 5, \"held\": 1, \"degraded\": 1, \"caught\": 1, "
                                          "\"WRONG\": 1, \"not_as_expected\": 1, \"not_computed\": 1}"));
  ASSERT_EQ(json["cases"].size(), 5u);
  EXPECT_TRUE(json["cases"][0]["steps"].is_null()) << "a case of the reader has no run";
  EXPECT_TRUE(json["cases"][2]["deviation_K"].is_null());
  const auto expect_part = [&](std::size_t row, const char* part) {
    const auto expected = nlohmann::ordered_json::parse(part);
    for (const auto& [key, value] : expected.items()) EXPECT_EQ(json["cases"][row][key], value) << key;
  };
  expect_part(1, R"({"outcome": "WRONG", "deviation_K": 11.0, "safe_computation_K": 460.0,
                     "temperature_max_inert_K": 471.0, "steps": 21000, "state": "does not ignite"})");
  expect_part(3, R"({"as_expected": "no", "expected": "caught"})");
  expect_part(4, R"({"outcome": "not computed", "finding": "the run failed: no more memory"})");
}

TEST(StabilityReport, WritesThePageAndItsFiles) {
  const auto rendered = render_report(report_of(made_stability()));
  EXPECT_NE(text_in(rendered, "study.json"), "");
  const std::string page = text_in(rendered, "report.md");
  EXPECT_NE(page.find("launchsafe study studies/made.toml -o DIR"), std::string::npos);
  EXPECT_NE(page.find("off by \\| 11 K"), std::string::npos);
  EXPECT_NE(text_in(rendered, "stability.csv").find("load,wrong,WRONG,not WRONG,no,"), std::string::npos);
}

}  // namespace
}  // namespace launchsafe::kinds
