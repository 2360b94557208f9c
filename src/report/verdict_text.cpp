#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/scene/constants.hpp"
#include "launchsafe/scene/plan.hpp"
#include "launchsafe/study/study_cases.hpp"

#include <set>

namespace launchsafe::report {
namespace {

using keys::fixed, keys::significant, keys::text;

/// The charge off the grid lines, in the scene of a study or in those of its cases, which may have meshes and
/// bodies of their own.
void add_off_grid(const study::StudyFile& study, Row& facts) {
  std::size_t count = 0;
  const auto add = [&](const std::string& label, const scene::Scene& scene) {
    const std::string edges = scene::charge_edges_off_grid(scene);
    if (!edges.empty() && count++ == 0) facts["edges"] = label.empty() ? edges : label + ": " + edges;
  };
  if (study.study.axes.empty()) {
    add("", study.scene.scene);
  } else {
    for (const study::StudyCase& each : study.cases) add(each.label, each.scene.scene);
    facts["of_cases"] = study.cases.size();
  }
  facts["count"] = count;
}

/// Adds name = "..." for what is open and may be accepted, each name once.
void add_lines(const std::vector<study::CaseRow>& rows, std::vector<study::Remark> study::CaseRow::*remarks,
               const char* heading, std::vector<std::string>& lines) {
  std::set<std::string> names;
  for (const study::CaseRow& row : rows)
    for (const study::Remark& each : row.*remarks)
      if (each.is_open() && each.acceptable) names.insert(each.name);
  if (!names.empty()) lines.emplace_back(heading);
  for (const std::string& name : names) lines.push_back(name + " = \"...\"");
}

/// One cause that makes the critical gap of a case uncertain.
struct CauseRow {
  const NamedCase* of;
  const study::CauseShare* share;
  const study::CauseTraits& traits() const { return study::traits_of(share->cause); }
};

const Quantities<CauseRow> cause_quantities{
    {quantity::case_name, &CauseRow::of, &NamedCase::label},
    {"cause", "cause", text(), "What makes the critical gap uncertain.", &CauseRow::traits,
     &study::CauseTraits::title},
    {"class", "class", text(), "random: differs from launch to launch; bound: unknown, but fixed.",
     [](const CauseRow& row) { return std::string(row.traits().random ? "random" : "bound"); }},
    {"shorter", "shorter by", significant(2, centimetre),
     "By how much the cause may shorten the critical gap.", &CauseRow::share, &study::CauseShare::shorter},
    {"longer", "longer by", significant(2, centimetre),
     "By how much the cause may lengthen the critical gap.", &CauseRow::share, &study::CauseShare::longer},
    {for_programs(Column{"remedy", "remedy", text(), "What would make the share smaller."}),
     &CauseRow::traits, &study::CauseTraits::remedy}};

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
      {always({"margin", "margin", fixed(2, kelvin), "Ignition temperature less T max."}), &GapRow::margin},
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
  return keys::joined<JudgedGap>(
      {of_part<JudgedGap>(temperatures, &JudgedGap::gap),
       {{reason, [](const JudgedGap& row) { return study::reason_text(*row.of, *row.gap); }}},
       of_part<JudgedGap>(effects, &JudgedGap::gap)});
}

Quantities<study::CriticalGap> critical_gap_quantities() {
  return {{for_programs(quantity::critical_gap_kind), &study::CriticalGap::kind},
          {for_programs(quantity::critical_gap), value_of},
          {quantity::critical_gap_reads_as, reads_as}};
}

Quantities<study::CaseRow> case_quantities() {
  using study::CaseRow, study::GapBounds;
  const auto names = [](const std::vector<study::Remark>& remarks) { return study::names_text(remarks); };
  return keys::joined<CaseRow>(
      {of_part<CaseRow>(critical_gap_quantities(), &CaseRow::critical),
       {{"critical_gap_at_least", "at least", significant(3, centimetre),
         "Lower bound of the critical gap: gaps below it are SAFE.", &CaseRow::bounds, &GapBounds::at_least},
        {"critical_gap_at_most", "at most", significant(3, centimetre), "Upper bound of the critical gap.",
         &CaseRow::bounds, &GapBounds::at_most},
        {for_programs(Column{"critical_gap_with_bounds", "critical gap with its bounds", text(),
                             "The critical gap in the digits that its bounds justify."}),
         measured_text},
        {"basis", "basis", text(), "calibrated, or extrapolated outside an interval of the constants.",
         &CaseRow::basis},
        {"warnings", "warnings", text(), "Names of the validity warnings.", &CaseRow::warnings, names},
        {"extrapolated", "extrapolated", text(), "Intervals of the constants that the case lies outside of.",
         &CaseRow::extrapolated, names},
        {"accepted", "accepted", text(), "Warnings and intervals that the study accepts, with its reasons.",
         study::accepted_text},
        {for_programs(Column{"incomplete", "incomplete", text(),
                             "Launches beside the case's own that did not complete; it has no bounds."}),
         &CaseRow::incomplete}}});
}

std::vector<std::string> acceptances_to_write(const std::vector<study::CaseRow>& rows) {
  std::vector<std::string> lines;
  add_lines(rows, &study::CaseRow::warnings, "[accept]", lines);
  add_lines(rows, &study::CaseRow::extrapolated, "[accept.extrapolation]", lines);
  return lines;
}

std::vector<std::string> verdict_notes(const study::StudyFile& study,
                                       const std::vector<study::CaseRow>& rows) {
  Row facts;
  if (study.study.kind.gives_verdicts) {
    const study::StatedNumerics& numerics = study.study.numerics;
    if (numerics.is_stated()) facts["numerics"] = {{"K", numerics.error}, {"because", numerics.because}};
    facts["no_models"] = study.study.models.empty();
    facts["no_velocity"] = !study.scene.scene.load.expected_velocity;
    if (const auto lines = acceptances_to_write(rows); !lines.empty())
      facts["lines"] = fmt::format("\n\n    {}", fmt::join(lines, "\n    "));
  }
  add_off_grid(study, facts);
  return noted("verdicts", facts);
}

std::string station_note(const study::StudyFile& study) {
  const scene::Surface& surface = study.scene.scene.surface;
  const auto millimetres = [](double length) {
    return shown_value(length, keys::significant(4, millimetre));
  };
  return noted("stations", {{"stations", scene::stations_of(study.scene.scene).size()},
                            {"depth_mm", millimetres(surface.station_depth)},
                            {"width_mm", millimetres(surface.station_width)}})
      .front();
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
  Row facts{{"closure", study::to_string(scene.surface.friction)},
            {"localisation", scene.surface.localisation},
            {"exchange_time_ms", shown_value(scene.surface.exchange_time, quantity::exchange_time.form)},
            {"ignition_temperature_K", scene.charge().kinetics.ignition_temperature}};
  for (const char* key : {"friction.localisation", "gap.exchange_time", "kinetics.ignition_temperature"})
    if (varies(study.study, key)) facts["varied"].push_back(fmt::format("`{}`", key));
  return fmt::format("{}\n", fmt::join(noted("friction", facts), "\n"));
}

std::optional<Measured> measured_gap(const study::CaseRow& of_case) {
  if (of_case.critical.kind != study::CriticalGapKind::value) return std::nullopt;
  return measured_gap(shown_gap(of_case.critical.value), shown_gap(of_case.bounds.at_least),
                      shown_gap(of_case.bounds.at_most));
}

std::string measured_text(const study::CaseRow& of_case) {
  const auto known = measured_gap(of_case);
  return known ? known->text(quantity::critical_gap.form.unit) : reads_as(of_case.critical);
}

Table cause_table(const std::vector<NamedCase>& cases) {
  std::vector<CauseRow> rows;
  for (const NamedCase& each : cases)
    for (const study::CauseShare& share : each.row->causes) rows.push_back({&each, &share});
  return table_of("What makes the critical gap uncertain", cause_quantities, rows, noted("causes"));
}

study::Use use_of(const std::shared_ptr<const scene::Constants>& constants, double gap, double published) {
  const auto is_it = [&](const scene::FittedNumber& row) {
    return row.is_fitted && std::abs(row.gap - gap) <= 1e-9 && study::same_number(row.published, published);
  };
  const bool is_fitted = constants != nullptr && std::ranges::any_of(constants->rows, is_it);
  return is_fitted ? study::Use::fitted : study::Use::check;
}

}  // namespace launchsafe::report
