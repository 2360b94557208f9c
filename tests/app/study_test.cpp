// launchsafe study: its answer on stdout and in the folder, and what it refuses.
#include "program.hpp"

#include <nlohmann/json.hpp>

namespace launchsafe::app {
namespace {

const std::string small_study = R"(kind = "critical-gap"
scene = "shell.toml"
gaps = "0, 0.01, 0.02 cm"
early_time = "0.03 ms"
uncertainty.peak_pressure = "0 %"
numerics = { value = "2 K", because = "two meshes of it" }
)";

class StudyProgram : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("shell.toml", tiny_scene);
    write("study.toml", small_study);
  }
};

TEST_F(StudyProgram, NotesItsJobsInTheManifest) {
  const Outcome outcome = run({"study", "study.toml", "-o", "out", "--jobs", "2", "--json", "--quiet"});
  EXPECT_EQ(nlohmann::json::parse(outcome.out)["verdicts"].size(), 3u) << outcome.err;
  EXPECT_EQ(nlohmann::json::parse(read("out/manifest.json"))["threads"], 2);
  EXPECT_TRUE(exists("out/verdicts.csv"));
}

TEST_F(StudyProgram, ARemarkMakesNoOtherStudy) {
  const int code = run({"study", "study.toml", "-o", "out"}).code;
  write("study.toml", "# a remark\n" + small_study);
  EXPECT_EQ(run({"study", "study.toml", "-o", "out"}).code, code);
}

TEST_F(StudyProgram, ExplainCountsItsRuns) {
  const auto plan = nlohmann::json::parse(run({"explain", "study.toml", "--json"}).out);
  EXPECT_EQ(plan["kind"], "critical-gap");
  EXPECT_EQ(plan["mechanical_runs"], 1);
  EXPECT_EQ(plan["coupled_runs_at_most"], 2);
  EXPECT_GT(plan["predicted_time_s"], 0.0);
  EXPECT_EQ(plan["gaps"], 3);
}

}  // namespace
}  // namespace launchsafe::app
