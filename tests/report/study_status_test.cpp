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
  progress.failures = {{"timed out: it took long", 2}, {"the run failed: <memory>", 1}};
  progress.gaps_found = 2;
  progress.largest_gap = 5e-4;
  progress.smallest_gaps = {{"250 MPa", 3e-4, 3.1e-4}, {"260 MPa", 4.9e-4, 5e-4}};
  Row members = progress_row(progress);
  members.update({{"host", "node1"},
                  {"process", 7},
                  {"since", "2026-03-01T11:58:00Z"},
                  {"time", "2026-03-01T12:00:00Z"},
                  {"ended", false},
                  {"runs_stored", 5},
                  {"case_files_bytes", 2500000},
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
  static std::string text(const std::vector<store::StoreStatus>& snapshots, std::time_t now = noon) {
    return status_text(status_facts("out", snapshots, now));
  }
};

TEST_F(StudyStatus, SaysHowFarARunningStudyIsAndThatItsEndIsAnEstimate) {
  EXPECT_EQ(text({snapshot()}), R"(out: running for 2 min 00 s
  cases         10 of 24 done, 3 failed, 14 left; 2 runs at work (launches)
  time left     about 10 min 00 s, until about 12:10: an estimate from the runs so far
  stored        5 runs, 2.5 MB
  critical gap  of 2 cases: smallest 0.03 cm (250 MPa), largest 0.05 cm
                (of ignition alone, without uncertainty: preliminary, no verdict)
  failed        2 cases: timed out: it took long
  failed        1 case: the run failed: <memory>
)");
  EXPECT_EQ(status_facts("out", {snapshot()}, noon)["exit_code"], 0);
}

TEST_F(StudyStatus, CountsDownBetweenSnapshots) {
  EXPECT_NE(text({snapshot()}, noon + 60).find("about 9 min 00 s, until about 12:10"), std::string::npos);
}

TEST_F(StudyStatus, AWriterThatDoesNotLiveWasInterruptedAndOneThatTellsNothingForHoursRuns) {
  store::StoreStatus killed = snapshot();
  killed.alive = false;
  const Row facts = status_facts("out", {killed}, noon);
  EXPECT_EQ(facts["state"], "interrupted");
  EXPECT_EQ(facts["exit_code"], 75);
  EXPECT_EQ(facts["command"], "launchsafe study sweep.toml -o out");
  EXPECT_EQ(status_facts("out", {snapshot()}, noon + 7200)["state"], "running");
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
  const std::string said = status_text(facts);
  EXPECT_NE(said.find("  shard 2/4: running, 10 of 24 cases done, 3 failed, about 10 min 00 s left; node1"),
            std::string::npos)
      << said;
  EXPECT_NE(said.find("2 shards more, of which nothing was seen"), std::string::npos) << said;
  EXPECT_EQ(status_facts("out", {ended(0, "1-of-2")}, noon)["state"], "waiting");
  EXPECT_EQ(status_facts("out", {ended(0, "1-of-2"), ended(75, "2-of-2")}, noon)["exit_code"], 75);
}

TEST_F(StudyStatus, TakesWhatADamagedFileLacksForNothing) {
  for (const char* text :
       {R"({"time": "2026-03-01T12:00:00Z"})",
        R"({"time": "x", "cases": "many", "failures": [3], "critical_gaps": [{"lower_cm": "x"}]})",
        R"({"time": "2026-03-01T12:00:00Z", "exit_code": 1e300, "failures": 3})"}) {
    const Row facts = status_facts("out", {{"", Row::parse(text)}}, noon);
    EXPECT_EQ(facts["cases"], 0) << text;
    EXPECT_FALSE(status_text(facts).empty()) << text;
  }
}

TEST_F(StudyStatus, TellsTimesOfOtherDaysWithTheDay) {
  EXPECT_EQ(clock_time(noon + 60, noon), "12:01");
  EXPECT_EQ(clock_time(noon + 86400, noon), "Mon 12:00");
  EXPECT_EQ(clock_time(noon + 30 * 86400, noon), "2026-03-31 12:00");
}

TEST_F(StudyStatus, FindsTheNextTimeOfDay) {
  EXPECT_EQ(next_clock_time("12:30", noon), noon + 1800);
  EXPECT_EQ(next_clock_time("06:00", noon), noon + 18 * 3600);
  EXPECT_EQ(next_clock_time("12:00", noon), noon + 86400);
  for (const char* text : {"", "6", "25:00", "06:00pm", "soon"})
    EXPECT_FALSE(next_clock_time(text, noon)) << text;
}

TEST_F(StudyStatus, LooksAheadOfTheClocksThatAreSetForward) {
  ::setenv("TZ", "CET-1CEST,M3.5.0,M10.5.0/3", 1);
  ::tzset();
  const std::time_t evening =
      1774735200;  // 2026-03-28T22:00:00Z, 23:00 local; clocks are set forward at 02:00
  EXPECT_EQ(next_clock_time("06:00", evening), evening + 6 * 3600);
}

}  // namespace
}  // namespace launchsafe::report
