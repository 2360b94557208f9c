#include "calibration_parts.hpp"
#include "launchsafe/study/gap_analysis.hpp"
#include "launchsafe/study/run_cases.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

namespace launchsafe::kinds {

using study::Firing, study::Posterior, study::PosteriorPoint, study::StudyOptions;

namespace {

constexpr int nodes = 25, fewer_nodes = 13;   ///< of the lattice of a posterior
constexpr double least_above_hottest = 20.0;  ///< K, of an ignition temperature above the hottest charge
constexpr double least_tail = 0.01;           ///< of study::tail_probability

void run_conditions(FiringResult& result, const StudyOptions& options) {
  for (const study::StudyCase& input : result.study.cases) result.conditions.push_back({input});
  study::run_every_case(
      result.study, options, result.timing, [&](std::size_t i, std::vector<study::FinishedRun>& finished) {
        CalibrationRun& condition = result.conditions[i];
        condition.outcome = finished.front().outcome;
        condition.failure = finished.front().failure;
        condition.mechanics = finished.front().result.mechanics;
        if (condition.failure.empty())
          condition.failure = calibration_validity_warnings(condition.input.scene.scene, condition.mechanics);
      });
}

/// By the rounds of the same pressure, temperature and gap.
void count_rounds(FiringRow& row, const std::vector<Firing>& firings) {
  for (const Firing& each : firings) {
    if (each.pressure != row.firing.pressure || each.temperature != row.firing.temperature ||
        each.gap != row.firing.gap)
      continue;
    row.rounds += each.rounds;
    row.ignited += each.ignited ? each.rounds : 0;
  }
  const math::Interval interval = math::clopper_pearson(row.ignited, row.rounds, 0.9);
  row.shown_lowest = interval.lower;
  row.shown_highest = interval.upper;
}

/// K, of T max of a skin that does not react.
double rise_of(const CalibrationRun& condition, double gap) {
  const surface::SkinModel model = study::without_reaction(surface::skin_model(condition.input.scene.scene));
  const auto skin = surface::integrate_skin(model, condition.mechanics.trace, gap);
  return surface::maximum_at_stations(skin, condition.mechanics.trace).temperature -
         condition.input.scene.scene.initial_temperature;
}

/// How much the heat of rounds differs as their pressures and temperatures do.
double log_heat_spread(const CalibrationRun& condition, const Firing& firing) {
  return std::hypot(study::heat_exponent * firing.pressure_spread / firing.pressure,
                    firing.temperature_spread / rise_of(condition, firing.gap));
}

std::vector<FiringRow> rows_of(const std::vector<Firing>& firings) {
  const std::vector<std::size_t> conditions = conditions_of(firings);
  std::vector<FiringRow> rows;
  for (std::size_t i = 0; i < firings.size(); ++i) {
    FiringRow& row = rows.emplace_back();
    row.firing = firings[i];
    row.condition = conditions[i];
    count_rounds(row, firings);
  }
  return rows;
}

/// What every row needs to ignite, over all that the wider prior allows; none, and a failure, where that is
/// not known.
std::vector<study::FiredLaunch> launches_of(FiringResult& result, const study::FiringPrior& widest) {
  std::vector<std::optional<surface::IgnitionBoundary>> boundaries(result.rows.size());
  tbb::parallel_for(std::size_t{0}, result.rows.size(), [&](std::size_t i) {
    FiringRow& row = result.rows[i];
    const CalibrationRun& condition = result.conditions[row.condition];
    row.log_heat_spread = log_heat_spread(condition, row.firing);
    boundaries[i] = surface::IgnitionBoundary::find(surface::skin_model(condition.input.scene.scene),
                                                    condition.mechanics.trace, row.firing.gap,
                                                    widest.log_products(), widest.ignition_temperatures());
  });
  std::vector<study::FiredLaunch> launches;
  for (std::size_t i = 0; i < boundaries.size(); ++i) {
    const FiringRow& row = result.rows[i];
    if (!boundaries[i] || !std::isfinite(row.log_heat_spread)) {
      result.failure = fmt::format(
          "at some constants within prior.localisation, prior.exchange_time and prior.ignition_temperature, "
          "or twice as wide ones, no heat decides whether \"{}\" ignites",
          row.firing.name);
      return {};
    }
    launches.push_back(
        {std::move(*boundaries[i]), row.log_heat_spread, row.firing.rounds, row.firing.ignited});
  }
  return launches;
}

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

template <class Number>
std::vector<double> numbers_of(const Posterior& posterior, Number number) {
  std::vector<double> numbers;
  for (const PosteriorPoint& each : posterior) numbers.push_back(number(each));
  return numbers;
}

double geometric_mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double each : values) sum += std::log(each);
  return std::exp(sum / static_cast<double>(values.size()));
}

std::vector<ConstantRange> ranges_of(const Posterior& prior, const Posterior& posterior,
                                     const Posterior& coarser) {
  const auto range_of = [&](const char* name, auto number) {
    const auto before = numbers_of(prior, number), after = numbers_of(posterior, number);
    const double centre = geometric_mean(after);
    return ConstantRange{name,
                         study::quantile_of(before, 0.05),
                         geometric_mean(before),
                         study::quantile_of(before, 0.95),
                         study::quantile_of(after, 0.05),
                         centre,
                         study::quantile_of(after, 0.95),
                         geometric_mean(numbers_of(coarser, number)) / centre - 1.0};
  };
  return {
      range_of("friction.localisation",
               [](const PosteriorPoint& each) { return each.constants.localisation; }),
      range_of("gap.exchange_time", [](const PosteriorPoint& each) { return each.constants.exchange_time; }),
      range_of("kinetics.ignition_temperature",
               [](const PosteriorPoint& each) { return each.constants.ignition_temperature; }),
      range_of("scatter", [](const PosteriorPoint& each) { return each.scatter; })};
}

/// Bits that an outcome of probability p decides.
double entropy(double p) {
  const auto part = [](double q) { return q > 0.0 ? -q * std::log2(q) : 0.0; };
  return part(p) + part(1.0 - p);
}

/// What one more round would tell of the constants, for every launch that was run and every gap: the entropy
/// of its outcome beyond what stays open where the constants are known (Lindley, Ann. Math. Stat. 27, 1956).
std::vector<NextFiring> next_firings(const FiringResult& result, const Posterior& posterior,
                                     std::vector<double> gaps) {
  const Firing largest =
      std::ranges::max_element(result.rows, {}, [](const FiringRow& row) { return row.firing.gap; })->firing;
  if (gaps.empty())
    for (const double times : {0.5, 1.0, 1.5, 2.0}) gaps.push_back(times * largest.gap);
  std::vector<NextFiring> next;
  for (std::size_t place = 0; place < result.conditions.size(); ++place) {
    const CalibrationRun& condition = result.conditions[place];
    const FiringRow& row = *std::ranges::find(result.rows, place, &FiringRow::condition);
    const surface::SkinModel model = surface::skin_model(condition.input.scene.scene);
    for (const double gap : gaps) {
      const auto boundary = study::boundary_for(posterior, model, condition.mechanics.trace, gap);
      if (!boundary) continue;
      const auto probabilities = study::ignition_probabilities(posterior, *boundary, row.log_heat_spread);
      std::vector<double> entropies;
      for (const double p : probabilities) entropies.push_back(entropy(p));
      const double mean = mean_of(probabilities);
      next.push_back(
          {row.firing.pressure, row.firing.temperature, gap, mean, entropy(mean) - mean_of(entropies)});
    }
  }
  std::ranges::stable_sort(next, std::ranges::greater{}, &NextFiring::information);
  return next;
}

/// The study's scene with the constants at the middle of their posterior.
scene::Scene calibrated_scene(const FiringResult& result, const std::vector<ConstantRange>& ranges) {
  scene::Scene scene = result.study.scene.scene;
  put({ranges[0].centre, ranges[1].centre, ranges[2].centre}, scene.surface, scene.charge().kinetics);
  scene.accepted.clear();
  return scene;
}

/// What the record says of the thickest gap that did not ignite, or of the first firing where all ignited.
study::CalibrationEvidence evidence_of(const FiringResult& result, const scene::Scene& calibrated,
                                       const study::FiringEvidence& firings,
                                       const std::vector<study::FiredLaunch>& launches) {
  std::size_t place = 0;
  double largest = 0.0;
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    const Firing& firing = result.rows[i].firing;
    const double speaks = study::calibrated_gap(firings.firings, firing.pressure, firing.temperature);
    if (firing.ignited || firing.gap > speaks || firing.gap < largest) continue;
    place = i;
    largest = firing.gap;
  }
  const surface::SurfaceConstants constants = surface::constants_of(surface::skin_model(calibrated));
  double factor = 1.0;
  for (const Posterior* posterior : {&firings.posterior, &firings.of_doubled_prior})
    factor = std::max(factor, study::heat_factor(*posterior, launches[place].boundary, constants));
  CalibrationRun condition = result.conditions[result.rows[place].condition];
  scene::Scene& scene = condition.input.scene.scene;
  scene.surface.localisation = calibrated.surface.localisation;
  scene.surface.exchange_time = calibrated.surface.exchange_time;
  const double friction = rise_of(condition, 0.0), all = rise_of(condition, result.rows[place].firing.gap);
  return {friction, all - friction, largest, std::min(1e4, (factor - 1.0) * all)};
}

void calibrate_on_firings(FiringResult& result) {
  const auto failed = std::ranges::find_if(result.conditions,
                                           [](const CalibrationRun& each) { return !each.failure.empty(); });
  if (failed != result.conditions.end()) {
    result.failure = failed->input.label + ": " + failed->failure;
    return;
  }
  const FiringSettings& settings = settings_of<CalibrationSettings>(result.study.study).firings;
  study::FiringPrior prior =
      settings.prior_about(surface::constants_of(surface::skin_model(result.study.scene.scene)));
  prior.least_ignition_temperature =
      std::ranges::max(settings.firings, {}, &Firing::temperature).temperature + least_above_hottest;
  const study::FiringPrior doubled = prior.widened(2.0);
  result.rows = rows_of(settings.firings);
  const auto launches = launches_of(result, doubled);
  if (launches.empty()) return;
  study::FiringEvidence firings{settings.firings, study::posterior_of(prior, launches, nodes),
                                study::posterior_of(doubled, launches, nodes),
                                result.study.study.demonstration};
  if (firings.posterior.empty() || firings.of_doubled_prior.empty()) {
    result.failure =
        "no constants within prior.localisation, prior.exchange_time, prior.ignition_temperature and "
        "prior.scatter explain the firings";
    return;
  }
  result.constants = ranges_of(study::posterior_of(prior, {}, nodes), firings.posterior,
                               study::posterior_of(prior, launches, fewer_nodes));
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    FiringRow& row = result.rows[i];
    const auto probabilities =
        study::ignition_probabilities(firings.posterior, launches[i].boundary, row.log_heat_spread);
    row.predicted = {mean_of(probabilities), study::quantile_of(probabilities, 0.05),
                     study::quantile_of(probabilities, 0.95)};
    if (study::tail_probability(probabilities, row.ignited, row.rounds) < least_tail)
      result.contradicting.push_back(row.firing.name);
  }
  if (!result.contradicting.empty()) return;
  result.next = next_firings(result, firings.posterior, settings.next_gaps);
  const scene::Scene calibrated = calibrated_scene(result, result.constants);
  const study::CalibrationEvidence evidence = evidence_of(result, calibrated, firings, launches);
  result.record = study::CalibrationRecord{
      .title = result.study.study.title,
      .calibration = {calibrated, evidence,
                      std::make_shared<const study::FiringEvidence>(std::move(firings))}};
}

}  // namespace

FiringResult run_firings(const study::StudyFile& study, const StudyOptions& options) {
  return study::run_timed<FiringResult>(
      study, options, [&](FiringResult& result) { run_conditions(result, options); }, calibrate_on_firings);
}

}  // namespace launchsafe::kinds
