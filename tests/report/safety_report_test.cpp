// The safety report of the shipped studies, and of copies of them that somebody changed.
#include "launchsafe/report/safety_report.hpp"

#include "store/temporary_folder.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <functional>
#include <sstream>

namespace launchsafe::report {
namespace {

using std::filesystem::path;

class SafetyReport : public launchsafe::testing::TemporaryFolder {
 protected:
  static path shipped(const std::string& name) { return path(LAUNCHSAFE_SOURCE_DIR) / "reports" / name; }
  path copy_of(const std::string& name) const {
    const path to = folder() / name;
    std::filesystem::copy(shipped(name), to, std::filesystem::copy_options::recursive);
    return to;
  }
  static std::string read(const path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
  }
  static void write(const path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
  }
  static void replace_in(const path& file, const std::string& from, const std::string& to) {
    std::string text = read(file);
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    write(file, text.replace(at, from.size(), to));
  }
  /// Changes the results of a study.
  static void change(const path& study, const std::function<void(nlohmann::ordered_json&)>& how) {
    auto results = nlohmann::ordered_json::parse(read(study / "study.json"));
    how(results);
    write(study / "study.json", results.dump(1));
  }
  /// Changes what a manifest says that was asked.
  static void ask(const path& study, const std::string& from, const std::string& to) {
    auto manifest = nlohmann::ordered_json::parse(read(study / "manifest.json"));
    std::string input = manifest["input"];
    const std::size_t at = input.rfind(from);
    ASSERT_NE(at, std::string::npos) << from;
    manifest["input"] = input.replace(at, from.size(), to);
    write(study / "manifest.json", manifest.dump(2));
  }
  static std::string page_one_of(const path& study) {
    const std::string page = file_of({study}, "report.html");
    return page.substr(0, page.find("<section id=\"limits\">"));
  }
  static std::string fault_of(const std::vector<path>& folders) {
    const auto evidence = read_safety_evidence(folders);
    return evidence ? "" : evidence.error().message;
  }
  static std::string file_of(const std::vector<path>& folders, const std::string& name) {
    const auto evidence = read_safety_evidence(folders);
    EXPECT_TRUE(evidence) << fault_of(folders);
    if (!evidence) return {};
    for (const TextFile& file : make_safety_report(*evidence).files)
      if (file.name == name) return file.text;
    ADD_FAILURE() << name;
    return {};
  }
};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(SafetyReport, GreenIsNoSafeThatSomebodyAccepts) {
  const path study = copy_of("critical_gap_155mm");
  const auto shown = [&](const char* look) {
    return has(file_of({study}, "report.html"),
               fmt::format("<td class=\"{}\" data-heading=\"verdict\">SAFE", look));
  };
  EXPECT_TRUE(shown("SAFE"));
  EXPECT_FALSE(shown("SAFE, accepted"));
  change(study, [](auto& results) { results["cases"][0]["accepted"] = "calibre, because ..."; });
  EXPECT_TRUE(shown("SAFE, accepted"));
  EXPECT_FALSE(shown("SAFE"));
}

TEST_F(SafetyReport, TheJsonHasTheFactsAndTheRowsOfTheTables) {
  const auto json =
      nlohmann::json::parse(file_of({shipped("critical_gap_155mm"), shipped("accuracy")}, "report.json"));
  EXPECT_EQ(json["format"], "launchsafe safety report 5");
  EXPECT_EQ(json["answer"]["largest_safe_gap_cm"], 0.01);
  EXPECT_EQ(json["others"][0]["label"], "B");
  const auto study = nlohmann::json::parse(read(shipped("critical_gap_155mm") / "study.json"));
  for (const char* key : {"gap_cm", "temperature_max_K", "margin_K", "uncertainty_K", "verdict", "reason"})
    EXPECT_EQ(json["tables"]["verdicts"][1][key], study["verdicts"][1][key]) << key;
  for (const char* table : {"causes", "published", "runs", "bodies", "inputs", "left_out", "studies"})
    EXPECT_FALSE(json["tables"][table].empty()) << table;
}

TEST_F(SafetyReport, EqualEvidenceMakesEqualBytes) {
  for (const char* name : {"report.html", "report.json", "temperature.svg"})
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
  const std::string html = file_of({study}, "report.html");
  EXPECT_FALSE(has(html, "<script"));
  EXPECT_FALSE(has(html, "<img src=x"));
  EXPECT_TRUE(has(html, "&lt;script&gt;alert(1)&lt;/script&gt;"));
  EXPECT_TRUE(has(html, "{{title}}"));  // as words: not filled in
}

TEST_F(SafetyReport, VerdictsThatAreIndeterminateAreCountedWithTheirCause) {
  const path study = copy_of("critical_gap_155mm");
  const auto report = [&] { return nlohmann::json::parse(file_of({study}, "report.json")); };
  const auto before = report();
  EXPECT_EQ(before["tables"]["verdicts"][1]["verdict"], "SAFE");
  change(study, [](auto& results) {
    auto& row = results["verdicts"][1];
    row["verdict"] = "INDETERMINATE";
    row["reason"] = "cells: a station is one cell wide; accepted: steel, because wide";
  });
  const auto after = report();
  EXPECT_EQ(after["tables"]["verdicts"][1]["reason"], "cells: a station is one cell wide");
  EXPECT_EQ(after["answer"]["cases"][0]["INDETERMINATE"],
            before["answer"]["cases"][0]["INDETERMINATE"].get<int>() + 1);
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
  const std::string one = page_one_of(study);
  for (const char* fact : {"calibre, steel", "shell-yields", "steel, because wide) ((; extrapolated: nothing",
                           "load.expected_velocity", ">34.5</td>"})
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
  const std::string one = page_one_of(study);
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
  const std::string page = file_of({study}, "report.html");
  EXPECT_EQ(nlohmann::json::parse(file_of({study}, "report.json"))["answer"]["finished"], false);
  EXPECT_FALSE(has(page, ">SAFE</td>"));
  EXPECT_TRUE(has(page, " -o " + study.string().substr(0, study.string().find('_')))) << "where it goes on";
}

// The second of two cases ignites at every gap.
TEST_F(SafetyReport, AllowsNoGapWhereOneOfSeveralCasesIgnitesAtEvery) {
  const path study = copy_of("critical_gap_155mm");
  change(study, [](auto& results) {
    for (const char* table : {"verdicts", "cases", "runs", "causes"}) {
      const auto rows = results[table];
      for (auto row : rows) {
        if (row.contains("case")) row["case"] = "510 MPa";
        if (row.contains("verdict")) row["verdict"] = "UNSAFE";
        if (row.contains("largest_safe_gap_cm")) row["largest_safe_gap_cm"] = nullptr;
        results[table].push_back(row);
      }
    }
  });
  const auto json = nlohmann::json::parse(file_of({study}, "report.json"));
  EXPECT_EQ(json["answer"]["cases"].size(), 2u);
  EXPECT_EQ(json["answer"]["cases"][0]["largest_safe_gap_cm"], 0.01);
  EXPECT_TRUE(json["answer"]["largest_safe_gap_cm"].is_null());
}

TEST_F(SafetyReport, ASweepByItselfAllowsNoGap) {
  const auto json = nlohmann::json::parse(file_of({shipped("sweep")}, "report.json"));
  EXPECT_TRUE(json["answer"]["largest_safe_gap_cm"].is_null());
  EXPECT_TRUE(json["answer"]["cases"].empty());
}

}  // namespace
}  // namespace launchsafe::report
