#include "safety_agreement.hpp"

#include "launchsafe/study/changed_scene.hpp"
#include "launchsafe/study/study_axes.hpp"
#include "safety_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace launchsafe::report {
namespace {

using safety::number_of;
using safety::Row;
using safety::text_of;

/// A critical gap with the values by which its launch differs from the study's scene.
struct JudgedLaunch {
  std::string name;
  std::map<std::string, double> values;  ///< SI, by scene key
  const Row* critical = nullptr;
};

/// The launches of one study.
struct JudgingStudy {
  const StudyEvidence* study = nullptr;
  std::vector<JudgedLaunch> launches;
};

/// Whether the bound of a row is one of the launch, and not the end of a search or of no critical gap at all.
bool is_comparable(const Row& critical) {
  const std::string kind = text_of(critical, "critical_gap_kind");
  return kind == "value" || kind == "all-ignite";
}

void add_launch(const StudyEvidence& study, const Row& row, std::map<std::string, double> values,
                JudgingStudy& judging) {
  if (is_comparable(row))
    judging.launches.push_back({safety::name_of_case(study, row), std::move(values), &row});
}

/// The verdicts of a case, which follow each other, say its load and defect.
void add_cases_of_verdicts(const StudyEvidence& study, JudgingStudy& judging) {
  const Row &cases = study.rows("cases"), &verdicts = study.rows("verdicts");
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto scene = scene_of(study, verdicts[i * verdicts.size() / cases.size()]);
    if (!scene) continue;
    const auto& strength = scene->charge().strength;
    add_launch(study, cases[i],
               {{"load.peak", scene->load.peak},
                {"charge.crack_radius", strength.initial_crack_radius},
                {"charge.flaw_size", strength.flaw_size}},
               judging);
  }
}

/// The coordinates of a case say them; `variant`: of these cases alone, where it is not empty.
void add_cases_of_axes(const StudyEvidence& study, JudgingStudy& judging) {
  for (const Row& row : study.rows("cases")) {
    std::map<std::string, double> values;
    for (const Row& axis : study.rows("axes")) {
      const auto key = scene::describe_key(study.scene, text_of(axis, "scene_key"), {});
      if (!key || text_of(axis, "key") == "gap_cm") continue;
      const std::string unit = text_of(axis, "unit");
      const double shown = number_of(row, text_of(axis, "key"));
      values[key->name] = unit.empty() ? shown : shown / scene::in_unit(1.0, key->dimension, unit);
    }
    add_launch(study, row, std::move(values), judging);
  }
}

JudgingStudy judging_of(const StudyEvidence& study) {
  JudgingStudy judging{&study, {}};
  const Row& cases = study.rows("cases");
  if (cases.empty()) return judging;
  if (study.kind == "critical-gap") add_cases_of_verdicts(study, judging);
  if (study.kind == "sweep") add_cases_of_axes(study, judging);
  return judging;
}

/// Keys that are nothing to a launch or its computation.
bool is_free(const std::string& key) {
  return key == "title" || key == "accept" || key == "gap.thickness" || key.starts_with("output.");
}

double value_of(const JudgedLaunch& launch, const StudyEvidence& study, const std::string& key) {
  const auto found = launch.values.find(key);
  return found != launch.values.end() ? found->second : study::number_in(study.scene, key);
}

/// Whether two launches are the same, of scenes that differ in these keys.
bool is_same(const JudgedLaunch& a, const StudyEvidence& of_a, const JudgedLaunch& b,
             const StudyEvidence& of_b, const std::set<std::string>& differing) {
  const auto varied = [&](const std::string& key) {
    return a.values.contains(key) || b.values.contains(key);
  };
  const auto agree = [&](const std::string& key) {
    return study::same_number(value_of(a, of_a, key), value_of(b, of_b, key));
  };
  return std::ranges::all_of(differing, [&](const auto& key) { return is_free(key) || varied(key); }) &&
         std::ranges::all_of(a.values, [&](const auto& each) { return agree(each.first); }) &&
         std::ranges::all_of(b.values, [&](const auto& each) { return agree(each.first); });
}

/// cm; 0 for what ignites without a gap.
double bracket_of(const Row& critical) {
  const double width =
      number_of(critical, "critical_gap_upper_cm") - number_of(critical, "critical_gap_lower_cm");
  return std::isfinite(width) ? width : 0.0;
}

bool have_one_bound(const Row& a, const Row& b) {
  constexpr double round_off = 1e-6;  // cm
  const double first = number_of(a, "critical_gap_at_least_cm"),
               second = number_of(b, "critical_gap_at_least_cm");
  if (std::isnan(first) || std::isnan(second)) return std::isnan(first) && std::isnan(second);
  return std::abs(first - second) <= round_off + bracket_of(a) + bracket_of(b);
}

std::string said_of(const StudyEvidence& study, const JudgedLaunch& launch) {
  const double bound = number_of(*launch.critical, "critical_gap_at_least_cm");
  return fmt::format("{} (case {}) {}", study.folder.string(), launch.name,
                     std::isfinite(bound) ? significant(bound, 6) + " cm" : "a bound that is not known");
}

/// The first launch of which two studies say different things.
store::MaybeError compare(const JudgingStudy& one, const JudgingStudy& other) {
  std::set<std::string> differing(one.study->differences.begin(), one.study->differences.end());
  differing.insert(other.study->differences.begin(), other.study->differences.end());
  for (const JudgedLaunch& a : one.launches)
    for (const JudgedLaunch& b : other.launches) {
      if (!is_same(a, *one.study, b, *other.study, differing) || have_one_bound(*a.critical, *b.critical))
        continue;
      return store::Error{
          store::Error::Kind::corrupt,
          fmt::format(
              "two studies give one launch different lower bounds of its critical gap: {}, {}; allowed: "
              "studies of a launch with one uncertainty, which name the same calibration, accuracy and "
              "model_form and state the same",
              said_of(*one.study, a), said_of(*other.study, b))};
    }
  return {};
}

}  // namespace

store::MaybeError check_agreement(const SafetyEvidence& evidence) {
  std::vector<JudgingStudy> judging;
  for (const StudyEvidence& study : evidence.studies)
    if (study.finished()) judging.push_back(judging_of(study));
  for (std::size_t i = 0; i < judging.size(); ++i)
    for (std::size_t j = i + 1; j < judging.size(); ++j)
      if (auto error = compare(judging[i], judging[j])) return error;
  return {};
}

}  // namespace launchsafe::report
