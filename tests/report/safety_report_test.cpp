// The safety report of the shipped studies, and of copies of them that somebody changed.
#include "safety_report_files.hpp"

#include <fmt/format.h>

namespace launchsafe::report {
namespace {

TEST_F(SafetyReport, ACriterionIsNamedWithItsSourceAndWhatItAllows) {
  const auto criterion = parse_criterion("margin >= 3 uncertainty", "works standard 12", 526.784);
  ASSERT_TRUE(criterion);
  const std::string page = file_of({shipped("critical_gap_155mm")}, "report.md", *criterion);
  EXPECT_TRUE(has(page, "Recommended largest gap, at 300 K before launch: 0.01 cm"));
  EXPECT_TRUE(has(page, "works standard 12"));
}

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
  EXPECT_FALSE(has(file_of({study}, "report.md"), "A demonstration"));
  change(study, [](auto& results) { results["demonstration"] = true; });
  EXPECT_FALSE(shown("SAFE"));
  EXPECT_TRUE(has(file_of({study}, "report.md"), "A demonstration"));
}

TEST_F(SafetyReport, TheHeadAndTheLinesForSignaturesAreTheUsers) {
  const auto evidence = read_safety_evidence({shipped("critical_gap_155mm")});
  ASSERT_TRUE(evidence);
  const auto report = make_safety_report(*evidence, {}, built_in_templates(),
                                         {"SR-12 <2>", "A. Author", "2026-11-26", {"B. Boss", "C. Chief"}});
  ASSERT_TRUE(report);
  for (const char* part : {"Document: SR-12 &lt;2&gt;.", "Author: A. Author.", "Date: 2026-11-26.",
                           "<td>B. Boss</td>", "<td>C. Chief</td>"})
    EXPECT_TRUE(has(report->files[0].text, part)) << part;
  EXPECT_TRUE(has(report->files[1].text, "| C. Chief | | |"));
  const std::string page = file_of({shipped("critical_gap_155mm")}, "report.html");
  EXPECT_FALSE(has(page, "id=\"approvals\""));
  EXPECT_TRUE(has(page, "Author: not stated."));
}

// What a board asks of its first page.
TEST_F(SafetyReport, PageOneTellsLoadConfidenceCoverageCalibrationProgramAndWhatIsNext) {
  const std::string page = file_of({shipped("critical_gap_155mm"), shipped("sweep_pressure_defect"),
                                    shipped("closing_gap_155mm")},
                                   "report.md"),
                    one = page.substr(0, page.find("## 2."));
  for (const char* part :
       {"A by launchsafe 0.1.0, commit ",
        "496 MPa peak pressure. Ignition at 526.8 K at the charge's bottom is an input, not a result.",
        "with random causes at two standard deviations, which is no rate per round, and all others at their "
        "worst",
        "air that stays hot (reservoir, A) and by a charge that lets go of the shell and strikes its base "
        "(closing, C)",
        "Refuse every gap, even none (0 cm)",
        // At 0.0625 cm, of its closing_shares: 408.0 K, and 2.3, -0.3 and 6.8 K.
        "it ignites. Without the last of these T max is at most 417 K, where known",
        "Section 3 has the critical gap by the reservoir, which permits nothing either, over peak pressure "
        "250 to 700 MPa and crack radius 30 to 2000 µm.",
        "to no firing (published rows not fitted, before ignition, are missed by at most",
        "Not among the evidence: a study of accuracy;",
        "the largest part, 0.0052 cm, is that of: initial temperature. Next: a measurement of how the charge "
        "is "
        "held and let go, without which no gap here can become SAFE; a narrower range of temperatures",
        "At 0.039 cm the published launch does not ignite (523 K at its end); here it does, at 18.3 ms.",
        "INDETERMINATE | 416 | 110 | 22 | ignites | not SAFE where the gap closes: C |",
        "UNSAFE | ignites |  |  | not run | ignition |"})
    EXPECT_TRUE(has(one, part)) << part << one;
  EXPECT_TRUE(has(page, "| 0.0052 |")) << "the same digits in section 7";
  EXPECT_TRUE(has(page, "with the interfaces of C (nose: sliding, wall: sliding, base: sliding)"));
}

TEST_F(SafetyReport, TheJsonNamesTheOriginOfEveryBlock) {
  const auto json =
      nlohmann::json::parse(file_of({shipped("critical_gap_155mm"), shipped("accuracy")}, "report.json"));
  EXPECT_EQ(json["format"], "launchsafe safety report 3");
  EXPECT_EQ(json["answer"]["largest_safe_gap_cm"], 0.02);
  EXPECT_TRUE(json["answer"]["recommended_gap_cm"].is_null());
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
  EXPECT_TRUE(has(fault_of({study}), "study.json: this is not what was written")) << fault_of({study});
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
  change(warned, [](auto& results) { results["verdicts"][0]["unaccepted"] = "gap.air = film"; });
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
  EXPECT_TRUE(has(fault_of({sweep}), "critical_gap_at_least_cm is 0.3, and what it follows from makes it 0"))
      << fault_of({sweep});
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
  EXPECT_TRUE(has(fault_of({study}), "an earlier program wrote these verdicts")) << fault_of({study});
}

TEST_F(SafetyReport, WarningsAreToldWhateverTheReasonSays) {
  const path study = copy_of("critical_gap_155mm");
  EXPECT_FALSE(has(file_of({study}, "report.md"), "Verdicts with validity warnings"));
  change(study, [](auto& results) { results["verdicts"].back()["validity_warnings"] = "cracks run away"; });
  EXPECT_TRUE(has(file_of({study}, "report.md"), "Verdicts with validity warnings"));
}

TEST_F(SafetyReport, VerdictsThatAreIndeterminateAreCountedOnPageOneAndToldWithTheirCause) {
  const path study = copy_of("critical_gap_155mm");
  const auto page_one = [&] {
    const std::string page = file_of({study}, "report.md");
    return page.substr(0, page.find("## 2."));
  };
  EXPECT_TRUE(
      has(page_one(), "Of 6 verdicts 3 are SAFE (at 300 K before launch), 2 UNSAFE and 1 INDETERMINATE."));
  change(study, [](auto& results) {
    auto& row = results["verdicts"][2];
    row["verdict"] = "INDETERMINATE";
    row["reason_code"] = "validity-warning";
    row["cause"] = row["validity_warnings"] = "cracks run away";
    row["limited"] = "limiters acted";
    results["cases"][0]["largest_safe_gap_cm"] = 0.01;
  });
  EXPECT_TRUE(
      has(page_one(), "Of 6 verdicts 2 are SAFE (at 300 K before launch), 2 UNSAFE and 2 INDETERMINATE."));
  EXPECT_TRUE(has(page_one(), "| cracks run away; limiters acted |"));
  EXPECT_TRUE(has(page_one(), "| 0.02 | INDETERMINATE |"));
  EXPECT_TRUE(has(page_one(), "Not calibrated, and so not in the uncertainty: ignition not excluded"))
      << "of all rows, once";
  change(study, [](auto& results) {
    for (auto& row : results["verdicts"]) {
      row["verdict"] = "INDETERMINATE";
      row["validity_warnings"] = "cracks run away";
    }
    results["cases"][0]["largest_safe_gap_cm"] = nullptr;
  });
  EXPECT_TRUE(has(page_one(), "All 6 verdicts are INDETERMINATE: nothing is shown to be safe."));
}

TEST_F(SafetyReport, ResultsOfAnotherKindThanTheManifestsAreRefused) {
  const path study = copy_of("critical_gap_155mm");
  change(study, [](auto& results) { results["kind"] = "accuracy"; });
  EXPECT_TRUE(has(fault_of({study}), "kind \"accuracy\", its manifest is of \"critical-gap\""))
      << fault_of({study});
}

TEST_F(SafetyReport, OnlyCoupledRunsThatAgreeConfirmACriticalGap) {
  const auto page_with = [this](const std::function<void(nlohmann::ordered_json&)>& how) {
    const path study = copy_of("critical_gap_155mm");
    change(study, how);
    const std::string page = file_of({study}, "report.md");
    std::filesystem::remove_all(study);
    return page;
  };
  EXPECT_TRUE(has(page_with([](auto&) {}),
                  "A complete simulation just below it does not ignite, and one just above does."));
  for (const auto& broken : std::vector<std::function<void(nlohmann::ordered_json&)>>{
           [](auto& results) {
             results["coupled_runs"] = nlohmann::ordered_json::array();
             results["cases"][0]["coupled_runs"] = "not confirmed";
           },
           [](auto& results) { results["coupled_runs"][1]["outcome"] = "failed"; },
           [](auto& results) { results["coupled_runs"].erase(1); }}) {
    const std::string page = page_with(broken);
    EXPECT_FALSE(has(page, "bear it out"));
    EXPECT_TRUE(has(page, "No coupled run has confirmed it."));
    EXPECT_TRUE(has(page, "No coupled run has confirmed the critical gap of 496 MPa"));
  }
}

TEST_F(SafetyReport, AnUncertaintyStatedByHandStandsOnPageOneWithItsSource) {
  const path study = copy_of("critical_gap_155mm");
  EXPECT_TRUE(has(file_of({study}, "report.md"), "the spread of the inputs"));
  change(study, [](auto& results) {
    results["assumed"].erase("input_uncertainty");
    results["stated_by_hand"] = {{{"key", "input_uncertainty"}, {"K", 12.5}, {"because", "30 rounds fired"}}};
  });
  const std::string page = file_of({study}, "report.md"), one = page.substr(0, page.find("## 2."));
  EXPECT_TRUE(has(one, "Stated by hand: input uncertainty 12.5 K, because 30 rounds fired."));
  EXPECT_FALSE(has(one, "the spread of the inputs"));
}

// Issue 35: the upper bound of 95 % counts, and assumed spreads show nothing.
TEST_F(SafetyReport, AProbabilityIsShownByDrawnLaunchesOfStatedSpreadsUpToTheirGap) {
  const path study = copy_of("critical_gap_155mm"), drawn = copy_of("sensitivity");
  const auto recommended = [&](const std::string& text) {
    const auto criterion = parse_criterion(text, "works standard 12", 526.784);
    return nlohmann::json::parse(
        file_of({study, drawn}, "report.json", *criterion))["answer"]["recommended_gap_cm"];
  };
  EXPECT_TRUE(recommended("probability <= 0.05").is_null()) << "the spread of the inputs is assumed";
  change(study, [](auto& results) { results["assumed"].erase("input_uncertainty"); });
  // None of 96 launches ignites at 0.02 cm: 0 to 3.77 %.
  EXPECT_EQ(recommended("probability <= 0.05"), 0.02);
  EXPECT_TRUE(recommended("probability <= 0.01").is_null());
  change(drawn, [](auto& results) {
    for (auto& each : results["evaluations"])
      each["peak_pressure_MPa"] = each["peak_pressure_MPa"].template get<double>() - 190.0;
  });
  EXPECT_TRUE(recommended("probability <= 0.05").is_null())
      << "drawn about 306 MPa, where this launch has 496";
  EXPECT_FALSE(has(file_of({study, drawn}, "report.md"), "launches drawn from the inputs"));
  change(drawn, [](auto& results) {
    for (auto& each : results["evaluations"])
      each["peak_pressure_MPa"] = each["peak_pressure_MPa"].template get<double>() + 190.0;
  });
  EXPECT_EQ(recommended("probability <= 0.05"), 0.02);
  EXPECT_TRUE(has(file_of({study, drawn}, "report.md"), "launches drawn from the inputs"));
  change(drawn, [](auto& results) { results["failed"] = 1; });
  EXPECT_TRUE(recommended("probability <= 0.05").is_null()) << "one that failed may be one that ignites";
}

TEST_F(SafetyReport, AGapThatClosesStandsBesideTheReservoirAndIsTheReportsOwnOtherwise) {
  const path closing = shipped("closing_gap_155mm");
  const std::string page = file_of({shipped("critical_gap_155mm"), closing}, "report.md");
  EXPECT_TRUE(has(
      page.substr(0, page.find("## 2.")),
      "By the second it may ignite at 0 cm (closing, worst corner); this does not say that shells ignite: "
      "how likely that is nobody knows, and no firing is in it."));
  EXPECT_TRUE(has(page, "the base takes heat): no ignition up to 0.075 cm."));
  EXPECT_TRUE(has(page, "by both models of the gap, with the interfaces of B (nose: sliding, "));
  EXPECT_TRUE(
      has(page, "By air that is a reservoir alone, which permits nothing here, the critical gap is 0.038"))
      << "A is the main study, whichever comes first";
  EXPECT_TRUE(has(file_of({closing}, "report.md"), "No computed gap has the verdict SAFE"));
}

// Issue 34: SAFE only where the reservoir is SAFE and the worst corner of a gap that closes does not ignite.
TEST_F(SafetyReport, NoGapIsSafeThatIsNotSafeWhereItCloses) {
  const path reservoir = shipped("critical_gap_155mm"), closing = copy_of("closing_gap_155mm");
  const auto criterion = *parse_criterion("margin >= 1.5 uncertainty", "works standard 12", 526.784);
  const auto answer = [&](const std::vector<path>& studies) {
    return nlohmann::json::parse(file_of(studies, "report.json", criterion))["answer"];
  };
  EXPECT_EQ(answer({reservoir})["recommended_gap_cm"], 0.02);
  const auto none = answer({reservoir, closing});
  EXPECT_TRUE(none["recommended_gap_cm"].is_null());
  EXPECT_TRUE(none["largest_safe_gap_cm"].is_null());
  EXPECT_EQ(none["cases"][0]["SAFE"], 0);
  EXPECT_TRUE(has(file_of({reservoir, closing}, "report.md"), "not SAFE where the gap closes: B"));
  static constexpr int corner_launches = 2 * 8;  // flows of air, instants of release
  change(closing, [](auto& results) {
    bound_by_computation(results, 0.015);
    results["cases"][0]["largest_safe_gap_cm"] = 0.01;
    for (const std::size_t i : {0, 1}) {
      auto& row = results["verdicts"][i];
      row["uncertainty_of_fit_K"] = 5.0;
      row["uncertainty_K"] = row["uncertainty_of_computation_K"].template get<double>() +
                             row["uncertainty_of_inputs_K"].template get<double>() + 5.0 + 50.0;
      row["verdict"] = "SAFE";
    }
    // Of the corner, 410 + 5 K, the reservoir's heat makes no more uncertain than by 5 + 15 + 50 K and some.
    for (auto& row : results["closing"]) {
      if (row["gap_cm"] <= 0.01) row["temperature_max_corner_K"] = 410.0;
      for (const char* bound : {"conducting", "insulated", "corner"})
        row[std::string(bound) + "_numerical_K"] = 5.0;
      row["corner_launches"] = corner_launches;
    }
  });
  EXPECT_EQ(answer({reservoir, closing})["recommended_gap_cm"], 0.01);
  // An earlier program looked at fewer instants of release.
  change(closing, [](auto& results) { results["closing"][1]["corner_launches"] = corner_launches - 1; });
  EXPECT_TRUE(has(fault_of({reservoir, closing}), no_verdict(2, "SAFE", "INDETERMINATE")));
}

// A blank behind the word made a row that reads SAFE, which nothing had checked.
TEST_F(SafetyReport, AWordThatIsNoVerdictIsRefused) {
  const path study = copy_of("critical_gap_155mm");
  for (const char* word : {"SAFE ", "safe", ""}) {
    change(study, [&](auto& results) { results["verdicts"][4]["verdict"] = word; });
    EXPECT_TRUE(has(fault_of({study}), no_verdict(5, word, "UNSAFE"))) << word;
  }
}

// A sweep of closing gaps looks for no worst corner: nothing is SAFE beside it alone.
TEST_F(SafetyReport, NoGapIsSafeBesideASweepOfGapsThatCloseAlone) {
  const path reservoir = shipped("critical_gap_155mm"), sweep = shipped("closing_sweep_155mm");
  const std::string page = file_of({reservoir, sweep}, "report.md");
  EXPECT_TRUE(has(page, "not SAFE where the gap closes: B"));
  EXPECT_TRUE(has(page, "No computed gap has the verdict SAFE"));
  EXPECT_TRUE(has(page, "by a reservoir (A). "));
  EXPECT_FALSE(has(page, "the worst corner where it closes is of"));
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
  EXPECT_TRUE(has(one, "The calibration is extrapolated in: station.width, peak pressure."));
  EXPECT_TRUE(has(one, "rest on 2 values that somebody accepts"));
  EXPECT_TRUE(has(one, "station.width = 7 mm, because wide)"));
  EXPECT_TRUE(has(one, "not computed for an acceptance without a row here"));
  EXPECT_TRUE(has(one, "| gap.exchange\\_time | 0.02 | SAFE | 450 | 467 | no |"));
}

TEST_F(SafetyReport, ARowOfWhichNothingSaysHowWrongItIsHasNoUncertainty) {
  const path study = copy_of("critical_gap_155mm");
  change(study, [](auto& results) {
    results["cases"][0]["largest_safe_gap_cm"] = nullptr;
    for (auto& row : results["verdicts"]) {
      if (row["ignition_cause"].is_null()) row["verdict"] = "INDETERMINATE";
      row["unaccepted"] = "gap.air = film";
      row["reason_code"] = "unaccepted";
      row["reason"] =
          "validity warning: extrapolated: the constants were calibrated on another launch (gap.air = film), "
          "and "
          "nothing says how wrong they are here";
    }
  });
  const std::string page = file_of({study}, "report.md");
  EXPECT_TRUE(has(page, "; its error is not known."));
  EXPECT_FALSE(has(page, "What limits the answer"));
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
  const std::string said = "no variant of the accuracy study is known to be the launch of the main study";
  EXPECT_FALSE(has(file_of({shipped("critical_gap_155mm"), accuracy}, "report.md"), said));
  change(accuracy, [](auto& results) {
    for (auto& row : results["settings"]) {
      row["temperature_bound_K"] = 98.7;
      row["variant"] = "another";
    }
  });
  const auto report =
      nlohmann::json::parse(file_of({shipped("critical_gap_155mm"), accuracy}, "report.json"));
  EXPECT_TRUE(has(report.dump(), said));
  EXPECT_FALSE(has(report.dump(), "\"meshes\"")) << "numbers of another launch";
}

TEST_F(SafetyReport, TheScenesLaunchIsNotCalledCoveredWhereNoCaseIsOfIt) {
  const path study = copy_of("critical_gap_155mm");
  move_to_pressures(study, {400.0});
  const std::string page = file_of({study}, "report.md");
  EXPECT_FALSE(has(page, "Only this launch is covered"));
  EXPECT_TRUE(has(page, "The scene's own launch, 496 MPa, is covered only if a case names it"));
}

TEST_F(SafetyReport, AFolderWithoutAStudyIsRefused) {
  EXPECT_TRUE(has(fault_of({folder()}), "found no study there"));
  write(folder() / "manifest.json", "{}");
  EXPECT_TRUE(has(fault_of({folder()}), "is no manifest of a study"));
}

TEST_F(SafetyReport, AnotherModelVersionIsRefused) {
  const path study = copy_of("critical_gap_155mm");
  replace_in(study / "manifest.json", "\"model_version\": 7", "\"model_version\": 6");
  EXPECT_TRUE(has(fault_of({study}), "of model version 6, this program is of 7")) << fault_of({study});
}
TEST_F(SafetyReport, AStudyThatIsNotFinishedHasNoAnswer) {
  const path study = copy_of("critical_gap_155mm");
  auto manifest = nlohmann::ordered_json::parse(read(study / "manifest.json"));
  manifest["files"] = nlohmann::ordered_json::array();
  write(study / "manifest.json", manifest.dump(2));
  const std::string page = file_of({study}, "report.md");
  EXPECT_TRUE(has(page, "There is no answer yet"));
  EXPECT_FALSE(has(page, "Covered"));
  EXPECT_FALSE(has(page, "SAFE |"));
  EXPECT_FALSE(has(page.substr(0, page.find("## 2.")), "The shot leaves")) << "of which of its launches?";
  EXPECT_TRUE(has(page, " -o " + study.string().substr(0, study.string().find('_')))) << "where it goes on";
  EXPECT_TRUE(has(page, "Bodies"));
}

TEST_F(SafetyReport, TemplatesOfALabReplaceWhatTheyHave) {
  write(folder() / "texts.mustache", "@@ a remark\n@section.answer\nDie Antwort\n@column.verdict\nUrteil\n");
  const auto templates = read_templates(folder(), built_in_templates());
  ASSERT_TRUE(templates);
  const auto evidence = read_safety_evidence({shipped("critical_gap_155mm")});
  ASSERT_TRUE(evidence);
  const auto report = make_safety_report(*evidence, {}, *templates);
  ASSERT_TRUE(report);
  EXPECT_TRUE(has(report->files[0].text, "1. Die Antwort"));
  EXPECT_TRUE(has(report->files[0].text, "Urteil"));
  EXPECT_TRUE(has(report->files[0].text, "td class=\"SAFE\""));
  EXPECT_TRUE(has(report->files[0].text, "the critical gap is 0.038"));
}

TEST_F(SafetyReport, TemplatesThatAreNoneAreRefused) {
  EXPECT_FALSE(read_templates(folder(), built_in_templates()));
  write(folder() / "report.html.mustache", "{{#open}} never closed");
  EXPECT_FALSE(read_templates(folder(), built_in_templates()));
  std::filesystem::remove(folder() / "report.html.mustache");
  write(folder() / "texts.mustache", "no name\n");
  const auto nameless = read_templates(folder(), built_in_templates());
  ASSERT_FALSE(nameless);
  EXPECT_TRUE(has(nameless.error().message, "before the first name")) << nameless.error().message;
}

}  // namespace
}  // namespace launchsafe::report
