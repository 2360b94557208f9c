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
  for (const char* key : {"critical_gap", "verdicts", "causes", "fit", "timing", "cases"})
    EXPECT_TRUE(json.contains(key)) << key;
  const auto& critical = json["critical_gap"];
  for (const char* key : {"critical_gap_cm", "critical_gap_at_least_cm", "critical_gap_at_most_cm",
                          "critical_gap_kind", "largest_safe_gap_cm", "reason"})
    EXPECT_TRUE(critical.contains(key)) << key;
  EXPECT_EQ(critical["critical_gap_kind"], "value");
  EXPECT_LT(critical["critical_gap_at_least_cm"], critical["critical_gap_cm"]);
  EXPECT_GT(critical["critical_gap_at_most_cm"], critical["critical_gap_cm"]);
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

// 100 um lie outside of the interval of the shipped constants, 0 to 60 um.
TEST(CriticalGapReport, NamesTheIntervalsThatALaunchLiesOutsideOf) {
  const std::string cracks = "charge.crack_radius = \"100 um\"\n";
  const CriticalGapResult result =
      run_critical_gap(study_of(study_text + synthetic_constants + cracks), synthetic_options());
  const auto json = json_of(result);
  EXPECT_EQ(json["critical_gap"]["basis"], "extrapolated");
  EXPECT_EQ(json["critical_gap"]["extrapolated"], "crack_radius");
  EXPECT_NE(answer(result).find("crack_radius"), std::string::npos) << answer(result);
  EXPECT_EQ(json_of(one_case())["critical_gap"]["basis"], "calibrated");
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
