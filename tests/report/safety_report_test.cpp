// The safety report of the shipped studies, and of copies of them that somebody changed.
#include "safety_report_files.hpp"

#include <fmt/format.h>

namespace launchsafe::report {
namespace {

TEST_F(SafetyReport, GreenIsNoSafeThatSomebodyAcceptsOrThatIsOfADemonstration) {
  const path study = copy_of("critical_gap_155mm");
  const auto shown = [&](const char* look) {
    return has(file_of({study}, "report.html"),
               fmt::format("class=\"{}\" data-heading=\"verdict\">SAFE", look));
  };
  EXPECT_TRUE(shown("SAFE"));
  EXPECT_FALSE(shown("ACCEPTED"));
  change(study,
         [](auto& results) { results["verdicts"][0]["accepted"] = "station.width = 7 mm, because ..."; });
  EXPECT_TRUE(shown("ACCEPTED"));
  EXPECT_TRUE(shown("SAFE")) << "the other gaps";
  change(study, [](auto& results) { results["demonstration"] = true; });
  EXPECT_FALSE(shown("SAFE"));
}

TEST_F(SafetyReport, TheJsonNamesTheOriginOfEveryBlock) {
  const auto json =
      nlohmann::json::parse(file_of({shipped("critical_gap_155mm"), shipped("accuracy")}, "report.json"));
  EXPECT_EQ(json["format"], "launchsafe safety report 4");
  EXPECT_EQ(json["answer"]["largest_safe_gap_cm"], 0.02);
  int tables = 0;
  for (const auto& section : json["sections"])
    for (const auto& block : section["blocks"]) {
      if (block["kind"] != "table" || block["id"] == "studies") continue;
      ++tables;
      EXPECT_FALSE(block["origin"]["study"].get<std::string>().empty()) << block["id"];
      EXPECT_FALSE(block["origin"]["of"].get<std::string>().empty()) << block["id"];
    }
  EXPECT_GT(tables, 8);
}

TEST_F(SafetyReport, EqualEvidenceMakesEqualBytes) {
  for (const char* name : {"report.html", "report.md", "report.json", "temperature.svg"})
    EXPECT_EQ(file_of({shipped("critical_gap_155mm")}, name), file_of({shipped("critical_gap_155mm")}, name))
        << name;
}

TEST_F(SafetyReport, MarkupInAStudyIsShownAndNotObeyed) {
  const path study = copy_of("critical_gap_155mm");
  const std::string evil =
      "<script>alert(1)</script> <img src=x onerror=alert(2)> [a](javascript:b) {{title}} & \"q\"";
  change(study, [&](auto& results) { results["title"] = evil; });
  ask(study, "Critical bottom gap of the 155 mm shell", evil);
  restate(study, "below the lower bound of the critical gap, 0.0273 cm", "below <b onclick=x>| a </td>");
  const std::string html = file_of({study}, "report.html"), page = file_of({study}, "report.md");
  EXPECT_FALSE(has(html, "<script"));
  EXPECT_FALSE(has(html, "<img src=x"));
  EXPECT_TRUE(has(html, "&lt;script&gt;alert(1)&lt;/script&gt;"));
  EXPECT_TRUE(has(html, "{{title}}"));  // as words: not filled in
  EXPECT_TRUE(has(page, "\\<script\\>"));
  for (std::size_t at = page.find("<script"); at != std::string::npos; at = page.find("<script", at + 1))
    EXPECT_EQ(page[at - 1], '\\') << page.substr(at - 40, 80);
  EXPECT_FALSE(has(page, "[a](javascript:b)"));
  EXPECT_TRUE(has(page, "\\[a\\](javascript:b)"));
}

TEST_F(SafetyReport, AnEditedFileIsRefused) {
  const path study = copy_of("critical_gap_155mm");
  replace_in(study / "study.json", "INDETERMINATE", "SAFE");
  EXPECT_TRUE(has(fault_of({study}), "study.json")) << fault_of({study});
  const path other = copy_of("accuracy");
  std::filesystem::remove(other / "accuracy.csv");
  EXPECT_TRUE(has(fault_of({other}), "accuracy.csv")) << fault_of({other});
}

TEST_F(SafetyReport, ASafeThatItsOwnNumbersContradictIsRefused) {
  const path study = copy_of("critical_gap_155mm");
  restate(study, "\"verdict\": \"INDETERMINATE\"", "\"verdict\": \"SAFE\"");
  EXPECT_TRUE(has(fault_of({study}), no_verdict(4, "SAFE", "INDETERMINATE"))) << fault_of({study});
}

TEST_F(SafetyReport, ASafeThatItsTemperatureOrCriticalGapContradictsIsRefused) {
  const path colder = copy_of("critical_gap_155mm");
  change(colder, [](auto& results) { results["verdicts"][2]["margin_K"] = 300.0; });
  EXPECT_TRUE(has(fault_of({colder}), "row 3: margin_K is 300.0")) << fault_of({colder});
  std::filesystem::remove_all(colder);
  // Above a lower bound that is now smaller.
  const path near = copy_of("critical_gap_155mm");
  change(near, [](auto& results) { bound_by_computation(results, 0.0199); });
  EXPECT_TRUE(has(fault_of({near}), no_verdict(3, "SAFE", "INDETERMINATE"))) << fault_of({near});
  change(near, [](auto& results) {
    results["cases"][0]["critical_gap_kind"] = "indeterminate";
    for (const char* key : {"critical_gap_cm", "critical_gap_at_least_cm", "critical_gap_at_most_cm"})
      results["cases"][0][key] = nullptr;
  });
  EXPECT_TRUE(has(fault_of({near}), no_verdict(1, "SAFE", "INDETERMINATE"))) << fault_of({near});
  std::filesystem::remove_all(near);
  const path warned = copy_of("critical_gap_155mm");
  change(warned, [](auto& results) { results["verdicts"][0]["unaccepted"] = "gap.pressure = chamber"; });
  EXPECT_TRUE(has(fault_of({warned}), no_verdict(1, "SAFE", "INDETERMINATE"))) << fault_of({warned});
}

// An earlier program called gaps SAFE under such a record where it went on for long.
TEST_F(SafetyReport, ASafeUnderALoadThatSaturatesIsRefused) {
  const path study = copy_of("critical_gap_155mm");
  for (const auto& [from, to] :
       {std::pair{"load.curve_time = []",
                  "load.curve_time = \"0, 0.005, 0.007, 0.009, 0.011, 0.013, 0.015, 0.018, 0.02, 0.15 s\""},
        {"load.curve_pressure = []",
         "load.curve_pressure = \"0, 60e6, 480e6, 496e6, 496e6, 496e6, 480e6, 2e6, 2e6, 0 Pa\""}})
    ask(study, from, to);
  change(study, [&](auto& results) { results["runs"][0]["stored_case"] = stored_case(study); });
  EXPECT_TRUE(has(fault_of({study}), no_verdict(1, "SAFE", "INDETERMINATE"))) << fault_of({study});
}

// By an earlier program, whose bound was the end of the search without ignition, and not half of it.
TEST_F(SafetyReport, ABoundOfAnEarlierProgramAtTheEndOfTheSearchIsRefused) {
  const path sweep = copy_of("sweep_pressure_defect");
  change(sweep, [](auto& results) {
    auto& found = results["cases"][0];
    found["critical_gap_kind"] = "all-safe";
    found["critical_gap_reads_as"] = found["critical_gap_with_bounds"] = "> 0.3 cm";
    found["critical_gap_lower_cm"] = found["critical_gap_at_least_cm"] = 0.3;
    for (const char* key : {"critical_gap_cm", "critical_gap_upper_cm", "critical_gap_at_most_cm"})
      found[key] = nullptr;
  });
  EXPECT_TRUE(has(fault_of({sweep}), "critical_gap_at_least_cm is 0.3")) << fault_of({sweep});
}

TEST_F(SafetyReport, ASafeOfASweepThatItsCriticalGapContradictsIsRefused) {
  const path sweep = copy_of("sweep_pressure_defect");
  change(sweep, [](auto& results) { set_bound(results["cases"][0], 0.0); });
  EXPECT_TRUE(has(fault_of({sweep}), no_verdict(1, "SAFE", "INDETERMINATE"))) << fault_of({sweep});
}

// A warning that stands in a sentence alone would be lost.
TEST_F(SafetyReport, VerdictsOfAnEarlierProgramAreRefused) {
  const path study = copy_of("critical_gap_155mm");
  change(study, [](auto& results) {
    for (auto& row : results["verdicts"]) row.erase("reason_code");
  });
  EXPECT_TRUE(has(fault_of({study}), "verdicts")) << fault_of({study});
}

TEST_F(SafetyReport, VerdictsThatAreIndeterminateAreCountedAndToldOnPageOneWithTheirCause) {
  const path study = copy_of("critical_gap_155mm");
  const auto page_one = [&] {
    const std::string page = file_of({study}, "report.md");
    return page.substr(0, page.find("## 2."));
  };
  EXPECT_FALSE(has(page_one(), "| 0.02 | INDETERMINATE |"));
  change(study, [](auto& results) {
    auto& row = results["verdicts"][2];
    row["verdict"] = "INDETERMINATE";
    row["reason_code"] = "validity-warning";
    row["cause"] = row["validity_warnings"] = "cracks run away";
    row["limited"] = "limiters acted";
    results["cases"][0]["largest_safe_gap_cm"] = 0.01;
  });
  EXPECT_TRUE(has(page_one(), "| cracks run away; limiters acted |"));
  EXPECT_TRUE(has(page_one(), "| 0.02 | INDETERMINATE |"));
  EXPECT_EQ(nlohmann::json::parse(file_of({study}, "report.json"))["answer"]["cases"][0]["INDETERMINATE"], 2);
}

TEST_F(SafetyReport, ResultsOfAnotherKindThanTheManifestsAreRefused) {
  const path study = copy_of("critical_gap_155mm");
  change(study, [](auto& results) { results["kind"] = "accuracy"; });
  EXPECT_TRUE(has(fault_of({study}), "\"accuracy\"")) << fault_of({study});
}

TEST_F(SafetyReport, OnlyCoupledRunsThatAgreeConfirmACriticalGap) {
  const auto confirmed = [this](const std::function<void(nlohmann::ordered_json&)>& how) {
    const path study = copy_of("critical_gap_155mm");
    change(study, how);
    const auto report = nlohmann::json::parse(file_of({study}, "report.json"));
    std::filesystem::remove_all(study);
    return report["answer"]["cases"][0]["confirmed"].get<bool>();
  };
  EXPECT_TRUE(confirmed([](auto&) {}));
  for (const auto& broken : std::vector<std::function<void(nlohmann::ordered_json&)>>{
           [](auto& results) {
             results["coupled_runs"] = nlohmann::ordered_json::array();
             results["cases"][0]["coupled_runs"] = "not confirmed";
           },
           [](auto& results) { results["coupled_runs"][1]["outcome"] = "failed"; },
           [](auto& results) { results["coupled_runs"].erase(1); }})
    EXPECT_FALSE(confirmed(broken));
}

TEST_F(SafetyReport, DrawnLaunchesCountOnlyAboutTheLaunchOfTheMainStudy) {
  const path study = shipped("critical_gap_155mm"), drawn = copy_of("sensitivity");
  const auto shows_probability = [&] {
    return has(file_of({study, drawn}, "report.json"), "\"limits.probability\"");
  };
  EXPECT_TRUE(shows_probability());
  change(drawn, [](auto& results) {
    for (auto& each : results["evaluations"])
      each["peak_pressure_MPa"] = each["peak_pressure_MPa"].template get<double>() - 190.0;
  });
  EXPECT_FALSE(shows_probability()) << "drawn about 306 MPa, where this launch has 496";
}

// A blank behind the word made a row that reads SAFE, which nothing had checked.
TEST_F(SafetyReport, AWordThatIsNoVerdictIsRefused) {
  const path study = copy_of("critical_gap_155mm");
  for (const char* word : {"SAFE ", "safe", ""}) {
    change(study, [&](auto& results) { results["verdicts"][4]["verdict"] = word; });
    EXPECT_TRUE(has(fault_of({study}), no_verdict(5, word, "UNSAFE"))) << word;
  }
}

/// Sentences are taken from lists, whatever parentheses and words a reason has.
TEST_F(SafetyReport, AcceptancesAndExtrapolationsStandOnPageOneWhateverTheReasonsSay) {
  const path study = copy_of("critical_gap_155mm");
  change(study, [](auto& results) {
    results["extrapolated"] = {"station.width", "peak pressure"};
    results["accepted"] = {
        {{"key", "station.width"}, {"value", "7 mm"}, {"because", "wide) ((; extrapolated: nothing"}},
        {{"key", "gap.exchange_time"}, {"value", "0.5 ms"}, {"because", "a wet gap"}}};
    results["not_accepted"] = nlohmann::json::array();
    results["as_calibrated"] = {{{"gap_cm", 0.02},
                                 {"verdict", "SAFE"},
                                 {"key", "gap.exchange_time"},
                                 {"temperature_max_K", 450.4},
                                 {"temperature_max_as_calibrated_K", 467.2},
                                 {"ignites", "no"}},
                                {{"gap_cm", 0.03},
                                 {"verdict", "INDETERMINATE"},
                                 {"key", "gap.exchange_time"},
                                 {"temperature_max_K", 470.0},
                                 {"temperature_max_as_calibrated_K", 490.0},
                                 {"ignites", "no"}}};
    for (auto& row : results["verdicts"])
      row["reason"] = "accepted: station.width = 7 mm, because wide) ((; extrapolated: nothing";
  });
  const std::string page = file_of({study}, "report.md"), one = page.substr(0, page.find("## 2."));
  EXPECT_TRUE(has(one, "station.width, peak pressure"));
  EXPECT_TRUE(has(one, "station.width = 7 mm, because wide)"));
  EXPECT_TRUE(has(one, "| gap.exchange\\_time | 0.02 | SAFE | 450 | 467 | no |"));
}

TEST_F(SafetyReport, ARowOfWhichNothingSaysHowWrongItIsHasNoUncertainty) {
  const path study = copy_of("critical_gap_155mm");
  change(study, [](auto& results) {
    results["cases"][0]["largest_safe_gap_cm"] = nullptr;
    for (auto& row : results["verdicts"]) {
      if (row["ignition_cause"].is_null()) row["verdict"] = "INDETERMINATE";
      row["unaccepted"] = "gap.pressure = chamber";
      row["reason_code"] = "unaccepted";
    }
  });
  const auto report = nlohmann::json::parse(file_of({study}, "report.json"));
  for (const auto& block : report["sections"][0]["blocks"]) {
    if (block["id"] != "verdicts") continue;
    for (const auto& row : block["rows"]) {
      EXPECT_TRUE(row["uncertainty_K"].is_null());
      EXPECT_TRUE(row["margin_over_uncertainty"].is_null());
    }
  }
}

TEST_F(SafetyReport, NoVariantOfTheAccuracyIsShownWhereTheMainStudyTookTheRecordOfNone) {
  const path accuracy = copy_of("accuracy");
  const auto report = [&] { return file_of({shipped("critical_gap_155mm"), accuracy}, "report.json"); };
  EXPECT_TRUE(has(report(), "\"meshes\""));
  change(accuracy, [](auto& results) {
    for (auto& row : results["settings"]) {
      row["temperature_bound_K"] = 98.7;
      row["variant"] = "another";
    }
  });
  EXPECT_FALSE(has(report(), "\"meshes\"")) << "numbers of another launch";
}

TEST_F(SafetyReport, AFolderWithoutAStudyIsRefused) {
  EXPECT_FALSE(read_safety_evidence({folder()}));
  write(folder() / "manifest.json", "{}");
  EXPECT_FALSE(read_safety_evidence({folder()}));
}

TEST_F(SafetyReport, AnotherModelVersionIsRefused) {
  const path study = copy_of("critical_gap_155mm");
  replace_in(study / "manifest.json", "\"model_version\": 7", "\"model_version\": 6");
  EXPECT_TRUE(has(fault_of({study}), "6")) << fault_of({study});
}

TEST_F(SafetyReport, AStudyThatIsNotFinishedHasNoAnswer) {
  const path study = copy_of("critical_gap_155mm");
  auto manifest = nlohmann::ordered_json::parse(read(study / "manifest.json"));
  manifest["files"] = nlohmann::ordered_json::array();
  write(study / "manifest.json", manifest.dump(2));
  const std::string page = file_of({study}, "report.md");
  EXPECT_EQ(nlohmann::json::parse(file_of({study}, "report.json"))["answer"]["finished"], false);
  EXPECT_FALSE(has(page, "SAFE |"));
  EXPECT_TRUE(has(page, " -o " + study.string().substr(0, study.string().find('_')))) << "where it goes on";
}

}  // namespace
}  // namespace launchsafe::report
