// Limits of the gap from the literature beside the critical gaps of a study.
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/verdict_text.hpp"
#include "launchsafe/study/cited_limits.hpp"

#include <fmt/format.h>

#include <cmath>

namespace launchsafe::report {
namespace {

std::vector<Cell> cells_of(const study::LimitComparison& comparison, const study::StudyFile& study,
                           const std::vector<const study::CriticalGap*>& critical) {
  std::vector<Cell> cells{100.0 * comparison.limit.gap,
                          optional_number(1e-6 * comparison.limit.peak_pressure), comparison.limit.source};
  if (!comparison.nearest) return cells;
  const study::StudyCase& input = study.cases[*comparison.nearest];
  const study::CriticalGap& gap = *critical[*comparison.nearest];
  cells.insert(cells.end(), {1e-6 * input.peak_pressure, input.label, optional_number(100.0 * value_of(gap)),
                             reads_as(gap), optional_number(100.0 * comparison.difference)});
  return cells;
}

}  // namespace

Table cited_limit_table(const study::StudyFile& study,
                        const std::vector<const study::CriticalGap*>& critical) {
  Table table;
  if (study.study.cited_limits.empty()) return table;
  table.title = "Cited limits of the gap";
  table.columns = {significant_column("limit", "cm", 6, "limit_cm"),
                   significant_column("at", "MPa", 6, "limit_peak_pressure_MPa"),
                   named_text("source", "source"),
                   significant_column("computed at", "MPa", 6, "peak_pressure_MPa"),
                   quantity::case_name(),
                   quantity::critical_gap(),
                   quantity::critical_gap_reads_as(),
                   significant_column("computed minus cited", "cm", 2, "difference_cm")};
  bool chosen = false;
  for (const study::LimitComparison& each : study::compare_with_limits(study, critical)) {
    chosen = chosen || each.cases > 1;
    table.rows.push_back(cells_of(each, study, critical));
  }
  table.notes.push_back(fmt::format(
      "Beside each limit stands the case with the nearest peak pressure; for one without a pressure, that of "
      "the study's scene. The difference is given where the pressures agree within {:.6g} %.",
      100.0 * study::pressure_slack));
  if (chosen)
    table.notes.emplace_back(
        "Of several cases at that pressure it is the one with the smallest critical gap.");
  return table;
}

}  // namespace launchsafe::report
