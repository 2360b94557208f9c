#include "launchsafe/study/study_cases.hpp"

#include <algorithm>
#include <cmath>

namespace launchsafe::study {

using scene::Dimension, scene::Key, scene::Standing;

const std::vector<Key<CitedLimit>>& cited_limit_keys() {
  static const std::vector<Key<CitedLimit>> keys{
      scene::number_key<CitedLimit>(
          "gap", Dimension::length, scene::above(0), Standing::literature, "Largest gap that others allow.",
          [](auto& l) -> auto& { return l.gap; }) |
          scene::required(),
      scene::number_key<CitedLimit>(
          "peak_pressure", Dimension::pressure, scene::above(0), Standing::literature,
          "Peak pressure that it was found for; absent where none was stated.",
          [](auto& l) -> auto& { return l.peak_pressure; }),
      scene::text_key<CitedLimit>(
          "source", Standing::literature, "Who found it, and how.", "firing tests of 1998, table 3",
          [](auto& l) -> auto& { return l.source; }) |
          scene::required(),
  };
  return keys;
}

Fault read_cited_limits(const toml::table& root, StudyFile& study) {
  return read_rows(root, "cited_limit", cited_limit_keys(), study.file, study, study.study.cited_limits);
}

namespace {

/// The cases whose peak pressure is nearest to one, Pa.
std::vector<std::size_t> nearest_cases(const StudyFile& study, std::size_t count, double peak_pressure) {
  std::vector<std::size_t> nearest;
  double least = math::infinity;
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
  double smallest = math::infinity;
  for (const std::size_t i : cases) {
    // In the order of the smallest that the critical gap may be.
    const GapOrBound known = gap_or_bound(*critical[i]), gap = std::isnan(known) ? -1.0 : known;
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
