// The tables of a critical-gap study.
#include "critical_gap_marks.hpp"
#include "launchsafe/kinds/critical_gap.hpp"
#include "launchsafe/report/case_tables.hpp"
#include "launchsafe/report/kinetics_text.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/report/verdict_text.hpp"
#include "launchsafe/scene/launch_end.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::kinds {

using namespace study;
using namespace report;
namespace {

/// What the published temperature at the early time was used for.
std::string early_used_for(const study::Reference& published) {
  using enum study::Use;
  if (!std::isfinite(published.early_temperature)) return {};
  return to_string(published.calibrated ? fitted : published.selection ? chosen_by : held_out);
}

/// Computed minus published (K) of a calibrated row above which the scene's constants are not those of its
/// calibration.
constexpr double calibration_slack = 0.5;

using keys::fixed, keys::scientific, keys::text;

/// A row that stands beside a published one.
using ComparedRow = const GapVerdict*;

Column published(Column computed) {
  return {computed.name + "_published", "published", computed.form, "What was published of it.",
          computed.audience};
}

Column published_place(Column computed) {
  return {computed.name + "_published_place", "published at", text(), "Where that was published to be."};
}

Column difference_of(Column computed) {
  return {computed.name + "_computed_minus_published", "computed - published", computed.form,
          "Computed minus published; none where either ignited."};
}

Quantities<ComparedRow> comparison_quantities(double early_time) {
  using namespace quantity;
  const Column early = temperature_early(early_time);
  return {
      {gap(), &GapVerdict::gap},
      {used_for(), &GapVerdict::reference, report::used_for},
      {temperature_max(), [](ComparedRow row) { return row->until_exit.temperature; }},
      {published(temperature_max()), &GapVerdict::reference, &study::Reference::maximum_temperature},
      {difference_of(temperature_max()), &GapVerdict::misfit},
      {temperature_max_place(), [](ComparedRow row) { return row->until_exit.point; }},
      {published_place(temperature_max()), &GapVerdict::reference, &study::Reference::point},
      {{"temperature_early_used_for", "used for at " + milliseconds(early_time), text(),
        "The same of the temperature at early_time."},
       &GapVerdict::reference,
       early_used_for},
      {early, [](ComparedRow row) { return row->early.temperature; }},
      {published(early), &GapVerdict::reference, &study::Reference::early_temperature},
      {difference_of(early), &GapVerdict::early_misfit},
      {temperature_early_place(), [](ComparedRow row) { return row->early.point; }},
      {published_place(early), &GapVerdict::reference, &study::Reference::early_point},
      {ignition_time(), [](ComparedRow row) { return row->ignition ? row->ignition->time : not_a_number; }},
      {published(ignition_time()), &GapVerdict::reference, &study::Reference::ignition_time}};
}

Quantities<VerdictRow> judged_gap_quantities(const study::Study& study) {
  using namespace quantity;
  return keys::joined<VerdictRow>({{{gap(), &VerdictRow::width},
                                    {peak_pressure(), &VerdictRow::input, &study::StudyCase::peak_pressure},
                                    {crack_radius(), &VerdictRow::input, &study::StudyCase::crack_radius},
                                    {flaw_size(), &VerdictRow::input, &study::StudyCase::flaw_size}},
                                   verdict_quantities(study)});
}

}  // namespace

Table verdict_table(const CriticalGapResult& result) {
  std::vector<VerdictRow> rows;
  for (const CaseOutcome& outcome : result.cases)
    for (const GapVerdict& row : outcome.verdicts) rows.push_back({&outcome.input, &row, row.heated});
  Table table = table_of("Verdicts", judged_gap_quantities(result.study.study), rows);
  table.notes = mesh_notes(result.study);
  table.notes.push_back(station_note(result.study));
  return table;
}

Table comparison_table(const CriticalGapResult& result) {
  std::vector<ComparedRow> rows;
  bool ignited = false;
  double worst = 0;  // |computed - published| of a calibrated row, K
  for (const CaseOutcome& outcome : result.cases) {
    for (const GapVerdict& row : outcome.verdicts) {
      if (!row.reference) continue;
      ignited = ignited || row.reference->ignited() || row.ignition;
      if (row.reference->calibrated)
        worst = std::max(worst, std::isfinite(row.misfit()) ? std::abs(row.misfit()) : HUGE_VAL);
      rows.push_back(&row);
    }
  }
  Table table =
      table_of("Against the published results", comparison_quantities(result.study.study.early_time), rows);
  table.notes.push_back(
      "Fitted: the load or constants were fitted to it. Chosen by: it was seen when a form of the model was "
      "picked, and is no prediction. Held out: a prediction.");
  if (!(worst <= calibration_slack)) {
    table.notes.push_back(fmt::format(
        "The scene's constants do not meet the calibrated rows ({}): they belong to other settings, and no "
        "row here counts as calibrated.",
        std::isfinite(worst) ? "computed - published: " + in_words(worst, fixed(1, kelvin))
                             : std::string("one of them ignites")));
  }
  if (ignited) {
    table.notes.push_back(
        "After ignition T max is that of the burning skin; it is not compared. Whether and when the largest "
        "published gap that is safe and the smallest that ignites do so is calibrated: the ignition "
        "temperature was set between them.");
  }
  return table;
}

namespace {

std::string ignition_word(bool ignites) { return ignites ? "ignites" : "does not ignite"; }

std::string outcome_word(const Confirmation& each) {
  return each.completed ? ignition_word(each.ignited) : "failed";
}

std::string confirmation_text(const CaseOutcome& outcome) {
  if (outcome.confirmations.empty()) return "not confirmed";
  std::string text;
  for (const study::Confirmation& each : outcome.confirmations)
    text += fmt::format("{}{} {}", text.empty() ? "" : "; ", centimetres(each.gap), outcome_word(each));
  return text;
}

}  // namespace

namespace {

using NamedOutcome = const CaseOutcome*;

Quantities<NamedOutcome> judged_case_quantities() {
  return keys::joined<NamedOutcome>(
      {{{quantity::case_name(), &CaseOutcome::input, &StudyCase::label}},
       of_part<NamedOutcome>(bounded_gap_quantities(), &CaseOutcome::critical),
       {{for_programs(Column{"coupled_runs", "coupled runs", text(),
                             "What the coupled runs on both sides of the bracket did."}),
         [](NamedOutcome outcome) { return confirmation_text(*outcome); }},
        {quantity::recorded_uncertainty(), &CaseOutcome::input, &StudyCase::recorded_uncertainty},
        {quantity::remark(), [](NamedOutcome outcome) { return to_string(outcome->critical.reason); }}}});
}

/// A coupled run of a case.
struct CoupledRow {
  NamedOutcome of;
  const Confirmation* run;
};

Quantities<CoupledRow> coupled_quantities() {
  return keys::joined<CoupledRow>(
      {{{quantity::case_name(), &CoupledRow::of, &CaseOutcome::input, &StudyCase::label},
        {quantity::gap(), &CoupledRow::run, &Confirmation::gap},
        {{"expected", "expected", text(), "What the bracket says of the gap."},
         [](const CoupledRow& row) { return ignition_word(row.run->expected_ignition); }},
        {{"outcome", "outcome", text(), "What the coupled run did."},
         [](const CoupledRow& row) { return outcome_word(*row.run); }},
        {quantity::temperature_max(),
         [](const CoupledRow& row) { return known(row.run->maximum_temperature); }},
        {{"coupled_minus_traced", "coupled - traced", scientific(1, kelvin),
          "T max of the coupled run less that on the trace; none where either ignited."},
         &CoupledRow::run,
         &Confirmation::difference}},
       of_part<CoupledRow>(burnt_state_quantities(), &CoupledRow::run,
                           [](const Confirmation& run) {
                             const auto& combustion = run.combustion;
                             return combustion && !combustion->burnt_mass.empty() ? &*combustion : nullptr;
                           }),
       {{quantity::reason(), &CoupledRow::run, &Confirmation::failure}}});
}

/// A gap of a case that also has an answer on other terms.
struct OtherRow {
  NamedOutcome of;
  std::size_t gap;
};

/// T max with and without those terms. `name`: of what stands beside the answer.
Quantities<OtherRow> other_quantities(Column usual, Column other,
                                      std::optional<OtherAnswer> CaseOutcome::*member) {
  return {
      {quantity::case_name(), &OtherRow::of, &CaseOutcome::input, &StudyCase::label},
      {quantity::gap(), [](const OtherRow& row) { return row.of->verdicts[row.gap].gap; }},
      {std::move(usual), [](const OtherRow& row) { return row.of->verdicts[row.gap].maximum.temperature; }},
      {std::move(other),
       [member](const OtherRow& row) { return (row.of->*member)->maximum_temperature.at(row.gap); }}};
}

Quantities<OtherRow> film_quantities() {
  return other_quantities({"temperature_max_reservoir", "T max, reservoir", fixed(1, kelvin),
                           "Highest temperature under the reservoir of air."},
                          {"temperature_max_film", "T max, film", fixed(1, kelvin),
                           "Highest temperature under the film of air: an optimistic bound."},
                          &CaseOutcome::film);
}

Quantities<OtherRow> longer_launch_quantities() {
  Quantities<OtherRow> quantities =
      other_quantities({"temperature_max_with_exit", "T max, muzzle exit", fixed(1, kelvin),
                        "Highest temperature with the muzzle exit."},
                       {"temperature_max_without_exit", "T max, without", fixed(1, kelvin),
                        "Highest temperature in a barrel without end."},
                       &CaseOutcome::longer_launch);
  quantities.emplace_back(for_programs(Column{"critical_gap_without_exit", "critical gap, without", text(),
                                              "Critical gap in a barrel without end, in words."}),
                          [](const OtherRow& row) { return reads_as(row.of->longer_launch->critical); });
  return quantities;
}

/// The rows of a case, and the note on its critical gap.
void add_other(const CaseOutcome& outcome, const OtherAnswer& other, const char* words,
               std::vector<OtherRow>& rows, std::vector<std::string>& notes) {
  for (std::size_t i = 0; i < outcome.verdicts.size(); ++i) rows.push_back({&outcome, i});
  notes.push_back(fmt::format(fmt::runtime(words), outcome.input.label, reads_as(outcome.critical),
                              reads_as(other.critical)));
}

}  // namespace

Table critical_gap_table(const CriticalGapResult& result) {
  std::vector<NamedOutcome> rows;
  for (const CaseOutcome& outcome : result.cases) rows.push_back(&outcome);
  return table_of("Critical gap", judged_case_quantities(), rows);
}

Table coupled_run_table(const CriticalGapResult& result) {
  std::vector<CoupledRow> rows;
  std::vector<std::string> notes;
  for (const CaseOutcome& outcome : result.cases)
    for (const Confirmation& each : outcome.confirmations) {
      rows.push_back({&outcome, &each});
      if (each.combustion && notes.empty()) notes = {flame_kinetics_note(outcome.input.scene.scene)};
    }
  Table table = table_of("Coupled runs, on through combustion where they ignite", coupled_quantities(), rows);
  table.notes = std::move(notes);
  return table;
}

Table air_energy_table(const CriticalGapResult& result) {
  std::vector<AuditedGap> gaps;
  for (const CaseOutcome& outcome : result.cases) {
    const std::string label = result.cases.size() > 1 ? outcome.input.label : std::string{};
    for (const GapVerdict& row : outcome.verdicts) gaps.push_back({label, row.gap, row.air});
  }
  return air_energy_table(result.study.scene.scene.surface.air_model, gaps);
}

Table air_model_table(const CriticalGapResult& result) {
  std::vector<OtherRow> rows;
  std::vector<std::string> notes;
  for (const CaseOutcome& outcome : result.cases)
    if (outcome.film)
      add_other(outcome, *outcome.film, "Critical gap, {}: {} with the reservoir, {} with the film.", rows,
                notes);
  if (!rows.empty())
    notes.emplace_back(
        "The film conserves energy and conducts into charge and base: an optimistic bound, on which no "
        "verdict rests. Its temperature is that of the hottest depth of the charge: the base cools the "
        "surface.");
  Table table = table_of("Under both models of the air", film_quantities(), rows);
  table.notes = std::move(notes);
  return table;
}

Table without_exit_table(const CriticalGapResult& result) {
  std::vector<OtherRow> rows;
  std::vector<std::string> notes;
  for (const CaseOutcome& outcome : result.cases)
    if (outcome.longer_launch && !scene::is_cut_short(outcome.input.scene.scene.load))
      add_other(outcome, *outcome.longer_launch, "Critical gap, {}: {} with the muzzle exit, {} without.",
                rows, notes);
  if (!rows.empty())
    notes.emplace_back(
        "Verdicts rest on the muzzle exit that the scene states. Without it the load goes on until it is "
        "below "
        "1 % of its peak: what the answer would be if the exit were wrong.");
  Table table = table_of("In a barrel without end", longer_launch_quantities(), rows);
  table.notes = std::move(notes);
  return table;
}

namespace {

/// A line over the gap; only that of least squares has errors.
struct FittedLine {
  std::string label, name;
  const study::Line* line;
  const math::LeastSquares* errors = nullptr;
};

Quantities<FittedLine> line_quantities(const std::vector<double>& gaps) {
  Quantities<FittedLine> quantities{
      {for_programs(quantity::case_name()), &FittedLine::label},
      {{"line", "line", text(), "Which line it is."}, &FittedLine::name},
      {{"slope", "slope", fixed(1, kelvin_per_centimetre), "Rise of T max over the gap."},
       &FittedLine::line,
       &study::Line::slope},
      {{"intercept", "intercept", fixed(3, kelvin), "T max without a gap."},
       &FittedLine::line,
       &study::Line::intercept},
      {{"rms", "RMS", fixed(2, kelvin), "Root mean square of the residuals."},
       &FittedLine::line,
       &study::Line::root_mean_square}};
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    const Form form = quantity::gap().form;
    quantities.emplace_back(
        Column{"residual_" + digits_of(gaps[i], form) + "_" + form.unit,
               "residual " + digits_of(gaps[i], form), fixed(2, kelvin), "T max at that gap less the line."},
        [i](const FittedLine& row) {
          return i < row.line->residuals.size() ? row.line->residuals[i] : not_a_number;
        });
  }
  return keys::joined<FittedLine>(
      {quantities,
       {{for_programs(Column{"slope_standard_error", "slope error", fixed(1, kelvin_per_centimetre),
                             "Standard error of the slope."}),
         &FittedLine::errors, [](const math::LeastSquares& fit) { return fit.standard_errors[1]; }},
        {for_programs(Column{"intercept_standard_error", "intercept error", fixed(2, kelvin),
                             "Standard error of the intercept."}),
         &FittedLine::errors, [](const math::LeastSquares& fit) { return fit.standard_errors[0]; }},
        {for_programs(Column{"r_squared", "R^2", fixed(5), "Share of the variance that the line explains."}),
         &FittedLine::errors, [](const math::LeastSquares& fit) { return fit.r_squared; }},
        {for_programs(Column{"residual_deviation", "residual deviation", fixed(2, kelvin),
                             "Standard deviation of the residuals."}),
         &FittedLine::errors, [](const math::LeastSquares& fit) { return fit.residual_deviation; }}}});
}

}  // namespace

Table fit_table(const CaseOutcome& outcome) {
  if (!outcome.fit) return {};
  const study::GapFit& fit = *outcome.fit;
  const auto& ols = fit.least_squares;
  const std::string& label = outcome.input.label;
  std::vector<FittedLine> rows{{label, "least squares", &fit.ordinary, &ols}};
  if (fit.mixed)
    rows.push_back({label, "its slope through the zero-gap row (the published form)", &*fit.mixed});
  if (fit.published) rows.push_back({label, "as published", &*fit.published});
  Table table = table_of("T max = intercept + slope * gap over the rows that do not ignite, " + label,
                         line_quantities(fit.gaps), rows);
  if (ols.degrees_of_freedom > 0) {
    table.notes.push_back(
        fmt::format("Least squares: slope {:.1f} +- {:.1f} K/cm, intercept {:.2f} +- {:.2f} K "
                    "(standard errors), R^2 {:.5f}, residual deviation {:.2f} K.",
                    ols.coefficients[1], ols.standard_errors[1], ols.coefficients[0], ols.standard_errors[0],
                    ols.r_squared, ols.residual_deviation));
  }
  return table;
}

Table run_table(const CriticalGapResult& result) {
  std::vector<NamedRun> runs;
  for (const CaseOutcome& outcome : result.cases)
    runs.push_back({outcome.input.label, outcome.failure, &outcome.result.mechanics,
                    outcome.completed() ? "cases/" + outcome.hash + ".h5" : std::string{}});
  return report::run_table(runs);
}

Table gap_share_table(const CriticalGapResult& result) {
  std::vector<NamedGap> cases;
  for (const CaseOutcome& outcome : result.cases) cases.push_back({outcome.input.label, &outcome.critical});
  return report::gap_share_table(cases);
}

Table cited_limit_table(const CriticalGapResult& result) {
  return report::cited_limit_table(result.study, critical_gaps_of(result.cases));
}

std::vector<ResultTable> critical_gap_results() {
  const study::Study study;
  return {{"verdicts", "verdicts.csv", keys::described(judged_gap_quantities(study))},
          {"comparison", "", keys::described(comparison_quantities(study.early_time))},
          {"cases", "", keys::described(judged_case_quantities())},
          {"coupled_runs", "", keys::described(coupled_quantities())},
          {"cited_limits", "", cited_limit_columns()},
          {"as_calibrated", "", as_calibrated_columns()},
          {"without_exit", "", keys::described(longer_launch_quantities())},
          {"air_models", "", keys::described(film_quantities())},
          {"air_energy", "", air_energy_columns()},
          {"gap_shares", "", gap_share_columns()},
          {"fit", "", keys::described(line_quantities({}))},
          {"runs", "", run_columns()}};
}

}  // namespace launchsafe::kinds
