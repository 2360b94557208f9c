// launchsafe report as a user meets it: of studies that ran, failed or were interrupted, and of bad input.
#include "launchsafe/report/table.hpp"
#include "launchsafe/store/file.hpp"
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
  /// Puts other results in the place of those of the study, with their checksum.
  void forge(const nlohmann::ordered_json& results) {
    const std::string before = store::sha256(read("out/study.json"));
    write("out/study.json", results.dump());
    write("out/manifest.json",
          with(read("out/manifest.json"), before, store::sha256(read("out/study.json"))));
  }
  bool reports(const std::string& part) const {
    return read("safety/report.md").find(part) != std::string::npos;
  }
};

TEST_F(ReportCommand, WritesPageDataAndFiguresOfAStudyThatRan) {
  run_critical_gap();
  const Outcome outcome = run({"report", "out", "-o", "safety"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  for (const char* name : {"report.html", "report.md", "report.json", "section.svg", "pressure.svg"})
    EXPECT_TRUE(exists(std::string("safety/") + name)) << name;
  // Twice the same, and nothing of the study is touched.
  const std::string first = read("safety/report.html");
  EXPECT_EQ(run({"report", "out", "-o", "again"}).code, 0);
  EXPECT_EQ(read("again/report.html"), first);
  EXPECT_EQ(run({"report", "out", "-o", "safety"}).code, 0);
}

TEST_F(ReportCommand, NamesEveryProgramThatMadeALaunchWhereItIsNotThatOfTheStudy) {
  run_critical_gap();
  ASSERT_EQ(run({"report", "out", "-o", "safety"}).code, 0);
  EXPECT_EQ(read("safety/report.json").find("limits.programs"), std::string::npos);
  auto manifest = nlohmann::ordered_json::parse(read("out/manifest.json"));
  manifest["programs"].insert(manifest["programs"].begin(), "launchsafe 0.0.1, commit 0123abc");
  write("out/manifest.json", manifest.dump());
  ASSERT_EQ(run({"report", "out", "-o", "again"}).code, 0);
  EXPECT_NE(read("again/report.json").find("limits.programs"), std::string::npos);
  EXPECT_NE(read("again/report.md").find("launchsafe 0.0.1, commit 0123abc"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(read("again/manifest.json"))["programs"], manifest["programs"]);
}

// Likewise: bodies of other steels than the first are of the shell too.
TEST_F(ReportCommand, RefusesStudiesOfDifferentSecondSteels) {
  const auto with_second_steel = [](const std::string& yield_stress) {
    const std::string base = "name = \"base\"\nmaterial = ";
    return with(tiny_scene, base + "\"steel\"", base + "\"second\"") +
           "[material.second]\nlaw = \"steel\"\nlike = \"shell-steel\"\nyield_stress = \"" + yield_stress +
           "\"\n";
  };
  write("shell.toml", with_second_steel("1.1 GPa"));
  run_critical_gap();
  write("study.toml", sweep_study);
  ASSERT_NE(run({"study", "study.toml", "-o", "same"}).code, 2);
  EXPECT_EQ(run({"report", "out", "same", "-o", "safety"}).code, 0);
  write("shell.toml", with_second_steel("1.2 GPa"));
  ASSERT_NE(run({"study", "study.toml", "-o", "other"}).code, 2);
  const Outcome outcome = run({"report", "out", "other", "-o", "safety"});
  EXPECT_EQ(outcome.code, 2) << outcome.out;
  EXPECT_TRUE(outcome.says("different shells")) << outcome.err;
}

TEST_F(ReportCommand, OfAStudyWhoseCaseFailedSaysSo) {
  write("shell.toml", with(tiny_scene, "energy_drift_limit = 0.5", "energy_drift_limit = 1e-6"));
  write("study.toml", critical_gap_study);
  EXPECT_EQ(run({"study", "study.toml", "-o", "out"}).code, 3);
  EXPECT_EQ(run({"report", "out", "-o", "safety"}).code, 0);
  // What a run was like until it was cut off is no margin.
  const auto report = nlohmann::json::parse(read("safety/report.json"));
  for (const auto& block : report["sections"][0]["blocks"]) {
    if (block["id"] != "verdicts") continue;
    for (const auto& row : block["rows"])
      for (const char* key : {"temperature_max_K", "margin_K", "uncertainty_K", "margin_over_uncertainty"})
        EXPECT_TRUE(row[key].is_null()) << key << " " << row[key];
  }
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

TEST_F(ReportCommand, ASafeThatTheStoredRunDoesNotGiveIsRefused) {
  // Under the default ignition temperature the gaps stay far below it.
  write("study.toml",
        "largest_gap = \"1 cm\"\n" + critical_gap_study.substr(0, critical_gap_study.find("[set]")));
  run({"study", "study.toml", "-o", "out"});
  EXPECT_EQ(run({"report", "out", "-o", "as_it_is"}).code, 0);
  auto results = nlohmann::ordered_json::parse(read("out/study.json"));
  const auto safe = std::find_if(results["verdicts"].begin(), results["verdicts"].end(),
                                 [](const auto& row) { return row["verdict"] == "SAFE"; });
  ASSERT_NE(safe, results["verdicts"].end());
  // Margin and temperature go together, and the checksums with them: only the stored run tells.
  for (const auto& [key, by] : {std::pair{"temperature_max_K", -5.0}, std::pair{"margin_K", 5.0}})
    (*safe)[key] = (*safe)[key].get<double>() + by;
  forge(results);
  const Outcome outcome = run({"report", "out", "-o", "safety"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(outcome.says("the stored run of")) << outcome.err;
  EXPECT_FALSE(exists("safety"));
}

// All numbers of a critical gap are moved by as much, so that only the stored run tells.
TEST_F(ReportCommand, ACriticalGapThatTheStoredRunDoesNotGiveIsRefused) {
  run_critical_gap();
  auto results = nlohmann::ordered_json::parse(read("out/study.json"));
  auto& row = results["cases"][0];
  ASSERT_EQ(row["critical_gap_kind"], "value");
  constexpr double by = 0.001;  // cm
  for (const char* end : {"", "_lower", "_upper", "_at_least", "_at_most"}) {
    auto& cell = row[fmt::format("critical_gap{}_cm", end)];
    if (cell.is_number() && cell > 0.0) cell = cell.get<double>() + by;
  }
  const std::string reads_as = report::significant(row["critical_gap_cm"], 3) + " cm";
  row["critical_gap_reads_as"] = row["critical_gap_with_bounds"] = reads_as;  // of one without an upper bound
  for (auto& share : results["gap_shares"]) {
    if (share["raised"] == "ignites without a gap")
      share["lowers_cm"] = share["lowers_cm"].get<double>() + by;
    for (const char* end : {"raised", "lowered"}) {
      const std::string gap = share[end];
      if (gap.ends_with(" cm")) share[end] = report::significant(std::stod(gap) + by, 4) + " cm";
    }
  }
  forge(results);
  const Outcome outcome = run({"report", "out", "-o", "safety"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(outcome.says("critical_gap_lower_cm of 250 MPa, 30 µm, 1 mm is")) << outcome.err;
  EXPECT_TRUE(outcome.says("which the stored run contradicts")) << outcome.err;
}

// The manifest writes the temperature of the air too, which followed that of the charge in each case.
TEST_F(ReportCommand, CasesAtOtherTemperaturesAreThoseOfTheirStoredRuns) {
  write("study.toml",
        critical_gap_study + "\n[[vary]]\nkey = \"initial_temperature\"\nvalues = \"290, 300 K\"\n");
  run({"study", "study.toml", "-o", "out"});
  const Outcome outcome = run({"report", "out", "-o", "safety"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(reports("initial\\_temperature 290 K"));
}

TEST_F(ReportCommand, FiguresThatTheReportNoLongerHasMoveAside) {
  run_critical_gap();
  EXPECT_EQ(run({"report", "out", "-o", "safety"}).code, 0);
  std::vector<std::string> pictures;
  for (const auto& entry : std::filesystem::directory_iterator(folder() / "safety"))
    if (const std::string name = entry.path().filename();
        name.starts_with("histories_") || name.starts_with("profile"))
      pictures.push_back("safety/" + name);
  ASSERT_GE(pictures.size(), 2u);
  write("safety/mine.svg", "mine");
  write(pictures[0], "edited");
  std::filesystem::remove_all(folder() / "out/cases");
  const Outcome outcome = run({"report", "out", "-o", "safety"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(outcome.says(pictures[0] + ".edited-1")) << outcome.err;
  EXPECT_EQ(read(pictures[0] + ".edited-1"), "edited");
  EXPECT_EQ(read("safety/mine.svg"), "mine");
  EXPECT_FALSE(exists(pictures[1]));
  EXPECT_TRUE(exists(with(pictures[1], "safety/", "safety/earlier-1/")));
  EXPECT_TRUE(exists("safety/section.svg")) << "the new report has it";
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
