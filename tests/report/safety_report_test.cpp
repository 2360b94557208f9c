// The safety report of the shipped studies, and of copies of them that somebody changed.
#include "launchsafe/report/safety_render.hpp"
#include "launchsafe/store/sha256.hpp"
#include "store/temporary_folder.hpp"

#include <gtest/gtest.h>

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
  /// Changes study.json and its checksum: what the report makes of strange words in a study.
  static void restate(const path& study, const std::string& from, const std::string& to) {
    const std::string before = store::sha256(read(study / "study.json"));
    replace_in(study / "study.json", from, to);
    replace_in(study / "manifest.json", before, store::sha256(read(study / "study.json")));
  }
  static std::string fault_of(const std::vector<path>& folders) {
    const auto evidence = read_safety_evidence(folders);
    return evidence ? "" : evidence.error().message;
  }
  static std::string file_of(const std::vector<path>& folders, const std::string& name,
                             const std::optional<GapCriterion>& criterion = {}) {
    const auto evidence = read_safety_evidence(folders);
    EXPECT_TRUE(evidence) << fault_of(folders);
    if (!evidence) return {};
    const auto report = render(make_safety_document(*evidence, criterion), built_in_templates());
    EXPECT_TRUE(report);
    for (const TextFile& file : report->files)
      if (file.name == name) return file.text;
    ADD_FAILURE() << name;
    return {};
  }
};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(SafetyReport, PageOneOfTheMainJobSaysWhatItsStudySays) {
  const std::string page = file_of({shipped("critical_gap_155mm")}, "report.md");
  // 0.0395058 cm, uncertain by 0.0094 cm, in study.json.
  EXPECT_TRUE(has(page, "The critical gap is 0.039 ± 0.010 cm")) << page.substr(0, 1500);
  EXPECT_TRUE(has(page, "no criterion for one was stated"));
  EXPECT_TRUE(has(page, "with all smaller ones, is 0.02 cm"));
  EXPECT_TRUE(has(page, "3 are SAFE, 1 UNSAFE and 2 INDETERMINATE"));
  EXPECT_TRUE(has(page, "32 times what compression can supply"));
  EXPECT_FALSE(has(page, "0.0395058"));
  EXPECT_FALSE(has(page, "{{"));
}

TEST_F(SafetyReport, ACriterionIsNamedWithItsSourceAndWhatItAllows) {
  const auto criterion = parse_criterion("margin >= 3 uncertainty", "works standard 12");
  ASSERT_TRUE(criterion);
  const std::string page = file_of({shipped("critical_gap_155mm")}, "report.md", *criterion);
  EXPECT_TRUE(has(page, "Recommended largest gap: 0.01 cm."));
  EXPECT_TRUE(has(page, "works standard 12"));
}

TEST_F(SafetyReport, TheJsonNamesTheOriginOfEveryBlock) {
  const auto json = nlohmann::json::parse(
      file_of({shipped("critical_gap_155mm"), shipped("accuracy_155mm")}, "report.json"));
  EXPECT_EQ(json["format"], "launchsafe safety report 1");
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
      "<script>alert(1)</script> <img src=x onerror=alert(2)> [a](javascript:b) {{title}} & \\\"q\\\"";
  restate(study, "Critical bottom gap of the 155 mm shell", evil);
  restate(study, "margin 103 K over uncertainty 22 K", "margin 103 K <b onclick=x>| a </td>");
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
  EXPECT_TRUE(has(fault_of({study}), "study.json: this is not what the study wrote")) << fault_of({study});
  const path other = copy_of("accuracy_155mm");
  std::filesystem::remove(other / "accuracy.csv");
  EXPECT_TRUE(has(fault_of({other}), "accuracy.csv")) << fault_of({other});
}

TEST_F(SafetyReport, ASafeThatItsOwnNumbersContradictIsRefused) {
  const path study = copy_of("critical_gap_155mm");
  restate(study, "\"verdict\": \"INDETERMINATE\"", "\"verdict\": \"SAFE\"");
  EXPECT_TRUE(has(fault_of({study}), "0.03 cm is called SAFE")) << fault_of({study});
}

TEST_F(SafetyReport, AFolderWithoutAStudyIsRefused) {
  EXPECT_TRUE(has(fault_of({folder()}), "found no study there"));
  write(folder() / "manifest.json", "{}");
  EXPECT_TRUE(has(fault_of({folder()}), "is no manifest of a study"));
}

TEST_F(SafetyReport, AnotherModelVersionIsRefused) {
  const path study = copy_of("critical_gap_155mm");
  replace_in(study / "manifest.json", "\"model_version\": 6", "\"model_version\": 5");
  EXPECT_TRUE(has(fault_of({study}), "of model version 5, this program is of 6")) << fault_of({study});
}

TEST_F(SafetyReport, TwoStudiesOfAKindAreRefused) {
  EXPECT_TRUE(has(fault_of({shipped("accuracy_155mm"), shipped("accuracy_bonded")}),
                  "both are studies of kind accuracy"));
}

TEST_F(SafetyReport, StudiesOfDifferentShellsAreRefusedByName) {
  const path study = copy_of("accuracy_155mm");
  // The manifest's input with its checksum, as a study of another shell would have written it.
  auto manifest = nlohmann::ordered_json::parse(read(study / "manifest.json"));
  std::string input = manifest["input"];
  const std::string from = "charge.density = \"1717 kg/m3\"";
  input.replace(input.find(from), from.size(), "charge.density = \"1600 kg/m3\"");
  manifest["input"] = input;
  manifest["input_sha256"] = store::sha256(input);
  write(study / "manifest.json", manifest.dump(2));
  const std::string fault = fault_of({shipped("critical_gap_155mm"), study});
  EXPECT_TRUE(has(fault, "different shells")) << fault;
  EXPECT_TRUE(has(fault, "charge.density")) << fault;
  EXPECT_TRUE(has(fault, study.string())) << fault;
}

TEST_F(SafetyReport, AStudyThatIsNotFinishedHasNoAnswer) {
  const path study = copy_of("critical_gap_155mm");
  auto manifest = nlohmann::ordered_json::parse(read(study / "manifest.json"));
  manifest["files"] = nlohmann::ordered_json::array();
  write(study / "manifest.json", manifest.dump(2));
  const std::string page = file_of({study}, "report.md");
  EXPECT_TRUE(has(page, "There is no answer yet"));
  EXPECT_FALSE(has(page, "SAFE |"));
  EXPECT_TRUE(has(page, "Bodies"));
}

TEST_F(SafetyReport, TemplatesOfALabReplaceWhatTheyHave) {
  write(folder() / "texts.mustache", "@@ a remark\n@section.answer\nDie Antwort\n@column.verdict\nUrteil\n");
  const auto templates = read_templates(folder());
  ASSERT_TRUE(templates);
  const auto evidence = read_safety_evidence({shipped("critical_gap_155mm")});
  ASSERT_TRUE(evidence);
  const auto report = render(make_safety_document(*evidence), *templates);
  ASSERT_TRUE(report);
  EXPECT_TRUE(has(report->files[0].text, "1. Die Antwort"));
  EXPECT_TRUE(has(report->files[0].text, "Urteil"));
  EXPECT_TRUE(has(report->files[0].text, "td class=\"SAFE\""));
  EXPECT_TRUE(has(report->files[0].text, "The critical gap is 0.039"));
}

TEST_F(SafetyReport, TemplatesThatAreNoneAreRefused) {
  EXPECT_FALSE(read_templates(folder()));
  write(folder() / "report.html.mustache", "{{#open}} never closed");
  EXPECT_FALSE(read_templates(folder()));
  std::filesystem::remove(folder() / "report.html.mustache");
  write(folder() / "texts.mustache", "no name\n");
  const auto nameless = read_templates(folder());
  ASSERT_FALSE(nameless);
  EXPECT_TRUE(has(nameless.error().message, "before the first name")) << nameless.error().message;
}

}  // namespace
}  // namespace launchsafe::report
