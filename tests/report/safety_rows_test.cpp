// Folders that somebody changed consistently, with all digests made anew. What is expected is what the
// shipped study says: its cells follow from each other, so that the one that was changed stands against the
// others.
#include "safety_report_files.hpp"

namespace launchsafe::report {
namespace {

using Results = nlohmann::ordered_json;

class SafetyReportRows : public SafetyReport {
 protected:
  /// Expects that a copy of a shipped study is refused once it was changed, and why.
  void expect_refused(const std::string& name, const std::function<void(Results&)>& how,
                      const std::string& why) {
    const path study = copy_of(name);
    change(study, how);
    EXPECT_TRUE(has(fault_of({study}), why)) << why << "\nin " << fault_of({study});
    std::filesystem::remove_all(study);
  }
};

TEST_F(SafetyReportRows, ALowerBoundThatItsCausesDoNotGiveIsRefused) {
  expect_refused(
      "critical_gap_155mm", [](Results& results) { set_bound(results["cases"][0], 0.0355); },
      "critical_gap_at_least_cm is 0.0355, and what it follows from makes it 0.0273430669");
  // Not even the causes may be changed alone, of which each is told twice.
  expect_refused(
      "critical_gap_155mm",
      [](Results& results) {
        for (Results& share : results["gap_shares"]) share["lowers_cm"] = 1e-4;
      },
      "raised is \"0.03394 cm\", and what it follows from makes it \"0.03808 cm\"");
  expect_refused(
      "critical_gap_155mm",
      [](Results& results) {
        for (Results& share : results["gap_shares"]) share["class"] = "random";
      },
      "class is \"random\", and what it follows from makes it \"knowledge\"");
}

TEST_F(SafetyReportRows, ALowerBoundIsNotKnownWithoutACauseThatMakesTMaxUncertain) {
  for (const char* cause : {"other models", "calibrated constants", "computation", "peak pressure"})
    expect_refused(
        "critical_gap_155mm",
        [&](Results& results) {
          std::erase_if(results["gap_shares"].get_ref<Results::array_t&>(),
                        [&](const Results& share) { return share["cause"] == cause; });
        },
        "and what it follows from makes it null");
}

// An upper bound follows from critical gaps of four digits: 0.04787 cm.
TEST_F(SafetyReportRows, AnUpperBoundAndWordsThatTheirNumbersDoNotGiveAreRefused) {
  expect_refused(
      "critical_gap_155mm", [](Results& results) { results["cases"][0]["critical_gap_at_most_cm"] = 0.04; },
      "critical_gap_at_most_cm is 0.04, and what it follows from makes it 0.0478");
  expect_refused(
      "critical_gap_155mm",
      [](Results& results) { results["cases"][0]["critical_gap_with_bounds"] = "0.380 ± 0.001 cm"; },
      "what it follows from makes it \"0.038 +0.010 −0.011 cm\"");
  expect_refused(
      "critical_gap_155mm",
      [](Results& results) { results["cases"][0]["critical_gap_reads_as"] = "0.382 cm"; },
      "what it follows from makes it \"0.0382 cm\"");
  expect_refused(
      "critical_gap_155mm", [](Results& results) { results["cases"][0]["largest_safe_gap_cm"] = 0.03; },
      "largest_safe_gap_cm is 0.03, and what it follows from makes it 0.02");
}

// In a sweep no causes are listed: its lower bound is none above the critical gap, 0.0961805 cm at 250 MPa.
TEST_F(SafetyReportRows, ALowerBoundOfASweepAboveItsBracketIsRefused) {
  expect_refused(
      "sweep_pressure_defect", [](Results& results) { set_bound(results["cases"][0], 0.0962); },
      "critical_gap_at_least_cm is 0.0962, and what it follows from makes it 0.096180");
}

// 21.86 K are the sum of 1.01, 2.86, 15.13 and 2.86 K.
TEST_F(SafetyReportRows, AnUncertaintyThatIsNotTheSumOfItsPartsIsRefused) {
  for (const char* name : {"critical_gap_155mm", "sweep_pressure_defect"})
    expect_refused(
        name, [](Results& results) { results["verdicts"][0]["uncertainty_K"] = 1.0; },
        "row 1: uncertainty_K is 1.0, and what it follows from makes it ");
  expect_refused(
      "critical_gap_155mm",
      [](Results& results) {
        Results& row = results["verdicts"][0];
        row["uncertainty_of_fit_K"] = -row["uncertainty_of_fit_K"].get<double>();
        row["uncertainty_K"] = 21.8617364957 + 2 * row["uncertainty_of_fit_K"].get<double>();
      },
      "and what it follows from makes it 21.8617");
}

TEST_F(SafetyReportRows, ACaseWithoutVerdictsAndVerdictsWithoutACaseAreRefused) {
  expect_refused(
      "critical_gap_155mm",
      [](Results& results) {
        results["cases"].push_back(results["cases"][0]);
        results["cases"][1]["case"] = "600 MPa, 30 µm, 1 mm";
      },
      "rows: cases is 2, and what it follows from makes it 1");
  expect_refused(
      "critical_gap_155mm",
      [](Results& results) {
        const Results rows = results["verdicts"];
        for (const Results& row : rows) results["verdicts"].push_back(row);
      },
      "rows: verdicts is 12, and what it follows from makes it 6");
}

TEST_F(SafetyReportRows, ResultsOfAnotherStudyAreRefused) {
  for (const char* key : {"title", "study"})
    expect_refused(
        "critical_gap_155mm", [&](Results& results) { results[key] = "another"; },
        fmt::format("found results of {} \"another\"", key));
  // Those of the sweep under the names of the main job.
  expect_refused(
      "critical_gap_155mm",
      [](Results& results) {
        Results other = Results::parse(read(shipped("sweep_pressure_defect") / "study.json"));
        for (const char* key : {"title", "study"}) other[key] = results[key];
        results = other;
      },
      "rows: cases is 56, and what it follows from makes it 1");
}

TEST_F(SafetyReportRows, APeakPressureThatIsNotThatOfTheManifestOrOfTheStoredRunIsRefused) {
  expect_refused(
      "critical_gap_155mm", [](Results& results) { results["verdicts"][0]["peak_pressure_MPa"] = 600.0; },
      "peak_pressure_MPa is 600.0, and what it follows from makes it 496.0");
  const path study = copy_of("critical_gap_155mm");
  ask(study, "load.peak = \"496000000 Pa\"", "load.peak = \"600000000 Pa\"");
  EXPECT_TRUE(has(fault_of({study}), "what it follows from makes it \"600 MPa, 30 µm, 1 mm\""));
  restate(study, "peak_pressure_MPa\": 496", "peak_pressure_MPa\": 600");
  std::string text = read(study / "study.json");
  const std::string digest = store::sha256(text), from = "496 MPa, 30 µm", to = "600 MPa, 30 µm";
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos;)
    text.replace(at, from.size(), to);
  write(study / "study.json", text);
  replace_in(study / "manifest.json", digest, store::sha256(text));
  // The name of the stored run is the digest of its launch, whether or not the file was kept.
  EXPECT_TRUE(has(fault_of({study}), "stored_case is \"cases/3502bb587d417529e93adc945ed9e56b.h5\""))
      << fault_of({study});
}

TEST_F(SafetyReportRows, ValuesOfAnAxisThatAreNotThoseOfTheManifestAreRefused) {
  expect_refused(
      "temperature", [](Results& results) { results["cases"].back()["initial_temperature_K"] = 300.0; },
      "initial_temperature_K is 300.0, and what it follows from makes it 344.0");
  const path sweep = copy_of("temperature");
  ask(sweep, "336, 344 K", "336, 345 K");
  EXPECT_TRUE(has(fault_of({sweep}), "axes: axes is ")) << fault_of({sweep});
}

TEST_F(SafetyReportRows, AGapThatWasMovedIsRefused) {
  expect_refused(
      "critical_gap_155mm", [](Results& results) { results["verdicts"][2]["gap_cm"] = 0.025; },
      "gap_cm is 0.025, and what it follows from makes it 0.02");
}

TEST_F(SafetyReportRows, AVerdictThatWarnsLessThanItsPartsIsRefused) {
  for (const int row : {4, 5})
    expect_refused(
        "critical_gap_155mm",
        [&](Results& results) {
          results["verdicts"][row - 1]["verdict"] = row == 4 ? "SAFE" : "INDETERMINATE";
        },
        row == 4 ? no_verdict(4, "SAFE", "INDETERMINATE") : no_verdict(5, "INDETERMINATE", "UNSAFE"));
}

// Within a bracket as wide as 0.001 cm what a cause changes vanishes.
TEST_F(SafetyReportRows, ASafeOfAnEarlierProgramByAWideBracketIsRefused) {
  const auto widen = [](Results& results) {
    Results& row = results["cases"][0];
    const double gap = row["critical_gap_lower_cm"].get<double>() + 0.0005;
    row["critical_gap_upper_cm"] = gap + 0.0005;
    row["critical_gap_cm"] = gap;
    row["critical_gap_reads_as"] = significant(gap, 3) + " cm";
    set_bound(row, row["critical_gap_at_least_cm"]);
  };
  expect_refused("sweep_pressure_defect", widen, no_verdict(1, "SAFE", "INDETERMINATE"));
}

// All shipped studies of this kind, which several builds made.
TEST_F(SafetyReportRows, ShippedStudiesFollowFromTheirParts) {
  for (const char* name : {"critical_gap_155mm", "defects", "sweep_pressure_defect", "temperature"})
    EXPECT_EQ(fault_of({shipped(name)}), "") << name;
}

}  // namespace
}  // namespace launchsafe::report
