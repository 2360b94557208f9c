// launchsafe study --dry-run: what would be run, and nothing written.
#include "stored_study.hpp"

namespace launchsafe::app {
namespace {

class DryRun : public StoredStudy {
 protected:
  nlohmann::json estimate_study(std::vector<std::string> more = {}) {
    std::vector<std::string> command{"study", "study.toml", "--dry-run", "--json"};
    command.insert(command.end(), more.begin(), more.end());
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out);
  }
};

TEST_F(DryRun, CountsTheFewestRunsAndMakesNoFolder) {
  for (const auto& more : {std::vector<std::string>{}, {"-o", "out"}}) {
    const auto estimate = estimate_study(more);
    EXPECT_EQ(estimate["mechanical_runs"], 12);
    EXPECT_EQ(estimate["cases"], 24);
    EXPECT_EQ(estimate["to_run"], 12);
    EXPECT_GT(estimate["updates_per_second"], 0);
  }
  EXPECT_FALSE(exists("out"));
  const std::string text = run({"study", "study.toml", "--dry-run"}).out;
  EXPECT_NE(text.find("mechanical runs       12 for 24 cases\n"), std::string::npos) << text;
  EXPECT_NE(text.find("measured now"), std::string::npos) << text;
}

TEST_F(DryRun, ReadsJobsAsADecimalNumber) { EXPECT_EQ(estimate_study({"--jobs", "010"})["jobs"], 10); }

TEST_F(DryRun, ExplainShowsTheSame) {
  const auto plan = nlohmann::json::parse(run({"explain", "study.toml", "--json"}).out);
  const auto estimate = estimate_study();
  for (const char* key : {"kind", "cases", "mechanical_runs", "gaps", "memory_bytes", "particle_updates"})
    EXPECT_EQ(plan[key], estimate[key]) << key;
}

TEST_F(DryRun, KnowsWhatIsStored) {
  ASSERT_EQ(run({"study", "study.toml", "-o", "out", "--shard", "1/3"}).code, 0);
  const std::string results_file = read("out/study.1-of-3.db");
  const auto listing = results_in("out");
  const auto estimate = estimate_study({"-o", "out"});
  EXPECT_EQ(estimate["stored"], 4);
  EXPECT_EQ(estimate["to_run"], 8);
  EXPECT_TRUE(read("out/study.1-of-3.db") == results_file);
  EXPECT_TRUE(results_in("out") == listing);
}

TEST_F(DryRun, ShowsOneShard) {
  const auto estimate = estimate_study({"--shard", "2/3"});
  EXPECT_EQ(estimate["mechanical_runs"], 4);
}

TEST_F(DryRun, IsToldThatTheStudyRunsAndDisturbsNothing) {
  write("shell.toml", brief_scene());
  start({"study", "study.toml", "-o", "out", "--jobs", "1"});
  wait_for_a_case("out");
  const Outcome beside = run_beside({"study", "study.toml", "-o", "out", "--dry-run", "--json"});
  EXPECT_EQ(beside.code, 2) << beside.err;
  EXPECT_TRUE(beside.says("in use by another process")) << beside.err;
  EXPECT_EQ(wait().code, 0);
}

TEST_F(DryRun, RepairsNothing) {
  ASSERT_EQ(run({"study", "study.toml", "-o", "out", "--shard", "1/3"}).code, 0);
  const auto everything = [this] {
    std::map<std::string, std::string> found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder() / "out"))
      found[entry.path().string()] = entry.is_regular_file()
                                         ? read(std::filesystem::relative(entry.path(), folder()).string())
                                         : std::string();
    return found;
  };
  const auto before = everything();
  // Where nothing may be written: root may all the same, so that the listing is what tells.
  for (const char* name : {"out", "out/cases"})
    std::filesystem::permissions(folder() / name, std::filesystem::perms(0555));
  const auto estimate = estimate_study({"-o", "out"});
  for (const char* name : {"out", "out/cases"})
    std::filesystem::permissions(folder() / name, std::filesystem::perms(0755));
  EXPECT_TRUE(everything() == before);
}

TEST_F(DryRun, AmountsAreRead) {
  for (const char* size : {"500 MB", "1.5GiB", "8e9B"})
    EXPECT_EQ(run({"study", "study.toml", "--dry-run", "--memory", size}).code, 0) << size;
  for (const char* size : {"8XB", "8", "much", "-1GB", "0", "inf", "1e30 GB"})
    EXPECT_EQ(run({"study", "study.toml", "--dry-run", "--memory", size}).code, 2) << size;
  for (const char* time : {"1.5 d", "90s", "10min", "2h"})
    EXPECT_EQ(run({"study", "study.toml", "--dry-run", "--time-limit", time}).code, 0) << time;
  for (const char* time : {"10 parsecs", "10", "soon", "-1s", "0s", "nan"})
    EXPECT_EQ(run({"study", "study.toml", "--dry-run", "--time-limit", time}).code, 2) << time;
}

}  // namespace
}  // namespace launchsafe::app
