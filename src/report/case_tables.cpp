#include "launchsafe/report/case_tables.hpp"

#include "case_pictures_parts.hpp"
#include "launchsafe/report/study_text.hpp"

namespace launchsafe::report {
namespace {

using keys::fixed, keys::text;

// --- faces that slide ---

/// A face on which something slid, and its hottest node.
struct FaceRow {
  const run::InterfaceResult* faces;
  std::size_t node;
};

double largest_in(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::ranges::max_element(values);
}

// --- combustion ---

std::string end_of(const run::CombustionHistory& combustion) {
  if (combustion.end == run::CombustionEnd::time) return "time after ignition";
  if (combustion.end == run::CombustionEnd::pressure) return "stop pressure";
  if (combustion.end == run::CombustionEnd::broke_off) return "broke off: " + combustion.reason;
  return "charge burnt through";
}

/// The last value of a history; 0 before the first.
auto last_of(std::vector<double> run::CombustionHistory::*history) {
  return [history](const run::CombustionHistory& combustion) {
    return (combustion.*history).empty() ? 0.0 : (combustion.*history).back();
  };
}

// --- the energy of the air ---

using run::MechanicsResult;
const Quantities<NamedRun> run_quantities{
    {quantity::case_name, &NamedRun::name},
    {headed("status", quantity::status),
     [](const NamedRun& run) { return run.failure.empty() ? "completed" : run.failure; }},
    {quantity::energy_drift, &NamedRun::mechanics, run::largest_energy_drift},
    {quantity::steps, &NamedRun::mechanics, &MechanicsResult::steps},
    {quantity::particles, &NamedRun::mechanics, &MechanicsResult::particles},
    {quantity::updates_per_second, &NamedRun::mechanics, &MechanicsResult::update_rate},
    {quantity::limiters, [](const NamedRun& run) { return limiters_text(run.mechanics->limiters); }},
    {for_programs(Column{"stored_case", "stored case", text(), "File in the folder that holds the run."}),
     &NamedRun::stored}};

Quantities<FaceRow> face_quantities() {
  using keys::significant;
  const auto largest = [](auto member) {
    return [member](const FaceRow& row) { return largest_in(std::invoke(member, *row.faces)); };
  };
  const auto at_node = [](auto member) {
    return [member](const FaceRow& row) { return std::invoke(member, *row.faces).at(row.node); };
  };
  return {{"body", "body", text(), "Body that slides on the charge.", &FaceRow::faces,
           &run::InterfaceResult::body},
          {"face", "face", text(), "Direction of the face.",
           [](const FaceRow& row) { return row.faces->along_x ? "along x" : "along r"; }},
          {"friction_work", "friction work", significant(4, joule), "Work of friction on the whole face.",
           &FaceRow::faces, &run::InterfaceResult::friction_work},
          {"largest_heat", "largest heat", significant(3, kilojoule_per_area),
           "Largest heat of friction on the face.", at_node(&run::InterfaceResult::friction_heat)},
          {"at", "at", significant(4, centimetre), "Where that is.", at_node(&run::InterfaceResult::place)},
          {"slid", "slid up to", significant(3, millimetre), "Longest way slid.",
           largest(&run::InterfaceResult::slid)},
          {"open", "open up to", significant(3, millimetre), "Widest opening.",
           largest(&run::InterfaceResult::largest_gap)}};
}

/// A gap that burnt.
using OneGap = const run::GapResult*;

using run::CombustionHistory;
const Quantities<OneGap> combustion_quantities = keys::joined<OneGap>(
    {{{quantity::gap, &run::GapResult::gap}},
     of_part<OneGap>(
         Quantities<CombustionHistory>{
             {"skin_flame_speed", "flame in the skin", keys::significant(3, metre_per_second),
              "Speed of the flame through the skin.", &CombustionHistory::skin_flame_speed},
             {"bulk_flame_speed", "behind it", keys::significant(3, metre_per_second),
              "Speed of the flame through the charge behind the skin.", &CombustionHistory::bulk_flame_speed},
             {quantity::skin_burnt_time, &CombustionHistory::complete_time},
             {quantity::burnt_mass, last_of(&CombustionHistory::burnt_mass)},
             {quantity::gas_volume, last_of(&CombustionHistory::gas_volume)},
             {quantity::gas_temperature, last_of(&CombustionHistory::gas_temperature)},
             {quantity::bottom_pressure_max,
              [](const CombustionHistory& c) { return largest_in(c.pressure); }},
             {quantity::heat_released, last_of(&CombustionHistory::released)},
             {"heat_kept_back", "kept back", keys::significant(3, kilojoule),
              "Heat of reaction of what burnt that was not released.",
              last_of(&CombustionHistory::kept_back)},
             {"heat_brought", "brought", keys::significant(3, kilojoule),
              "Heat above the initial temperature that what burnt had before.",
              last_of(&CombustionHistory::brought)},
             {quantity::combustion_residual, &CombustionHistory::energy_residual},
             {quantity::energy_drift, &CombustionHistory::energy_drift},
             {"combustion_end", "ended by", text(), "What ended the run.", end_of},
             {quantity::wall_time, &CombustionHistory::wall_time}},
         &run::GapResult::combustion)});

Quantities<AuditedGap> air_quantities(bool labelled) {
  const Quantities<AuditedGap> names{{quantity::case_name, &AuditedGap::label}};
  return keys::joined<AuditedGap>(
      {labelled ? names : Quantities<AuditedGap>{},
       {{quantity::gap, &AuditedGap::gap},
        {quantity::skin_took, &AuditedGap::air, &surface::AirEnergy::taken},
        {quantity::compression_supplies, &AuditedGap::air, &surface::AirEnergy::supplied},
        {quantity::taken_over_supplied, &AuditedGap::air, &surface::AirEnergy::ratio}}});
}

/// "runs away by itself in 341 ms from 519 K and in 29.3 ms from 550 K": adiabatic, specific heat in J/(kg
/// K). 519 K is where the air of a gap takes the skin of the 155 mm shell, 550 K what cook-off tests go to.
std::string runaway_text(const materials::KineticsParameters& kinetics, double specific_heat) {
  const auto milliseconds = [&](double from) {
    return significant(1e3 * materials::adiabatic_runaway_time(kinetics, specific_heat, from), 3);
  };
  return fmt::format("runs away by itself in {} ms from 519 K and in {} ms from 550 K", milliseconds(519.0),
                     milliseconds(550.0));
}

}  // namespace

Quantities<run::CombustionHistory> burnt_state_quantities() {
  using run::CombustionHistory;
  return {{quantity::skin_burnt_time, &CombustionHistory::complete_time},
          {quantity::burnt_mass, last_of(&CombustionHistory::burnt_mass)},
          {quantity::heat_released, last_of(&CombustionHistory::released)},
          {quantity::bottom_pressure_max, [](const CombustionHistory& c) { return largest_in(c.pressure); }},
          {quantity::combustion_residual, &CombustionHistory::energy_residual}};
}

std::vector<Column> air_energy_columns() { return keys::described(air_quantities(true)); }

Table run_table(const std::vector<NamedRun>& runs) { return table_of("Runs", run_quantities, runs); }

Table interface_table(const run::MechanicsResult& mechanics) {
  std::vector<FaceRow> rows;
  for (const run::InterfaceResult& faces : mechanics.interfaces) {
    const auto hottest = std::ranges::max_element(faces.friction_heat);
    if (hottest != faces.friction_heat.end())
      rows.push_back({&faces, static_cast<std::size_t>(hottest - faces.friction_heat.begin())});
  }
  return table_of("Faces that slide on the charge", face_quantities(), rows, noted("faces"));
}

Table combustion_table(const scene::Scene& scene, const run::CaseResult& result) {
  std::vector<OneGap> burnt;
  for (const run::GapResult& gap : result.gaps)
    if (gap.combustion) burnt.push_back(&gap);
  Table table = table_of("After ignition, with two-way coupling", combustion_quantities, burnt);
  if (!burnt.empty()) table.notes = noted("combustion", {{"kinetics", flame_kinetics_note(scene)}});
  return table;
}

std::string air_energy_statement(const std::vector<AuditedGap>& gaps) {
  Row facts = Row::object();
  // Where the skin took most against what can be supplied.
  double most = -HUGE_VAL;
  for (const AuditedGap& gap : gaps) {
    const double ratio = gap.air.ratio();
    if (!std::isfinite(ratio) || ratio <= most) continue;
    most = ratio;
    const std::string place = "a gap of " + centimetres(gap.gap);
    facts["worst"] = {{"place", gap.label.empty() ? place : fmt::format("{} ({})", place, gap.label)},
                      {"ratio", ratio},
                      {"taken", in_words(gap.air.taken, quantity::skin_took.form)},
                      {"supplied", in_words(gap.air.supplied, quantity::skin_took.form)}};
  }
  return noted("air", facts).front();
}

Table air_energy_table(const std::vector<AuditedGap>& gaps) {
  if (gaps.empty()) return {};
  const bool labelled = std::ranges::any_of(gaps, [](const AuditedGap& gap) { return !gap.label.empty(); });
  Table table = table_of("The energy of the air", air_quantities(labelled), gaps, noted("air_energy"));
  table.notes.push_back(air_energy_statement(gaps));
  return table;
}

std::string flame_kinetics_note(const scene::Scene& scene) {
  const auto told = [&scene](const materials::KineticsParameters& kinetics) {
    return fmt::format("(E/R {:.6g} K, {:.4g} 1/s, {:.5g} MJ/kg), which {}", kinetics.activation_temperature,
                       kinetics.frequency, 1e-6 * kinetics.heat_of_reaction,
                       runaway_text(kinetics, scene.charge().specific_heat));
  };
  Row facts{{"own", told(scene.charge().kinetics)}};
  if (scene.combustion.kinetics != scene::effective_kinetics)
    facts["flame"] = {{"name", scene.combustion.kinetics}, {"told", told(scene::flame_kinetics(scene))}};
  return noted("flame_kinetics", facts).front();
}

}  // namespace launchsafe::report
