// What accepted constants of the surface do to every gap.
#include "launchsafe/kinds/critical_gap.hpp"
#include "launchsafe/report/quantities.hpp"

namespace launchsafe::kinds {

using namespace report;

namespace {

/// One gap of a case with one constant as calibrated.
struct CalibratedRow {
  const study::CaseOutcome* outcome;
  const study::GapVerdict* gap;
  const study::AsCalibrated* constant;
};

Quantities<CalibratedRow> calibrated_quantities() {
  using keys::text;
  return {
      {quantity::case_name(), &CalibratedRow::outcome, &study::CaseOutcome::input, &study::StudyCase::label},
      {quantity::gap(), &CalibratedRow::gap, &study::GapVerdict::gap},
      {quantity::verdict(), &CalibratedRow::gap, &study::GapVerdict::judgement, &study::Judgement::verdict},
      {{"key", "constant", text(), "The constant that is put back."},
       [](const CalibratedRow& row) {
         return row.constant->key.empty() ? "all of gap and friction" : row.constant->key;
       }},
      {quantity::temperature_max(),
       [](const CalibratedRow& row) { return known(row.gap->maximum.temperature); }},
      {{"temperature_max_as_calibrated", "T max, as calibrated", keys::fixed(1, kelvin),
        "Highest temperature with that constant as calibrated."},
       &CalibratedRow::constant,
       &study::AsCalibrated::temperature},
      {{"ignites", "ignites then", text(), "Whether the gap ignites with it."},
       &CalibratedRow::constant,
       &study::AsCalibrated::ignites}};
}

}  // namespace

std::vector<Column> as_calibrated_columns() { return keys::described(calibrated_quantities()); }

Table as_calibrated_table(const CriticalGapResult& result) {
  std::vector<CalibratedRow> rows;
  for (const study::CaseOutcome& outcome : result.cases)
    for (const study::GapVerdict& gap : outcome.verdicts)
      for (const study::AsCalibrated& each : gap.as_calibrated) rows.push_back({&outcome, &gap, &each});
  Table table = table_of("With constants of the surface as calibrated", calibrated_quantities(), rows);
  if (!rows.empty())
    table.notes.emplace_back(
        "The same skin on the same trace, but for this constant. What all of gap and friction together "
        "change "
        "lowers the bound of the critical gap.");
  return table;
}

}  // namespace launchsafe::kinds
