#include "launchsafe/study/verdict.hpp"

#include "launchsafe/study/constants_of_study.hpp"

namespace launchsafe::study {
namespace {

std::vector<scene::Implausible> implausible_in(const Study& study, const StudyCase& input,
                                               const scene::RigidMotion& launch) {
  std::vector<scene::Implausible> values = study.implausible;
  std::ranges::move(scene::implausible_values(input.scene.scene, launch), std::back_inserter(values));
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

std::string optimistic_by_input(const Study& study, const scene::Scene& scene,
                                const scene::RigidMotion& launch) {
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
  if (!(row.gap < critical.bounds.at_least)) return indeterminate(ReasonCode::not_below_bound, critical);
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
  // No stress case of a stability study may pass because its input is called implausible.
  if (!study.kind.gives_verdicts) return all;
  all.distance = distance_to_record(RecordKind::calibration, scene, study.calibration.scene);
  all.implausible = implausible_in(study, input, launch);
  all.extrapolated = all.distance.names();
  if (const double over = scene.load.smoothing; over > 0.0)
    all.extrapolated.push_back("load smoothed over " + scene::format_quantity(over, scene::Dimension::time));
  all.calibrated_gap = study.calibration.evidence.largest_gap;
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
  if (!of_case.validity_warnings.empty()) return indeterminate(ReasonCode::validity_warning, critical);
  if (row.ignition) return {Verdict::unsafe, ReasonCode::ignition};
  if (of_case.input.has_unaccepted()) return indeterminate(ReasonCode::unaccepted, critical);
  // Written so that NaN is never safe.
  if (!(row.margin > 0.0)) return indeterminate(ReasonCode::no_margin, critical);
  if (!of_case.input.optimistic.empty() || !optimistic_by_run(of_case.friction_rise).empty())
    return indeterminate(ReasonCode::optimistic, critical);
  return judge_in_gap(row, critical);
}

// --- the verdict of a gap ---

namespace {

using keys::ActsOn;

Line line_through(const char* name, double intercept, double slope, const std::vector<double>& gaps_cm,
                  const std::vector<double>& temperatures) {
  double squares = 0.0;
  for (std::size_t i = 0; i < gaps_cm.size(); ++i)
    squares += std::pow(temperatures[i] - (intercept + slope * gaps_cm[i]), 2);
  Line line;
  line.name = name;
  line.intercept = intercept;
  line.slope = slope;
  line.root_mean_square = std::sqrt(squares / static_cast<double>(gaps_cm.size()));
  return line;
}

/// Each once.
std::vector<std::string> keys_of(const std::vector<scene::Implausible>& to_be_accepted) {
  std::vector<std::string> keys;
  const auto add = [&keys](const std::string& key) {
    if (std::ranges::count(keys, key) == 0) keys.push_back(key);
  };
  for (const scene::Implausible& each : to_be_accepted) {
    add(each.key);
    std::ranges::for_each(each.stands_for, add);
  }
  return keys;
}

}  // namespace

std::vector<Line> fit_gaps(const std::vector<double>& gaps, const std::vector<double>& temperatures) {
  const auto gaps_cm = of_each(gaps, [](double gap) { return 100.0 * gap; });
  const auto fitted = math::fit_line(gaps_cm, temperatures);
  if (!fitted) return {};
  const double slope = fitted->coefficients[1];
  std::vector<Line> lines{
      line_through("least squares", fitted->coefficients[0], slope, gaps_cm, temperatures)};
  if (fitted->degrees_of_freedom > 0) {
    // The diagonal of (X^T X)^-1, of two coefficients.
    lines[0].intercept_error = fitted->residual_deviation * std::sqrt(fitted->inverse_normal[0]);
    lines[0].slope_error = fitted->residual_deviation * std::sqrt(fitted->inverse_normal[3]);
  }
  if (const auto zero = std::ranges::find(gaps, 0.0); zero != gaps.end())
    lines.push_back(line_through("its slope through the zero-gap row (the published form)",
                                 temperatures[static_cast<std::size_t>(zero - gaps.begin())], slope, gaps_cm,
                                 temperatures));
  return lines;
}

std::vector<std::string> skin_keys(const std::vector<scene::Implausible>& to_be_accepted) {
  std::vector<std::string> keys = keys_of(to_be_accepted);
  std::erase_if(keys, [](const std::string& key) {
    // What acts on the skin of a given trace, or in proportion to what the trace holds.
    constexpr std::array felt{ActsOn::trace, ActsOn::heat, ActsOn::conduction, ActsOn::surface};
    return std::ranges::count(felt, scene::role_of(key).acts_on) == 0;
  });
  return keys;
}

std::vector<std::string> keys_as_calibrated(const std::vector<scene::Implausible>& to_be_accepted) {
  std::vector<std::string> keys = skin_keys(to_be_accepted);
  if (!keys.empty()) keys.insert(keys.begin(), "");
  for (const std::string& key : keys_of(to_be_accepted))
    if (scene::role_of(key).acts_on == ActsOn::chemistry) keys.push_back(key);
  return keys;
}

scene::Scene with_calibrated(const scene::Scene& scene, const scene::Scene& calibrated,
                             const std::vector<std::string>& keys) {
  scene::Scene changed = scene;
  for (const std::string& name : keys) {
    const auto& key = *scene::find_key(scene::scene_keys(), name);
    key.set(changed, key.get(calibrated));
  }
  if (std::ranges::find(keys, "charge.sliding_friction") != keys.end())
    changed.surface.localisation *= calibrated.charge().sliding_friction / scene.charge().sliding_friction;
  return changed;
}

std::vector<AsCalibrated> as_calibrated(const scene::Scene& scene, const scene::Scene& calibrated,
                                        const std::vector<scene::Implausible>& to_be_accepted,
                                        const trace::BottomTrace& trace, double gap) {
  std::vector<AsCalibrated> all;
  for (const std::string& key : keys_as_calibrated(to_be_accepted)) {
    const std::vector<std::string> keys = key.empty() ? skin_keys(to_be_accepted) : std::vector{key};
    const scene::Scene changed = with_calibrated(scene, calibrated, keys);
    const auto skin = surface::integrate_skin(surface::skin_model(changed), trace, gap);
    all.push_back({key, surface::maximum_at_stations(skin, trace).temperature, skin.ignition.has_value()});
  }
  return all;
}

std::string to_string(surface::IgnitionCause cause) {
  return cause == surface::IgnitionCause::trigger ? "T1" : "Arrhenius";
}

double GapVerdict::misfit() const {
  if (!reference || reference->ignited() || ignition) return not_a_number;
  return until_exit.temperature - reference->maximum_temperature;
}

double GapVerdict::calibrated_margin() const {
  for (const AsCalibrated& each : as_calibrated)
    if (each.key.empty())
      return each.ignites ? -math::infinity : margin + maximum.temperature - each.temperature;
  return math::infinity;
}

double GapVerdict::early_misfit() const {
  return reference ? early.temperature - reference->early_temperature : not_a_number;
}

void judge_rows(const Study& study, const std::shared_ptr<const CaseEvidence>& of_case,
                const CriticalGap& critical, std::vector<GapVerdict>& rows) {
  for (GapVerdict& row : rows) {
    row.of_case = of_case;
    row.judgement = judge(row, critical);
  }
}

double largest_safe_gap(const std::vector<GapVerdict>& rows) {
  double largest = not_a_number, first_other = no_ignition;
  for (const GapVerdict& each : rows)
    if (each.judgement.verdict != Verdict::safe) first_other = std::min(first_other, each.gap);
  for (const GapVerdict& each : rows)
    if (each.gap < first_other && !(each.gap <= largest)) largest = each.gap;
  return largest;
}

}  // namespace launchsafe::study
