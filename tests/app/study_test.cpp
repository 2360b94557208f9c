// launchsafe study: its answer on stdout and in the folder, and what it refuses.
#include "program.hpp"

#include <nlohmann/json.hpp>

namespace launchsafe::app {
namespace {

const std::string small_study = R"(kind = "critical-gap"
scene = "shell.toml"
gaps = "0, 0.01, 0.02 cm"
early_time = "0.03 ms"
input_uncertainty = "2 K"
model_form_uncertainty = "1 K"
)";

class StudyProgram : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("shell.toml", tiny_scene);
    write("study.toml", small_study);
  }
};

TEST_F(StudyProgram, JsonHoldsGapVerdictsFitAndTiming) {
  const Outcome outcome = run({"study", "study.toml", "-o", "out", "--jobs", "2", "--json", "--quiet"});
  EXPECT_TRUE(outcome.code == 0 || outcome.code == 4) << outcome.code << outcome.err;
  const auto object = nlohmann::json::parse(outcome.out);
  for (const char* key : {"critical_gap_cm", "critical_gap_lower_cm", "critical_gap_upper_cm"}) {
    EXPECT_TRUE(object["critical_gap"].contains(key)) << key;
  }
  EXPECT_EQ(object["verdicts"].size(), 3u);
  EXPECT_TRUE(object.contains("fit"));
  EXPECT_TRUE(object.contains("timing"));
  EXPECT_EQ(nlohmann::json::parse(read("out/manifest.json"))["threads"], 2);
  EXPECT_TRUE(exists("out/verdicts.csv"));
}

TEST_F(StudyProgram, ARemarkMakesNoOtherStudy) {
  const int code = run({"study", "study.toml", "-o", "out"}).code;
  write("study.toml", "# a remark\n" + small_study);
  EXPECT_EQ(run({"study", "study.toml", "-o", "out"}).code, code);
}

// The gap stays cold under each of these; without their ranges all of them ended SAFE.
TEST_F(StudyProgram, AnImplausibleValueIsNamedInsteadOfSafeUntilItIsAccepted) {
  const std::vector<std::pair<std::string, std::string>> edits{{"gap.exchange_time", "\"100 s\""},
                                                               {"friction.closure", "\"none\""}};
  int number = 0;
  for (const auto& [key, value] : edits) {
    const std::string set = "[set]\n" + key + " = " + value + "\n";
    const std::string folder = "out" + std::to_string(++number);
    write("study.toml", small_study + set);
    EXPECT_EQ(run({"study", "study.toml", "-o", folder}).code, 4) << key;
    EXPECT_EQ(read(folder + "/verdicts.csv").find("SAFE"), std::string::npos) << key;
    EXPECT_NE(read(folder + "/verdicts.csv").find(key + " = "), std::string::npos) << key;
    write("study.toml",
          small_study + "accept = [{ key = \"" + key + "\", because = \"it is a test\" }]\n" + set);
    EXPECT_EQ(run({"study", "study.toml", "-o", folder, "--update"}).code, 0) << key;
    EXPECT_NE(read(folder + "/verdicts.csv").find("SAFE"), std::string::npos) << key;
    EXPECT_NE(read(folder + "/verdicts.csv").find("because it is a test"), std::string::npos) << key;
  }
}

TEST_F(StudyProgram, ExplainCountsItsRuns) {
  const auto plan = nlohmann::json::parse(run({"explain", "study.toml", "--json"}).out);
  EXPECT_EQ(plan["kind"], "critical-gap");
  EXPECT_EQ(plan["mechanical_runs"], 1);
  EXPECT_EQ(plan["coupled_runs_at_most"], 2);
  EXPECT_GT(plan["predicted_time_of_coupled_runs_s"], 0.0);
  EXPECT_GT(plan["predicted_time_s"], plan["predicted_time_of_coupled_runs_s"]);
  EXPECT_EQ(plan["gaps"], 3);
  EXPECT_NE(run({"explain", "study.toml"}).out.find("mechanical runs       1"), std::string::npos);
}

TEST_F(StudyProgram, IsInterruptedAndNamesTheCommandToGoOn) {
  write("shell.toml", long_scene());
  start({"study", "study.toml", "-o", "out"});
  wait_for_file("out/manifest.json");
  send(SIGINT);
  const Outcome outcome = wait();
  EXPECT_EQ(outcome.code, 75) << outcome.err;
  EXPECT_TRUE(outcome.says("launchsafe study study.toml -o out")) << outcome.err;
}

}  // namespace
}  // namespace launchsafe::app
