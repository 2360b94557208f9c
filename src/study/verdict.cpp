#include "launchsafe/study/verdict.hpp"

#include "launchsafe/run/validity_warnings.hpp"
#include "launchsafe/scene/launch_end.hpp"
#include "launchsafe/scene/load_roughness.hpp"
#include "launchsafe/study/firing_posterior.hpp"

namespace launchsafe::study {
namespace {

/// A peak pressure at which no other model of the launch was looked at: how wrong the one is there nobody
/// knows, whatever is assumed or stated of it.
std::optional<scene::Implausible> pressure_beyond_models(const Study& study, const StudyCase& input) {
  const scene::Scene& scene = input.scene.scene;
  const scene::Limits compared = compared_pressures(study.model_form);
  constexpr double round_off = 1e-9;
  const double peak = scene::PressureHistory(scene.load).stated_peak();
  if (peak >= compared.lowest * (1.0 - round_off) && peak <= compared.highest * (1.0 + round_off))
    return std::nullopt;
  return scene::implausible(
      scene.accepted, {.kind = keys::KeyKind::number, .dimension = scene::Dimension::pressure},
      scene::pressure_of_models, keys::Value(peak),
      fmt::format("{} to {}, because other models of the launch were compared only there",
                  scene::pressure_text(compared.lowest), scene::pressure_text(compared.highest)));
}

/// A ring of the record that smoothing takes away heats, and may ignite, where it is pressure: that it is not
/// somebody has to say.
std::optional<scene::Implausible> ring_smoothed_away(const scene::Scene& scene) {
  const auto ring = scene::smoothed_ring(scene.load);
  if (!ring) return std::nullopt;
  return scene::implausible(
      scene.accepted, {.kind = keys::KeyKind::number, .dimension = scene::Dimension::time}, "load.smoothing",
      keys::Value(scene.load.smoothing),
      fmt::format("\"0 ms\", because it takes a ring of {:.2g} kHz away, which may be pressure",
                  1e-3 * ring->frequency));
}

/// Whether of what is foreign to firings it cannot be told that it is milder than what was fired: all but the
/// peak pressure and the temperature, which were held against them.
bool no_firing_speaks_of(const scene::Implausible& foreign) {
  return foreign.key != "load.peak" && foreign.key != "initial_temperature";
}

std::vector<scene::Implausible> implausible_in(const Study& study, const StudyCase& input,
                                               const scene::RigidMotion& launch) {
  std::vector<scene::Implausible> values = study.implausible;
  if (auto beyond = pressure_beyond_models(study, input)) values.push_back(std::move(*beyond));
  if (auto ring = ring_smoothed_away(input.scene.scene)) values.push_back(std::move(*ring));
  for (scene::Implausible& each : scene::implausible_values(input.scene.scene, launch)) {
    // One that firings gave its value, about a plausible one: another value is foreign to them.
    if (!study.calibration.firings || scene::role_of(each.key).part != keys::Part::calibrated)
      values.push_back(std::move(each));
  }
  return values;
}

/// What only averages or removes heat: no ignition under it shows nothing.
std::vector<std::string> cooling_in(const scene::Scene& scene, const scene::Scene& calibrated) {
  constexpr double deepest_station = 10e-3, widest_station = 20e-3, thickest_skin = 0.3e-3;  // m
  constexpr double least_share = 0.5, slack = 1e-9;
  const scene::Surface &ours = scene.surface, &theirs = calibrated.surface;
  std::vector<std::string> found;
  const auto add = [&found](bool cools, std::string name) {
    if (cools) found.push_back(std::move(name));
  };
  add(ours.station_depth > deepest_station + slack, "stations deeper than 10 mm");
  add(ours.station_width > widest_station + slack, "stations wider than 20 mm");
  add(ours.skin_thickness > thickest_skin + slack, "a skin above 0.3 mm");
  add(ours.friction == scene::FrictionClosure::none, "no friction heat");
  add(ours.localisation * scene.charge().sliding_friction <
          least_share * theirs.localisation * calibrated.charge().sliding_friction,
      "sliding friction times localisation below half the calibrated product");
  add(ours.exchange_time * least_share > theirs.exchange_time,
      "an exchange slower than half the calibrated one");
  return found;
}

/// No stress case of a stability study may pass for any but the film.
std::string optimistic_by_input(const Study& study, const scene::Scene& scene,
                                const scene::RigidMotion& launch) {
  if (scene.surface.air_model == scene::AirModel::film)
    return "no ignition under gap.air = \"film\", which gives what compression supplies alone, shows nothing";
  if (!study.kind.gives_verdicts) return {};
  if (const std::vector<std::string> cooling = cooling_in(scene, study.calibration.scene); !cooling.empty())
    return fmt::format(
        "no ignition with {} shows nothing: that only averages or removes heat, accepted or not",
        fmt::join(cooling, ", "));
  const double calibres = scene::calibres_of(scene, launch);
  if (calibres >= fewest_calibres) return {};
  return fmt::format(
      "no ignition within {:.3g} calibres of travel shows nothing: no barrel is shorter than {:g}", calibres,
      fewest_calibres);
}

bool nobody_accepts(const scene::Implausible& value) { return !value.accepted(); }

Judgement indeterminate(ReasonCode code, const CriticalGap& critical, GapReason why = {}) {
  return {Verdict::indeterminate, code, critical.bounds.at_least, std::move(why)};
}

/// Where nothing ignites up to the end of the search, which a gap may lie at.
Judgement judge_margin(const GapVerdict& row, const CriticalGap& critical) {
  // Written so that NaN is never safe.
  if (!(row.margin > row.uncertainty.total()))
    return indeterminate(ReasonCode::margin_within_uncertainty, critical);
  if (!(row.calibrated_margin() > row.uncertainty.total()))
    return indeterminate(ReasonCode::calibrated_margin_within_uncertainty, critical);
  if (!(row.gap <= critical.bounds.at_least)) return indeterminate(ReasonCode::not_below_bound, critical);
  return {Verdict::safe, ReasonCode::margin_over_uncertainty, critical.bounds.at_least};
}

Judgement judge_in_gap(const GapVerdict& row, const CriticalGap& critical) {
  const double at_least = critical.bounds.at_least;
  switch (critical.kind) {
    case CriticalGapKind::indeterminate:
      return indeterminate(ReasonCode::critical_gap_indeterminate, critical, critical.reason);
    case CriticalGapKind::several_crossings:
      return indeterminate(ReasonCode::several_crossings, critical, critical.reason);
    case CriticalGapKind::all_ignite:
      return indeterminate(ReasonCode::smaller_gaps_ignite, critical);
    case CriticalGapKind::all_safe:
      return judge_margin(row, critical);
    case CriticalGapKind::value:
      break;
  }
  if (std::isnan(at_least)) return indeterminate(ReasonCode::no_lower_bound, critical);
  if (!(row.gap < at_least))
    return indeterminate(at_least > 0.0 ? ReasonCode::not_below_bound : ReasonCode::may_ignite_without_gap,
                         critical);
  return {Verdict::safe, ReasonCode::below_bound, at_least};
}

/// A gap that is SAFE by the reservoir, where it closes.
Judgement judge_closing(const GapVerdict& row, const CriticalGap& critical, Judgement by_reservoir) {
  if (by_reservoir.verdict != Verdict::safe) return by_reservoir;
  if (!row.closing.known) return indeterminate(ReasonCode::closing_unknown, critical);
  if (std::isnan(row.closing.corner_margin))
    return indeterminate(ReasonCode::closing_without_corner, critical);
  // Written so that NaN is never safe.
  if (!(row.closing.corner_margin > row.closing_uncertainty()))
    return indeterminate(ReasonCode::closing_corner, critical);
  return by_reservoir;
}

}  // namespace

std::vector<scene::Implausible> CaseStatements::to_be_accepted() const {
  std::vector<scene::Implausible> values = implausible;
  for (const scene::Implausible& each : distance.foreign)
    if (std::ranges::count(values, each.key, &scene::Implausible::key) == 0) values.push_back(each);
  return values;
}

bool CaseStatements::has_unaccepted() const {
  return std::ranges::any_of(implausible, nobody_accepts) ||
         std::ranges::any_of(distance.foreign, nobody_accepts);
}

bool CaseStatements::is_beyond(double gap) const { return gap > calibrated_gap * (1.0 + 1e-9); }

CaseStatements statements_of(const Study& study, const StudyCase& input) {
  const scene::Scene& scene = input.scene.scene;
  scene::RigidMotion launch;
  if (study.kind.gives_verdicts) launch = scene::rigid_motion(scene, scene::read_time(scene.load));
  CaseStatements all;
  all.uncovered_load = run::uncovered_load(scene.load);
  all.optimistic = optimistic_by_input(study, scene, launch);
  all.ring = scene::ring_text(scene.load);
  all.closes = input.closing.has_value();
  if (study.model_form) all.model_form = model_form_shift(*study.model_form, scene);
  // No stress case of a stability study may pass because its input is called implausible.
  if (!study.kind.gives_verdicts) return all;
  all.distance = distance_to_calibration(scene, study.calibration);
  all.implausible = implausible_in(study, input, launch);
  all.extrapolated = all.distance.names();
  if (const double over = scene.load.smoothing; over > 0.0)
    all.extrapolated.push_back("load smoothed over " + scene::format_quantity(over, scene::Dimension::time));
  all.calibrated_gap = calibrated_gap(study.calibration, scene);
  if (study.calibration.firings && std::ranges::any_of(all.distance.foreign, no_firing_speaks_of))
    all.calibrated_gap = -1.0;
  all.calibrated_by_firings = study.calibration.firings != nullptr;
  all.demonstration = study.demonstration;
  return all;
}

std::string optimistic_by_run(double friction_rise) {
  if (friction_rise >= least_friction_rise) return {};
  return fmt::format(
      "friction heats the charge's bottom by {:.2g} K over the launch, less than {:g} K: no ignition shows "
      "nothing",
      friction_rise, least_friction_rise);
}

std::string to_string(Verdict verdict) {
  constexpr std::array words{"SAFE", "UNSAFE", "INDETERMINATE"};
  return words.at(static_cast<std::size_t>(verdict));
}

Judgement judge(const GapVerdict& row, const CriticalGap& critical) {
  if (row.of_case == nullptr) return {};
  const CaseEvidence& of_case = *row.of_case;
  if (!of_case.completed()) return indeterminate(ReasonCode::failed, critical);
  if (!std::isfinite(row.maximum.temperature)) return indeterminate(ReasonCode::no_temperature, critical);
  if (!of_case.validity_warnings.empty() || std::isfinite(row.when_over))
    return indeterminate(ReasonCode::validity_warning, critical);
  if (row.ignition) return {Verdict::unsafe, ReasonCode::ignition};
  if (of_case.input.closes && row.closing.ignited) return {Verdict::unsafe, ReasonCode::closing_ignition};
  if (of_case.input.has_unaccepted()) return indeterminate(ReasonCode::unaccepted, critical);
  // Written so that NaN is never safe.
  if (!(row.margin > 0.0)) return indeterminate(ReasonCode::no_margin, critical);
  if (!of_case.input.optimistic.empty() || !optimistic_by_run(of_case.friction_rise).empty())
    return indeterminate(ReasonCode::optimistic, critical);
  if (of_case.input.calibrated_by_firings && of_case.input.is_beyond(row.gap))
    return indeterminate(ReasonCode::beyond_firings, critical);
  const Judgement by_reservoir = judge_in_gap(row, critical);
  return of_case.input.closes ? judge_closing(row, critical, by_reservoir) : by_reservoir;
}

}  // namespace launchsafe::study
