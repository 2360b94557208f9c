// What accepted constants of the surface do to every gap.
#include "launchsafe/kinds/critical_gap.hpp"
#include "launchsafe/report/quantities.hpp"

namespace launchsafe::kinds {

using namespace report;

Table as_calibrated_table(const CriticalGapResult& result) {
  Table table{"With constants of the surface as calibrated",
              {quantity::case_name(), quantity::gap(), quantity::verdict(), named_text("constant", "key"),
               quantity::temperature_max(),
               number_column("T max, as calibrated", "K", 1, "temperature_max_as_calibrated_K"),
               named_text("ignites then", "ignites")}};
  for (const study::CaseOutcome& outcome : result.cases)
    for (const study::GapVerdict& row : outcome.verdicts)
      for (const study::AsCalibrated& each : row.as_calibrated)
        table.rows.push_back({outcome.input.label, 100.0 * row.gap, study::to_string(row.judgement.verdict),
                              each.key.empty() ? "all of gap and friction" : each.key,
                              optional_number(row.maximum.temperature), optional_number(each.temperature),
                              each.ignites ? "yes" : "no"});
  if (!table.rows.empty())
    table.notes.emplace_back(
        "The same skin on the same trace, but for this constant. What all of gap and friction together "
        "change "
        "lowers the bound of the critical gap.");
  return table;
}

}  // namespace launchsafe::kinds
