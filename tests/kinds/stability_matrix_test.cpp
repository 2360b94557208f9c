// The small version of the matrix, computed for real.
#include "launchsafe/kinds/read_study.hpp"
#include "launchsafe/kinds/stability.hpp"
#include "study/synthetic_launch.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

StabilityResult all_rows_of(const StudyFile& study) {
  StudyOptions options;
  options.jobs = 2;
  StabilityResult result = run_stability(study, options);
  EXPECT_EQ(result.rows.size(), study::settings_of<kinds::StabilitySettings>(study.study).cases.size());
  return result;
}

TEST(StabilityMatrix, HasNoCaseThatIsWrongOrUnexpected) {
  const auto study = read_study(studies_folder / "stability" / "smoke.toml");
  ASSERT_TRUE(study) << study.error().message();
  const StabilityResult result = all_rows_of(*study);
  for (const StressCaseRow& row : result.rows)
    EXPECT_TRUE(row.is_as_expected())
        << row.group << ", " << row.name << ": " << to_string(row.finding.outcome) << ", " << row.finding.text
        << row.failure;
  for (const auto outcome : {verify::Outcome::held, verify::Outcome::degraded, verify::Outcome::caught})
    EXPECT_GT(result.count(outcome), 0u) << to_string(outcome);
}

/// The paper's method on its even grid: all cases but those that ask where the other step is stable.
TEST(StabilityMatrixSlow, HasNoCaseThatIsWrongInTheUpdatedLagrangianForm) {
  const auto file = studies_folder / "stability.toml";
  std::ifstream shipped(file);
  std::string text(std::istreambuf_iterator<char>(shipped), {});
  const std::string laws = "laws = true";
  const auto at = text.find(laws);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, laws.size(),
               "laws = false\n"
               "set = { numerics.formulation = \"updated-lagrangian\", numerics.growth_x = 1 }\n#");
  // That form does not go through ignition; the cases that are refused for it stay.
  const std::string burns = "coupling = \"two-way\", kinetics";
  for (auto found = text.find(burns); found != std::string::npos; found = text.find(burns))
    text.replace(found, burns.size(), "kinetics");
  const auto study = parse_study(text, file);
  ASSERT_TRUE(study) << study.error().message();
  const StabilityResult result = all_rows_of(*study);
  for (const StressCaseRow& row : result.rows)
    EXPECT_NE(row.finding.outcome, verify::Outcome::wrong)
        << row.group << ", " << row.name << ": " << row.finding.text;
  EXPECT_GT(result.count(verify::Outcome::held),
            settings_of<StabilitySettings>(study->study).cases.size() / 3);
}

}  // namespace
