// Studies whose folders are looked into and compared.
#pragma once

#include "launchsafe/store/case_file.hpp"
#include "launchsafe/store/case_store.hpp"
#include "program.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <string>

namespace launchsafe::app {

/// 12 mechanical runs for 24 cases: the last key is thermal.
inline const std::string sweep_study = R"(kind = "critical-gap"
scene = "shell.toml"
early_time = "0.03 ms"
gaps = "0, 0.01, 0.02 cm"
largest_gap = "1 cm"
set = { kinetics.ignition_temperature = "600 K" }
uncertainty.peak_pressure = "0 %"
numerics = { value = "2 K", because = "two meshes of it" }

[[vary]]
key = "peak_pressure"
values = "250, 260, 270, 280 MPa"

[[vary]]
key = "crack_radius"
values = "20, 30, 40 um"

[[vary]]
key = "gap.exchange_time"
values = "20, 40 us"
)";

/// 8 evaluations, each a mechanical run.
inline const std::string sensitivity_study = R"(kind = "sensitivity"
scene = "shell.toml"
early_time = "0.03 ms"
gaps = "0.01 cm"
samples = 8

[[vary]]
key = "peak_pressure"
distribution = "uniform"
range = "250 to 280 MPa"

[[vary]]
key = "crack_radius"
distribution = "uniform"
range = "20 to 40 um"
)";

/// One mechanical run, and two coupled runs that confirm the critical gap.
inline const std::string critical_gap_study = R"(kind = "critical-gap"
scene = "shell.toml"
early_time = "0.03 ms"
gaps = "0, 0.01 cm"
uncertainty.peak_pressure = "0 %"
numerics = { value = "2 K", because = "two meshes of it" }

[set]
kinetics.ignition_temperature = "350 K"
gap.exchange_time = "20 us"
)";

/// Some mechanical runs until the peak pressure is found; the published temperatures are made up.
inline const std::string calibration_study = R"(kind = "calibration"
scene = "shell.toml"
early_time = "0.03 ms"
fit = "load.peak, friction.localisation"
reference = [
  { scene = "shell.toml", gap = "0 cm", maximum_temperature = "307 K" },
  { scene = "shell.toml", gap = "0.01 cm", maximum_temperature = "308.65 K" },
  { scene = "shell.toml", gap = "0.02 cm", maximum_temperature = "800 K", ignition_time = "1.45 ms" },
]
)";

/// Three reference meshes, each a mechanical run.
inline const std::string accuracy_study = R"(kind = "accuracy"
scene = "shell.toml"
early_time = "0.03 ms"
gaps = "0, 0.01 cm"
reference_cell_sizes = "1.25, 2.5, 5 mm"

[[settings]]
numerics.cell_size = "5 mm"
)";

/// One launch and its safe computation.
inline const std::string stability_study = R"(kind = "stability"
scene = "shell.toml"

[[group]]
name = "load"
cases = [ { name = "as it is", set = { load.peak = "50 MPa" }, against = { numerics.time_step_factor = 0.25 } } ]
)";

/// A small study of every kind, by the name of the kind.
inline const std::map<std::string, std::string> study_of_kind{
    {"critical-gap", critical_gap_study}, {"calibration", calibration_study},
    {"sensitivity", sensitivity_study},   {"accuracy", accuracy_study},
    {"stability", stability_study},
};

/// Tests of studies that leave a store.
class StoredStudy : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("shell.toml", far_scene());
    write("study.toml", sweep_study);
  }

  /// The result files of a folder: all that must not depend on how the study came about.
  std::map<std::string, std::string> results_in(const std::string& name) const {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder() / name)) {
      const std::string file = std::filesystem::relative(entry.path(), folder() / name).string();
      const bool own = file == "manifest.json" || file.ends_with(".db") || file == "study.lock" ||
                       file.ends_with("-journal");
      if (entry.is_regular_file() && !own) files[file] = read(name + "/" + file);
    }
    return files;
  }

  /// Compares name by name, so that a failure does not print whole files.
  void expect_same_results(const std::string& one, const std::string& other) const {
    const auto expected = results_in(one), found = results_in(other);
    EXPECT_GT(expected.size(), 4u);
    std::set<std::string> names;
    for (const auto& [name, bytes] : expected) names.insert(name);
    for (const auto& [name, bytes] : found) names.insert(name);
    for (const std::string& name : names) {
      const bool in_both = expected.contains(name) && found.contains(name);
      EXPECT_TRUE(in_both && expected.at(name) == found.at(name)) << name;
    }
  }

  /// The hashes of the cases that are done; of a folder where no study is running.
  std::set<std::string> done_cases(const std::string& name) const {
    std::set<std::string> done;
    if (!exists(name + "/study.db")) return done;
    for (const store::RunRecord& record : store::CaseStore::open_to_read(folder() / name)->records())
      if (record.state == store::CaseState::done) done.insert(record.hash);
    return done;
  }

  /// The files of cases, which are whole, and when each was written.
  std::map<std::string, std::filesystem::file_time_type> case_files(const std::string& name) const {
    std::map<std::string, std::filesystem::file_time_type> files;
    std::error_code gone;
    for (const auto& entry : std::filesystem::directory_iterator(folder() / name / "cases", gone))
      if (entry.path().extension() == ".h5") files[entry.path().stem()] = entry.last_write_time(gone);
    return files;
  }

  /// The files of whole cases; whatever is there under such a name has to be one.
  std::vector<std::filesystem::path> whole_cases(const std::string& name) const {
    std::vector<std::filesystem::path> cases;
    if (!exists(name + "/cases")) return cases;
    for (const auto& entry : std::filesystem::directory_iterator(folder() / name / "cases")) {
      if (entry.path().extension() != ".h5") continue;
      EXPECT_NO_THROW(store::read_case_file(entry.path())) << entry.path();
      cases.push_back(entry.path());
    }
    std::sort(cases.begin(), cases.end());
    return cases;
  }

  /// Waits until a case is done, so that what follows meets a study that is running.
  void wait_for_a_case(const std::string& name) const {
    wait_until([&] { return !case_files(name).empty(); });
  }
};

}  // namespace launchsafe::app
