#include "launchsafe/study/case_rows.hpp"

#include "launchsafe/surface/after_launch.hpp"

namespace launchsafe::study {
namespace {

using trace::BottomTrace;

// --- what is accepted ---

std::string reason_of(const std::map<std::string, std::string>& reasons, const std::string& name) {
  const auto found = reasons.find(name);
  return found == reasons.end() ? std::string{} : found->second;
}

std::vector<Remark> warnings_of(const Study& study, const StudyCase& input,
                                const run::MechanicsResult& mechanics) {
  std::vector<run::Warning> warnings = run::validity_warnings(input.scene.scene, mechanics);
  if (study.kind.gives_verdicts)
    std::ranges::move(run::launch_warnings(input.scene.scene), std::back_inserter(warnings));
  return of_each(warnings, [&](const run::Warning& each) {
    const bool acceptable = run::is_acceptable(each.name);
    return Remark{each.name, each.text, acceptable,
                  acceptable ? reason_of(study.accepted_warnings, each.name) : std::string{}};
  });
}

/// Intervals of the constants that a case lies outside of. Without constants nothing says how wrong it is.
std::vector<Remark> extrapolations_of(const Study& study, const StudyCase& input) {
  if (!study.kind.gives_verdicts) return {};
  if (input.scene.constants == nullptr) return {{"constants", "none were fitted", false, {}}};
  return of_each(scene::outside_of_range(*input.scene.constants, input.scene.scene),
                 [&](const scene::OutsideOfRange& each) {
                   return Remark{
                       each.name, fmt::format("{}, fitted {}", each.found, each.allowed), each.acceptable,
                       each.acceptable ? reason_of(study.accepted_extrapolation, each.name) : std::string{}};
                 });
}

// --- one case ---

bool has_trace(const run::MechanicsResult& mechanics) { return mechanics.trace.samples() > 0; }

/// What a row needs of its case besides the trace.
struct RowDrawer {
  const Study& study;
  const StudyCase& input;
  const BottomTrace& trace;
  const CaseRow& of_case;
  const surface::SkinModel model = surface::skin_model(input.scene.scene);
  const BottomTrace annuli = trace::of_rings(trace);

  GapRow row_of(const run::GapResult& gap) const {
    const scene::Scene& scene = input.scene.scene;
    GapRow row;
    row.gap = gap.gap;
    row.maximum = peak_of(gap.at_stations, trace);
    const double read = scene::read_time(scene.load);
    row.until_exit = peak_of(surface::maximum_until(gap.skin, trace, read), trace);
    row.early = peak_of(surface::maximum_at_time(gap.skin, trace, study.early_time), trace);
    row.spread = surface::spread_at_time(gap.skin, trace, read);
    row.margin = scene.charge().kinetics.ignition_temperature - gap.at_stations.temperature;
    row.heated = heated_temperature(model, annuli, gap.gap);
    row.air = gap.air;
    row.ignition = named(gap.skin.ignition, trace);
    if (!study.kind.gives_verdicts) return row;
    row.uncertainty = uncertainty_of(row);
    if (!row.ignition)
      row.ignition_after_launch =
          surface::ignition_after_launch(model, gap.skin, trace, model.initial_temperature);
    return row;
  }

  /// K: how much hotter the skin of a gap is that is thicker by what the bounds leave below the critical gap.
  double uncertainty_of(const GapRow& row) const {
    const double thicker = of_case.critical.value - of_case.bounds.at_least;
    if (std::isnan(thicker)) return math::not_a_number;
    return heated_temperature(model, annuli, row.gap + thicker) - row.heated;
  }
};

void draw_gaps(const Study& study, CaseInDetail& drawn) {
  const BottomTrace& trace = drawn.result.mechanics.trace;
  const std::vector<double>& gaps = study.gaps.empty() ? drawn.input.scene.scene.surface.gaps : study.gaps;
  drawn.gaps.resize(gaps.size());
  for (std::size_t i = 0; i < gaps.size(); ++i) drawn.gaps[i].gap = gaps[i];
  if (!has_trace(drawn.result.mechanics)) return;
  const RowDrawer drawer{study, drawn.input, trace, drawn};
  drawn.result.gaps.resize(gaps.size());
  run_parts(gaps.size(), [&](std::size_t i) {
    drawn.result.gaps[i] = run::evaluate_gap(drawn.input.scene.scene, trace, gaps[i]);
    drawn.gaps[i] = drawer.row_of(drawn.result.gaps[i]);
  });
}

/// Puts the study's published rows beside those of a case under the study's own conditions.
void attach_references(const Study& study, const StudyCase& input, std::vector<GapRow>& gaps) {
  if (!input.own_conditions) return;
  for (GapRow& row : gaps) {
    const auto found = std::ranges::find_if(study.references, [&row](const Reference& reference) {
      return std::abs(reference.gap - row.gap) <= 1e-9;
    });
    if (found != study.references.end()) row.reference = *found;
  }
}

void judge_gaps(CaseRow& of_case) {
  for (GapRow& gap : of_case.gaps) gap.judgement = judge(of_case, gap);
}

std::vector<Line> lines_of(const CaseRow& of_case) {
  std::vector<double> gaps, temperatures;
  for (const GapRow& row : of_case.gaps) {
    if (row.ignition || !of_case.completed()) continue;
    gaps.push_back(row.gap);
    temperatures.push_back(row.maximum.temperature);
  }
  return fit_gaps(gaps, temperatures);
}

RunRow run_row_of(const run::MechanicsResult& mechanics) {
  return {mechanics.status, mechanics.steps, mechanics.particles, run::largest_energy_drift(mechanics),
          mechanics.limiters};
}

void find_critical_gap_of(const Study& study, const std::vector<FinishedRun>& runs, CaseInDetail& drawn) {
  const surface::IgnitionOfGaps ignites(surface::skin_model(drawn.input.scene.scene),
                                        drawn.result.mechanics.trace);
  drawn.critical = find_critical_gap(std::cref(ignites), study.end_of_search());
  if (!study.kind.gives_verdicts) return;
  drawn.models = gaps_of_models(study, drawn.input, runs, drawn.critical);
  drawn.incomplete = incomplete_launches(runs);
  drawn.causes = causes_of(study, drawn.input, runs, drawn.critical);
  if (drawn.incomplete.empty()) drawn.bounds = bounds_of(drawn.critical, drawn.causes);
}

CaseInDetail without_result(const Study& study, const StudyCase& input, RunOutcome outcome,
                            std::string failure) {
  CaseInDetail drawn;
  drawn.input = input;
  drawn.outcome = outcome;
  drawn.failure = std::move(failure);
  draw_gaps(study, drawn);
  attach_references(study, input, drawn.gaps);
  if (study.kind.gives_verdicts) judge_gaps(drawn);
  return drawn;
}

/// Draws the rows of all cases from their launches.
struct RowRunner {
  const StudyFile& study;
  const StudyOptions& options;
  Timing& timing;
  ProgressTracker& tracker;
  std::vector<CaseRuns> cases = case_runs(study, options.shard.count);
  std::vector<CaseRow> rows = std::vector<CaseRow>(study.cases.size());

  std::vector<CaseRow> draw_all() {
    run_cases(cases, options, tracker, timing,
              [&](std::size_t i, std::vector<FinishedRun>& runs) { draw_members(cases[i].members, runs); });
    return std::move(rows);
  }

  void draw_members(const std::vector<std::size_t>& members, std::vector<FinishedRun>& runs) {
    const FinishedRun* lacking = run_without_result(runs);
    // A study that was stopped, and a shard, report nothing: there may be a million such cases.
    const bool reports_nothing =
        stop_requested(options) || (lacking != nullptr && lacking->outcome == RunOutcome::other_shard);
    run_parts(members.size(), [&](std::size_t i) {
      CaseRow& row = rows[members[i]];
      if (!reports_nothing) {
        row = draw_row(study.study, study.cases[members[i]], runs);
        return;
      }
      row.outcome = lacking != nullptr ? lacking->outcome : RunOutcome::interrupted;
      row.failure = lacking != nullptr ? lacking->failure : "interrupted before its gaps were judged";
    });
    // Progress counts the case as left.
    if (std::ranges::any_of(members,
                            [&](std::size_t i) { return rows[i].outcome == RunOutcome::interrupted; }))
      runs.front().outcome = RunOutcome::interrupted;
  }
};

}  // namespace

CaseInDetail draw_case(const Study& study, const StudyCase& input, const std::vector<FinishedRun>& runs) {
  if (const FinishedRun* lacking = run_without_result(runs))
    return without_result(study, input, lacking->outcome, lacking->failure);
  const FinishedRun& own = runs.front();
  CaseInDetail drawn;
  drawn.input = input;
  drawn.outcome = own.outcome;
  drawn.failure = own.failure;
  drawn.hash = own.hash;
  drawn.result.mechanics = own.result.mechanics;
  drawn.run = run_row_of(own.result.mechanics);
  if (drawn.completed()) {
    drawn.warnings = warnings_of(study, input, own.result.mechanics);
    drawn.extrapolated = extrapolations_of(study, input);
    find_critical_gap_of(study, runs, drawn);
  }
  draw_gaps(study, drawn);
  attach_references(study, input, drawn.gaps);
  if (study.kind.gives_verdicts) judge_gaps(drawn);
  drawn.lines = lines_of(drawn);
  return drawn;
}

CaseRow draw_row(const Study& study, const StudyCase& input, const std::vector<FinishedRun>& runs) {
  if (run_without_result(runs) == nullptr && was_cut_off(runs.front())) {
    CaseRow row = without_result(study, input, runs.front().outcome, runs.front().failure);
    row.run.status = runs.front().result.mechanics.status;
    return row;
  }
  return draw_case(study, input, runs);
}

CaseRow draw_row(const Study& study, const StudyCase& input, const run::MechanicsResult& mechanics) {
  std::vector<FinishedRun> runs(1);
  runs.front().outcome = RunOutcome::ran;
  runs.front().failure = failure_of(mechanics);
  runs.front().result.mechanics = mechanics;
  return draw_case(study, input, runs);
}

void apply_confirmations(CaseInDetail& of_case) {
  for (const Confirmation& each : of_case.confirmations) {
    if (!each.ran || each.agrees()) continue;
    const std::string said = !each.completed ? "did not complete: " + each.failure
                             : each.ignited  ? "ignites"
                                             : "does not ignite";
    of_case.incomplete = fmt::format("the coupled run at {:.6g} cm {}", 100.0 * each.gap, said);
    of_case.bounds = {};
  }
  judge_gaps(of_case);
}

std::vector<CaseRow> draw_rows(const StudyFile& study, const StudyOptions& options, Timing& timing,
                               ProgressTracker& tracker) {
  return RowRunner{study, options, timing, tracker}.draw_all();
}

bool was_cut_off(const FinishedRun& run) {
  return run.outcome == RunOutcome::timed_out || run.outcome == RunOutcome::interrupted;
}

}  // namespace launchsafe::study
