// Safety reports of the shipped studies, and of copies of them that a test changes.
#pragma once

#include "launchsafe/report/safety_report.hpp"
#include "launchsafe/store/file.hpp"
#include "store/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <functional>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace launchsafe::report {

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
  /// Likewise, of its results as a value.
  static void change(const path& study, const std::function<void(nlohmann::ordered_json&)>& how) {
    const std::string before = store::sha256(read(study / "study.json"));
    auto results = nlohmann::ordered_json::parse(read(study / "study.json"));
    how(results);
    write(study / "study.json", results.dump(1));
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
    const auto report = make_safety_report(*evidence, criterion, built_in_templates());
    EXPECT_TRUE(report);
    for (const TextFile& file : report->files)
      if (file.name == name) return file.text;
    ADD_FAILURE() << name;
    return {};
  }
};

inline bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace launchsafe::report
