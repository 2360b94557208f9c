// The safety report of the shipped studies, and of copies of them that somebody changed.
#include "safety_report_files.hpp"

#include <fmt/format.h>

namespace launchsafe::report {
namespace {

TEST_F(SafetyReport, GreenIsNoSafeThatSomebodyAccepts) {
  const path study = copy_of("critical_gap_155mm");
  const auto shown = [&](const char* look) {
    return has(file_of({study}, "report.html"),
               fmt::format("class=\"{}\" data-heading=\"verdict\">SAFE", look));
  };
  EXPECT_TRUE(shown("SAFE"));
  EXPECT_FALSE(shown("ACCEPTED"));
  change(study, [](auto& results) { results["cases"][0]["accepted"] = "calibre, because ..."; });
  EXPECT_TRUE(shown("ACCEPTED"));
  EXPECT_FALSE(shown("SAFE"));
}

TEST_F(SafetyReport, TheJsonNamesTheOriginOfEveryBlock) {
  const auto json =
      nlohmann::json::parse(file_of({shipped("critical_gap_155mm"), shipped("accuracy")}, "report.json"));
  EXPECT_EQ(json["format"], "launchsafe safety report 4");
  EXPECT_EQ(json["answer"]["largest_safe_gap_cm"], 0.01);
  int tables = 0;
  for (const auto& section : json["sections"])
    for (const auto& block : section["blocks"]) {
      if (block["kind"] != "table" || block["id"] == "studies") continue;
      ++tables;
      EXPECT_FALSE(block["origin"]["study"].get<std::string>().empty()) << block["id"];
      EXPECT_FALSE(block["origin"]["of"].get<std::string>().empty()) << block["id"];
    }
  EXPECT_GE(tables, 8);
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
  replace_in(study / "study.json", "below the lower bound of the critical gap,",
             "below <b onclick=x>| a </td>");
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

TEST_F(SafetyReport, VerdictsThatAreIndeterminateAreCountedAndToldOnPageOneWithTheirCause) {
  const path study = copy_of("critical_gap_155mm");
  const auto page_one = [&] {
    const std::string page = file_of({study}, "report.md");
    return page.substr(0, page.find("## 2."));
  };
  EXPECT_FALSE(has(page_one(), "| 0.01 | INDETERMINATE |"));
  const auto count = [&] {
    const auto report = nlohmann::json::parse(file_of({study}, "report.json"));
    return report["answer"]["cases"][0]["INDETERMINATE"].get<int>();
  };
  const int before = count();
  change(study, [](auto& results) {
    auto& row = results["verdicts"][1];
    row["verdict"] = "INDETERMINATE";
    row["reason_code"] = "warning";
    row["reason"] = "cells: a station is one cell wide";
  });
  EXPECT_TRUE(has(page_one(), "| cells: a station is one cell wide |"));
  EXPECT_TRUE(has(page_one(), "| 0.01 | INDETERMINATE |"));
  EXPECT_EQ(count(), before + 1);
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

TEST_F(SafetyReport, BasisWarningsAcceptancesAndNotesStandOnPageOne) {
  const path study = copy_of("critical_gap_155mm");
  change(study, [](auto& results) {
    auto& row = results["cases"][0];
    row["basis"] = "extrapolated";
    row["extrapolated"] = "calibre, steel";
    row["warnings"] = "shell-yields";
    row["accepted"] = "steel, because wide) ((; extrapolated: nothing";
    results["notes"] = {"load.expected_velocity"};
    results["verdicts"][3]["ignition_after_launch_ms"] = 34.5;
  });
  const std::string page = file_of({study}, "report.md"), one = page.substr(0, page.find("## 2."));
  for (const char* fact : {"calibre, steel", "shell-yields", "steel, because wide) ((; extrapolated: nothing",
                           "load.expected\\_velocity", "34.5 ms"})
    EXPECT_TRUE(has(one, fact)) << fact;
}

TEST_F(SafetyReport, TheLargestCauseDecides) {
  const path study = copy_of("critical_gap_155mm");
  change(study, [](auto& results) {
    const std::string name = results["cases"][0]["case"];
    results["causes"] = {
        {{"case", name}, {"cause", "numerics"}, {"shorter_cm", 0.0012}, {"remedy", "finer cells"}},
        {{"case", name}, {"cause", "constants"}, {"shorter_cm", 0.0041}, {"remedy", "more temperatures"}}};
  });
  const std::string page = file_of({study}, "report.md"), one = page.substr(0, page.find("## 2."));
  EXPECT_TRUE(has(one, "more temperatures"));
  EXPECT_FALSE(has(one, "finer cells"));
}

TEST_F(SafetyReport, AStudyWithAFileThatIsMissingOrNoJsonIsRefused) {
  const path study = copy_of("critical_gap_155mm");
  write(study / "study.json", "no JSON");
  EXPECT_TRUE(has(fault_of({study}), "study.json")) << fault_of({study});
  std::filesystem::remove(study / "study.json");
  EXPECT_TRUE(has(fault_of({study}), "study.json")) << fault_of({study});
}

TEST_F(SafetyReport, StudiesOfDifferentShellsAreRefusedByName) {
  const path study = copy_of("accuracy");
  ask(study, "charge.density = \"1717 kg/m3\"", "charge.density = \"1600 kg/m3\"");
  const std::string fault = fault_of({shipped("critical_gap_155mm"), study});
  EXPECT_TRUE(has(fault, "charge.density")) << fault;
  EXPECT_TRUE(has(fault, study.string())) << fault;
}

TEST_F(SafetyReport, AFolderWithoutAStudyIsRefused) {
  EXPECT_FALSE(read_safety_evidence({folder()}));
  write(folder() / "manifest.json", "{}");
  EXPECT_FALSE(read_safety_evidence({folder()}));
}

TEST_F(SafetyReport, AnotherModelVersionIsRefused) {
  const path study = copy_of("critical_gap_155mm");
  replace_in(study / "manifest.json", "\"model_version\": 8", "\"model_version\": 6");
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
