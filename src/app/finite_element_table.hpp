// The comparison with finite elements of `launchsafe verify --finite-elements`: text, JSON and files.
#pragma once

#include "launchsafe/report/written_files.hpp"
#include "launchsafe/store/result.hpp"
#include "launchsafe/verify/static_stress_comparison.hpp"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace launchsafe::app {

/// All that was compared, and by what.
struct FiniteElementComparison {
  std::string version;  ///< of CalculiX
  std::vector<verify::StaticComparison> cases;
  std::optional<verify::TubeComparison> tube;
};

/// For a terminal; `command` is the one that makes it.
std::string finite_element_text(const FiniteElementComparison& comparison, const std::string& command);

nlohmann::ordered_json finite_element_json(const FiniteElementComparison& comparison,
                                           const std::string& command);

inline const std::vector<std::string> finite_element_files{"stresses.csv", "summary.md"};
/// Writes these files.
store::Result<report::WrittenFiles> write_finite_element_files(const FiniteElementComparison& comparison,
                                                               const std::string& command,
                                                               const std::filesystem::path& folder);

}  // namespace launchsafe::app
