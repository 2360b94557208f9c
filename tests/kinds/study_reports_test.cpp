// The pages, tables and JSON of studies on a launch in closed form.
#include "launchsafe/kinds/critical_gap.hpp"
#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/report/table.hpp"
#include "launchsafe/scene/constants.hpp"
#include "report/report_folder.hpp"
#include "study/synthetic_launch.hpp"

#include <nlohmann/json.hpp>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;
using report::json_of;

const std::string study_text = critical_text +
                               "title = \"A test\"\ngaps = \"0, 0.03, 0.06 cm\"\n"
                               "reference = [{ gap = \"0 cm\", maximum_temperature = \"416.1 K\", point = "
                               "\"G2\" }, { gap = \"0.03 cm\", maximum_temperature = \"492.9 K\" }]\n";

CriticalGapResult one_case() {
  return run_critical_gap(study_of(study_text + synthetic_constants), synthetic_options());
}

TEST(CriticalGapReport, JsonHasTheKeysThatOtherProgramsReadFrom) {
  const auto json = json_of(one_case());
  for (const char* key : {"critical_gap", "verdicts", "fit", "timing", "cases"})
    EXPECT_TRUE(json.contains(key)) << key;
  const auto& critical = json["critical_gap"];
  for (const char* key :
       {"critical_gap_cm", "critical_gap_lower_cm", "critical_gap_upper_cm", "critical_gap_kind", "reason"})
    EXPECT_TRUE(critical.contains(key)) << key;
  EXPECT_EQ(critical["critical_gap_kind"], "value");
  EXPECT_LE(critical["critical_gap_upper_cm"].get<double>() - critical["critical_gap_lower_cm"].get<double>(),
            1e-4);
  ASSERT_EQ(json["verdicts"].size(), 3u);
  for (const char* key :
       {"gap_cm", "peak_pressure_MPa", "crack_radius_um", "flaw_size_mm", "temperature_max_K",
        "temperature_max_place", "temperature_max_time_ms", "temperature_early_K", "margin_K",
        "uncertainty_K", "verdict", "reason", "ignition_cause"}) {
    EXPECT_TRUE(json["verdicts"][0].contains(key)) << key;
  }
  ASSERT_EQ(json["comparison"].size(), 2u);
  EXPECT_EQ(json["comparison"][1]["temperature_max_published_K"], 492.9);
  EXPECT_TRUE(json["verdicts"][0]["ignition_cause"].is_null());
  EXPECT_EQ(json["verdicts"][2]["ignition_place"], "S2");
  for (const char* key : {"wall_time_s", "runs", "reused"}) EXPECT_TRUE(json["timing"].contains(key));
}

TEST(CriticalGapReport, TellsWhichSharesAreAssumedUntilTheStudyStatesThem) {
  const auto assumed = [](const std::string& keys) {
    return json_of(run_critical_gap(study_of(keys + study_text + synthetic_constants), synthetic_options()))
        .at("assumed");
  };
  const auto alone = assumed("");
  EXPECT_TRUE(alone.contains("numerical_uncertainty"));
  EXPECT_EQ(alone.size(), 1u) << "the study states the others";
  EXPECT_TRUE(assumed("numerical_uncertainty = { value = \"5 K\", because = \"a mesh study\" }\n").empty());
}

// The largest with all smaller ones: a gap that is not SAFE ends it, in whatever order they were asked.
TEST(CriticalGapReport, TellsTheLargestSafeGapOfTheComputedOnes) {
  const auto gap = [](double width, study::Verdict verdict) {
    study::GapVerdict row;
    row.gap = width;
    row.judgement.verdict = verdict;
    return row;
  };
  using enum study::Verdict;
  EXPECT_EQ(largest_safe_gap({gap(3e-4, safe), gap(1e-4, safe), gap(2e-4, indeterminate)}), 1e-4);
  EXPECT_EQ(largest_safe_gap({gap(0, safe), gap(2e-4, safe)}), 2e-4);
  EXPECT_TRUE(std::isnan(largest_safe_gap({gap(0, unsafe), gap(1e-4, safe)})));
}

// What a cause moves the critical gap by is less than a wide bracket: with 0.005 cm the shipped study had a
// lower bound of 0.0317 cm, and with 0.0001 cm one of 0.0273 cm.
TEST(CriticalGapReport, AWideToleranceRaisesNoLowerBound) {
  const auto bounds_with = [](const std::string& tolerance) {
    const std::string key = "tolerance = \"" + tolerance + "\"\n";
    return run_critical_gap(study_of(key + study_text + synthetic_constants), synthetic_options())
        .details.front()
        .critical;
  };
  const CriticalGap fine = bounds_with("0.0001 cm"), wide = bounds_with("0.01 cm");
  ASSERT_TRUE(std::isfinite(fine.bounds.at_least));
  EXPECT_EQ(wide.bounds.at_least, fine.bounds.at_least);
  EXPECT_EQ(wide.lower, fine.lower);
}

// A published number is fitted where the constants of the scene were fitted to it.
TEST(CriticalGapReport, TellsWhatTheConstantsWereFittedTo) {
  StudyFile study = study_of(study_text + synthetic_constants);
  scene::Constants constants;
  constants.rows = {{"T at 18 ms", 0.0, 416.1, 416.0, "K", true},
                    {"largest T", 3e-4, 492.9, 490.0, "K", false}};
  study.scene.constants = std::make_shared<scene::Constants>(constants);
  const auto json = json_of(run_critical_gap(study, synthetic_options()));
  EXPECT_EQ(json["comparison"][0]["used_for"], "fitted");
  EXPECT_EQ(json["comparison"][1]["used_for"], "check");
}

}  // namespace
