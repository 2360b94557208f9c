// Statements of a publication: what their files may say, and what is computed for them.
#include "launchsafe/study/published_statements.hpp"

#include "launchsafe/report/statement_table.hpp"
#include "launchsafe/study/gap_analysis.hpp"
#include "synthetic_launch.hpp"

#include <cmath>
#include <fstream>

namespace launchsafe::study {
namespace {

using Agreement = StatementCheck::Agreement;

std::string statement(const std::string& keys) {
  return "statement = [{ " + keys + ", source = \"Fig. 1\" }]\n";
}

scene::InputError error_of_statement(const std::string& keys) {
  const auto study = parse_here(critical_text + statement(keys));
  EXPECT_FALSE(study) << keys;
  return study ? scene::InputError{} : study.error();
}

void expect_fault(const std::string& keys, const std::string& key, const std::string& text) {
  const scene::InputError error = error_of_statement(keys);
  EXPECT_EQ(error.key, "statement." + key) << error.message();
  EXPECT_NE(error.message().find(text), std::string::npos) << error.message();
  EXPECT_GT(error.line, 0) << error.message();
}

TEST(PublishedStatements, FaultsNameLineKeyAndWhatWasMeant) {
  const std::string spread = "quantity = \"spread\", gaps = \"0 cm\", time = \"10 ms\", value = \"13 K\"";
  expect_fault(spread, "tolerance", "missing");
  expect_fault("quantity = \"spread\", gaps = \"0 cm\", value = \"13 K\", tolerance = \"1 K\"", "time",
               "quantity \"spread\" needs it");
  expect_fault(spread + ", tolerance = \"1 ms\"", "tolerance", "1 ms");
  expect_fault(spread + ", tolerance = \"-1 K\"", "tolerance", "-1 K");
  expect_fault(spread + ", tolerance = \"1 K\", level = \"784 K\"", "level", "does not have");
  expect_fault("quantity = \"spred\", value = \"13 K\"", "quantity", "\"spread\"");
  expect_fault(
      "quantity = \"hottest region\", gaps = \"0 cm\", time = \"10 ms\", value = \"340 K\", "
      "tolerance = \"1 K\"",
      "value", "340 K");
  expect_fault(
      "quantity = \"hottest region\", gaps = \"0 cm\", time = \"10 ms\", value = \"400 to 340 K\", "
      "tolerance = \"1 K\"",
      "value", "lower end first");
  expect_fault("quantity = \"hottest point\", gaps = \"0 cm\", time = \"10 ms\", value = \"G113\"", "value",
               "did you mean G1");
  expect_fault("quantity = \"hottest part\", gaps = \"0 cm\", time = \"10 ms\", value = \"center\"", "value",
               "did you mean centre");
  expect_fault("quantity = \"hottest point\", gaps = \"0 cm\", time = \"19 ms\", value = \"G13\"", "time",
               "until 18 ms");
  expect_fault("quantity = \"not computed\", value = \"all is well\"", "remark", "missing");
  expect_fault("quantity = \"peak pressure\", value = \"496 MPa\", tolerance = \"1 MPa\", sauce = \"x\"",
               "sauce", "source");
}

TEST(PublishedStatements, AFileOfTheirOwnIsNamedInItsFaults) {
  const auto folder = std::filesystem::path(::testing::TempDir()) / "launchsafe_statements";
  std::filesystem::create_directories(folder);
  std::filesystem::copy_file(studies_folder / "scene_155mm.toml", folder / "scene_155mm.toml",
                             std::filesystem::copy_options::overwrite_existing);
  std::ofstream(folder / "text.toml")
      << "# one fault\n"
      << statement("quantity = \"spread\", gaps = \"0 cm\", value = \"13 K\"");
  const auto read = [&](const std::string& more) {
    return kinds::parse_study(critical_text + more, folder / "study.toml");
  };
  const auto bad = read("statements = \"text.toml\"\n");
  ASSERT_FALSE(bad);
  EXPECT_TRUE(bad.error().file.ends_with("text.toml")) << bad.error().message();
  EXPECT_EQ(bad.error().line, 2);
  const auto missing = read("statements = \"texd.toml\"\n");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().key, "statements");
  EXPECT_NE(missing.error().suggestion.find("text.toml"), std::string::npos) << missing.error().message();
  EXPECT_FALSE(read("statements = \"scene_155mm.toml\"\n"));
}

TEST(PublishedStatements, TheShippedOnesAreThoseOfTheMainJob) {
  const auto study = kinds::read_study(studies_folder / "critical_gap_155mm.toml");
  ASSERT_TRUE(study) << study.error().message();
  EXPECT_GT(study->study.statements.size(), 60u);
}

/// The synthetic launch, judged: no friction at the third station as much as at the second.
CaseOutcome judged(const StudyFile& study) {
  CaseOutcome outcome;
  outcome.input = study.cases.front();
  outcome.result.mechanics = synthetic_mechanics(outcome.input.scene.scene);
  find_critical_gaps(study.study, outcome);
  evaluate_gaps(study.study, outcome);
  return outcome;
}

std::vector<StatementCheck> checks_of(const std::string& statements) {
  const StudyFile study = study_of(critical_text + "gaps = \"0, 0.02 cm\"\nstatement = [\n" + statements +
                                   "]\n" + synthetic_constants);
  return check_statements(study.study, judged(study));
}

TEST(PublishedStatements, AreComputedFromTheHistories) {
  // Friction heats in proportion to t^3 and to 0.95, 1 and 0.7 at the stations, by 116.1 K at the second one;
  // without a gap nothing else does but for a little reaction. So at 9 ms it is an eighth.
  const auto checks = checks_of(
      "{ quantity = \"temperature\", gaps = \"0 cm\", time = \"9 ms\", value = \"314.5 K\", tolerance = "
      "\"0.1 K\", source = \"1\" },\n"
      "{ quantity = \"temperature\", gaps = \"0 cm\", time = \"9 ms\", point = \"S3\", value = \"314.5 K\", "
      "tolerance = \"0.1 K\", source = \"2\" },\n"
      "{ quantity = \"hottest region\", gaps = \"0 cm\", time = \"9 ms\", value = \"311 to 314 K\", "
      "tolerance = \"0.2 K\", source = \"3\" },\n"
      "{ quantity = \"hottest point\", gaps = \"0 cm\", time = \"9 ms\", value = \"G2\", source = \"4\" },\n"
      "{ quantity = \"spread\", gaps = \"0 cm\", time = \"9 ms\", value = \"4.4 K\", tolerance = \"0.1 K\", "
      "source = \"5\" },\n"
      "{ quantity = \"hottest part\", gaps = \"0 cm\", time = \"9 ms\", value = \"outer\", source = \"6\" "
      "},\n"
      "{ quantity = \"reaches\", gaps = \"0 cm\", level = \"314.5125 K\", value = \"9 ms\", tolerance = "
      "\"0.05 ms\", source = \"7\" },\n"
      "{ quantity = \"reaches\", gaps = \"0 cm\", level = \"800 K\", value = \"9 ms\", tolerance = \"0.05 "
      "ms\", source = \"8\" },\n"
      "{ quantity = \"ignition\", gaps = \"0 cm\", value = \"9 ms\", tolerance = \"0.05 ms\", source = \"9\" "
      "},\n"
      "{ quantity = \"air temperature\", ratio = 3, value = \"413 K\", tolerance = \"0.5 K\", source = "
      "\"10\" },\n"
      "{ quantity = \"temperature\", gaps = \"0, 0.01, 0.02 cm\", value = \"300 to 530 K\", tolerance = \"0 "
      "K\", source = \"11\" },\n"
      "{ quantity = \"not computed\", value = \"all is well\", remark = \"too vague\", source = \"12\" },\n");
  ASSERT_EQ(checks.size(), 14u);
  EXPECT_NEAR(checks[0].low, 300.0 + 116.1 / 8.0, 0.05);
  EXPECT_EQ(checks[0].agreement, Agreement::agrees);
  EXPECT_NEAR(checks[1].low, 300.0 + 0.7 * 116.1 / 8.0, 0.05);
  EXPECT_EQ(checks[1].agreement, Agreement::differs);
  EXPECT_NEAR(checks[1].difference, 300.0 + 0.7 * 116.1 / 8.0 - 314.5, 0.05);
  // From 310.16 to 314.51 K: further below the range than above it.
  EXPECT_NEAR(checks[2].difference, 300.0 + 0.7 * 116.1 / 8.0 - 311.0, 0.05);
  EXPECT_EQ(checks[2].agreement, Agreement::differs);
  EXPECT_EQ(checks[3].place, "S2");
  EXPECT_EQ(checks[4].agreement, Agreement::agrees);
  EXPECT_EQ(checks[5].place, "outer");  // r of 57.5 mm
  EXPECT_NEAR(checks[6].low, 9e-3, 0.02e-3);
  EXPECT_EQ(checks[7].agreement, Agreement::differs);
  EXPECT_NE(checks[7].reason.find("not reached"), std::string::npos);
  EXPECT_EQ(checks[8].agreement, Agreement::differs);
  EXPECT_NEAR(checks[9].low, 410.621, 1e-3);  // model section 10
  EXPECT_NEAR(checks[9].difference, -2.379, 1e-3);
  for (std::size_t i : {10u, 11u, 12u}) EXPECT_EQ(checks[i].agreement, Agreement::agrees) << i;
  EXPECT_GT(checks[11].low, checks[10].low);  // a gap that the study does not judge is computed too
  EXPECT_EQ(checks[13].agreement, Agreement::not_computed);
  const report::Table table = report::statement_table(checks);
  EXPECT_EQ(table.rows.size(), 14u);
  std::int64_t counted = 0;
  for (const auto& row : report::statement_summary(checks).rows) counted += std::get<std::int64_t>(row[1]);
  EXPECT_EQ(counted, 13);
}

TEST(PublishedStatements, TheRiseIsFastWhereItsRateIsMoreThanHalfOfTheLargest) {
  // Of a rate like sin^2 over 16 ms, that is from a quarter to three quarters.
  surface::SkinHistory skin;
  trace::BottomTrace trace;
  trace.stations = {{"S1", 0.678, 0.0025, 1e-4, false}};
  for (int i = 0; i <= 900; ++i) {
    const double t = 16e-3 * i / 800.0, inside = std::min(t, 16e-3);
    trace.time.push_back(t);
    skin.time.push_back(t);
    constexpr double turn = 2.0 * 3.14159265358979 / 16e-3;
    skin.temperature.push_back(300.0 + 1e4 * (0.5 * inside - std::sin(turn * inside) / (2.0 * turn)));
  }
  const FastRise rise = fast_rise_of(skin, trace);
  EXPECT_NEAR(rise.begins, 4e-3, 1e-5);
  EXPECT_NEAR(rise.ends, 12e-3, 1e-5);
}

TEST(PublishedStatements, OfARunThatBrokeNothingIsComputed) {
  const StudyFile study = study_of(
      critical_text +
      statement(
          "quantity = \"spread\", gaps = \"0 cm\", time = \"9 ms\", value = \"4 K\", tolerance = \"1 K\""));
  CaseOutcome outcome;
  outcome.input = study.cases.front();
  outcome.failure = "energy drift";
  const auto checks = check_statements(study.study, outcome);
  ASSERT_EQ(checks.size(), 1u);
  EXPECT_EQ(checks[0].agreement, Agreement::not_computed);
  EXPECT_EQ(checks[0].reason, "energy drift");
}

}  // namespace
}  // namespace launchsafe::study
