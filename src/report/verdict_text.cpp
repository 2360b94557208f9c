#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/scene/constants.hpp"
#include "launchsafe/scene/plan.hpp"
#include "launchsafe/study/case_answer.hpp"
#include "launchsafe/study/constants_of_study.hpp"
#include "launchsafe/study/study_cases.hpp"

namespace launchsafe::report {
namespace {

using keys::fixed, keys::text;

Column share_of_uncertainty(std::string name, std::string heading, std::string meaning) {
  return always({"uncertainty_of_" + std::move(name), std::move(heading), keys::significant(2, kelvin),
                 std::move(meaning)});
}

/// What the judgement of a gap rests on, for programs: empty where there is nothing to say.
Quantity<study::GapVerdict> evidence_quantity(const char* name, std::string (*said)(const study::GapVerdict&),
                                              const char* meaning) {
  return {for_programs(Column{name, name, text(), meaning}), said};
}

/// What the input of the case says.
template <auto said>
std::string of_input(const study::GapVerdict& row) {
  return row.of_case == nullptr ? std::string{} : said(row.of_case->input);
}

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

/// One cause that makes the critical gap of a case uncertain.
struct ShareRow {
  const NamedGap* of;
  const study::GapShare* share;
};

const Quantities<ShareRow> share_quantities{
    {quantity::case_name, [](const ShareRow& row) { return row.of->label; }},
    {"cause", "cause", text(), "What is uncertain.",
     [](const ShareRow& row) { return study::traits_of(row.share->kind).title; }},
    {"class", "class", text(), "Whether it scatters at random or is not known better.",
     [](const ShareRow& row) { return study::traits_of(row.share->kind).of_class; }},
    {"raised", "critical gap towards ignition", text(), "Critical gap with the cause at its worse end.",
     [](const ShareRow& row) { return gap_text(row.share->raised); }},
    {"lowered", "at the other end", text(), "Critical gap with the cause at its better end.",
     [](const ShareRow& row) { return gap_text(row.share->lowered); }},
    {"lowers", "lowers the bound by", keys::significant(2, centimetre),
     "By how much the cause moves the critical gap towards ignition.",
     [](const ShareRow& row) { return study::move_towards_ignition(row.of->gap->lower, *row.share); }}};

}  // namespace

Quantities<study::GapVerdict> verdict_quantities(const study::Study& study) {
  using study::GapVerdict, study::Judgement, study::NamedIgnition, study::Peak, study::Uncertainty,
      surface::AirEnergy;
  using namespace quantity;
  return {
      {temperature_max, &GapVerdict::maximum, &Peak::temperature},
      {temperature_max_place, &GapVerdict::maximum, &Peak::point},
      {temperature_max_time, &GapVerdict::maximum, &Peak::time},
      {temperature_early(study.early_time), &GapVerdict::early, &Peak::temperature},
      {for_programs(Column{"spread", "spread", fixed(1, kelvin),
                           "Hottest less coldest station at the end of what is read."}),
       &GapVerdict::spread},
      {always({"margin", "margin", fixed(2, kelvin), "Ignition temperature less T max."}),
       &GapVerdict::margin},
      {always(uncertainty), &GapVerdict::uncertainty, &Uncertainty::total},
      {share_of_uncertainty("computation", "of computation",
                            "Of it: sampling, integration, mesh, step, scaling, and sliding on the base."),
       &GapVerdict::uncertainty, &Uncertainty::computed},
      {share_of_uncertainty("fit", "of fit", "Of it: how well the calibrated constants are known."),
       &GapVerdict::uncertainty, &Uncertainty::fit},
      {share_of_uncertainty("inputs", "of inputs", "Of it: how well load, gap and others are known."),
       &GapVerdict::uncertainty, &Uncertainty::inputs},
      {share_of_uncertainty("model_form", "of model form",
                            "Share by which launches under other constants move towards ignition."),
       &GapVerdict::uncertainty, &Uncertainty::model_form},
      {verdict, &GapVerdict::judgement, &Judgement::verdict},
      {reason, study::reason_text},
      {for_programs(reason_code), &GapVerdict::judgement, &Judgement::code},
      evidence_quantity("cause", study::cause_text, "The beginning of the reason: what decided."),
      evidence_quantity("validity_warnings", study::validity_warnings_text,
                        "Why a completed run is no basis."),
      evidence_quantity("unaccepted", of_input<study::unaccepted_text>,
                        "What is not plausible, or foreign to the calibration, and nobody accepts."),
      evidence_quantity("accepted", of_input<study::accepted_text>,
                        "What somebody accepts of that, and why."),
      evidence_quantity("limited", study::limiters_text, "Limiters that acted."),
      evidence_quantity("failed_models", study::failed_models_text,
                        "Launches under other constants that failed."),
      evidence_quantity("extrapolated", study::extrapolated_text,
                        "What lies outside the domain of the calibration."),
      {for_people(Column{"ignition", "ignition", text(), "Cause, instant and station of ignition."}),
       &GapVerdict::ignition,
       [](const NamedIgnition& ignition) {
         return fmt::format("{} at {}, {}", study::to_string(ignition.cause),
                            in_words(ignition.time, quantity::ignition_time.form), ignition.point);
       }},
      {for_programs(Column{"ignition_cause", "ignition cause", text(), "What began it."}),
       &GapVerdict::ignition, [](const NamedIgnition& ignition) { return study::to_string(ignition.cause); }},
      {for_programs(ignition_time), &GapVerdict::ignition, &NamedIgnition::time},
      {for_programs(Column{"ignition_place", "ignition at", text(), "Station that ignites."}),
       &GapVerdict::ignition, &NamedIgnition::point},
      {for_programs(Column{"ignition_chemical_share", "chemical share", fixed(3),
                           "Share of reaction in the heating rate at ignition."}),
       &GapVerdict::ignition, &NamedIgnition::chemical_share},
      {for_programs(skin_took), &GapVerdict::air, &AirEnergy::taken},
      {for_programs(compression_supplies), &GapVerdict::air, &AirEnergy::supplied},
      {for_programs(taken_over_supplied), &GapVerdict::air, &AirEnergy::ratio}};
}

Quantities<study::CriticalGap> critical_gap_quantities() {
  using study::CriticalGap, keys::significant;
  return {{for_programs(quantity::critical_gap_kind), &CriticalGap::kind},
          {for_programs(quantity::critical_gap), value_of},
          {quantity::critical_gap_reads_as, reads_as},
          {for_programs(Column{"critical_gap_lower", "no ignition", significant(6, centimetre),
                               "Lower end of the bracket: the largest gap there that does not ignite."}),
           &CriticalGap::lower},
          {for_programs(Column{"critical_gap_upper", "ignites", significant(6, centimetre),
                               "Upper end of the bracket: the smallest gap there that ignites."}),
           &CriticalGap::upper}};
}

Quantities<study::CriticalGap> bounded_gap_quantities() {
  return keys::joined<study::CriticalGap>(
      {critical_gap_quantities(),
       {{"critical_gap_at_least", "at least", keys::significant(3, centimetre),
         "Lower bound of the critical gap: what is below it is SAFE.", &study::CriticalGap::bounds,
         &study::GapBounds::at_least},
        {"critical_gap_at_most", "at most", keys::significant(3, centimetre),
         "Upper bound of the critical gap.", &study::CriticalGap::bounds, &study::GapBounds::at_most},
        {for_programs(Column{"critical_gap_with_bounds", "critical gap with its bounds", text(),
                             "How it is quoted, in digits that its bounds bear."}),
         measured_text}}});
}

std::vector<std::string> mesh_notes(const study::StudyFile& study) {
  const auto numerical = study::numerical_uncertainty_of(study);
  Row facts{{"assumed", numerical.assumed}, {"largest_K", numerical.largest}, {"source", numerical.source}};
  for (const study::StatedUncertainty& each : study.study.stated)
    facts["stated"].push_back({{"first", facts["stated"].empty()},
                               {"key", each.key},
                               {"K", each.value},
                               {"assumed_K", each.assumed},
                               {"because", each.because}});
  facts["no_models"] = study.study.kind.gives_verdicts && study.study.models.empty();
  add_off_grid(study, facts);
  // What nobody accepts, as a file would say it; the first where many cases have values of their own.
  constexpr std::size_t most_entries = 12;
  auto [accepted, missing, unneeded, extrapolated] = study::acceptances_of(study);
  facts["unneeded"] = unneeded;
  facts["missing_count"] = missing.size();
  facts["missing_more"] = missing.size() > most_entries;
  missing.resize(std::min(missing.size(), most_entries));
  if (!missing.empty()) facts["missing"] = "\n" + scene::acceptances_to_write(missing);
  return noted("mesh", facts);
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

std::string gap_text(study::GapOrBound gap) {
  if (std::isnan(gap)) return "not known";
  if (gap == study::no_ignition) return "no ignition";
  return gap > 0.0 ? in_words(gap, keys::significant(4, centimetre)) : "ignites without a gap";
}

double value_of(const study::CriticalGap& gap) {
  return gap.kind == study::CriticalGapKind::value ? gap.value : study::not_a_number;
}

std::string reads_as(const study::CriticalGap& gap) {
  using enum study::CriticalGapKind;
  if (gap.kind == value) return in_words(gap.value, keys::significant(3, centimetre));
  if (gap.kind == all_safe) return "> " + centimetres(gap.lower);
  if (gap.kind == all_ignite) return gap.upper > 0 ? "< " + centimetres(gap.upper) : "ignites without a gap";
  if (gap.kind == several_crossings) return "several, the first at " + centimetres(gap.lower);
  if (std::isnan(gap.indicative)) return "indeterminate";
  return fmt::format("indeterminate (indicative: {})", gap.indicative == study::no_ignition
                                                           ? "none up to the end of the search"
                                                           : gap_text(gap.indicative));
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

std::optional<Measured> measured_gap(const study::CriticalGap& gap) {
  const Form form = quantity::critical_gap.form;
  return measured_gap(shown_value(value_of(gap), form), shown_value(gap.bounds.at_least, form),
                      shown_value(gap.bounds.at_most, form));
}

std::string measured_text(const study::CriticalGap& gap) {
  const auto known = measured_gap(gap);
  return known ? known->text(quantity::critical_gap.form.unit) : reads_as(gap);
}

Table gap_share_table(const std::vector<NamedGap>& cases) {
  std::vector<ShareRow> rows;
  for (const NamedGap& each : cases)
    for (const study::GapShare& share : each.gap->shares) rows.push_back({&each, &share});
  return table_of("What makes the critical gap uncertain", share_quantities, rows,
                  noted("gap_shares", {{"coverage", study::coverage_factor}}));
}

study::Use use_of(const std::shared_ptr<const scene::Constants>& constants, double gap, double published) {
  const auto is_it = [&](const scene::FittedNumber& row) {
    return row.is_fitted && std::abs(row.gap - gap) <= 1e-9 && study::same_number(row.published, published);
  };
  const bool is_fitted = constants != nullptr && std::ranges::any_of(constants->rows, is_it);
  return is_fitted ? study::Use::fitted : study::Use::check;
}

}  // namespace launchsafe::report
