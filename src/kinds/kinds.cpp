#include "launchsafe/kinds/kind.hpp"

#include <algorithm>
#include <cassert>

namespace launchsafe::kinds {

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all{
      critical_gap_kind(), calibration_kind(), sensitivity_kind(),
      accuracy_kind(),     stability_kind(),   comparison_kind(),
  };
  return all;
}

const Kind& kind_named(std::string_view name) {
  const auto found =
      std::ranges::find_if(kinds(), [name](const Kind& kind) { return kind.traits.name == name; });
  assert(found != kinds().end());
  return *found;
}

const Kind& kind_of(const study::Study& study) { return kind_named(study.kind.name); }

StudyOutcome run_study(const study::StudyFile& study, const study::StudyOptions& options) {
  return kind_of(study.study).run(study, options);
}

bool FileName::fits(std::string_view name) const {
  if (end.empty()) return name == begin;
  return name.size() >= begin.size() + end.size() && name.starts_with(begin) && name.ends_with(end);
}

bool may_write(const Kind& kind, std::string_view name) {
  return name == "report.md" || name == "study.json" ||
         std::ranges::any_of(kind.files, [name](const FileName& file) { return file.fits(name); }) ||
         std::ranges::any_of(kind.results(), [name](const ResultTable& table) { return table.csv == name; });
}

}  // namespace launchsafe::kinds
