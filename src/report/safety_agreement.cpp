// One launch has one uncertainty, whichever study judges it.
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/safety_evidence.hpp"
#include "launchsafe/study/changed_scene.hpp"

#include <fmt/format.h>

#include <cmath>

namespace launchsafe::report {
namespace {

/// Keys that are nothing to a launch or its computation.
bool is_no_part_of_launch(const std::string& key) {
  return key == "title" || key == "accept" || key == "gap.thickness" || key.starts_with("output.");
}

/// Whether the bound of a row is one of the launch, and not the end of a search or of no critical gap at all.
bool is_comparable(const Row& critical) {
  const std::string kind = text_of(critical, "critical_gap_kind");
  return kind == "value" || kind == "all-ignite";
}

/// A case and the study that judges it.
struct JudgedLaunch {
  const StudyEvidence& study;
  const CaseEvidence& judged;

  double value(const std::string& key) const {
    const auto found = judged.values.find(key);
    return found != judged.values.end() ? found->second : own_value(study, key);
  }
  double bound() const { return number_of(*judged.critical, "critical_gap_at_least_cm"); }
  /// cm; 0 for what ignites without a gap.
  double bracket() const {
    const double width = number_of(*judged.critical, "critical_gap_upper_cm") -
                         number_of(*judged.critical, "critical_gap_lower_cm");
    return std::isfinite(width) ? width : 0.0;
  }
  std::string text() const {
    return fmt::format(
        "{} (case {}) {}", study.folder.string(), judged.label,
        std::isfinite(bound()) ? significant(bound(), 6) + " cm" : "a bound that is not known");
  }
};

bool is_same_launch(const JudgedLaunch& a, const JudgedLaunch& b) {
  const auto is_varied = [&](const std::string& key) {
    return a.judged.values.contains(key) || b.judged.values.contains(key);
  };
  for (const StudyEvidence* study : {&a.study, &b.study})
    for (const study::Difference& each : study->differences)
      if (!is_no_part_of_launch(each.key.name) && !is_varied(each.key.name)) return false;
  for (const CaseEvidence* judged : {&a.judged, &b.judged})
    for (const auto& [key, value] : judged->values)
      if (!study::same_number(a.value(key), b.value(key))) return false;
  return true;
}

bool have_one_bound(const JudgedLaunch& a, const JudgedLaunch& b) {
  constexpr double round_off = 1e-6;  // cm
  if (std::isnan(a.bound()) || std::isnan(b.bound())) return std::isnan(a.bound()) && std::isnan(b.bound());
  return std::abs(a.bound() - b.bound()) <= round_off + a.bracket() + b.bracket();
}

}  // namespace

store::MaybeError check_agreement(const SafetyEvidence& evidence) {
  std::vector<std::pair<const StudyEvidence*, std::vector<CaseEvidence>>> earlier;
  for (const StudyEvidence& study : evidence.studies) {
    if (study.tells != Tells::launch && study.tells != Tells::sweep) continue;
    std::vector<CaseEvidence> cases = cases_of(study);
    std::erase_if(cases, [](const CaseEvidence& each) { return !is_comparable(*each.critical); });
    for (const auto& [other, others] : earlier)
      for (const CaseEvidence& first : others)
        for (const CaseEvidence& second : cases) {
          const JudgedLaunch a{*other, first}, b{study, second};
          if (have_one_bound(a, b) || !is_same_launch(a, b)) continue;
          return store::Error{
              store::Error::Kind::corrupt,
              fmt::format(
                  "two studies give one launch different lower bounds of its critical gap: {}, {}; allowed: "
                  "studies of a launch with one uncertainty, which name the same calibration, accuracy and "
                  "model_form and state the same",
                  a.text(), b.text())};
        }
    earlier.emplace_back(&study, std::move(cases));
  }
  return {};
}

}  // namespace launchsafe::report
