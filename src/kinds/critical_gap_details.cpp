// What a critical-gap study in detail has besides: coupled runs, answers on other terms, causes, fits, runs.
#include "critical_gap_tables.hpp"
#include "launchsafe/report/case_tables.hpp"

namespace launchsafe::kinds {

using study::AsCalibrated, study::Confirmation, study::Line, study::ModelGap;

namespace {

/// One gap of a case with one constant as calibrated.
struct CalibratedRow {
  const CaseOutcome* outcome;
  const GapVerdict* gap;
  const AsCalibrated* constant;
};

const Quantities<CalibratedRow> calibrated_quantities{
    {quantity::case_name, &CalibratedRow::outcome, &CaseOutcome::input, &StudyCase::label},
    {quantity::gap, &CalibratedRow::gap, &GapVerdict::gap},
    {quantity::verdict, &CalibratedRow::gap, &GapVerdict::judgement, &study::Judgement::verdict},
    {"key", "constant", text(), "The constant that is put back.",
     [](const CalibratedRow& row) {
       return row.constant->key.empty() ? "all of gap and friction" : row.constant->key;
     }},
    {quantity::temperature_max,
     [](const CalibratedRow& row) { return report::known(row.gap->maximum.temperature); }},
    {"temperature_max_as_calibrated", "T max, as calibrated", fixed(1, kelvin),
     "Highest temperature with that constant as calibrated.", &CalibratedRow::constant,
     &AsCalibrated::temperature},
    {"ignites", "ignites then", text(), "Whether the gap ignites with it.", &CalibratedRow::constant,
     &AsCalibrated::ignites}};

std::string ignition_word(bool ignites) { return ignites ? "ignites" : "does not ignite"; }

std::string outcome_word(const Confirmation& each) {
  return each.completed ? ignition_word(each.ignited) : "failed";
}

const Quantities<CaseOutcome> case_quantities{{quantity::case_name, &CaseOutcome::input, &StudyCase::label}};

const auto coupled_quantities = with_whole(
    case_quantities,
    Quantities<Confirmation>{{quantity::gap, &Confirmation::gap},
                             {"expected", "expected", text(), "What the bracket says of the gap.",
                              [](const Confirmation& run) { return ignition_word(run.expected_ignition); }},
                             {"outcome", "outcome", text(), "What the coupled run did.", outcome_word},
                             {quantity::temperature_max,
                              [](const Confirmation& run) { return report::known(run.maximum_temperature); }},
                             {quantity::reason, &Confirmation::failure}});

const auto line_quantities = with_whole(
    case_quantities,
    Quantities<Line>{
        {"line", "line", text(), "Which line it is.", &Line::name},
        {"slope", "slope", fixed(1, keys::kelvin_per_centimetre), "Rise of T max over the gap.",
         &Line::slope},
        {"slope_standard_error", "standard error", fixed(1, keys::kelvin_per_centimetre),
         "Standard error of the slope by least squares.", &Line::slope_error},
        {"intercept", "intercept", fixed(3, kelvin), "T max without a gap.", &Line::intercept},
        {"intercept_standard_error", "standard error", fixed(2, kelvin),
         "Standard error of the intercept by least squares.", &Line::intercept_error},
        {"rms", "RMS", fixed(2, kelvin), "Root mean square of the residuals.", &Line::root_mean_square}});

const auto model_rows = with_whole(
    case_quantities,
    Quantities<ModelGap>{{"model", "constants", text(), "Other constants of the launch.", &ModelGap::name},
                         {"critical_gap_of_model", "critical gap", text(), "Critical gap under them.",
                          [](const ModelGap& model) { return report::gap_text(model.critical_gap); }},
                         {quantity::reason, &ModelGap::failure}});

Table as_calibrated_table(const CriticalGapResult& result) {
  std::vector<CalibratedRow> rows;
  for (const CaseOutcome& outcome : result.details)
    for (const GapVerdict& gap : outcome.verdicts)
      for (const AsCalibrated& each : gap.as_calibrated) rows.push_back({&outcome, &gap, &each});
  return table_of("With constants of the surface as calibrated", calibrated_quantities, rows,
                  said("critical_gap.note.as_calibrated"));
}

Table fit_table(const CriticalGapResult& result) {
  return table_of("T max = intercept + slope * gap over the rows that do not ignite", line_quantities,
                  parts_of<Line>(result.details, &CaseOutcome::lines));
}

Table run_table(const CriticalGapResult& result) {
  return report::run_table(of_each(result.details, [](const CaseOutcome& outcome) {
    const std::string stored = outcome.completed() ? "cases/" + outcome.hash + ".h5" : "";
    return report::NamedRun{outcome.input.label, outcome.failure, &outcome.result.mechanics, stored};
  }));
}

bool is_within_bounds(const CaseOutcome& outcome, const GapVerdict& row) {
  return row.judgement.verdict == Verdict::indeterminate && !row.ignition && outcome.completed() &&
         row.of_case->validity_warnings.empty() && !row.of_case->input.has_unaccepted();
}

/// Which gaps lie between the lower bound of the critical gap and ignition, and what lowers that bound most.
std::string undecided_text(const CriticalGapResult& result) {
  Row facts{{"several", result.details.size() > 1}, {"undecided", Row::array()}};
  for (const CaseOutcome& outcome : result.details) {
    const CriticalGap& gap = outcome.critical;
    Row row{{"case", outcome.input.label}, {"at_least", centimetres(gap.bounds.at_least)}};
    for (const GapVerdict& each : outcome.verdicts)
      if (is_within_bounds(outcome, each)) row["gaps"].push_back(centimetres(each.gap));
    if (!row.contains("gaps")) continue;
    const auto moves = [&](const study::GapShare& share) { return move_towards_ignition(gap.lower, share); };
    if (const auto largest = std::ranges::max_element(gap.shares, {}, moves); largest != gap.shares.end())
      row.update({{"moves", centimetres(moves(*largest))},
                  {"cause", traits_of(largest->kind).title},
                  {"remedy", traits_of(largest->kind).remedy}});
    facts["undecided"].push_back(std::move(row));
  }
  const std::string text = said_below("critical_gap.undecided", facts);
  return text.empty() ? text : "## What keeps rows undecided\n\n" + text;
}

std::vector<ReportTable> detail_tables(const CriticalGapResult& result) {
  const auto cases = of_each(result.details, [](const CaseOutcome& outcome) {
    return report::NamedGap{outcome.input.label, &outcome.critical};
  });
  return {{as_calibrated_table(result), "", "as_calibrated", Shown::page},
          {table_of("Other models", model_rows, parts_of<ModelGap>(result.details, &CaseOutcome::models)), "",
           "other_models", Shown::page},
          {report::gap_share_table(cases), "", "gap_shares", Shown::page},
          {fit_table(result), "", "fit"}};
}

}  // namespace

Table coupled_run_table(const CriticalGapResult& result) {
  const auto rows = parts_of<Confirmation>(result.details, &CaseOutcome::confirmations);
  Table table = table_of("Coupled runs, on through combustion where they ignite", coupled_quantities, rows);
  const auto burnt = std::ranges::find_if(rows, [](const auto& row) { return bool(row.part->combustion); });
  if (burnt == rows.end()) return table;
  const Scene& scene = burnt->whole->input.scene.scene;
  for (const std::string& warning : run::combustion_validity_warnings(scene, *burnt->part->combustion))
    table.notes.push_back(fmt::format("What follows ignition is indicative: {}.", warning));
  return table;
}

std::string limiter_remark(const CriticalGapResult& result) {
  Row runs = Row::array();
  for (const CaseOutcome& outcome : result.details)
    runs.push_back({{"case", outcome.input.label},
                    {"limiters", report::limiters_text(outcome.result.mechanics.limiters)}});
  return said_below("critical_gap.limiters", {{"runs", runs}});
}

void add_details(const CriticalGapResult& result, Report& report) {
  for (ReportTable& table : detail_tables(result)) report.add(std::move(table));
  report.say(undecided_text(result));
}

void add_runs(const CriticalGapResult& result, Report& report) {
  report.add({run_table(result), "", "runs"});
  report.say(report::timing_sentence(result.timing));
}

std::vector<ReportTable> detail_results() {
  std::vector<ReportTable> all{{coupled_run_table({}), "", "coupled_runs"}};
  std::ranges::move(detail_tables({}), std::back_inserter(all));
  all.push_back({run_table(CriticalGapResult()), "", "runs"});
  return all;
}

}  // namespace launchsafe::kinds
