// Safety reports of the shipped studies, and of copies of them that a test changes.
#pragma once

#include "launchsafe/report/safety_report.hpp"
#include "store/temporary_folder.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <functional>
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
  /// Makes a study of one case one of as many as there are peak pressures (MPa), which say the same
  /// otherwise.
  static void move_to_pressures(const path& study, const std::vector<double>& pressures) {
    change(study, [&](auto& results) {
      results["axes"] = {{{"name", "peak_pressure"},
                          {"scene_key", "load.peak"},
                          {"key", "peak_pressure_MPa"},
                          {"unit", "MPa"},
                          {"values", pressures}}};
      for (const char* table : {"verdicts", "cases", "runs", "causes"}) {
        const auto rows = std::exchange(results[table], nlohmann::ordered_json::array());
        for (const double pressure : pressures)
          for (auto row : rows) {
            if (row.contains("case")) row["case"] = fmt::format("{} MPa, 30 µm, 1 mm", pressure);
            if (row.contains("critical_gap_kind") || row.contains("verdict"))
              row["peak_pressure_MPa"] = pressure;
            results[table].push_back(row);
          }
      }
    });
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

inline bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace launchsafe::report
