#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/scene/constants.hpp"
#include "launchsafe/scene/plan.hpp"
#include "launchsafe/study/study_cases.hpp"

#include <set>

namespace launchsafe::report {
namespace {

using keys::fixed, keys::significant, keys::text;

/// A note on the first charge that lies off the grid lines, in the scene of a study or in those of its cases,
/// which may have meshes and bodies of their own. Empty without such a charge.
std::string off_grid_note(const study::StudyFile& study) {
  std::string edges =
      scene::charge_edges_off_grid(study.study.axes.empty() ? study.scene.scene : scene::Scene{});
  for (std::size_t i = 0; !study.study.axes.empty() && edges.empty() && i < study.cases.size(); ++i)
    if (const std::string found = scene::charge_edges_off_grid(study.cases[i].scene.scene); !found.empty())
      edges = study.cases.label(i) + ": " + found;
  return edges.empty() ? ""
                       : fmt::format(
                             "The charge lies off the grid lines ({}): calibrated constants do not carry "
                             "over from a grid that fits.",
                             edges);
}

}  // namespace

Quantities<JudgedGap> verdict_quantities(const study::Study& study) {
  using study::GapRow, study::Judgement, study::NamedIgnition, study::Peak, surface::AirEnergy;
  using namespace quantity;
  const Quantities<GapRow> temperatures{
      {temperature_max, &GapRow::maximum, &Peak::temperature},
      {temperature_max_place, &GapRow::maximum, &Peak::point},
      {temperature_max_time, &GapRow::maximum, &Peak::time},
      {temperature_early(study.early_time), &GapRow::early, &Peak::temperature},
      {for_programs(Column{"spread", "spread", fixed(1, kelvin),
                           "Hottest less coldest station at the muzzle exit, or at the end without one."}),
       &GapRow::spread},
      {margin, &GapRow::margin},
      {always(uncertainty), &GapRow::uncertainty},
      {verdict, &GapRow::judgement, &Judgement::verdict}};
  const Quantities<GapRow> effects{
      {for_programs(reason_code), &GapRow::judgement, &Judgement::code},
      {for_people(Column{"ignition", "ignition", text(), "Cause, instant and station of ignition."}),
       &GapRow::ignition,
       [](const NamedIgnition& ignition) {
         return fmt::format("{} at {}, {}", study::to_string(ignition.cause),
                            in_words(ignition.time, quantity::ignition_time.form), ignition.point);
       }},
      {for_programs(Column{"ignition_cause", "ignition cause", text(), "Cause of ignition."}),
       &GapRow::ignition, [](const NamedIgnition& ignition) { return study::to_string(ignition.cause); }},
      {for_programs(ignition_time), &GapRow::ignition, &NamedIgnition::time},
      {for_programs(Column{"ignition_place", "ignition at", text(), "Station that ignites."}),
       &GapRow::ignition, &NamedIgnition::point},
      {for_programs(Column{"ignition_chemical_share", "chemical share", fixed(3),
                           "Share of reaction in the heating rate at ignition."}),
       &GapRow::ignition, &NamedIgnition::chemical_share},
      {"ignition_after_launch", "ignites after the launch", significant(3, millisecond),
       "Time from the end of the launch to ignition of a skin that only its own reaction heats.",
       &GapRow::ignition_after_launch},
      {for_programs(skin_took), &GapRow::air, &AirEnergy::taken},
      {for_programs(compression_supplies), &GapRow::air, &AirEnergy::supplied},
      {for_programs(taken_over_supplied), &GapRow::air, &AirEnergy::ratio}};
  const auto reason_of = [](const JudgedGap& row) { return study::reason_text(*row.of, *row.gap); };
  return keys::joined<JudgedGap>(
      {of_part<JudgedGap>(temperatures, &JudgedGap::gap),
       {{for_programs(reason), reason_of},
        {for_people(reason), [=](const JudgedGap& row) { return rule_in(reason_of(row)); }}},
       of_part<JudgedGap>(effects, &JudgedGap::gap)});
}

Quantities<study::CaseRow> case_quantities() {
  using study::CaseRow, study::GapBounds;
  const auto names = [](const std::vector<study::Remark>& remarks) { return study::names_text(remarks); };
  return {{for_programs(quantity::critical_gap_kind), &CaseRow::critical, &study::CriticalGap::kind},
          {for_programs(quantity::critical_gap), &CaseRow::critical, value_of},
          {quantity::critical_gap_reads_as, &CaseRow::critical, reads_as},
          {quantity::lower_bound, &CaseRow::bounds, &GapBounds::at_least},
          {quantity::upper_bound, &CaseRow::bounds, &GapBounds::at_most},
          {"costliest_cause", "costs most", text(), "Cause that shortens the critical gap most.",
           [](const CaseRow& row) {
             const auto cause = study::costliest(row);
             return cause ? study::traits_of(*cause).title : std::string();
           }},
          {for_programs(Column{"critical_gap_with_bounds", "critical gap with its bounds", text(),
                               "The critical gap in the digits that its bounds justify."}),
           measured_text},
          {"basis", "basis", text(), "calibrated, or extrapolated outside an interval of the constants.",
           &CaseRow::basis},
          {"warnings", "warnings", text(), "Names of the validity warnings.", &CaseRow::warnings, names},
          {"extrapolated", "extrapolated", text(),
           "Intervals of the constants that the case lies outside of.", &CaseRow::extrapolated, names},
          {"accepted", "accepted", text(), "Warnings and intervals that the study accepts, with its reasons.",
           study::accepted_text},
          {for_programs(Column{"incomplete", "incomplete", text(),
                               "Launches beside the case's own that did not complete; it has no bounds."}),
           &CaseRow::incomplete}};
}

std::vector<std::string> acceptances_to_write(const std::vector<study::CaseRow>& rows) {
  std::vector<std::string> lines;
  for (const auto& [heading, remarks] : {std::pair{"[accept]", &study::CaseRow::warnings},
                                         {"[accept.extrapolation]", &study::CaseRow::extrapolated}}) {
    std::set<std::string> names;
    for (const study::CaseRow& row : rows)
      for (const study::Remark& each : row.*remarks)
        if (each.is_open() && each.acceptable) names.insert(each.name);
    if (!names.empty()) lines.emplace_back(heading);
    for (const std::string& name : names) lines.push_back(name + " = \"...\"");
  }
  return lines;
}

std::vector<std::string> verdict_notes(const study::StudyFile& study,
                                       const std::vector<study::CaseRow>& rows) {
  std::vector<std::string> notes;
  if (study.study.kind.gives_verdicts) {
    const study::StatedNumerics& numerics = study.study.numerics;
    if (numerics.is_stated())
      notes.push_back(fmt::format("Stated by hand: numerics {} K, because {}.",
                                  significant(numerics.error, 3), numerics.because));
    if (study.study.models.empty()) notes.emplace_back("No other model was compared.");
    if (!study.scene.scene.load.expected_velocity)
      notes.emplace_back("Nothing checks the pressure that was typed: load.expected_velocity.");
  }
  if (std::string note = off_grid_note(study); !note.empty()) notes.push_back(std::move(note));
  if (const auto lines = acceptances_to_write(rows); study.study.kind.gives_verdicts && !lines.empty())
    notes.push_back(
        fmt::format("To judge the launch all the same, add to the study, with reasons in words:\n\n    {}",
                    fmt::join(lines, "\n    ")));
  return notes;
}

std::string station_note(const study::StudyFile& study) {
  const scene::Surface& surface = study.scene.scene.surface;
  return fmt::format(
      "Temperatures are those of the hottest of {} stations that tile the charge's bottom, S1 at "
      "the wall, each {} deep; station.width {}.",
      scene::stations_of(study.scene.scene).size(),
      in_words(surface.station_depth, significant(4, millimetre)),
      in_words(surface.station_width, significant(4, millimetre)));
}

std::string rule_in(const std::string& reason) { return reason.substr(0, reason.find("; accepted: ")); }

std::vector<Column> verdict_columns() {
  std::vector<Column> columns = keys::described(verdict_quantities(study::Study{}));
  std::erase_if(columns, [](const Column& column) { return column.name == "temperature_early"; });
  columns.insert(columns.begin(), quantity::gap);
  return columns;
}

double value_of(const study::CriticalGap& gap) {
  return gap.kind == study::CriticalGapKind::all_safe ? study::not_a_number : gap.value;
}

std::string reads_as(const study::CriticalGap& gap) {
  using enum study::CriticalGapKind;
  const std::string number = in_words(gap.value, significant(3, centimetre));
  if (gap.kind == value) return number;
  if (gap.kind == all_safe) return "> " + number;
  if (gap.kind == all_ignite) return "ignites without a gap";
  return gap.kind == several_crossings ? "several, the first at " + number : "unknown";
}

std::string friction_remark(const study::StudyFile& study) {
  const scene::Scene& scene = study.scene.scene;
  std::string varied;
  for (const char* key : {"friction.localisation", "gap.exchange_time", "kinetics.ignition_temperature"})
    if (varies(study.study, key)) varied += fmt::format("The study varies `{}` around it.\n", key);
  return fmt::format(
      "Friction closure \"{}\" with a localisation of {}, exchange time {}, ignition temperature {}: these "
      "are calibrated on published rows, as are the shape of the load and the choice of the model (see "
      "`studies/calibrate_table8.toml`). The critical gap of the calibration's own load and defect is a fit, "
      "not a prediction; it is computed for how it moves with pressure, defect, load shape and design. That "
      "closed crack faces rub is no part of the published text (see `studies/defects.toml`).\n"
      "{}The air is the published reservoir, which stays on its adiabat whatever the skin draws from it: "
      "column taken_over_supplied has that over the heat that compression can supply.\n",
      study::to_string(scene.surface.friction), significant(scene.surface.localisation, 6),
      milliseconds(scene.surface.exchange_time),
      in_words(scene.charge().kinetics.ignition_temperature, significant(6, kelvin)), varied);
}

std::string measured_text(const study::CaseRow& of_case) {
  std::string text;
  if (of_case.critical.kind == study::CriticalGapKind::value)
    text = between_bounds(shown_gap(of_case.critical.value), shown_gap(of_case.bounds.at_least),
                          shown_gap(of_case.bounds.at_most), quantity::critical_gap.form.unit);
  return text.empty() ? reads_as(of_case.critical) : text;
}

}  // namespace launchsafe::report
