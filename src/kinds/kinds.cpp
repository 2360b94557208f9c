#include "launchsafe/kinds/accuracy.hpp"
#include "launchsafe/kinds/calibration.hpp"
#include "launchsafe/kinds/comparison.hpp"
#include "launchsafe/kinds/critical_gap.hpp"
#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/kinds/sensitivity.hpp"
#include "launchsafe/kinds/stability.hpp"

#include <algorithm>
#include <cassert>
#include <memory>
#include <tuple>

/// Of every kind, so that none can be missing.
struct launchsafe::study::KindSettings {
  std::tuple<kinds::CriticalGapSettings, kinds::CalibrationSettings, kinds::SensitivitySettings,
             kinds::AccuracySettings, kinds::StabilitySettings, kinds::ComparisonSettings>
      of_kinds;
};

namespace launchsafe::kinds {

template <class Settings>
const Settings& settings_of(const study::Study& study) {
  static const study::KindSettings defaults;
  return std::get<Settings>((study.settings ? *study.settings : defaults).of_kinds);
}

template <class Settings>
Settings& settings_of(study::Study& study) {
  if (!study.settings) study.settings = std::make_shared<study::KindSettings>();
  if (study.settings.use_count() > 1) study.settings = std::make_shared<study::KindSettings>(*study.settings);
  return std::get<Settings>(study.settings->of_kinds);
}

template const CriticalGapSettings& settings_of(const study::Study&);
template CriticalGapSettings& settings_of(study::Study&);
template const CalibrationSettings& settings_of(const study::Study&);
template CalibrationSettings& settings_of(study::Study&);
template const SensitivitySettings& settings_of(const study::Study&);
template SensitivitySettings& settings_of(study::Study&);
template const AccuracySettings& settings_of(const study::Study&);
template AccuracySettings& settings_of(study::Study&);
template const StabilitySettings& settings_of(const study::Study&);
template StabilitySettings& settings_of(study::Study&);
template const ComparisonSettings& settings_of(const study::Study&);
template ComparisonSettings& settings_of(study::Study&);

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
