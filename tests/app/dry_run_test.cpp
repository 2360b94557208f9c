// launchsafe study --dry-run: what would be run, and nothing written.
#include "stored_study.hpp"

namespace launchsafe::app {
namespace {

class DryRun : public StoredStudy {
 protected:
  nlohmann::json foresee(std::vector<std::string> more = {}) {
    std::vector<std::string> command{"study", "study.toml", "--dry-run", "--json"};
    command.insert(command.end(), more.begin(), more.end());
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out);
  }
};

TEST_F(DryRun, CountsTheFewestRunsAndMakesNoFolder) {
  for (const auto& more : {std::vector<std::string>{}, {"-o", "out"}}) {
    const auto foresight = foresee(more);
    EXPECT_EQ(foresight["mechanical_runs"], 12);
    EXPECT_EQ(foresight["cases"], 24);
    EXPECT_EQ(foresight["to_run"], 12);
    EXPECT_EQ(foresight["rate_learned_from_runs"], 0);
    EXPECT_GT(foresight["updates_per_second"], 0);
    EXPECT_EQ(foresight["runs"].size(), 12u);
    EXPECT_EQ(foresight["runs"][0]["cases"], 2);
  }
  EXPECT_FALSE(exists("out"));
  const std::string text = run({"study", "study.toml", "--dry-run"}).out;
  EXPECT_NE(text.find("mechanical runs       12 for 24 cases\n"), std::string::npos) << text;
  EXPECT_NE(text.find("measured now"), std::string::npos) << text;
}

TEST_F(DryRun, ExplainShowsTheSame) {
  const auto plan = nlohmann::json::parse(run({"explain", "study.toml", "--json"}).out);
  const auto foresight = foresee();
  for (const char* key : {"kind", "cases", "mechanical_runs", "gaps", "memory_bytes", "particle_updates"})
    EXPECT_EQ(plan[key], foresight[key]) << key;
}

TEST_F(DryRun, KnowsWhatIsStoredAndLearnsTheRate) {
  ASSERT_EQ(run({"study", "study.toml", "-o", "out", "--shard", "1/3"}).code, 0);
  const std::string journal = read("out/journal.1-of-3.jsonl");
  const auto listing = results_in("out");
  const auto foresight = foresee({"-o", "out"});
  EXPECT_EQ(foresight["stored"], 4);
  EXPECT_EQ(foresight["to_run"], 8);
  EXPECT_EQ(foresight["rate_learned_from_runs"], 4);
  EXPECT_EQ(read("out/journal.1-of-3.jsonl"), journal);
  EXPECT_TRUE(results_in("out") == listing);
  const std::string text = run({"study", "study.toml", "--dry-run", "-o", "out"}).out;
  EXPECT_NE(text.find("12 for 24 cases; 4 stored, 8 to run"), std::string::npos) << text;
  EXPECT_NE(text.find("learned from 4 runs in out"), std::string::npos) << text;
}

TEST_F(DryRun, ShowsOneShard) {
  const auto foresight = foresee({"--shard", "2/3"});
  EXPECT_EQ(foresight["mechanical_runs"], 4);
  for (const auto& each : foresight["runs"]) EXPECT_EQ(each["shard"], 2);
}

TEST_F(DryRun, AmountsAreRead) {
  for (const char* size : {"8GB", "500 MB", "8e9", "1.5GiB", "2g"})
    EXPECT_EQ(run({"study", "study.toml", "--dry-run", "--memory", size}).code, 0) << size;
  for (const char* size : {"8XB", "much", "-1GB", "0", "inf"})
    EXPECT_EQ(run({"study", "study.toml", "--dry-run", "--memory", size}).code, 2) << size;
  for (const char* time : {"90s", "10min", "2h", "1.5 d", "90"})
    EXPECT_EQ(run({"study", "study.toml", "--dry-run", "--time-limit", time}).code, 0) << time;
  for (const char* time : {"10 parsecs", "soon", "-1s", "0s", "nan"})
    EXPECT_EQ(run({"study", "study.toml", "--dry-run", "--time-limit", time}).code, 2) << time;
}

}  // namespace
}  // namespace launchsafe::app
