// The energy of the air and the cited limits, in tables and in words.
#include "facts_in_text.hpp"
#include "kinds/made_studies.hpp"
#include "launchsafe/kinds/critical_gap.hpp"
#include "launchsafe/report/case_tables.hpp"
#include "study/synthetic_launch.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace launchsafe::report {
namespace {

using namespace kinds;

using testing::has_digits, testing::in_order;

/// An open gap (m) from which the skin took so much and could get so much, J/m2.
AuditedGap taken(double gap, double energy, double supply) { return {"", gap, {energy, supply}}; }

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(AirEnergyStatement, NamesTheGapWhereMostWasTakenAgainstItsSupply) {
  const std::string text =
      air_energy_statement({taken(0.0, 0.0, 0.0), taken(2e-4, 15000, 500), taken(4e-4, 32700, 925)});
  // 32.7 over 0.925 is 35.4; at the other gap 15 over 0.5 is 30.
  EXPECT_TRUE(in_order(text, {"0.04 cm", "35 times", "32.7 kJ/m2", "0.925 kJ/m2"}));
}

TEST(AirEnergyStatement, NamesTheShareWhereNoMoreWasTakenThanCanBe) {
  EXPECT_TRUE(in_order(air_energy_statement({taken(4e-4, 290, 925)}), {"0.31 times", "0.04 cm"}));
}

TEST(AirEnergyStatement, WithoutAComputedGapClaimsNothing) {
  for (const auto& gaps : {std::vector<AuditedGap>{}, {AuditedGap{"", 4e-4, {}}}, {taken(0.0, 0.0, 0.0)}}) {
    const std::string text = air_energy_statement(gaps);
    EXPECT_FALSE(has_digits(text)) << text;
  }
}

TEST(AirEnergyTable, HasARowForEveryGapWithUnits) {
  const Table table = air_energy_table({taken(0.0, 0.0, 0.0), taken(4e-4, 32700, 925)});
  const auto rows = json_rows(table);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_NEAR(rows[1]["gap_cm"].get<double>(), 0.04, 1e-12);
  EXPECT_NEAR(rows[1]["skin_took_kJ_per_m2"].get<double>(), 32.7, 1e-12);
  EXPECT_NEAR(rows[1]["compression_supplies_kJ_per_m2"].get<double>(), 0.925, 1e-12);
  EXPECT_NEAR(rows[1]["taken_over_supplied"].get<double>(), 35.35, 0.01);
  EXPECT_TRUE(rows[0]["taken_over_supplied"].is_null());
  EXPECT_FALSE(rows[0].contains("case"));
  EXPECT_EQ(table.notes.back(), air_energy_statement({taken(4e-4, 32700, 925)}));
  EXPECT_TRUE(air_energy_table({}).rows.empty());
}

const std::string limited_study = study::critical_text + "gaps = \"0, 0.03 cm\"\nconfirm = false\n" +
                                  "cited_limit = [{ gap = \"0.38 mm\", peak_pressure = \"500 MPa\", source = "
                                  "\"underwater experiments\" }]\n";

TEST(CriticalGapReport, SaysWhatTheSkinTookAndWhatOthersFound) {
  const study::StudyFile file = study::study_of(limited_study + study::synthetic_constants);
  const auto result = kinds::run_critical_gap(file, study::synthetic_options());
  const std::string page = to_markdown(report_of(result));
  EXPECT_TRUE(says(page, "underwater experiments"));
  const auto json = json_of(result);
  EXPECT_GT(json["verdicts"][1]["taken_over_supplied"].get<double>(), 1.0);
  EXPECT_NEAR(json["verdicts"][1]["skin_took_kJ_per_m2"].get<double>(),
              1e-3 * result.details[0].verdicts[1].air.taken, 1e-12);
  ASSERT_EQ(json["cited_limits"].size(), 1u);
  EXPECT_NEAR(json["cited_limits"][0]["difference_cm"].get<double>(),
              100.0 * result.details[0].critical.value - 0.038, 1e-12);
  EXPECT_TRUE(says(to_csv(verdict_table(result)), "skin_took_kJ_per_m2,compression_supplies_kJ_per_m2"));
}

TEST(CriticalGapReport, WithoutCitedLimitsHasNoTableOfThem) {
  const study::StudyFile file = study::study_of(study::critical_text + study::synthetic_constants);
  const auto result = kinds::run_critical_gap(file, study::synthetic_options());
  EXPECT_TRUE(json_of(result)["cited_limits"].empty());
}

TEST(SweepReport, SaysWhatTheSkinTookWhereItTookMost) {
  kinds::CriticalGapResult result = made_sweep();
  EXPECT_FALSE(has_digits(critical_gap_table(result).notes.back()));
  result.answers[0].verdicts[1].air = {7000, 230};
  result.answers[3].verdicts[3].air = {32700, 925};
  const std::string note = critical_gap_table(result).notes.back();
  EXPECT_TRUE(in_order(note, {"0.039 cm", "350 MPa, 50 µm", "35 times"}));
  EXPECT_TRUE(says(to_markdown(report_of(result)), note));
}

// The made sweep has 496 MPa and 30 um, the scene's own, with 0.0395 cm, and no 506 MPa.
TEST(SweepReport, CitedLimitsStandBesideTheNearestPressure) {
  kinds::CriticalGapResult result = made_sweep();
  result.study.cases.complete_with([](study::StudyCase& made) {
    made.peak_pressure = made.coordinates[0];
    made.scene.scene.charge().strength.initial_crack_radius = made.coordinates[1];
    made.scene.scene.charge().strength.flaw_size = 1e-3;
  });
  result.study.study.cited_limits = {{0.38e-3, 500e6, "tests"}, {0.381e-3, 506e6, "a simulated pressure"}};
  const auto rows = json_rows(cited_limit_table(result));
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_NEAR(rows[0]["peak_pressure_MPa"].get<double>(), 496.0, 1e-9);
  EXPECT_NEAR(rows[0]["critical_gap_cm"].get<double>(), 0.0395, 1e-9);
  EXPECT_NEAR(rows[0]["difference_cm"].get<double>(), 0.0015, 1e-9);
  EXPECT_NEAR(rows[1]["critical_gap_cm"].get<double>(), 0.0395, 1e-9);
  EXPECT_TRUE(rows[1]["difference_cm"].is_null()) << "2 % off the pressure of the limit";
  EXPECT_TRUE(says(to_markdown(report_of(result)), "a simulated pressure"));
}

}  // namespace
}  // namespace launchsafe::report
