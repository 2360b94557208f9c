// The shipped small table of stress cases, computed for real.
#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/kinds/stability.hpp"
#include "study/synthetic_launch.hpp"

#include <gtest/gtest.h>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

TEST(StabilityMatrix, HasNoCaseThatIsWrongOrUnexpected) {
  const auto study = read_study(studies_folder / "stability" / "smoke.toml");
  ASSERT_TRUE(study) << study.error().message();
  StudyOptions options;
  options.jobs = 2;
  const StabilityResult result = run_stability(*study, options);
  for (const StressCaseRow& row : result.rows)
    EXPECT_TRUE(row.is_as_expected()) << row.asked.label() << ": " << to_string(row.finding.outcome) << ", "
                                      << row.finding.text << row.result.failure;
  for (const auto outcome : {Outcome::held, Outcome::degraded, Outcome::caught})
    EXPECT_GT(result.count(outcome), 0u) << to_string(outcome);
}

}  // namespace
