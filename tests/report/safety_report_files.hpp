// Safety reports of the shipped studies, and of copies of them that a test changes.
#pragma once

#include "launchsafe/report/safety_report.hpp"
#include "launchsafe/store/file.hpp"
#include "launchsafe/study/run_cases.hpp"
#include "store/temporary_folder.hpp"

#include <fmt/format.h>
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
  /// Changes what a manifest says that was asked, and its checksum.
  static void ask(const path& study, const std::string& from, const std::string& to) {
    auto manifest = nlohmann::ordered_json::parse(read(study / "manifest.json"));
    std::string input = manifest["input"];
    const std::size_t at = input.rfind(from);
    ASSERT_NE(at, std::string::npos) << from;
    manifest["input"] = input.replace(at, from.size(), to);
    manifest["input_sha256"] = store::sha256(input);
    write(study / "manifest.json", manifest.dump(2));
  }
  /// The file of the run of the scene that a manifest has, at another peak pressure (Pa).
  static std::string stored_case(const path& study, std::optional<double> peak = {}) {
    const std::string input = nlohmann::json::parse(read(study / "manifest.json"))["input"],
                      heading = "\n\n# scene\n";
    const std::size_t begin = input.rfind(heading) + heading.size();
    scene::Scene scene =
        scene::parse_scene(input.substr(begin, input.find("\n\n# ", begin) - begin), {}).value().scene;
    if (peak) scene.load.peak = *peak;
    return "cases/" + study::mechanics_run(scene, {}).hash + ".h5";
  }
  /// Gives the row of a critical gap another lower bound (cm), as a study would word it.
  static void set_bound(nlohmann::ordered_json& row, double at_least) {
    row["critical_gap_at_least_cm"] = at_least;
    row["critical_gap_with_bounds"] =
        measured_gap(row["critical_gap_cm"], at_least, row["critical_gap_at_most_cm"])->text("cm");
  }
  /// The same of the only case of a study in detail, by its computation alone.
  static void bound_by_computation(nlohmann::ordered_json& results, double at_least) {
    auto& row = results["cases"][0];
    const double lower = row["critical_gap_lower_cm"];
    for (auto& share : results["gap_shares"]) {
      const bool bounds = share["cause"] == "computation";
      share["lowers_cm"] = bounds ? lower - at_least : 0.0;
      share["raised"] = bounds ? significant(at_least, 4) + " cm" : "no ignition";
    }
    set_bound(row, at_least);
  }
  /// Makes a study of one case one of as many as there are peak pressures (MPa), which say the same
  /// otherwise.
  static void move_to_pressures(const path& study, const std::vector<double>& pressures) {
    ask(study, "\n\n# scene\n",
        fmt::format("\n\n[[vary]]\nkey = 'peak_pressure'\nvalues = '{} MPa'\n\n# scene\n",
                    fmt::join(pressures, ", ")));
    change(study, [&](auto& results) {
      results["axes"] = {{{"name", "peak_pressure"},
                          {"scene_key", "load.peak"},
                          {"key", "peak_pressure_MPa"},
                          {"unit", "MPa"},
                          {"values", pressures}}};
      for (const char* table : {"verdicts", "cases", "runs", "gap_shares", "fit_curves"}) {
        const auto rows = std::exchange(results[table], nlohmann::ordered_json::array());
        for (const double pressure : pressures)
          for (auto row : rows) {
            if (row.contains("case")) row["case"] = fmt::format("{} MPa, 30 µm, 1 mm", pressure);
            if (row.contains("critical_gap_kind") || row.contains("verdict"))
              row["peak_pressure_MPa"] = pressure;
            if (row.contains("stored_case")) row["stored_case"] = stored_case(study, 1e6 * pressure);
            results[table].push_back(row);
          }
      }
    });
  }
  /// That the verdict of a row of the table (from 1) is none to be given, and which one follows.
  static std::string no_verdict(int row, const std::string& verdict, const std::string& least) {
    return fmt::format("row {}: verdict is \"{}\", and what it follows from makes it \"{}\"", row, verdict,
                       least);
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
