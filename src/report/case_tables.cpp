#include "launchsafe/report/case_tables.hpp"

#include "case_pictures_parts.hpp"
#include "launchsafe/report/study_text.hpp"

namespace launchsafe::report {
namespace {

using keys::fixed, keys::text;

double largest_in(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::ranges::max_element(values);
}

// --- combustion ---

std::string end_of(const run::CombustionHistory& combustion) {
  if (combustion.end == run::CombustionEnd::time) return "time after ignition";
  if (combustion.end == run::CombustionEnd::pressure) return "stop pressure";
  return "broke off: " + combustion.reason;
}

/// The last value of a history; 0 before the first.
auto last_of(std::vector<double> run::CombustionHistory::*history) {
  return [history](const run::CombustionHistory& combustion) {
    return (combustion.*history).empty() ? 0.0 : (combustion.*history).back();
  };
}

using run::MechanicsResult;
const Quantities<NamedRun> run_quantities = keys::joined<NamedRun>(
    {{{quantity::case_name, &NamedRun::name},
      {headed("status", quantity::status),
       [](const NamedRun& run) { return run.failure.empty() ? "completed" : run.failure; }}},
     of_part<NamedRun>(launch_effects(), &NamedRun::mechanics),
     {{quantity::energy_drift, &NamedRun::mechanics, run::largest_energy_drift},
      {quantity::steps, &NamedRun::mechanics, &MechanicsResult::steps},
      {quantity::particles, &NamedRun::mechanics, &MechanicsResult::particles},
      {quantity::limiters, [](const NamedRun& run) { return limiters_text(run.mechanics->limiters); }},
      {for_programs(Column{"stored_case", "stored case", text(), "File in the folder that holds the run."}),
       &NamedRun::stored}}});

/// A gap that burnt.
using OneGap = const run::GapResult*;

using run::CombustionHistory;
const Quantities<OneGap> combustion_quantities =
    keys::joined<OneGap>({{{quantity::gap, &run::GapResult::gap}},
                          of_part<OneGap>(
                              Quantities<CombustionHistory>{
                                  {quantity::burnt_mass, last_of(&CombustionHistory::burnt_mass)},
                                  {quantity::gas_volume, last_of(&CombustionHistory::gas_volume)},
                                  {quantity::gas_temperature, last_of(&CombustionHistory::gas_temperature)},
                                  {quantity::bottom_pressure_max,
                                   [](const CombustionHistory& c) { return largest_in(c.pressure); }},
                                  {quantity::heat_released, last_of(&CombustionHistory::released)},
                                  {"heat_brought", "brought", keys::significant(3, kilojoule),
                                   "Heat above the initial temperature that what burnt had before.",
                                   last_of(&CombustionHistory::brought)},
                                  {quantity::combustion_residual, &CombustionHistory::energy_residual},
                                  {quantity::energy_drift, &CombustionHistory::energy_drift},
                                  {"combustion_end", "ended by", text(), "What ended the run.", end_of},
                                  {quantity::wall_time, &CombustionHistory::wall_time}},
                              &run::GapResult::combustion)});

}  // namespace

const Quantities<MechanicsResult>& launch_effects() {
  static const Quantities<MechanicsResult> effects{
      {"largest_plastic_strain", "plastic strain of the steel", keys::significant(3, keys::percent),
       "Largest plastic strain of the steel at the end.", &MechanicsResult::largest_plastic_strain},
      {"yielded_wall", "yielded wall", keys::significant(3, keys::millimetre),
       "Length of the steel beside the charge whose plastic strain exceeds 0.2 %.",
       &MechanicsResult::yielded_wall},
      {"friction_over_work", "friction heat over work", keys::significant(3),
       "Friction heat of the charge over the net work done on it.", &MechanicsResult::friction_over_work}};
  return effects;
}

Table run_table(const std::vector<NamedRun>& runs) {
  return table_of(
      "Runs", run_quantities, runs,
      {"Friction heat over work: friction heat of the charge over the net work done on it. Yielded "
       "wall: the length of the steel beside the charge whose plastic strain exceeds 0.2 %."});
}

Table combustion_table(const run::CaseResult& result) {
  std::vector<OneGap> burnt;
  for (const run::GapResult& gap : result.gaps)
    if (gap.combustion) burnt.push_back(&gap);
  Table table = table_of("After ignition, with two-way coupling", combustion_quantities, burnt);
  if (!burnt.empty())
    table.notes = {
        "At the end of the run; p max is the largest over it. Released: the heat of reaction of what burnt. "
        "Brought: its heat above the initial temperature before, from air, friction and slow reaction.",
        "The closure and the localisation of friction are not calibrated for the motion that the gas causes: "
        "how fast burning spreads over the bottom is a result of the model, and no prediction."};
  return table;
}

}  // namespace launchsafe::report
