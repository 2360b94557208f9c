// The tables, page and JSON of a stability study made by hand.
#include "facts_in_text.hpp"
#include "kinds/made_studies.hpp"
#include "launchsafe/kinds/stability.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <string>

namespace launchsafe::kinds {

using namespace study;
using namespace report;
namespace {

using kinds::StressCaseRow, kinds::StabilityResult;
using testing::in_order;

StressCaseRow row(const std::string& name, Outcome outcome, const std::string& finding) {
  StressCaseRow made;
  made.group = "load";
  made.name = name;
  made.must_hold = "it | holds";
  made.finding = {outcome, finding};
  return made;
}

StressCaseRow launch(const std::string& name, Outcome outcome, double against) {
  StressCaseRow made = row(name, outcome, "0.02 cm: T max 471.0 K, SAFE");
  made.ran = true;
  made.run = {run::RunStatus::completed, 21000, 9207, 4e-5, {}};
  made.end_time = 18e-3;
  kinds::StressCaseGap gap;
  gap.gap = 2e-4;
  gap.temperature = gap.heated = 471.0;
  gap.heated_against = against;
  gap.uncertainty = 4.0;
  gap.judgement = {study::Verdict::safe, "margin"};
  made.gaps = {gap};
  return made;
}

/// One of every outcome; the wrong one first among the launches.
StabilityResult made_stability() {
  StabilityResult result;
  result.study = bare_study(kinds::traits_of("stability"), {2e-4});
  StressCaseRow reader = row("reader", Outcome::held, "3e-9 of 1e-6");
  StressCaseRow late = row("late", Outcome::degraded, "caught late");
  late.expected = {Outcome::caught};
  StressCaseRow lost = row("lost", Outcome::wrong, "");
  lost.failure = "the run failed: no more memory";
  result.rows = {reader, launch("wrong", Outcome::wrong, 460.0),
                 launch("sound", Outcome::held, std::numeric_limits<double>::quiet_NaN()), late, lost};
  return result;
}

TEST(StabilityReport, TheAnswerCountsAndNamesWhatIsWrongUnexpectedAndNotComputed) {
  const std::string text = answer(made_stability());
  EXPECT_TRUE(in_order(text, {"5 stress cases", "2 held", "1 degraded", "0 caught", "1 WRONG"}));
  EXPECT_TRUE(in_order(text, {"load: wrong: ", "0.02 cm", "471.0 K", "SAFE", "expects",
                              "load: late: ", "computed", "load: lost: ", "no more memory"}));
}

TEST(StabilityReport, WithoutAWrongCaseItSaysSo) {
  StabilityResult result = made_stability();
  result.rows = {result.rows[0], result.rows[2]};
  EXPECT_NE(answer(result).find("No broken computation passes for a sound one."), std::string::npos);
  EXPECT_EQ(answer(result).find("Not as"), std::string::npos);
  EXPECT_EQ(answer(made_stability()).find("No broken"), std::string::npos);
}

TEST(StabilityReport, EveryCaseIsARowWithItsOutcomeAndReason) {
  const Table table = stability_table(made_stability());
  ASSERT_EQ(table.rows.size(), 5u);
  const std::vector<std::string> outcomes{"held", "WRONG", "held", "degraded", "not computed"};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(std::get<std::string>(table.rows[i][3]), outcomes[i]);
  EXPECT_EQ(std::get<std::string>(table.rows[3][4]), "caught");
  EXPECT_EQ(std::get<std::string>(table.rows[4][5]), "the run failed: no more memory");
}

TEST(StabilityReport, LaunchesHaveTheirNumbersAndNothingWhereThereIsNone) {
  const Table table = launch_table(made_stability());
  ASSERT_EQ(table.rows.size(), 2u);
  const auto keys = keys_of(table);
  const auto at = static_cast<std::size_t>(std::find(keys.begin(), keys.end(), "deviation_K") - keys.begin());
  EXPECT_DOUBLE_EQ(std::get<double>(table.rows[0][at]), 11.0);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(table.rows[1][at]));
}

TEST(StabilityReport, JsonHoldsCountsAndCases) {
  const auto json = json_of(made_stability());
  EXPECT_EQ(json["kind"], "stability");
  EXPECT_EQ(json["counts"]["WRONG"], 1);
  EXPECT_EQ(json["counts"]["not_as_expected"], 1);
  EXPECT_EQ(json["counts"]["not_computed"], 1);
  ASSERT_EQ(json["cases"].size(), 5u);
  EXPECT_EQ(json["cases"][1]["outcome"], "WRONG");
  EXPECT_EQ(json["cases"][3]["as_expected"], "no");
  ASSERT_EQ(json["launches"].size(), 2u) << "a case of the reader has none";
  EXPECT_EQ(json["launches"][0]["deviation_K"], 11.0);
  EXPECT_EQ(json["launches"][0]["temperature_max_inert_K"], 471.0);
  EXPECT_TRUE(json["launches"][1]["deviation_K"].is_null());
}

TEST(StabilityReport, LongFindingsAreCutOnATerminalOnly) {
  StabilityResult result = made_stability();
  result.rows[0].finding.text = std::string(99, 'x') + "\xc2\xb5" + std::string(50, 'y');
  const std::string shown = std::get<std::string>(stability_summary(result).rows[0][3]);
  EXPECT_EQ(shown, std::string(99, 'x') + " ...") << "never half a letter";
  EXPECT_EQ(std::get<std::string>(stability_table(result).rows[0][5]), result.rows[0].finding.text);
}

TEST(StabilityReport, WritesThePageAndItsFiles) {
  const Folder folder;
  const auto written = write_report(report_of(made_stability()), folder.path);
  ASSERT_TRUE(written) << written.error().message;
  EXPECT_EQ(written->files,
            (std::vector<std::string>{"stability.csv", "launches.csv", "report.md", "study.json"}));
  const std::string page = content_of(folder.path / "report.md");
  EXPECT_NE(page.find("launchsafe study studies/made.toml -o DIR"), std::string::npos);
  EXPECT_NE(page.find("it \\| holds"), std::string::npos);
  EXPECT_NE(content_of(folder.path / "stability.csv").find("load,wrong,it | holds,WRONG"), std::string::npos);
}

}  // namespace
}  // namespace launchsafe::kinds
