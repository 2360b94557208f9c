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
    return read("safety/report.html").find(part) != std::string::npos;
  }
};

TEST_F(ReportCommand, WritesPageDataAndFiguresOfAStudyThatRan) {
  run_critical_gap();
  const Outcome outcome = run({"report", "out", "-o", "safety"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  for (const char* name : {"report.html", "report.json", "pressure.svg"})
    EXPECT_TRUE(exists(std::string("safety/") + name)) << name;
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
  // What a run was like until it was cut off is no margin.
  const auto report = nlohmann::json::parse(read("safety/report.json"));
  ASSERT_FALSE(report["tables"]["verdicts"].empty());
  for (const auto& row : report["tables"]["verdicts"])
    for (const char* key : {"temperature_max_K", "margin_K", "uncertainty_K"})
      EXPECT_TRUE(row[key].is_null()) << key << " " << row[key];
  EXPECT_FALSE(exists("safety/temperature.svg"));
}

TEST_F(ReportCommand, OfAStudyThatWasInterruptedSaysHowToGoOn) {
  write("shell.toml", long_scene());
  write("study.toml", critical_gap_study);
  start({"study", "study.toml", "-o", "out"});
  wait_for_file("out/manifest.json");
  send(SIGTERM);
  EXPECT_EQ(wait().code, 75);
  const Outcome outcome = run({"report", "out", "-o", "safety"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(reports("launchsafe study study.toml -o out"));
}

TEST_F(ReportCommand, BadInputIsOneMessage) {
  run_critical_gap();
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"report", "nowhere", "-o", "safety"},
        {"report", "out", "out", "-o", "safety"},
        {"report", "out", "-o", "out"},
        {"report", "out"}}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments[1];
    EXPECT_EQ(outcome.lines_of_error(), 1) << outcome.err;
    EXPECT_FALSE(exists("safety"));
  }
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

TEST_F(ReportCommand, SomebodyElsesReportIsNotOverwritten) {
  run_critical_gap();
  std::filesystem::create_directory(folder() / "safety");
  write("safety/report.html", "mine");
  EXPECT_EQ(run({"report", "out", "-o", "safety"}).code, 2);
  EXPECT_EQ(read("safety/report.html"), "mine");
  EXPECT_FALSE(exists("safety/report.json"));
}

}  // namespace
}  // namespace launchsafe::app
