// A folder that holds something else already.
#include "stored_study.hpp"

namespace launchsafe::app {
namespace {

class ChangedStudy : public StoredStudy {
 protected:
  void SetUp() override {
    StoredStudy::SetUp();
    first_ = run({"study", "study.toml", "-o", "out"});
    ASSERT_EQ(first_.code, 0) << first_.out << first_.err;
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
  EXPECT_TRUE(updated.says("re-used 12 mechanical runs, ran 3;")) << updated.err;
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

class ForeignFolder : public StoredStudy {};

TEST_F(ForeignFolder, ResultsAreKeptApartFromTheStudysFile) {
  const Outcome refused = run({"study", "study.toml", "-o", "."});
  EXPECT_EQ(refused.code, 2);
  EXPECT_FALSE(exists("cases"));
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
