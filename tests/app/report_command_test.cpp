// launchsafe report as a user meets it: of studies that ran, failed or were interrupted, and of bad input.
#include "stored_study.hpp"

namespace launchsafe::app {
namespace {

class ReportCommand : public StoredStudy {
 protected:
  std::string run_critical_gap() {
    write("study.toml", critical_gap_study);
    run({"study", "study.toml", "-o", "out"});
    return "out";
  }
  bool reports(const std::string& part) const {
    return read("safety/report.md").find(part) != std::string::npos;
  }
};

TEST_F(ReportCommand, WritesPageDataAndFiguresOfAStudyThatRan) {
  run_critical_gap();
  const Outcome outcome = run({"report", "out", "-o", "safety"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  for (const char* name : {"report.html", "report.md", "report.json", "section.svg", "load.svg"})
    EXPECT_TRUE(exists(std::string("safety/") + name)) << name;
  EXPECT_TRUE(reports("launchsafe study study.toml -o DIR"));
  // Twice the same, and nothing of the study is touched.
  const std::string first = read("safety/report.html");
  EXPECT_EQ(run({"report", "out", "-o", "again"}).code, 0);
  EXPECT_EQ(read("again/report.html"), first);
  EXPECT_EQ(run({"report", "out", "-o", "safety"}).code, 0);
}

TEST_F(ReportCommand, OfAStudyWhoseCaseFailedSaysSo) {
  write("shell.toml", with(tiny_scene, "energy_drift_limit = 0.5", "energy_drift_limit = 1e-6"));
  write("study.toml", critical_gap_study);
  EXPECT_EQ(run({"study", "study.toml", "-o", "out"}).code, 3);
  EXPECT_EQ(run({"report", "out", "-o", "safety"}).code, 0);
  EXPECT_TRUE(reports("The critical gap is indeterminate"));
  EXPECT_TRUE(reports("did not complete"));
  EXPECT_TRUE(reports("nothing is shown to be safe"));
}

TEST_F(ReportCommand, OfAStudyThatWasInterruptedSaysHowToGoOn) {
  write("shell.toml", long_scene());
  write("study.toml", critical_gap_study);
  start({"study", "study.toml", "-o", "out"});
  while (!exists("out/manifest.json")) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  send(SIGTERM);
  EXPECT_EQ(wait().code, 75);
  const Outcome outcome = run({"report", "out", "-o", "safety"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(reports("There is no answer yet"));
  EXPECT_TRUE(reports("launchsafe study study.toml -o DIR"));
}

TEST_F(ReportCommand, BadInputIsOneMessage) {
  run_critical_gap();
  const auto refused = [this](const std::vector<std::string>& arguments, const std::string& says) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << says;
    EXPECT_EQ(outcome.lines_of_error(), 1) << outcome.err;
    EXPECT_TRUE(outcome.says(says)) << outcome.err;
    EXPECT_FALSE(exists("safety"));
  };
  refused({"report", "nowhere", "-o", "safety"}, "found no study there");
  refused({"report", "out", "out", "-o", "safety"}, "both are studies of kind critical-gap");
  refused({"report", "out", "-o", "out"}, "one of the studies");
  refused({"report", "out", "-o", "safety", "--criterion", "margin > 2", "--criterion-source", "a"},
          "--criterion");
  refused({"report", "out", "-o", "safety", "--criterion", "margin >= 2 K"}, "--criterion-source");
  refused({"report", "out", "-o", "safety", "--templates", "nowhere"}, "found no template there");
}

TEST_F(ReportCommand, ADamagedCaseIsRefused) {
  run_critical_gap();
  for (const auto& entry : std::filesystem::directory_iterator(folder() / "out/cases"))
    std::filesystem::resize_file(entry.path(), 3000);
  const Outcome outcome = run({"report", "out", "-o", "safety"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(outcome.says(".h5")) << outcome.err;
  EXPECT_FALSE(exists("safety"));
}

TEST_F(ReportCommand, WithoutCaseFilesItSaysWhatTheyWouldShow) {
  run_critical_gap();
  std::filesystem::remove_all(folder() / "out/cases");
  EXPECT_EQ(run({"report", "out", "-o", "safety"}).code, 0);
  EXPECT_TRUE(reports("need the case files"));
}

TEST_F(ReportCommand, SomebodyElsesReportIsNotOverwritten) {
  run_critical_gap();
  std::filesystem::create_directory(folder() / "safety");
  write("safety/report.md", "mine");
  EXPECT_EQ(run({"report", "out", "-o", "safety"}).code, 2);
  EXPECT_EQ(read("safety/report.md"), "mine");
  EXPECT_FALSE(exists("safety/report.html"));
}

}  // namespace
}  // namespace launchsafe::app
