#include "launchsafe/report/study_text.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

namespace launchsafe::report {
namespace {

constexpr std::time_t noon = 1772366400;  // 2026-03-01T12:00:00Z

/// A snapshot of two minutes of a study, at noon.
store::StoreStatus snapshot(const std::string& part = {}) {
  study::Progress progress;
  progress.running = 2;
  progress.total = 12;
  progress.cases = 24;
  progress.cases_done = 10;
  progress.cases_failed = 3;
  progress.seconds_left = 600;
  Row members = progress_row(progress);
  members.update({{"host", "node1"},
                  {"process", 7},
                  {"since", "2026-03-01T11:58:00Z"},
                  {"time", "2026-03-01T12:00:00Z"},
                  {"ended", false},
                  {"runs_stored", 5},
                  {"command", "launchsafe study sweep.toml -o out"}});
  return {part, members, true};
}

store::StoreStatus ended(int exit_code, const std::string& part = {}) {
  store::StoreStatus made = snapshot(part);
  made.members.update({{"ended", true}, {"exit_code", exit_code}, {"runs_running", 0}});
  made.alive = false;
  return made;
}

class StudyStatus : public ::testing::Test {
 protected:
  void SetUp() override {
    ::setenv("TZ", "UTC", 1);
    ::tzset();
  }
};

TEST_F(StudyStatus, CountsTheCasesOfARunningStudy) {
  const Row facts = status_facts("out", {snapshot()}, noon);
  for (const auto& [key, count] : {std::pair{"cases", 24},
                                   {"cases_done", 10},
                                   {"cases_failed", 3},
                                   {"cases_left", 14},
                                   {"runs_running", 2},
                                   {"exit_code", 0}})
    EXPECT_EQ(facts[key], count) << key;
}

TEST_F(StudyStatus, CountsDownBetweenSnapshots) {
  EXPECT_EQ(status_facts("out", {snapshot()}, noon + 60)["time_left_s"], 540.0);
}

TEST_F(StudyStatus, AWriterThatDoesNotLiveWasInterruptedAndOneThatTellsNothingForHoursRuns) {
  store::StoreStatus killed = snapshot();
  killed.alive = false;
  const Row facts = status_facts("out", {killed}, noon);
  EXPECT_EQ(facts["state"], "interrupted");
  EXPECT_EQ(facts["exit_code"], 75);
  EXPECT_EQ(facts["command"], "launchsafe study sweep.toml -o out");
  EXPECT_EQ(status_facts("out", {snapshot()}, noon + 7200)["state"], "running");
  EXPECT_FALSE(facts.contains("time_left_s"));
}

TEST_F(StudyStatus, HasTheExitCodeOfTheStudy) {
  const std::vector<std::pair<int, const char*>> states{
      {0, "finished"}, {3, "finished"}, {4, "finished"}, {70, "failed"}, {75, "interrupted"}};
  for (const auto& [code, state] : states) {
    const Row facts = status_facts("out", {ended(code)}, noon + 3600);
    EXPECT_EQ(facts["exit_code"], code);
    EXPECT_EQ(facts["state"], state);
  }
  store::StoreStatus without_code = snapshot();
  without_code.members["ended"] = true;
  EXPECT_EQ(status_facts("out", {without_code}, noon)["exit_code"], 70);
}

TEST_F(StudyStatus, AddsUpShardsAndNamesThoseThatNobodySaw) {
  const Row facts = status_facts("out", {ended(0, "1-of-4"), snapshot("2-of-4")}, noon);
  EXPECT_EQ(facts["state"], "running");
  EXPECT_EQ(facts["cases"], 48);
  EXPECT_EQ(facts["cases_done"], 20);
  EXPECT_FALSE(facts.contains("time_left_s")) << "two shards have not begun";
  EXPECT_EQ(facts["writers"][1]["shard"], "2/4");
  EXPECT_EQ(facts["shards_not_seen"], 2);
  EXPECT_EQ(status_facts("out", {ended(0, "1-of-2")}, noon)["state"], "waiting");
  EXPECT_EQ(status_facts("out", {ended(0, "1-of-2"), ended(75, "2-of-2")}, noon)["exit_code"], 75);
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
