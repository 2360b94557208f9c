// A fit over the cases of a sweep.
#include "made_sweeps.hpp"

namespace launchsafe::study {
namespace {

using namespace kinds;

const std::string asks_fit = "surrogate = true\n";

VariedKeys nine_by_eight() {
  return {{"initial_temperature", "290, 292, 294, 296, 298, 300, 302, 304, 306 K"},
          {"kinetics.ignition_temperature", "505, 510, 515, 520, 525, 530, 535, 540 K"}};
}

/// The record of the fit among the files of a report; of an empty text without one.
auto fit_in(const report::Report& written) {
  const auto file = std::ranges::find(written.files, "surrogate.json", &report::TextFile::name);
  return parse_surrogate(file == written.files.end() ? std::string{} : file->text, "surrogate.json");
}

// The launch is the one of sweep_of: what it computes between the fitted values is the judge, those of the
// third, sixth, ... value of each key: 2 of 9 and 2 of 8, 72 - 7 x 6 cases.
TEST(Sweep, AFitOverItsCasesIsHeldAgainstThoseBetweenOthers) {
  StudyOptions options;
  options.runners = synthetic_runners();
  const CriticalGapResult result =
      run_critical_gap(sweep_of("0, 0.02 cm", nine_by_eight(), "0.2 cm", {}, asks_fit), options);
  const report::Report written = report_of(result);
  const auto record = fit_in(written);
  ASSERT_TRUE(record) << record.error().message();
  EXPECT_FALSE(record->drawn);
  EXPECT_EQ(record->fitted(), 42u);
  EXPECT_EQ(record->held_out.size(), 30u);
  EXPECT_DOUBLE_EQ(ranges_of(*record)[0].lower, 290.0);
  EXPECT_DOUBLE_EQ(ranges_of(*record)[0].upper, 306.0);
  const SurrogateOutput* critical = record->predicted("critical_gap");
  ASSERT_NE(critical, nullptr);
  ASSERT_NE(record->predicted("temperature_max_0.02cm"), nullptr);
  const Surrogate surrogate(*record, *critical);
  for (std::size_t i = 0; i < result.answers.size(); ++i) {
    const auto prediction = surrogate.at(record->inputs.point_of(result.study.cases.coordinates(i)));
    EXPECT_NEAR(prediction.value, result.answers[i].critical.value, prediction.error) << i;
  }
  EXPECT_NE(std::ranges::find(written.files, "ask.html", &report::TextFile::name), written.files.end());
}

TEST(Sweep, NothingIsPredictedFromLaunchesWithValidityWarnings) {
  StudyOptions options;
  options.runners = synthetic_runners();
  CriticalGapResult result =
      run_critical_gap(sweep_of("0, 0.02 cm", nine_by_eight(), "0.2 cm", {}, asks_fit), options);
  result.answers[5].validity_warnings = {"its stations are thinner than a cell"};
  const auto record = fit_in(report_of(result));
  ASSERT_TRUE(record) << record.error().message();
  for (const SurrogateOutput& output : record->outputs)
    EXPECT_EQ(output.reason,
              "1 of 72 launches have validity warnings, such as: its stations are thinner than a cell")
        << output.name;
}

TEST(Sweep, CriticalGapsThatAreBoundsAreNotFitted) {
  StudyOptions options;
  options.runners = synthetic_runners();
  const CriticalGapResult result =
      run_critical_gap(sweep_of("0 cm", nine_by_eight(), "0.038 cm", {}, asks_fit), options);
  const auto record = fit_in(report_of(result));
  ASSERT_TRUE(record) << record.error().message();
  EXPECT_EQ(record->predicted("critical_gap"), nullptr);
  const std::string& reason = record->outputs.back().reason;
  EXPECT_NE(
      reason.find("critical gaps are bounds, not numbers (the first without a number: no ignition up to"),
      std::string::npos)
      << reason;
}

}  // namespace
}  // namespace launchsafe::study
