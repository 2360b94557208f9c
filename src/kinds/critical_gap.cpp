#include "critical_gap_tables.hpp"
#include "launchsafe/scene/plan.hpp"

namespace launchsafe::kinds {

using study::CaseRun, study::CaseRuns, study::Confirmation, study::PlannedRun, study::ProgressTracker;

namespace {

/// Of so many cases at the most a study is in detail (Study::in_detail): histories are kept, the longer
/// launch is run, and coupled runs confirm the critical gap unless the study says otherwise. A study of more
/// cases keeps their answers alone, unless it asks for confirmation.
constexpr std::size_t most_cases_in_detail = 6;

/// The coupled run that confirms a gap (m) of a case: "496 MPa, 30 µm, 1 mm, coupled at 0.04 cm". Journals
/// of stored studies name it so.
std::string label_with_skin(const CaseOutcome& outcome, double gap) {
  return fmt::format("{}, coupled at {}", outcome.input.label, centimetres(gap));
}

/// One case on its runs: the mechanics, and those under a raised load where there are.
CaseOutcome judged(const Study& study, const StudyCase& input, std::vector<FinishedRun> runs) {
  if (const FinishedRun* run = run_without_result(runs))
    return without_result(study, input, run->outcome, run->failure);
  CaseOutcome outcome;
  outcome.input = input;
  outcome.outcome = runs.front().outcome;
  outcome.failure = runs.front().failure;
  outcome.result.mechanics = std::move(runs.front().result.mechanics);
  if (runs.size() > 1 && outcome.completed()) {
    outcome.raised = std::move(runs[1].result.mechanics);
    outcome.raised->monitor.clear();
    outcome.raised->snapshots.clear();
  }
  evaluate(study, outcome);
  return outcome;
}

void take_confirmation(const CaseOutcome& outcome, const FinishedRun& run, Confirmation& confirmation) {
  confirmation.ran = true;
  confirmation.outcome = run.outcome;
  confirmation.failure = run.failure;
  const std::vector<run::GapResult>& gaps = run.result.gaps;
  if (!gaps.empty()) confirmation.combustion = gaps.front().combustion;
  // What breaks off by itself after it has ignited has ignited. How far a run that was cut off came depends
  // on the machine.
  const bool cut_off = run.outcome != RunOutcome::ran && run.outcome != RunOutcome::reused;
  if (!confirmation.failure.empty() && (cut_off || !confirmation.combustion)) return;
  if (gaps.empty() || !std::isfinite(gaps.front().at_stations.temperature)) {
    confirmation.failure = "its temperature is not a number";
    return;
  }
  confirmation.completed = true;
  confirmation.ignited = gaps.front().skin.ignition.has_value();
  confirmation.maximum_temperature = gaps.front().at_stations.temperature;
  const run::GapResult traced =
      run::evaluate_gap(outcome.input.scene.scene, outcome.result.mechanics.trace, confirmation.gap);
  if (!confirmation.ignited && !traced.skin.ignition)
    confirmation.difference = confirmation.maximum_temperature - traced.at_stations.temperature;
}

/// Particle updates of a longer launch from the last checkpoint before the reading of the launch `own` ends.
double cost_from(const Scene& own, const Scene& longer) {
  const double left =
      1.0 + 1.0 / scene::parts_of_launch - scene::read_time(own.load) / scene::end_time(longer.load);
  return left * study::cost_of(longer);
}

/// Lets a longer launch go on from a checkpoint of the case's own, where they are one launch up to its exit.
void go_on_from(const CaseOutcome& outcome, CaseRun& longer) {
  const Scene own = scene::mechanical_part(outcome.input.scene.scene);
  Scene same = longer.scene;
  same.load = own.load;
  if (!outcome.result.mechanics.checkpoints || scene::to_toml(same) != scene::to_toml(own)) return;
  longer.launch = &outcome.result.mechanics;
  longer.same_until = scene::read_time(own.load);
  longer.cost = cost_from(own, longer.scene);
}

/// Particle updates of the runs that follow those of some cases, as a rule: two that confirm the critical gap
/// of each, and their longer launch.
double following_cost(const StudyFile& study, const CaseRuns& runs, const PlannedRun& longer) {
  const Scene scene = study.cases[runs.members.front()].scene.scene;
  double cost = longer.make ? cost_from(scene, longer.make().scene) : 0.0;
  if (study.confirmations_per_case > 0)
    cost += static_cast<double>(study.confirmations_per_case * runs.members.size()) *
            continued_cost(study::skin_run(scene, study.study.largest_gap, {}));
  return cost;
}

/// Runs that go on from a launch which was computed, and what takes each.
struct FollowingRuns {
  using Taker = std::function<void(const FinishedRun&)>;
  CriticalGapResult& result;
  std::vector<PlannedRun> runs = {};
  std::vector<Taker> takers = {};

  /// Coupled runs on both sides of its bracket.
  void add_confirmations(CaseOutcome& outcome) {
    if (outcome.critical.kind != CriticalGapKind::value) return;
    outcome.confirmations = {{.gap = outcome.critical.lower},
                             {.gap = outcome.critical.upper, .expected_ignition = true}};
    for (std::size_t side = 0; side < 2; ++side) {
      const double gap = outcome.confirmations[side].gap;
      CaseRun run = study::skin_run(outcome.input.scene.scene, gap, label_with_skin(outcome, gap));
      run.launch = &outcome.result.mechanics;
      if (run.launch->checkpoints) run.cost = continued_cost(run);
      add(std::move(run), [&outcome, side](const FinishedRun& finished) {
        take_confirmation(outcome, finished, outcome.confirmations[side]);
      });
    }
  }

  /// The longer launch of cases that share it.
  void add_longer_launch(const PlannedRun& planned, const std::vector<std::size_t>& members) {
    const CaseOutcome& first = result.details[members.front()];
    if (!first.completed()) return;
    CaseRun run = planned.make();
    go_on_from(first, run);
    add(std::move(run), [this, members](const FinishedRun& finished) {
      MechanicsResult mechanics = finished.result.mechanics;
      if (!finished.has_result()) {
        mechanics.status = run::RunStatus::interrupted;
        mechanics.reason = finished.failure;
      }
      for (const std::size_t each : members)
        evaluate_longer_launch(result.study.study, mechanics, result.details[each]);
    });
  }

  void add(CaseRun run, Taker taker) {
    runs.push_back(planned_run(std::move(run)));
    takers.push_back(std::move(taker));
  }
};

void run_in_detail(CriticalGapResult& result, const StudyOptions& options) {
  const StudyFile& study = result.study;
  const bool confirm = study.confirmations_per_case > 0;
  ProgressTracker tracker(options.progress);
  result.details.resize(study.cases.size());
  std::vector<CaseRuns> runs = case_runs(study, options.shard.count, confirm);
  std::vector<PlannedRun> longer(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (study::with_longer_launch(study.cases[runs[i].members.front()].scene.scene)) {
      longer[i] = std::move(runs[i].runs.back());
      runs[i].runs.pop_back();
    }
  double foreseen = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) foreseen += following_cost(study, runs[i], longer[i]);
  tracker.expect(0, foreseen);
  run_cases(runs, options, tracker, result.timing, [&](std::size_t i, std::vector<FinishedRun>& finished) {
    const auto loads = neighbouring_loads(study, runs[i].members.front());
    if (loads) interpolate_raised_load(*loads, finished);
    for (const std::size_t member : runs[i].members) {
      result.details[member] = judged(study.study, study.cases[member], finished);
      result.details[member].hash = finished.front().hash;
    }
  });
  FollowingRuns following{result};
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (longer[i].make) following.add_longer_launch(longer[i], runs[i].members);
  if (confirm)
    std::ranges::for_each(result.details, [&](CaseOutcome& each) { following.add_confirmations(each); });
  tracker.begin(study::Phase::following_runs);
  tracker.expect(0, -foreseen);
  run_each(std::move(following.runs), options, tracker, result.timing,
           [&](std::size_t i, const FinishedRun& finished) { following.takers[i](finished); });
  for (CaseOutcome& outcome : result.details) outcome.result.mechanics.checkpoints.reset();
  tracker.begin(study::Phase::report);
  for (CaseOutcome& outcome : result.details) {
    apply_confirmations(study.study, outcome);
    conclude(study.study, outcome);
    result.answers.push_back(answer_of(outcome));
  }
}

/// Of many cases the answers alone.
void run_many(CriticalGapResult& result, const StudyOptions& options) {
  ProgressTracker tracker(options.progress);
  result.answers = answer_cases(result.study, options, result.timing, tracker);
}

const std::vector<Key<CriticalGapSettings>> critical_gap_keys{
    flag_key("confirm", Standing::assumed,
             fmt::format("Coupled runs on both sides of the bracket: the skin in the mechanics, and on "
                         "through combustion. Of a study with more than {} cases it is false unless stated.",
                         most_cases_in_detail),
             &CriticalGapSettings::confirm),
};

StudyKeys raised_load_keys() {
  return {word_key(
      "raised_load", Standing::assumed,
      fmt::format("The launch of a case under a load {:.3g} % higher, for the spread of the peak pressure: "
                  "one of its own, or interpolated between the cases at neighbouring peak pressures, {:.3g} "
                  "to {:.3g} % apart, with what that misses the middle one of three by added to its heat. "
                  "Cases without two such neighbours have launches of their own.",
                  100.0 * study::assumed_load_spread, 100.0 * (study::least_load_ratio - 1.0),
                  100.0 * (study::largest_load_ratio - 1.0)),
      {{"launched", study::RaisedLoad::launched}, {"interpolated", study::RaisedLoad::interpolated}},
      &Study::raised_load)};
}

/// Refuses a raised load that is to be interpolated where none is needed, or between no cases.
void check_raised_load(const StudyFile& study) {
  if (study.study.raised_load == study::RaisedLoad::launched) return;
  if (!propagates_spread(study.study))
    refuse_at(study, "raised_load", "a raised load beside a stated input_uncertainty", "one of the two");
  for (std::size_t i = 0; i < study.cases.size(); ++i)
    if (neighbouring_loads(study, i)) return;
  refuse_at(study, "raised_load", "\"interpolated\", and no case with two neighbours in peak_pressure",
            fmt::format("at least three peak pressures, each {:.3g} to {:.3g} % above the one before, and a "
                        "launch whose end does not follow from load.muzzle_travel",
                        100.0 * (study::least_load_ratio - 1.0), 100.0 * (study::largest_load_ratio - 1.0)));
}

void make_critical_gap_cases(const StudySource& source, StudyFile& study) {
  read_references(source, study);
  read_cited_limits(source.root, study);
  make_factorial(study);
  check_raised_load(study);
  const bool few = study.cases.size() <= most_cases_in_detail;
  bool& confirm = settings_of<CriticalGapSettings>(study.study).confirm;
  if (!study.places.contains("confirm")) confirm = few;
  study.study.in_detail = few || confirm;
  study.confirmations_per_case = confirm ? 2 : 0;
}

std::vector<Failure> critical_gap_failures(const CriticalGapResult& result) {
  std::vector<Failure> failures = failures_of(result);
  for (const CaseOutcome& each : result.details)
    for (const study::Confirmation& confirmation : each.confirmations)
      add_failure(failures, label_with_skin(each, confirmation.gap), confirmation);
  return failures;
}

}  // namespace

bool CriticalGapResult::any_indeterminate() const {
  return std::ranges::any_of(answers, [](const CaseAnswer& answer) {
    return answer.critical.kind == CriticalGapKind::indeterminate ||
           std::ranges::any_of(answer.verdicts, [](const GapVerdict& row) {
             return row.judgement.verdict == Verdict::indeterminate;
           });
  });
}

CriticalGapResult run_critical_gap(const StudyFile& study, const StudyOptions& options) {
  return run_timed<CriticalGapResult>(study, options, [&](CriticalGapResult& result) {
    study.study.in_detail ? run_in_detail(result, options) : run_many(result, options);
  });
}

Kind critical_gap_kind() {
  return {
      .traits = {.name = "critical-gap", .keeps_answers = true},
      .keys = joined({reference_keys(), gaps_keys(), own_keys(critical_gap_keys), judging_keys(),
                      calibration_record_keys(), uncertainty_keys(), raised_load_keys()}),
      .tables = {reference_table(), cited_limit_table(), vary_table()},
      .varies = {.values = true},
      .make_cases = make_critical_gap_cases,
      .run = outcome_of<run_critical_gap, critical_gap_failures>,
      .files = {"temperature.svg", "critical_gap*.svg"},
      .results = critical_gap_results,
  };
}

}  // namespace launchsafe::kinds
