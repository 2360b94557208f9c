// A folder that holds something else already.
#include "stored_study.hpp"

namespace launchsafe::app {
namespace {

class ChangedStudy : public StoredStudy {
 protected:
  void SetUp() override {
    StoredStudy::SetUp();
    first_ = run({"study", "study.toml", "-o", "out"});
    ASSERT_EQ(first_.code, 0) << first_.err;
    page_ = read("out/report.md");
  }
  Outcome update() { return run({"study", "study.toml", "-o", "out", "--update"}); }

  Outcome first_;
  std::string page_;
};

TEST_F(ChangedStudy, IsRefusedAndToldOfUpdate) {
  write("shell.toml", with(far_scene(), "250 MPa", "255 MPa"));
  const auto before = results_in("out");
  const Outcome refused = run({"study", "study.toml", "-o", "out"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_EQ(refused.lines_of_error(), 1) << refused.err;
  EXPECT_TRUE(refused.says("--update")) << refused.err;
  EXPECT_TRUE(refused.says("(load.peak = 255 MPa here, 250 MPa there)")) << refused.err;
  EXPECT_TRUE(results_in("out") == before);
  EXPECT_FALSE(exists("out/earlier-1"));
}

// Verdicts rest on such files too: a report that is called up to date after one of them changed may say SAFE
// of what is no longer safe.
TEST_F(ChangedStudy, OfAFileThatItRestsOnIsAnotherStudy) {
  write("rows.toml", "[[reference]]\ngap = \"0 cm\"\nmaximum_temperature = \"400 K\"\n");
  write("study.toml", "references = \"rows.toml\"\n" + sweep_study);
  ASSERT_EQ(update().code, 0);
  write("rows.toml", "[[reference]]\ngap = \"0 cm\"\nmaximum_temperature = \"401 K\"\n");
  const Outcome refused = run({"study", "study.toml", "-o", "out"});
  EXPECT_EQ(refused.code, 2) << refused.err;
  EXPECT_TRUE(refused.says("--update")) << refused.err;
  EXPECT_TRUE(refused.says("another file that it rests on")) << refused.err;
}

TEST_F(ChangedStudy, IsToldWithItsFirstDifferenceAndHowManyMoreThereAre) {
  write("study.toml", with(with(sweep_study, "0, 0.01, 0.02 cm", "0, 0.01 cm"), "\"1 cm\"", "\"0.9 cm\""));
  const Outcome refused = run({"study", "study.toml", "-o", "out"});
  EXPECT_TRUE(refused.says("gaps = 0, 0.01 cm here, 0, 0.01, 0.02 cm there and 1 more")) << refused.err;
  write("study.toml", sweep_study);
  write("shell.toml", with(far_scene(), "r = \"1 cm\"", "r = \"1.2 cm\""));
  const Outcome moved = run({"study", "study.toml", "-o", "out"});
  EXPECT_TRUE(moved.says("(G1 = { x = 0.039 m, r = 0.012 m } here, { x = 0.039 m, r = 0.01 m } there)"))
      << moved.err;
}

TEST_F(ChangedStudy, WithOtherThermalInputNeedsNoRun) {
  write("study.toml", with(sweep_study, "20, 40 us", "20, 60 us"));
  const Outcome updated = update();
  EXPECT_EQ(updated.code, 0) << updated.err;
  EXPECT_TRUE(updated.says("re-used 12 mechanical runs, ran 0")) << updated.err;
  EXPECT_TRUE(updated.says("out/earlier-1")) << updated.err;
  EXPECT_EQ(read("out/earlier-1/report.md"), page_);
  EXPECT_TRUE(exists("out/earlier-1/manifest.json"));
  EXPECT_TRUE(exists("out/earlier-1/critical_gaps.csv"));
  EXPECT_FALSE(exists("out/earlier-1/cases"));
  EXPECT_NE(read("out/report.md"), page_);
}

TEST_F(ChangedStudy, WithOneMoreValueRunsWhatIsNew) {
  write("study.toml", with(sweep_study, "270, 280 MPa", "270, 280, 290 MPa"));
  const Outcome updated = update();
  EXPECT_EQ(updated.code, 0) << updated.err;
  EXPECT_TRUE(updated.says("re-used 12 mechanical runs, ran 3 ")) << updated.err;
  write("study.toml", with(sweep_study, "270, 280 MPa", "270 MPa"));
  const Outcome fewer = update();
  EXPECT_TRUE(fewer.says("re-used 9 mechanical runs, ran 0")) << fewer.err;
  EXPECT_EQ(read("out/earlier-1/report.md"), page_);
  EXPECT_TRUE(exists("out/earlier-2/report.md"));
  ASSERT_EQ(run({"study", "study.toml", "-o", "alone"}).code, 0);
  EXPECT_EQ(read("out/report.md"), read("alone/report.md"));
}

TEST_F(ChangedStudy, UpdateOfTheSameStudyMovesNothing) {
  EXPECT_EQ(update().code, 0);
  EXPECT_FALSE(exists("out/earlier-1"));
}

TEST_F(ChangedStudy, TellsBeforeWhyARunRuns) {
  write("shell.toml", with(far_scene(), "peak_time = \"0.35 ms\"", "peak_time = \"0.36 ms\""));
  const auto rows = [this] {
    return nlohmann::json::parse(
        run({"study", "study.toml", "-o", "out", "--dry-run", "--json"}).out)["runs"];
  };
  for (const auto& row : rows()) {
    const std::string state = row["state"];
    EXPECT_TRUE(state.starts_with("to run: ") && state.find("peak_time") != std::string::npos) << state;
  }
  ASSERT_EQ(update().code, 0);
  for (const auto& row : rows()) EXPECT_EQ(row["state"], "stored");
}

class ForeignFolder : public StoredStudy {};

TEST_F(ForeignFolder, ResultsAreKeptApartFromTheStudysFile) {
  const Outcome refused = run({"study", "study.toml", "-o", "."});
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(refused.says(". is the folder of the study's file")) << refused.err;
  EXPECT_TRUE(refused.says("did you mean -o ./results?")) << refused.err;
  EXPECT_FALSE(exists("cases"));
  // Where an earlier version wrote them they stay in use.
  ASSERT_EQ(run({"study", "study.toml", "-o", "out"}).code, 0);
  std::filesystem::copy(folder() / "study.toml", folder() / "out");
  std::filesystem::copy(folder() / "shell.toml", folder() / "out");
  const Outcome present = run({"study", "out/study.toml", "-o", "out"});
  EXPECT_EQ(present.code, 0) << present.err;
}

TEST_F(ForeignFolder, FilesOfSomebodyElseAreNotOverwritten) {
  std::filesystem::create_directory(folder() / "out");
  write("out/report.md", "mine");
  const Outcome outcome = run({"study", "study.toml", "-o", "out", "--update"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(outcome.says("report.md")) << outcome.err;
  EXPECT_EQ(read("out/report.md"), "mine");
  EXPECT_FALSE(exists("out/cases"));
}

}  // namespace
}  // namespace launchsafe::app
