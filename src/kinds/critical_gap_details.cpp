// What a critical-gap study in detail has besides: coupled runs, causes, fits, runs.
#include "critical_gap_tables.hpp"
#include "launchsafe/report/case_tables.hpp"

namespace launchsafe::kinds {

using study::Confirmation, study::Line;

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
  Table table = report::cause_table(of_each(result.details, [](const CaseInDetail& each) {
    return report::NamedCase{each.input.label, &each};
  }));
  Row facts{{"several", result.details.size() > 1}, {"cases", Row::array()}};
  for (const CaseInDetail& each : result.details) {
    const auto largest = std::ranges::max_element(each.causes, {}, &study::CauseShare::shorter);
    if (largest != each.causes.end() && largest->shorter > 0.0)
      facts["cases"].push_back({{"case", each.input.label},
                                {"cause", traits_of(largest->cause).title},
                                {"shorter_cm", shown_gap(largest->shorter)}});
  }
  std::ranges::move(said("critical_gap.note.cause", facts), std::back_inserter(table.notes));
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
  Row runs = Row::array();
  for (const CaseInDetail& each : result.details)
    runs.push_back(
        {{"case", each.input.label}, {"limiters", report::limiters_text(each.result.mechanics.limiters)}});
  return said_below("critical_gap.limiters", {{"runs", runs}});
}

void add_details(const CriticalGapResult& result, Report& report) {
  report.add({cause_table(result), "", "causes", Shown::page});
  report.add({fit_table(result), "", "fit"});
}

void add_runs(const CriticalGapResult& result, Report& report) {
  report.add({run_table(result), "", "runs"});
  report.say(report::timing_sentence(result.timing));
}

std::vector<ReportTable> detail_results() {
  return {{coupled_run_table({}), "", "coupled_runs"},
          {cause_table({}), "", "causes"},
          {fit_table({}), "", "fit"},
          {run_table({}), "", "runs"}};
}

}  // namespace launchsafe::kinds
