#include "launchsafe/study/case_answer.hpp"

namespace launchsafe::study {
namespace {

using trace::BottomTrace;

/// What a tolerance ten times wider changes, K.
double integration_error(const surface::SkinModel& model, const BottomTrace& trace,
                         const run::GapResult& gap) {
  surface::SkinModel wide = model;
  wide.relative_tolerance *= 10.0;
  const auto maximum = surface::maximum_at_stations(surface::integrate_skin(wide, trace, gap.gap), trace);
  return std::abs(maximum.temperature - gap.at_stations.temperature);
}

bool has_trace(const CaseOutcome& outcome) { return outcome.result.mechanics.trace.samples() > 0; }

/// T max (K) over the stations of a skin that air and friction heat and that neither reacts nor is
/// triggered.
double heated_temperature(const scene::Scene& scene, const BottomTrace& trace, double gap) {
  const surface::SkinModel model = without_reaction(surface::skin_model(scene));
  return surface::maximum_at_stations(surface::integrate_skin(model, trace, gap), trace).temperature;
}

/// K by which T max of a row is higher in a raised launch; infinite where that ignites and the row does not.
/// Of a row that ignites it is the difference of skins that do not react.
double raised_share(const RaisedLaunch& raised, const GapVerdict& row) {
  if (raised.trace == nullptr) return not_a_number;
  const double gap = row.gap + raised.thicker;
  const surface::SkinModel skin = row.ignition ? without_reaction(raised.skin) : raised.skin;
  const auto history = surface::integrate_skin(skin, *raised.trace, gap);
  if (history.ignition && !row.ignition) return math::infinity;
  const double hotter = surface::maximum_at_stations(history, *raised.trace).temperature -
                        (row.ignition ? row.heated : row.maximum.temperature);
  return hotter < 0.0 ? 0.0 : hotter;  // NaN stays NaN
}

using SharedTrace = std::shared_ptr<const BottomTrace>;

/// What all rows of a case are judged by. Traces are of the stations that tile the bottom, which alone count.
struct OfAllRows {
  SharedTrace trace;
  double load_curve = 0;             ///< share of the rises: see load_curve_share
  std::vector<RaisedLaunch> raised;  ///< towards ignition
};

OfAllRows of_all_rows(const Study& study, const CaseOutcome& outcome) {
  const auto annuli = [](const BottomTrace& whole) {
    return std::make_shared<const BottomTrace>(trace::of_rings(whole));
  };
  OfAllRows all{annuli(outcome.result.mechanics.trace), load_curve_share(outcome.input.scene.scene.load),
                raised_launches(study, outcome, End::towards_ignition)};
  for (RaisedLaunch& each : all.raised)
    if (each.trace) each.trace = annuli(*each.trace);
  return all;
}

/// K, the random causes together, as independent ones are.
double input_share(const Study& study, const CaseOutcome& outcome, const OfAllRows& all,
                   const GapVerdict& row) {
  double squares = outcome.raised ? 0.0 : std::pow(stated_input_share(study, outcome.input), 2);
  for (const RaisedLaunch& each : all.raised) {
    const double share = raised_share(each, row);
    squares += share * share;
  }
  return std::sqrt(squares);
}

/// K by which T max of a gap is higher where it is thicker (m).
double thicker_gap_share(const CaseOutcome& outcome, const SharedTrace& trace, const GapVerdict& row,
                         double thicker) {
  constexpr double least = 1e-9;  // m
  if (std::isnan(thicker)) return thicker;
  if (thicker < least) return 0.0;
  return raised_share({{}, surface::skin_model(outcome.input.scene.scene), trace, thicker}, row);
}

/// The smallest and the largest critical gap (m) under other constants; NaN where one is not known.
struct GapsOfModels {
  GapOrBound smallest = not_a_number, largest = not_a_number;
};
GapsOfModels range_of_models(const Study& study, const CaseOutcome& outcome) {
  const std::vector<GapOrBound> gaps = of_each(outcome.models, &ModelGap::critical_gap);
  const bool known = std::ranges::none_of(gaps, [](GapOrBound gap) { return std::isnan(gap); });
  if (gaps.empty() || gaps.size() != study.models.size() || !known) return {};
  const auto [smallest, largest] = std::ranges::minmax(gaps);
  return {smallest, largest};
}

/// By other constants the critical gap moves from its bracket, or from no ignition, to theirs.
GapShare share_of_models(const Study& study, const CaseOutcome& outcome) {
  const CriticalGap& own = outcome.critical;
  const auto [smallest, largest] = range_of_models(study, outcome);
  const bool is_value = own.kind == CriticalGapKind::value;
  // NaN comes first, and stays.
  return {ShareKind::model_form, std::min(smallest, is_value ? own.lower : no_ignition),
          std::max(largest, is_value ? own.upper : no_ignition)};
}

/// K by which T max of a gap is higher where it is thicker by as much as other constants move the critical
/// gap towards ignition.
double model_form_share(const Study& study, const CaseOutcome& outcome, const SharedTrace& trace,
                        const GapVerdict& row) {
  if (study.models.empty()) return 0.0;
  const CriticalGap& own = outcome.critical;
  const GapOrBound found = std::isnan(own.indicative) ? gap_or_bound(own) : own.indicative;
  const double safe = own.kind == CriticalGapKind::value ? own.lower : std::min(found, largest_gap(study));
  return thicker_gap_share(outcome, trace, row, safe - range_of_models(study, outcome).smallest);
}

/// The shares of a row that its study, its accuracy record and the calibration's evidence give. Errors grow
/// with the rise.
void add_shares(const Study& study, const CaseOutcome& outcome, const OfAllRows& all, GapVerdict& row) {
  const double initial = outcome.input.scene.scene.initial_temperature;
  row.uncertainty.numerical = numerical_share(outcome.input, row.gap, row.maximum.temperature - initial);
  const Rises rises{outcome.heated_without_gap - initial, row.heated - outcome.heated_without_gap};
  row.uncertainty.fit = fit_share(study, outcome.evidence->input.distance, rises);
  row.uncertainty.input = input_share(study, outcome, all, row);
  row.uncertainty.load_curve = all.load_curve * (rises.friction + rises.air);
  row.uncertainty.model_form = model_form_share(study, outcome, all.trace, row);
  row.uncertainty.sliding =
      friction_share(outcome) + thicker_gap_share(outcome, all.trace, row, opening_at_base(outcome));
}

GapVerdict row_of(const Study& study, const CaseOutcome& outcome, const OfAllRows& all,
                  const run::GapResult& gap) {
  const scene::Scene& scene = outcome.input.scene.scene;
  const BottomTrace& trace = outcome.result.mechanics.trace;
  GapVerdict row;
  row.gap = gap.gap;
  row.maximum = peak_of(gap.at_stations, trace);
  const double read = scene::read_time(scene.load);
  row.until_exit = peak_of(surface::maximum_until(gap.skin, trace, read), trace);
  row.early = peak_of(surface::maximum_at_time(gap.skin, trace, study.early_time), trace);
  row.spread = surface::spread_at_time(gap.skin, trace, read);
  row.margin = scene.charge().kinetics.ignition_temperature - gap.at_stations.temperature;
  row.heated = heated_temperature(scene, *all.trace, gap.gap);
  if (study.kind.gives_verdicts)
    row.as_calibrated = as_calibrated(scene, study.calibration.scene,
                                      outcome.evidence->input.to_be_accepted(), *all.trace, gap.gap);
  row.air = gap.air;
  row.ignition = named(gap.skin.ignition, trace);
  row.uncertainty.sampling = gap.sampling_error;
  row.uncertainty.integration = integration_error(surface::skin_model(scene), *all.trace, gap);
  add_shares(study, outcome, all, row);
  return row;
}

/// K, the largest difference between traced temperatures and coupled runs.
double coupling_share(const CaseOutcome& outcome) {
  double coupling = 0;
  for (const Confirmation& each : outcome.confirmations)
    if (std::isfinite(each.difference)) coupling = std::max(coupling, std::abs(each.difference));
  return coupling;
}

/// The critical gap of a raised launch, and of one lowered, beside that of the case.
GapOrBound critical_gap_of(const Study& study, const CriticalGap& critical, const RaisedLaunch& launch,
                           End end) {
  if (launch.trace == nullptr) return not_a_number;
  const surface::IgnitionOfGaps ignites(launch.skin, *launch.trace);
  const auto thicker = [&](double gap) { return ignites(std::max(0.0, gap + launch.thicker)); };
  const bool towards = end == End::towards_ignition;
  const double from = towards ? 0.0 : critical.upper;
  const double to = towards ? (critical.kind == CriticalGapKind::value ? critical.upper : critical.lower)
                            : largest_gap(study);
  return smallest_igniting_gap(thicker, from, to, bracket_width(study));
}

/// The case at the gap next to its critical one that does not ignite, or where the search ended.
GapVerdict row_at_critical_gap(const Study& study, const CaseOutcome& outcome) {
  const run::GapResult gap =
      run::evaluate_gap(outcome.input.scene.scene, outcome.result.mechanics.trace, outcome.critical.lower);
  GapVerdict row = row_of(study, outcome, of_all_rows(study, outcome), gap);
  row.uncertainty.coupling = coupling_share(outcome);
  return row;
}

/// What makes the critical gap uncertain, each cause bisected on its own trace, and the bounds that follow.
void find_bounds_of_critical_gap(const Study& study, CaseOutcome& outcome) {
  CriticalGap& critical = outcome.critical;
  if (!study.kind.bounds_critical_gaps || critical.kind == CriticalGapKind::indeterminate ||
      critical.kind == CriticalGapKind::several_crossings)
    return;
  if (critical.kind == CriticalGapKind::all_ignite) return set_shares(critical, {});
  const GapVerdict row = row_at_critical_gap(study, outcome);
  std::vector<RaisedLaunch> raised = raised_launches(study, outcome, End::towards_ignition, &row);
  std::vector<RaisedLaunch> lowered;
  if (critical.kind == CriticalGapKind::value) lowered = raised_launches(study, outcome, End::away, &row);
  std::vector<GapShare> shares(raised.size());
  run_parts(raised.size(), [&](std::size_t i) {
    GapShare& share = shares[i];
    share.kind = raised[i].kind;
    share.raised = critical_gap_of(study, critical, raised[i], End::towards_ignition);
    const auto away = std::ranges::find(lowered, share.kind, &RaisedLaunch::kind);
    share.lowered =
        away == lowered.end() ? critical.upper : critical_gap_of(study, critical, *away, End::away);
  });
  if (!study.models.empty()) shares.push_back(share_of_models(study, outcome));
  set_shares(critical, std::move(shares));
}

/// With the bracket that was traced.
GapReason disagreement_of(const Confirmation& confirmation, const CriticalGap& traced) {
  using enum GapReasonCode;
  const GapReasonCode code = !confirmation.completed ? coupled_failed
                             : confirmation.ignited  ? coupled_ignites
                                                     : coupled_safe;
  return {code, confirmation.gap, traced.lower, traced.upper, confirmation.failure};
}

/// Those of a completed run itself.
std::vector<std::string> validity_warnings_of(const CaseOutcome& outcome) {
  if (!outcome.completed()) return {};
  std::vector<std::string> warnings =
      run::validity_warnings(outcome.input.scene.scene, outcome.result.mechanics);
  if (outcome.raised && outcome.raised->status != run::RunStatus::completed)
    warnings.push_back(
        fmt::format("the run with the load raised by {:.3g} %, for the uncertainty of the inputs: {}{}{}",
                    100.0 * assumed_load_spread, run::to_string(outcome.raised->status),
                    outcome.raised->reason.empty() ? "" : ", ", outcome.raised->reason));
  return warnings;
}

/// Without a trace there is no heat, and a study without verdicts does not ask whether anything was launched.
CaseEvidence evidence_of(const Study& study, const CaseOutcome& outcome) {
  constexpr double unasked = math::infinity;
  const bool asks = study.kind.gives_verdicts && outcome.completed() && has_trace(outcome);
  return {outcome.failure,
          outcome.result.mechanics.limiters,
          validity_warnings_of(outcome),
          asks ? outcome.heated_without_gap - outcome.input.scene.scene.initial_temperature : unasked,
          statements_of(study, outcome.input),
          failed_models(outcome.models)};
}

void find_critical_gaps(const Study& study, CaseOutcome& outcome) {
  if (outcome.completed() && outcome.evidence->validity_warnings.empty()) {
    const surface::SkinModel model = surface::skin_model(outcome.input.scene.scene);
    const surface::IgnitionOfGaps ignites(model, outcome.result.mechanics.trace);
    outcome.critical = find_critical_gap(std::cref(ignites), largest_gap(study), bracket_width(study));
  }
  if (GapReason reason = why_no_critical_gap(*outcome.evidence); reason.code != GapReasonCode::none)
    outcome.critical = {.reason = std::move(reason), .indicative = gap_or_bound(outcome.critical)};
}

void evaluate_gaps(const Study& study, CaseOutcome& outcome) {
  const std::vector<double>& gaps = study.gaps;
  outcome.verdicts.resize(gaps.size());
  for (std::size_t i = 0; i < gaps.size(); ++i) outcome.verdicts[i].gap = gaps[i];
  if (has_trace(outcome)) {
    const OfAllRows all = of_all_rows(study, outcome);
    outcome.result.gaps.resize(gaps.size());
    run_parts(gaps.size(), [&](std::size_t i) {
      run::GapResult& gap = outcome.result.gaps[i];
      gap = run::evaluate_gap(outcome.input.scene.scene, outcome.result.mechanics.trace, gaps[i]);
      outcome.verdicts[i] = row_of(study, outcome, all, gap);
    });
  }
  attach_references(study, outcome.input, outcome.verdicts);
}

/// The search on a launch under other constants, with their skin.
ModelGap gap_of_model(const Study& study, const scene::Scene& scene, const FinishedRun& run) {
  ModelGap gap{run.model, not_a_number, run.failure};
  const run::MechanicsResult& mechanics = run.result.mechanics;
  if (gap.failure.empty())
    gap.failure = fmt::format("{}", fmt::join(run::validity_warnings(scene, mechanics), "; "));
  if (!gap.failure.empty()) return gap;
  const surface::IgnitionOfGaps ignites(surface::skin_model(scene), mechanics.trace);
  gap.critical_gap = smallest_igniting_gap(std::cref(ignites), 0.0, largest_gap(study), bracket_width(study));
  if (std::isnan(gap.critical_gap)) gap.failure = "a temperature is not a number";
  return gap;
}

}  // namespace

std::vector<ModelGap> gaps_of_models(const Study& study, const StudyCase& input,
                                     const std::vector<FinishedRun>& runs) {
  std::vector<ModelGap> gaps(study.models.size());
  run_parts(gaps.size(), [&](std::size_t i) {
    const auto& model = study.models[i];
    gaps[i] = {.name = name_of_model(*model), .failure = "not run"};
    const auto run = std::ranges::find(runs, gaps[i].name, &FinishedRun::model);
    if (run != runs.end()) gaps[i] = gap_of_model(study, scene_of_model(input, model), *run);
  });
  return gaps;
}

Peak peak_of(const surface::Maximum& maximum, const BottomTrace& trace) {
  return {maximum.temperature, maximum.time, trace.name_of(maximum.station)};
}

std::optional<NamedIgnition> named(const std::optional<surface::Ignition>& ignition,
                                   const BottomTrace& trace) {
  if (!ignition) return std::nullopt;
  return NamedIgnition{ignition->cause, ignition->time, trace.name_of(ignition->station),
                       ignition->chemical_share};
}

void attach_references(const Study& study, const StudyCase& input, std::vector<GapVerdict>& rows) {
  if (!input.own_conditions) return;
  for (GapVerdict& row : rows) {
    const auto found = std::ranges::find_if(study.references, [&row](const Reference& reference) {
      return std::abs(reference.gap - row.gap) <= 1e-9;
    });
    if (found != study.references.end()) row.reference = *found;
  }
}

double friction_share(const CaseOutcome& outcome) {
  const scene::Scene& scene = outcome.input.scene.scene;
  const materials::Charge& charge = scene.charge();
  const double capacity = charge.density * charge.specific_heat;  // J/(m3 K)
  const double diffused =
      0.5 * std::sqrt(std::numbers::pi * charge.conductivity * scene::read_time(scene.load) / capacity);
  const double heat = run::largest_at_bottom(outcome.result.mechanics, scene::charge_extent(scene).x_end,
                                             &run::InterfaceResult::friction_heat);
  return heat / (capacity * std::min(scene.surface.skin_thickness, diffused));
}

double opening_at_base(const CaseOutcome& outcome) {
  return run::largest_at_bottom(outcome.result.mechanics,
                                scene::charge_extent(outcome.input.scene.scene).x_end,
                                &run::InterfaceResult::largest_gap);
}

double largest_gap(const Study& study) {
  return study.gaps.empty() ? study.largest_gap : std::max(study.largest_gap, std::ranges::max(study.gaps));
}

surface::SkinModel without_reaction(surface::SkinModel model) {
  constexpr double never = std::numeric_limits<double>::max();
  model.kinetics.frequency = 0.0;
  model.kinetics.ignition_temperature = never;
  model.kinetics.burnt_temperature = never;
  return model;
}

void evaluate(const Study& study, CaseOutcome& outcome) {
  if (has_trace(outcome))
    outcome.heated_without_gap =
        heated_temperature(outcome.input.scene.scene, outcome.result.mechanics.trace, 0.0);
  outcome.evidence = std::make_shared<const CaseEvidence>(evidence_of(study, outcome));
  find_critical_gaps(study, outcome);
  evaluate_gaps(study, outcome);
}

CaseOutcome without_result(const Study& study, const StudyCase& input, RunOutcome of_run,
                           std::string failure) {
  CaseOutcome outcome;
  outcome.input = input;
  outcome.outcome = of_run;
  outcome.failure = std::move(failure);
  evaluate(study, outcome);
  return outcome;
}

void apply_confirmations(const Study& study, CaseOutcome& outcome) {
  find_bounds_of_critical_gap(study, outcome);
  for (const Confirmation& confirmation : outcome.confirmations)
    // The bracket stays readable in the reason; a number that was not confirmed is none.
    if (confirmation.ran && !confirmation.agrees()) {
      outcome.critical = {.reason = disagreement_of(confirmation, outcome.critical)};
      return;
    }
}

void conclude(const Study& study, CaseOutcome& outcome) {
  const double coupling = coupling_share(outcome);
  std::vector<double> gaps, temperatures;
  for (GapVerdict& row : outcome.verdicts) {
    row.uncertainty.coupling = coupling;
    if (row.ignition || !outcome.completed()) continue;
    gaps.push_back(row.gap);
    temperatures.push_back(row.maximum.temperature);
  }
  judge_rows(study, outcome.evidence, outcome.critical, outcome.verdicts);
  outcome.lines = fit_gaps(gaps, temperatures);
}

}  // namespace launchsafe::study
