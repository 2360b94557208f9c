// What a critical-gap study in detail has besides: coupled runs, causes, fits, runs.
#include "critical_gap_tables.hpp"
#include "launchsafe/report/case_tables.hpp"

namespace launchsafe::kinds {

using study::CauseShare, study::CauseTraits, study::Confirmation, study::Line;

namespace {

std::string ignition_word(bool ignites) { return ignites ? "ignites" : "does not ignite"; }

std::string outcome_word(const Confirmation& each) {
  return each.completed ? ignition_word(each.ignited) : "failed";
}

const Quantities<CaseInDetail> name_quantities{
    {quantity::case_name, &CaseInDetail::input, &StudyCase::label}};

const auto coupled_quantities = with_whole(
    name_quantities,
    Quantities<Confirmation>{{quantity::gap, &Confirmation::gap},
                             {"expected", "expected", text(), "Whether the critical gap lies below the gap.",
                              [](const Confirmation& run) { return ignition_word(run.expected_ignition); }},
                             {"outcome", "outcome", text(), "What the coupled run did.", outcome_word},
                             {quantity::temperature_max,
                              [](const Confirmation& run) { return report::known(run.maximum_temperature); }},
                             {quantity::reason, &Confirmation::failure}});

const auto cause_quantities = with_whole(
    name_quantities,
    Quantities<CauseShare>{
        {"cause", "cause", text(), "What makes the critical gap uncertain.", &CauseShare::cause,
         study::traits_of, &CauseTraits::title},
        {"class", "class", text(), "random: differs from launch to launch; bound: unknown, but fixed.",
         [](const CauseShare& share) -> std::string {
           return study::traits_of(share.cause).random ? "random" : "bound";
         }},
        {quantity::shorter, &CauseShare::shorter},
        {quantity::longer, &CauseShare::longer},
        {report::for_programs(Column{"remedy", "remedy", text(), "What would make the share smaller."}),
         &CauseShare::cause, study::traits_of, &CauseTraits::remedy}});

const auto line_quantities = with_whole(
    name_quantities,
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

Table fit_table(const CriticalGapResult& result) {
  return table_of("T max = intercept + slope * gap over the rows that do not ignite", line_quantities,
                  parts_of<Line>(result.details, &CaseInDetail::lines));
}

Table run_table(const CriticalGapResult& result) {
  return report::run_table(of_each(result.details, [](const CaseInDetail& each) {
    const std::string stored = each.completed() ? "cases/" + each.hash + ".h5" : "";
    return report::NamedRun{each.input.label, each.failure, &each.result.mechanics, stored};
  }));
}

/// The causes of all cases; the notes name the cause that lowers the bound of each case most.
Table cause_table(const CriticalGapResult& result) {
  Table table = table_of(
      "What makes the critical gap uncertain", cause_quantities,
      parts_of<CauseShare>(result.details, &CaseInDetail::causes),
      {"Each cause is computed on this launch alone. The bounds are the critical gap less, or plus, the "
       "root of the sum of squares of the random causes, and the sum of the others."});
  for (const CaseInDetail& each : result.details) {
    const auto largest = std::ranges::max_element(each.causes, {}, &study::CauseShare::shorter);
    if (largest != each.causes.end() && largest->shorter > 0.0)
      table.notes.push_back(fmt::format("Largest cause in {}: {} ({}).", each.input.label,
                                        traits_of(largest->cause).title,
                                        in_words(largest->shorter, quantity::shorter.form)));
  }
  return table;
}

}  // namespace

Table coupled_run_table(const CriticalGapResult& result) {
  const auto rows = parts_of<Confirmation>(result.details, &CaseInDetail::confirmations);
  Table table = table_of("Coupled runs, on through combustion where they ignite", coupled_quantities, rows);
  const auto burnt = std::ranges::find_if(rows, [](const auto& row) { return bool(row.part->combustion); });
  if (burnt == rows.end()) return table;
  const Scene& scene = burnt->whole->input.scene.scene;
  for (const std::string& warning : run::combustion_validity_warnings(scene, *burnt->part->combustion))
    table.notes.push_back(fmt::format("What follows ignition is indicative: {}.", warning));
  return table;
}

std::string limiter_remark(const CriticalGapResult& result) {
  std::string text;
  for (const CaseInDetail& each : result.details)
    if (const run::LimiterCounts& limiters = each.result.mechanics.limiters; limiters.acted())
      text += fmt::format("Limiters acted in {} ({} particle steps); its verdicts rest on them too.\n",
                          each.input.label, report::limiters_text(limiters));
  return text;
}

void add_details(const CriticalGapResult& result, Report& report) {
  report.add({cause_table(result), "", "causes", Shown::page});
  report.add({fit_table(result), "", "fit"});
}

void add_runs(const CriticalGapResult& result, Report& report) {
  report.add({run_table(result), "", "runs"});
  report.say("This computation " + report::timing_text(result.timing) + ".\n");
}

std::vector<ReportTable> detail_results() {
  return {{coupled_run_table({}), "", "coupled_runs"},
          {cause_table({}), "", "causes"},
          {fit_table({}), "", "fit"},
          {run_table({}), "", "runs"}};
}

}  // namespace launchsafe::kinds
