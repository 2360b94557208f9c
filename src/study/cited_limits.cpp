#include "launchsafe/study/cited_limits.hpp"

#include "launchsafe/study/bracket.hpp"

#include <algorithm>
#include <cmath>

namespace launchsafe::study {
namespace {

using scene::Dimension, scene::Key;
using Standing = scene::Standing;

std::vector<Key<CitedLimit>> make_cited_limit_keys() {
  return {
      scene::required(scene::number_key<CitedLimit>(
          "gap", Dimension::length, scene::above(0), Standing::literature, "Largest gap that others allow.",
          [](auto& l) -> auto& { return l.gap; })),
      scene::number_key<CitedLimit>(
          "peak_pressure", Dimension::pressure, scene::above(0), Standing::literature,
          "Peak pressure that it was found for; absent where none was stated.",
          [](auto& l) -> auto& { return l.peak_pressure; }),
      scene::required(scene::text_key<CitedLimit>(
          "source", Standing::literature, "Who found it, and how.", "firing tests of 1998, table 3",
          [](auto& l) -> auto& { return l.source; })),
  };
}

}  // namespace

const std::vector<Key<CitedLimit>>& cited_limit_keys() {
  static const std::vector<Key<CitedLimit>> keys = make_cited_limit_keys();
  return keys;
}

Fault read_cited_limits(const toml::table& root, StudyFile& study) {
  const toml::node* node = root.get("cited_limit");
  if (!node || (node->is_array() && node->as_array()->empty())) return std::nullopt;
  if (!node->is_array_of_tables()) {
    return scene::error_at(scene::place_of(*node, study.file), "cited_limit", scene::found_text(*node),
                           "tables, each written [[cited_limit]]");
  }
  for (const toml::node& element : *node->as_array()) {
    CitedLimit limit;
    auto read = scene::read_table(*element.as_table(), cited_limit_keys(), {}, study.file, limit);
    if (!read) return in_table(read.error(), "cited_limit");
    study.study.cited_limits.push_back(std::move(limit));
  }
  return std::nullopt;
}

namespace {

/// The cases whose peak pressure is nearest to one, Pa.
std::vector<std::size_t> nearest_cases(const StudyFile& study, std::size_t count, double peak_pressure) {
  std::vector<std::size_t> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count; ++i) {
    const double distance = std::abs(study.cases[i].peak_pressure - peak_pressure);
    const double slack = 1e-9 * peak_pressure;
    if (distance > least + slack) continue;
    if (distance < least - slack) nearest.clear();
    least = std::min(least, distance);
    nearest.push_back(i);
  }
  return nearest;
}

/// Those of them that have the defect of the study's scene; all where none has.
std::vector<std::size_t> with_own_defect(const StudyFile& study, std::vector<std::size_t> cases) {
  const materials::ViscoScramParameters& own = study.scene.scene.charge().strength;
  std::vector<std::size_t> kept;
  for (const std::size_t i : cases) {
    const StudyCase& each = study.cases[i];
    if (each.crack_radius == own.initial_crack_radius && each.flaw_size == own.flaw_size) kept.push_back(i);
  }
  return kept.empty() ? cases : kept;
}

/// m, in which the cases at one pressure are ordered: the smallest that the critical gap may be.
double smallest_of(const CriticalGap& critical) {
  switch (critical.kind) {
    case CriticalGapKind::value:
      return critical.value;
    case CriticalGapKind::all_ignite:
      return 0.0;
    case CriticalGapKind::indeterminate:
      return -1.0;
    case CriticalGapKind::all_safe:
      break;
  }
  return std::numeric_limits<double>::infinity();
}

LimitComparison compare(const StudyFile& study, const std::vector<const CriticalGap*>& critical,
                        const CitedLimit& limit) {
  LimitComparison comparison;
  comparison.limit = limit;
  const double pressure = std::isnan(limit.peak_pressure)
                              ? scene::PressureHistory(study.scene.scene.load).stated_peak()
                              : limit.peak_pressure;
  const std::size_t count = std::min(study.cases.size(), critical.size());
  const std::vector<std::size_t> cases = with_own_defect(study, nearest_cases(study, count, pressure));
  comparison.cases = cases.size();
  double smallest = std::numeric_limits<double>::infinity();
  for (const std::size_t i : cases) {
    const double gap = smallest_of(*critical[i]);
    if (comparison.nearest && !(gap < smallest)) continue;
    comparison.nearest = i;
    smallest = gap;
  }
  if (!comparison.nearest || critical[*comparison.nearest]->kind != CriticalGapKind::value) return comparison;
  const double off = std::abs(study.cases[*comparison.nearest].peak_pressure - pressure);
  if (off <= pressure_slack * pressure) comparison.difference = smallest - limit.gap;
  return comparison;
}

}  // namespace

std::vector<LimitComparison> compare_with_limits(const StudyFile& study,
                                                 const std::vector<const CriticalGap*>& critical) {
  std::vector<LimitComparison> comparisons;
  for (const CitedLimit& limit : study.study.cited_limits)
    comparisons.push_back(compare(study, critical, limit));
  return comparisons;
}

}  // namespace launchsafe::study
