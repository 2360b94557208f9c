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
}

TEST_F(DryRun, ExplainShowsTheSame) {
  const auto plan = nlohmann::json::parse(run({"explain", "study.toml", "--json"}).out);
  const auto estimate = estimate_study();
  for (const char* key : {"kind", "cases", "mechanical_runs", "gaps", "memory_bytes", "particle_updates"})
    EXPECT_EQ(plan[key], estimate[key]) << key;
}

TEST_F(DryRun, KnowsWhatIsStored) {
  ASSERT_EQ(run({"study", "study.toml", "-o", "out", "--shard", "1/3"}).code, 0);
  const std::string results_file = read("out/study.db");
  const auto listing = results_in("out");
  const auto estimate = estimate_study({"-o", "out"});
  EXPECT_EQ(estimate["stored"], 4);
  EXPECT_EQ(estimate["to_run"], 8);
  EXPECT_TRUE(read("out/study.db") == results_file);
  EXPECT_TRUE(results_in("out") == listing);
}

TEST_F(DryRun, ShowsOneShard) {
  const auto estimate = estimate_study({"--shard", "2/3"});
  EXPECT_EQ(estimate["mechanical_runs"], 4);
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

}  // namespace
}  // namespace launchsafe::app
