// The small version of the matrix, computed for real.
#include "launchsafe/study/stability.hpp"
#include "study/synthetic_launch.hpp"

#include <gtest/gtest.h>

namespace {

using namespace launchsafe;
using namespace launchsafe::study;

TEST(StabilityMatrix, HasNoCaseThatIsWrongOrUnexpected) {
  const auto study = read_study(studies_folder / "stability" / "smoke.toml");
  ASSERT_TRUE(study) << study.error().message();
  StudyOptions options;
  options.jobs = 2;
  const StabilityResult result = run_stability(*study, options);
  EXPECT_EQ(result.rows.size(), study->launches.size());
  for (const HardRow& row : result.rows)
    EXPECT_TRUE(row.is_as_expected())
        << row.group << ", " << row.name << ": " << to_string(row.finding.outcome) << ", " << row.finding.text
        << row.failure;
  for (const auto outcome : {verify::Outcome::held, verify::Outcome::degraded, verify::Outcome::caught})
    EXPECT_GT(result.count(outcome), 0u) << to_string(outcome);
}

}  // namespace
