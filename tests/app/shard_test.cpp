// A study in shards, merged, is the study.
#include "stored_study.hpp"

namespace launchsafe::app {
namespace {

class ShardedStudy : public StoredStudy, public ::testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override {
    StoredStudy::SetUp();
    if (std::string(GetParam()) == "sensitivity") write("study.toml", sensitivity_study);
    alone_ = run({"study", "study.toml", "-o", "alone"});
  }
  Outcome run_shard(const std::string& shard, const std::string& output) {
    return run({"study", "study.toml", "-o", output, "--shard", shard});
  }

  static std::size_t lines_with(const std::string& text, const std::string& beginning) {
    std::istringstream lines(text);
    std::size_t count = 0;
    for (std::string line; std::getline(lines, line);) count += line.starts_with(beginning) ? 1 : 0;
    return count;
  }

  Outcome alone_;
};

TEST_P(ShardedStudy, AtOnceInOneFolderMergesToTheWhole) {
  start({"study", "study.toml", "-o", "out", "--shard", "1/3"});
  EXPECT_EQ(run_beside({"study", "study.toml", "-o", "out", "--shard", "2/3"}).code, 0);
  EXPECT_EQ(run_beside({"study", "study.toml", "-o", "out", "--shard", "3/3"}).code, 0);
  EXPECT_EQ(wait().code, 0);
  const Outcome merged = run({"merge", "study.toml", "-o", "out"});
  EXPECT_EQ(merged.code, alone_.code) << merged.err;
  expect_same_results("alone", "out");
}

TEST_P(ShardedStudy, WithoutOneOfThemIsNotMerged) {
  EXPECT_EQ(run_shard("1/3", "out").code, 0);
  EXPECT_EQ(run_shard("3/3", "out").code, 0);
  const Outcome merged = run({"merge", "study.toml", "-o", "out"});
  EXPECT_EQ(merged.code, 3);
  // Those of the second shard: done where the study ran alone, but not here.
  const std::size_t missing = done_cases("alone").size() - done_cases("out").size();
  EXPECT_TRUE(merged.says(std::to_string(missing) + " of ")) << merged.err;
  EXPECT_EQ(lines_with(merged.out, "missing: "), missing) << merged.out;
  EXPECT_FALSE(exists("out/report.md"));
}

TEST_P(ShardedStudy, GoesOnAsAWhole) {
  EXPECT_EQ(run_shard("2/3", "out").code, 0);
  const std::size_t kept = done_cases("out").size();
  EXPECT_GT(kept, 0u);
  const Outcome whole = run({"study", "study.toml", "-o", "out"});
  EXPECT_TRUE(whole.says("re-used " + std::to_string(kept) + " ")) << whole.err;
  expect_same_results("alone", "out");
}

INSTANTIATE_TEST_SUITE_P(Kinds, ShardedStudy, ::testing::Values("sweep", "sensitivity"),
                         [](const auto& test) { return std::string(test.param); });

class Merge : public StoredStudy {};

TEST_F(Merge, SenselessShardsAreBadUsage) {
  for (const char* shard : {"0/3", "4/3", "3", "1/", "one/three", "1/0"}) {
    const Outcome outcome = run({"study", "study.toml", "-o", "out", "--shard", shard});
    EXPECT_EQ(outcome.code, 2) << shard;
    EXPECT_EQ(outcome.lines_of_error(), 1) << outcome.err;
    EXPECT_TRUE(outcome.says("i/N")) << outcome.err;
  }
  EXPECT_FALSE(exists("out"));
}

TEST_F(Merge, AFolderWithoutAStoreIsNamed) {
  const Outcome outcome = run({"merge", "study.toml", "-o", "out", "nowhere"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(outcome.says("nowhere")) << outcome.err;
}

TEST_F(Merge, ResultsOfAnotherModelAreNotMixedIn) {
  ASSERT_EQ(run({"study", "study.toml", "-o", "other"}).code, 0);
  const std::filesystem::path path = whole_cases("other").front();
  auto stored = store::read_case_file(path);
  ASSERT_TRUE(stored);
  std::filesystem::remove(path);
  stored->manifest.model_version = 99;
  ASSERT_FALSE(store::write_case_file(path, scene::Scene{}, stored->result, stored->manifest));
  const Outcome outcome = run({"merge", "study.toml", "-o", "out", "other"});
  EXPECT_EQ(outcome.code, 2) << outcome.err;
  EXPECT_TRUE(outcome.says("model version 99")) << outcome.err;
  EXPECT_TRUE(whole_cases("out").empty());
}

TEST_F(Merge, AWholeStudyAndAShardExcludeEachOther) {
  write("shell.toml", brief_scene());
  start({"study", "study.toml", "-o", "out", "--shard", "1/2"});
  wait_for_a_case("out");
  const Outcome whole = run_beside({"study", "study.toml", "-o", "out"});
  EXPECT_EQ(whole.code, 2) << whole.err;
  EXPECT_TRUE(whole.says("process " + std::to_string(child()) + " ")) << whole.err;
  EXPECT_EQ(wait().code, 0);
}

}  // namespace
}  // namespace launchsafe::app
