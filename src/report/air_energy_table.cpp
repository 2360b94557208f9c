#include "launchsafe/report/air_energy_table.hpp"

#include "launchsafe/report/number.hpp"
#include "launchsafe/report/quantities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::report {
namespace {

std::string kilojoules_per_area(double energy) { return significant(1e-3 * energy, 3) + " kJ/m2"; }

/// "a gap of 0.04 cm (496 MPa, 30 um, 1 mm)".
std::string place_of_gap(const AuditedGap& gap) {
  const std::string place = fmt::format("a gap of {:.6g} cm", 100.0 * gap.gap);
  return gap.label.empty() ? place : fmt::format("{} ({})", place, gap.label);
}

/// Where the skin took most against what can be supplied; nullptr where nothing was computed or no gap is
/// open.
const AuditedGap* worst_of(const std::vector<AuditedGap>& gaps) {
  const AuditedGap* worst = nullptr;
  for (const AuditedGap& gap : gaps) {
    if (!std::isfinite(gap.air.ratio())) continue;
    if (worst == nullptr || gap.air.ratio() > worst->air.ratio()) worst = &gap;
  }
  return worst;
}

std::string excess_text(const AuditedGap& worst) {
  return fmt::format(
      "At {} the skin took {} times what compression can supply ({} against {}), so that energy is not "
      "conserved. That is conservative as to the heat of the air. The critical gap is therefore calibrated, "
      "and not derived from what the air can give.",
      place_of_gap(worst), significant(worst.air.ratio(), 2), kilojoules_per_area(worst.air.taken),
      kilojoules_per_area(worst.air.supplied));
}

}  // namespace

std::string air_energy_statement(scene::AirModel model, const std::vector<AuditedGap>& gaps) {
  const std::string impact = " A gap that closes by impact is not modelled.";
  if (model == scene::AirModel::film)
    return "The air is a film that conducts into charge and base, and gives no more than compression "
           "supplies. What the skin took is told as of a skin of one temperature, and says nothing of a "
           "film." +
           impact;
  const std::string reservoir =
      "The air is the published reservoir, which stays on its adiabat whatever the skin draws from it. ";
  const AuditedGap* worst = worst_of(gaps);
  if (worst == nullptr)
    return reservoir + "No gap with air in it was computed, to see how much the skin took." + impact;
  if (worst->air.ratio() > 1.0) return reservoir + excess_text(*worst) + impact;
  return fmt::format(
      "{}At no gap did the skin take more than compression can supply; the most was {} times that, at {}.{}",
      reservoir, significant(worst->air.ratio(), 2), place_of_gap(*worst), impact);
}

Table air_energy_table(scene::AirModel model, const std::vector<AuditedGap>& gaps) {
  Table table;
  if (gaps.empty()) return table;
  const bool labelled =
      std::any_of(gaps.begin(), gaps.end(), [](const AuditedGap& gap) { return !gap.label.empty(); });
  table.title = "The energy of the air";
  if (labelled) table.columns.push_back(quantity::case_name());
  append(table.columns, {quantity::gap(), quantity::skin_took(), quantity::compression_supplies(),
                         quantity::taken_over_supplied(),
                         significant_column("stored on the adiabat", "kJ/m2", 3, "adiabat_stores_kJ_per_m2"),
                         significant_column("isothermal work", "kJ/m2", 3, "isothermal_work_kJ_per_m2")});
  for (const AuditedGap& gap : gaps) {
    std::vector<Cell>& cells = table.rows.emplace_back();
    if (labelled) cells.emplace_back(gap.label);
    cells.insert(cells.end(),
                 {100.0 * gap.gap, optional_number(1e-3 * gap.air.taken),
                  optional_number(1e-3 * gap.air.supplied), optional_number(gap.air.ratio()),
                  optional_number(1e-3 * gap.air.stored), optional_number(1e-3 * gap.air.isothermal)});
  }
  table.notes.push_back(
      "Per area of the charge's bottom, until the end or ignition. Taken: the heat that the exchange brought "
      "to the hottest station, net and at its most. Supplied: the upper bound for air that is compressed "
      "before it gives up heat and cools down under pressure, the rise of its enthalpy on the adiabat.");
  table.notes.push_back(air_energy_statement(model, gaps));
  return table;
}

}  // namespace launchsafe::report
