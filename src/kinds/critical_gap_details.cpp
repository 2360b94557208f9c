// What a critical-gap study in detail has besides: coupled runs, answers on other terms, causes, fits, runs.
#include "critical_gap_tables.hpp"
#include "launchsafe/report/case_tables.hpp"

namespace launchsafe::kinds {

using keys::scientific;
using study::AsCalibrated, study::Confirmation, study::FittedCurve, study::GapFit, study::Line;

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
    joined<Confirmation>({{{quantity::gap, &Confirmation::gap},
                           {"expected", "expected", text(), "What the bracket says of the gap.",
                            [](const Confirmation& run) { return ignition_word(run.expected_ignition); }},
                           {"outcome", "outcome", text(), "What the coupled run did.", outcome_word},
                           {quantity::temperature_max,
                            [](const Confirmation& run) { return report::known(run.maximum_temperature); }},
                           {"coupled_minus_traced", "coupled - traced", scientific(1, kelvin),
                            "T max of the coupled run less that on the trace; none where either ignited.",
                            &Confirmation::difference}},
                          of_part<Confirmation>(report::burnt_state_quantities(),
                                                [](const Confirmation& run) {
                                                  const auto& combustion = run.combustion;
                                                  return combustion && !combustion->burnt_mass.empty()
                                                             ? &*combustion
                                                             : nullptr;
                                                }),
                          {{quantity::reason, &Confirmation::failure}}}));

/// A gap of a case that also has an answer under its longer launch.
struct LongerRow {
  const CaseOutcome* of;
  std::size_t gap;
};

Quantities<LongerRow> longer_launch_quantities() {
  return {{quantity::case_name, &LongerRow::of, &CaseOutcome::input, &StudyCase::label},
          {quantity::gap, [](const LongerRow& row) { return row.of->verdicts[row.gap].gap; }},
          {{"temperature_max_with_exit", "T max, muzzle exit", fixed(1, kelvin),
            "Highest temperature with the muzzle exit."},
           [](const LongerRow& row) { return row.of->verdicts[row.gap].maximum.temperature; }},
          {{"temperature_max_without_exit", "T max, without", fixed(1, kelvin),
            "Highest temperature in a barrel without end."},
           [](const LongerRow& row) { return row.of->longer_launch->maximum_temperature.at(row.gap); }},
          {for_programs(Column{"critical_gap_without_exit", "critical gap, without", text(),
                               "Critical gap in a barrel without end, in words."}),
           [](const LongerRow& row) { return reads_as(row.of->longer_launch->critical); }}};
}

/// A line over the gap; only that of least squares has errors.
struct FittedLine {
  const CaseOutcome* of;
  std::string name;
  const Line* line;
  const GapFit* fit = nullptr;
};

Quantities<FittedLine> line_quantities() {
  using keys::kelvin_per_centimetre, math::LeastSquares;
  const auto error = [](std::size_t coefficient) {
    return [coefficient](const GapFit& fit) { return fit.least_squares.standard_errors[coefficient]; };
  };
  const Quantities<Line> of_line{
      {"slope", "slope", fixed(1, kelvin_per_centimetre), "Rise of T max over the gap.", &Line::slope},
      {"intercept", "intercept", fixed(3, kelvin), "T max without a gap.", &Line::intercept},
      {"rms", "RMS", fixed(2, kelvin), "Root mean square of the residuals.", &Line::root_mean_square}};
  Quantities<GapFit> of_fit{
      {"slope_standard_error", "slope error", fixed(1, kelvin_per_centimetre), "Standard error of the slope.",
       error(1)},
      {"intercept_standard_error", "intercept error", fixed(2, kelvin), "Standard error of the intercept.",
       error(0)},
      {"r_squared", "R^2", fixed(5), "Share of the variance that the line explains.", &GapFit::least_squares,
       &LeastSquares::r_squared},
      {"residual_deviation", "residual deviation", fixed(2, kelvin), "Standard deviation of the residuals.",
       &GapFit::least_squares, &LeastSquares::residual_deviation},
      {"reaches_ignition", "reaches ignition at", significant(4, centimetre),
       "Gap at which the line reaches the ignition temperature.", &GapFit::reaches_ignition},
      {"reaches_ignition_half_width", "within", significant(2, centimetre),
       "Half the width of the band of 95 % there.", &GapFit::reaches_ignition_half_width}};
  for (auto& each : of_fit) each = for_programs(each);
  return joined<FittedLine>({{{quantity::case_name, &FittedLine::of, &CaseOutcome::input, &StudyCase::label},
                              {"line", "line", text(), "Which line it is.", &FittedLine::name}},
                             of_part<FittedLine>(of_line, &FittedLine::line),
                             of_part<FittedLine>(of_fit, &FittedLine::fit)});
}

/// A gap that does not ignite beside the lines through it and its neighbours.
struct FittedGap {
  const CaseOutcome* of;
  std::size_t gap;
  const GapFit& fit() const { return *of->fit; }
  double residual(const std::optional<Line>& line) const {
    return line ? line->residuals[gap] : not_a_number;
  }
};

const Quantities<FittedGap> fitted_row_quantities{
    {quantity::case_name, &FittedGap::of, &CaseOutcome::input, &StudyCase::label},
    {quantity::gap, [](const FittedGap& row) { return row.fit().gaps[row.gap]; }},
    {quantity::temperature_max, [](const FittedGap& row) { return row.fit().temperatures[row.gap]; }},
    {"residual", "less the line", fixed(2, kelvin), "T max less the line of least squares.",
     [](const FittedGap& row) { return row.residual(row.fit().ordinary); }},
    {"left_out", "less what the others predict", fixed(2, kelvin),
     "T max less the line of least squares through the other rows.",
     [](const FittedGap& row) { return row.fit().left_out[row.gap]; }},
    {"residual_mixed", "less the published form", fixed(2, kelvin),
     "T max less the line of that slope through the zero-gap row.",
     [](const FittedGap& row) { return row.residual(row.fit().mixed); }},
    {"residual_published", "less the published line", fixed(2, kelvin), "T max less the line as published.",
     [](const FittedGap& row) { return row.residual(row.fit().published); }}};

const auto curve_quantities = with_whole(
    case_quantities,
    Quantities<FittedCurve>{
        {"curve", "curve", text(), "What was fitted.", &FittedCurve::name},
        {"coefficients", "coefficients", count(), "How many it has.", &FittedCurve::coefficients},
        {"rms", "RMS", significant(2, kelvin), "Root mean square of the residuals.",
         &FittedCurve::root_mean_square},
        {"left_out_rms", "RMS left out", significant(2, kelvin),
         "The same of what each row is off the curve through the others.", &FittedCurve::left_out},
        {"aicc", "AICc", significant(3), "Akaike's criterion, corrected for few rows: less is better.",
         &FittedCurve::corrected_akaike}});

Table as_calibrated_table(const CriticalGapResult& result) {
  std::vector<CalibratedRow> rows;
  for (const CaseOutcome& outcome : result.details)
    for (const GapVerdict& gap : outcome.verdicts)
      for (const AsCalibrated& each : gap.as_calibrated) rows.push_back({&outcome, &gap, &each});
  return table_of("With constants of the surface as calibrated", calibrated_quantities, rows,
                  said("critical_gap.note.as_calibrated"));
}

Table air_energy_table(const CriticalGapResult& result) {
  std::vector<report::AuditedGap> gaps;
  for (const CaseOutcome& outcome : result.details) {
    const std::string label = result.details.size() > 1 ? outcome.input.label : std::string{};
    for (const GapVerdict& row : outcome.verdicts) gaps.push_back({label, row.gap, row.air});
  }
  if (gaps.empty()) return {.columns = report::air_energy_columns()};
  return report::air_energy_table(gaps);
}

Table longer_launch_table(const CriticalGapResult& result) {
  std::vector<LongerRow> rows;
  Row facts = Row::object();
  for (const CaseOutcome& outcome : result.details) {
    if (!outcome.longer_launch || scene::is_cut_short(outcome.input.scene.scene.load)) continue;
    for (std::size_t i = 0; i < outcome.verdicts.size(); ++i) rows.push_back({&outcome, i});
    facts["others"].push_back({{"case", outcome.input.label},
                               {"usual", reads_as(outcome.critical)},
                               {"other", reads_as(outcome.longer_launch->critical)}});
  }
  return table_of("In a barrel without end", longer_launch_quantities(), rows,
                  said("critical_gap.note.without_exit", facts));
}

Table fit_table(const CriticalGapResult& result) {
  std::vector<FittedLine> rows;
  for (const CaseOutcome& outcome : result.details) {
    if (!outcome.fit) continue;
    const GapFit& fit = *outcome.fit;
    rows.push_back({&outcome, "least squares", &fit.ordinary, &fit});
    if (fit.mixed)
      rows.push_back({&outcome, "its slope through the zero-gap row (the published form)", &*fit.mixed});
    if (fit.published) rows.push_back({&outcome, "as published", &*fit.published});
  }
  Row facts = Row::object();
  for (const FittedLine& row : rows) facts["lines"].push_back(json_of(line_quantities(), row));
  return table_of("T max = intercept + slope * gap over the rows that do not ignite", line_quantities(), rows,
                  said("critical_gap.note.fit", facts));
}

Table fitted_row_table(const CriticalGapResult& result) {
  std::vector<FittedGap> rows;
  for (const CaseOutcome& outcome : result.details)
    for (std::size_t i = 0; outcome.fit && i < outcome.fit->gaps.size(); ++i) rows.push_back({&outcome, i});
  return table_of("Rows against the lines", fitted_row_quantities, rows);
}

Table curve_table(const CriticalGapResult& result) {
  return table_of("Three curves through the rows that do not ignite", curve_quantities,
                  parts_of<FittedCurve>(result.details, [](const CaseOutcome& outcome) {
                    return outcome.fit ? std::span(outcome.fit->curves) : std::span<const FittedCurve>();
                  }));
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
          {longer_launch_table(result), "", "without_exit"},
          {air_energy_table(result), "", "air_energy"},
          {report::gap_share_table(cases), "", "gap_shares", Shown::page},
          {fit_table(result), "", "fit"},
          {fitted_row_table(result), "", "fit_rows", Shown::page},
          {curve_table(result), "", "fit_curves", Shown::page}};
}

}  // namespace

Table coupled_run_table(const CriticalGapResult& result) {
  const auto rows = parts_of<Confirmation>(result.details, &CaseOutcome::confirmations);
  Table table = table_of("Coupled runs, on through combustion where they ignite", coupled_quantities, rows);
  const auto burnt = std::ranges::find_if(rows, [](const auto& row) { return bool(row.part->combustion); });
  if (burnt == rows.end()) return table;
  const Scene& scene = burnt->whole->input.scene.scene;
  table.notes = {report::flame_kinetics_note(scene)};
  for (const std::string& warning : run::combustion_validity_warnings(scene, *burnt->part->combustion))
    table.notes.push_back(fmt::format("What follows ignition is indicative: {}.", warning));
  return table;
}

std::string confirmation_text(const CaseOutcome& outcome) {
  if (outcome.confirmations.empty()) return "not confirmed";
  const auto text = [](const Confirmation& each) { return centimetres(each.gap) + " " + outcome_word(each); };
  return fmt::format("{}", fmt::join(of_each(outcome.confirmations, text), "; "));
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
  for (const CaseOutcome& outcome : result.details) {
    Table faces = report::interface_table(outcome.result.mechanics);
    if (result.details.size() > 1) faces.title += ", " + outcome.input.label;
    report.add({.table = std::move(faces), .shown = Shown::page});
  }
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
