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

TEST_F(ChangedStudy, ARemarkMakesNoOtherStudy) {
  write("study.toml", "# a remark\n" + sweep_study);
  EXPECT_EQ(run({"study", "study.toml", "-o", "out"}).code, 0);
  EXPECT_EQ(read("out/report.md"), page_);
}

TEST_F(ChangedStudy, WithOtherThermalInputNeedsNoRun) {
  write("study.toml", with(sweep_study, "20, 40 us", "20, 60 us"));
  const Outcome updated = update();
  EXPECT_EQ(updated.code, 0) << updated.err;
  EXPECT_TRUE(updated.says("re-used 12 mechanical runs, ran 0")) << updated.err;
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
  ASSERT_EQ(run({"study", "study.toml", "-o", "alone"}).code, 0);
  EXPECT_EQ(read("out/report.md"), read("alone/report.md"));
}

}  // namespace
}  // namespace launchsafe::app
