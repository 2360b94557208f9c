#include "launchsafe/report/study_text.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

namespace launchsafe::report {
namespace {

constexpr std::time_t noon = 1772366400;  // 2026-03-01T12:00:00Z

/// A study, at noon.
store::StudyStatus at_noon(bool alive, int exit_code = -1) {
  return {.command = "launchsafe study sweep.toml -o out",
          .time = "2026-03-01T12:00:00Z",
          .cases = 24,
          .cases_done = 10,
          .cases_failed = 3,
          .time_left = 600,
          .exit_code = exit_code,
          .alive = alive};
}

class StudyStatus : public ::testing::Test {
 protected:
  void SetUp() override {
    ::setenv("TZ", "UTC", 1);
    ::tzset();
  }
  static Row facts_of(const store::StudyStatus& status, std::time_t now) {
    return status_facts({{"out", status}}, now)["folders"][0];
  }
};

TEST_F(StudyStatus, CountsTheCasesOfARunningStudyAndTheTimeLeft) {
  const Row facts = facts_of(at_noon(true), noon + 60);
  EXPECT_EQ(facts["state"], "running");
  EXPECT_EQ(facts["exit_code"], 0);
  EXPECT_EQ(facts["cases"], 24);
  EXPECT_EQ(facts["cases_done"], 10);
  EXPECT_EQ(facts["cases_failed"], 3);
  EXPECT_EQ(facts["time_left_s"], 540.0);
}

TEST_F(StudyStatus, HasTheExitCodeOfTheStudy) {
  for (const auto& [stored, code, state] : {std::tuple{-1, 75, "interrupted"},
                                            {0, 0, "finished"},
                                            {3, 3, "finished"},
                                            {70, 70, "failed"},
                                            {75, 75, "interrupted"}}) {
    const Row facts = facts_of(at_noon(false, stored), noon + 3600);
    EXPECT_EQ(facts["exit_code"], code);
    EXPECT_EQ(facts["state"], state);
    EXPECT_TRUE(facts["time_left_s"].is_null());
  }
  const Row both = status_facts({{"one", at_noon(false, 3)}, {"two", at_noon(false)}}, noon);
  EXPECT_EQ(both["exit_code"], 75);
  EXPECT_EQ(both["folders"].size(), 2u);
}

TEST_F(StudyStatus, FindsTheNextTimeOfDay) {
  EXPECT_EQ(next_clock_time("12:30", noon), noon + 1800);
  EXPECT_EQ(next_clock_time("06:00", noon), noon + 18 * 3600);
  EXPECT_EQ(next_clock_time("12:00", noon), noon + 86400);
  for (const char* text : {"", "6", "25:00", "06:00pm", "soon"})
    EXPECT_FALSE(next_clock_time(text, noon)) << text;
}

}  // namespace
}  // namespace launchsafe::report
