// A study in shards: what merges to the whole, and what does not. Of every kind: kinds_battery_test.cpp.
#include "stored_study.hpp"

namespace launchsafe::app {
namespace {

class ShardedStudy : public StoredStudy {
 protected:
  void SetUp() override {
    StoredStudy::SetUp();
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

TEST_F(ShardedStudy, AtOnceMergeToTheWhole) {
  start({"study", "study.toml", "-o", "1", "--shard", "1/3"});
  EXPECT_EQ(run_beside({"study", "study.toml", "-o", "2", "--shard", "2/3"}).code, 0);
  EXPECT_EQ(run_beside({"study", "study.toml", "-o", "3", "--shard", "3/3"}).code, 0);
  EXPECT_EQ(wait().code, 0);
  const Outcome merged = run({"merge", "study.toml", "-o", "out", "1", "2", "3"});
  EXPECT_EQ(merged.code, alone_.code) << merged.err;
  expect_same_results("alone", "out");
}

TEST_F(ShardedStudy, WithoutOneOfThemIsNotMerged) {
  EXPECT_EQ(run_shard("1/3", "1").code, 0);
  EXPECT_EQ(run_shard("3/3", "3").code, 0);
  const Outcome merged = run({"merge", "study.toml", "-o", "out", "1", "3"});
  EXPECT_EQ(merged.code, 3);
  // The cases of the second shard, of which two share a run: done where the study ran alone, but not here.
  const std::size_t missing = 2 * (done_cases("alone").size() - done_cases("out").size());
  EXPECT_TRUE(merged.says(std::to_string(missing) + " results are missing")) << merged.err;
  EXPECT_EQ(lines_with(merged.out, "missing: "), missing) << merged.out;
  EXPECT_FALSE(exists("out/report.md"));
}

/// Makes the runs of a results file those of another commit.
void take_for_anothers(const std::filesystem::path& results, const std::string& program) {
  store::Database database(results, true);
  database.rows("UPDATE stored_runs SET program = ?", {program});
}

TEST_F(ShardedStudy, EveryProgramThatMadeALaunchIsInTheManifestAndOnThePage) {
  const std::string other = "launchsafe 0.0.1, commit 0123abc";
  const std::string own = store::program_of(store::make_manifest({}));
  const auto programs = [this](const std::string& name) {
    return nlohmann::json::parse(read(name + "/manifest.json"))["programs"];
  };
  EXPECT_EQ(programs("alone"), nlohmann::json({own}));
  EXPECT_EQ(read("alone/report.md").find(own), std::string::npos);

  ASSERT_EQ(run_shard("1/2", "one").code, 0);
  ASSERT_EQ(run_shard("2/2", "two").code, 0);
  take_for_anothers(folder() / "one/study.db", other);
  const Outcome merged = run({"merge", "study.toml", "-o", "out", "one", "two"});
  EXPECT_EQ(merged.code, alone_.code) << merged.err;
  EXPECT_TRUE(merged.says(other)) << merged.err;
  EXPECT_EQ(programs("out"), nlohmann::json({other, own}));
  EXPECT_NE(read("out/report.md").find(other), std::string::npos);
  ASSERT_EQ(run({"report", "out", "-o", "safety"}).code, 0);
  EXPECT_NE(read("safety/report.json").find("other_programs"), std::string::npos);
}

}  // namespace
}  // namespace launchsafe::app
