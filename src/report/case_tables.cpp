#include "launchsafe/report/case_tables.hpp"

#include "launchsafe/report/kinetics_text.hpp"
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/study_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace launchsafe::report {
namespace {

// --- faces that slide ---

double largest_in(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

// --- combustion ---

std::string end_of(const run::CombustionHistory& combustion) {
  if (combustion.end == run::CombustionEnd::time) return "time after ignition";
  if (combustion.end == run::CombustionEnd::pressure) return "stop pressure";
  if (combustion.end == run::CombustionEnd::broke_off) return "broke off: " + combustion.reason;
  return "charge burnt through";
}

double last_of(const std::vector<double>& values) { return values.empty() ? 0.0 : values.back(); }

// --- the energy of the air ---

std::string kilojoules_per_area(double energy) { return significant(1e-3 * energy, 3) + " kJ/m2"; }

/// "a gap of 0.04 cm (496 MPa, 30 um, 1 mm)".
std::string place_of_gap(const AuditedGap& gap) {
  const std::string place = "a gap of " + centimetres(gap.gap);
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

Table run_table(const std::vector<NamedRun>& runs) {
  Table table{"Runs",
              {quantity::case_name(), quantity::status("status"), quantity::energy_drift(), quantity::steps(),
               quantity::particles(), scientific_column("updates", "1/s", 2, "updates_per_second"),
               quantity::limiters(), for_programs(named_text("stored case", "stored_case"))},
              {}};
  for (const NamedRun& each : runs) {
    const run::MechanicsResult& run = *each.mechanics;
    table.rows.push_back({each.name, each.failure.empty() ? "completed" : each.failure,
                          optional_number(run::largest_energy_drift(run)),
                          static_cast<std::int64_t>(run.steps), static_cast<std::int64_t>(run.particles),
                          optional_number(run.update_rate()), limiters_text(run.limiters), each.stored});
  }
  return table;
}

Table interface_table(const run::MechanicsResult& mechanics) {
  Table table{
      "Faces that slide on the charge",
      {text_column("body"), text_column("face"),
       significant_column("friction work", "J", 4, "friction_work_J"),
       significant_column("largest heat", "kJ/m2", 3, "largest_heat_kJ_per_m2"),
       significant_column("at", "cm", 4, "at_cm"), significant_column("slid up to", "mm", 3, "slid_mm"),
       significant_column("open up to", "mm", 3, "open_mm"),
       number_column("bonded nodes", "%", 0, "bonded_percent")},
      {}};
  for (const run::InterfaceResult& faces : mechanics.interfaces) {
    const auto hottest = std::max_element(faces.friction_heat.begin(), faces.friction_heat.end());
    if (hottest == faces.friction_heat.end()) continue;
    const auto node = static_cast<std::size_t>(hottest - faces.friction_heat.begin());
    const double bonded = std::accumulate(faces.bonded.begin(), faces.bonded.end(), 0.0);
    table.rows.push_back({faces.body, std::string(faces.along_x ? "along x" : "along r"), faces.friction_work,
                          1e-3 * *hottest, 100.0 * faces.place.at(node), 1e3 * largest_in(faces.slid),
                          1e3 * largest_in(faces.largest_gap),
                          100.0 * bonded / static_cast<double>(faces.bonded.size())});
  }
  if (!table.rows.empty())
    table.notes.push_back(
        "Heat of friction is per area of the face, over the whole launch, and heats no skin: that at the "
        "charge's bottom counts as uncertainty of T max instead.");
  return table;
}

BurntState burnt_state_of(const run::CombustionHistory& c) {
  return {1e3 * last_of(c.burnt_mass), 1e-3 * last_of(c.released), 1e-6 * largest_in(c.pressure)};
}

Table combustion_table(const scene::Scene& scene, const run::CaseResult& result) {
  Table table{"After ignition, with two-way coupling",
              {quantity::gap(), significant_column("flame in the skin", "m/s", 3, "skin_flame_speed_m_per_s"),
               significant_column("behind it", "m/s", 3, "bulk_flame_speed_m_per_s"),
               quantity::skin_burnt_time(), quantity::burnt_mass(), quantity::gas_volume(),
               quantity::gas_temperature(), quantity::bottom_pressure_max(), quantity::heat_released(),
               significant_column("kept back", "kJ", 3, "heat_kept_back_kJ"),
               significant_column("brought", "kJ", 3, "heat_brought_kJ"), quantity::combustion_residual(),
               quantity::energy_drift(), named_text("ended by", "combustion_end"),
               number_column("wall time", "s", 1, "wall_time_s")},
              {}};
  for (const run::GapResult& gap : result.gaps) {
    if (!gap.combustion) continue;
    const run::CombustionHistory& c = *gap.combustion;
    const BurntState state = burnt_state_of(c);
    table.rows.push_back({100.0 * gap.gap, c.skin_flame_speed, c.bulk_flame_speed,
                          optional_number(1e3 * c.complete_time), state.burnt_mass,
                          1e6 * last_of(c.gas_volume), last_of(c.gas_temperature), state.highest_pressure,
                          state.released, 1e-3 * last_of(c.kept_back), 1e-3 * last_of(c.brought),
                          c.energy_residual, c.energy_drift, end_of(c), c.wall_time});
  }
  if (table.rows.empty()) return table;
  table.notes = {
      "At the end of the run; p max is the largest over it. Released and kept back: of the heat of reaction "
      "of what had burnt. Brought: heat above the initial temperature that it had before, from air, friction "
      "and slow reaction.",
      flame_kinetics_note(scene),
      "The flame lives on conduction alone. Friction heats by the closure and the localisation of the "
      "launch, which are not calibrated for the motion that the gas causes: how fast burning spreads over "
      "the bottom is a result of the model, and no prediction."};
  return table;
}

Table combustion_history_table(const run::CombustionHistory& c, double gap, std::size_t rows) {
  Table table{"History of the combustion at " + centimetres(gap),
              {number_column("time", "ms", 3, "time_ms"),
               number_column("largest reaction degree", "", 3, "reaction_degree_max"),
               number_column("largest depth", "mm", 4, "burnt_depth_mm"), quantity::burnt_mass(),
               quantity::gas_volume(), quantity::gas_temperature(),
               number_column("p bottom", "MPa", 1, "bottom_pressure_MPa"), quantity::heat_released()},
              {}};
  if (c.time.empty() || rows == 0) return table;
  const std::size_t stations = c.reaction_degree.size() / c.time.size();
  const std::size_t stride = std::max<std::size_t>(1, (c.time.size() + rows - 1) / rows);
  for (std::size_t i = 0; i < c.time.size(); ++i) {
    const bool last = i + 1 == c.time.size();
    if (i % stride != 0 && !last) continue;
    const auto begin = c.reaction_degree.begin() + static_cast<std::ptrdiff_t>(i * stations);
    const double degree =
        stations > 0 ? *std::max_element(begin, begin + static_cast<std::ptrdiff_t>(stations)) : 0.0;
    table.rows.push_back({1e3 * c.time[i], degree, 1e3 * c.burnt_depth[i], 1e3 * c.burnt_mass[i],
                          1e6 * c.gas_volume[i], c.gas_temperature[i], 1e-6 * c.pressure[i],
                          1e-3 * c.released[i]});
  }
  return table;
}

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
