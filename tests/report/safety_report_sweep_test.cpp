// Safety reports of several cases, and of sweeps.
#include "safety_report_files.hpp"

namespace launchsafe::report {
namespace {

/// Of two cases the second, which ignites at every gap.
void let_ignite(nlohmann::ordered_json& results) {
  auto& row = results["cases"][1];
  row["critical_gap_kind"] = "all-ignite";
  row["critical_gap_reads_as"] = row["critical_gap_with_bounds"] = "ignites without a gap";
  row["largest_safe_gap_cm"] = nullptr;
  for (const char* key : {"critical_gap_cm", "critical_gap_at_least_cm", "critical_gap_at_most_cm"})
    row[key] = 0.0;
  for (std::size_t i = results["verdicts"].size() / 2; i < results["verdicts"].size(); ++i)
    results["verdicts"][i]["verdict"] = "UNSAFE";
}

TEST_F(SafetyReport, AllowsNoGapWhereOneOfSeveralCasesIgnitesAtEvery) {
  const path study = copy_of("critical_gap_155mm");
  move_to_pressures(study, {496.0, 510.0});
  change(study, let_ignite);
  const auto json = nlohmann::json::parse(file_of({study}, "report.json"));
  EXPECT_TRUE(json["answer"]["largest_safe_gap_cm"].is_null()) << "one case ignites at every gap";
}

TEST_F(SafetyReport, ASweepByItselfAllowsNoGap) {
  const auto json = nlohmann::json::parse(file_of({shipped("sweep_pressure_defect")}, "report.json"));
  EXPECT_TRUE(json["answer"]["largest_safe_gap_cm"].is_null());
  EXPECT_TRUE(json["answer"]["cases"].empty());
}

}  // namespace
}  // namespace launchsafe::report
