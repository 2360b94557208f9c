// A calibration on firings, with its tables, page and files.
#include "calibration_parts.hpp"
#include "launchsafe/report/case_tables.hpp"

#include <tbb/parallel_for.h>

namespace launchsafe::kinds {

using study::Firing, study::Posterior, study::PosteriorPoint;

namespace {

constexpr int nodes = 25, fewer_nodes = 13;   ///< of the lattice of a posterior
constexpr double least_above_hottest = 20.0;  ///< K, of an ignition temperature above the hottest charge
constexpr double least_tail = 0.01;           ///< of study::tail_probability

void run_conditions(FiringResult& result, const StudyOptions& options) {
  for (const StudyCase& input : result.study.cases) result.conditions.emplace_back(input);
  study::run_every_case(
      result.study, options, result.timing, [&](std::size_t i, std::vector<FinishedRun>& finished) {
        CalibrationRun& condition = result.conditions[i];
        static_cast<FinishedRun&>(condition) = finished.front();
        if (condition.failure.empty())
          condition.failure =
              calibration_validity_warnings(condition.input.scene.scene, condition.mechanics());
      });
}

/// K, of T max of a skin that does not react.
double rise_of(const CalibrationRun& condition, double gap) {
  const SkinModel model = study::without_reaction(surface::skin_model(condition.input.scene.scene));
  const auto skin = surface::integrate_skin(model, condition.mechanics().trace, gap);
  return surface::maximum_at_stations(skin, condition.mechanics().trace).temperature -
         condition.input.scene.scene.initial_temperature;
}

/// How much the heat of rounds differs as their pressures and temperatures do.
double log_heat_spread(const CalibrationRun& condition, const Firing& firing) {
  return std::hypot(study::heat_exponent * firing.pressure_spread / firing.pressure,
                    firing.temperature_spread / rise_of(condition, firing.gap));
}

/// Each firing with the rounds of its pressure, temperature and gap.
std::vector<FiringRow> rows_of(const std::vector<Firing>& firings) {
  const std::vector<std::size_t> conditions = conditions_of(firings);
  std::vector<FiringRow> rows;
  for (const Firing& firing : firings) {
    FiringRow& row = rows.emplace_back(FiringRow{firing, conditions[rows.size()]});
    for (std::size_t i = 0; i < firings.size(); ++i) {
      if (conditions[i] != row.condition || firings[i].gap != firing.gap) continue;
      row.rounds += firings[i].rounds;
      row.ignited += firings[i].ignited ? firings[i].rounds : 0;
    }
    row.shown = math::clopper_pearson(row.ignited, row.rounds, 0.9);
  }
  return rows;
}

/// What every row needs to ignite, over all that the wider prior allows; none where that is not known.
std::vector<study::FiredLaunch> launches_of(FiringResult& result, const study::FiringPrior& widest) {
  std::vector<std::optional<surface::IgnitionBoundary>> boundaries(result.rows.size());
  tbb::parallel_for(std::size_t{0}, result.rows.size(), [&](std::size_t i) {
    FiringRow& row = result.rows[i];
    const CalibrationRun& condition = result.conditions[row.condition];
    row.log_heat_spread = log_heat_spread(condition, row.firing);
    boundaries[i] = surface::IgnitionBoundary::find(surface::skin_model(condition.input.scene.scene),
                                                    condition.mechanics().trace, row.firing.gap,
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

double mean_of(const std::vector<double>& values) { return math::moments_of(values).mean; }

double geometric_mean(const std::vector<double>& values) {
  return std::exp(mean_of(of_each(values, [](double value) { return std::log(value); })));
}

/// The middle 90 % of values that are equally probable, about one in their middle.
math::Estimate middle_of(const std::vector<double>& values, double centre) {
  return {centre, study::quantile_of(values, 0.05), study::quantile_of(values, 0.95)};
}

std::vector<ConstantRange> ranges_of(const Posterior& prior, const Posterior& posterior,
                                     const Posterior& coarser) {
  const auto range_of = [&](const char* name, auto number) {
    const auto before = of_each(prior, number), after = of_each(posterior, number);
    const double centre = geometric_mean(after);
    return ConstantRange{name, middle_of(before, geometric_mean(before)), middle_of(after, centre),
                         geometric_mean(of_each(coarser, number)) / centre - 1.0};
  };
  const auto constant = [&](const char* name, double SurfaceConstants::*member) {
    return range_of(name, [member](const PosteriorPoint& each) { return each.constants.*member; });
  };
  return {constant("friction.localisation", &SurfaceConstants::localisation),
          constant("gap.exchange_time", &SurfaceConstants::exchange_time),
          constant("kinetics.ignition_temperature", &SurfaceConstants::ignition_temperature),
          range_of("scatter", &PosteriorPoint::scatter)};
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
    const SkinModel model = surface::skin_model(condition.input.scene.scene);
    for (const double gap : gaps) {
      const auto boundary = study::boundary_for(posterior, model, condition.mechanics().trace, gap);
      if (!boundary) continue;
      const auto probabilities = study::ignition_probabilities(posterior, *boundary, row.log_heat_spread);
      const double mean = mean_of(probabilities), open = mean_of(of_each(probabilities, entropy));
      next.push_back({row.firing.pressure, row.firing.temperature, gap, mean, entropy(mean) - open});
    }
  }
  std::ranges::stable_sort(next, std::ranges::greater{}, &NextFiring::information);
  return next;
}

/// The study's scene with the constants at the middle of their posterior.
Scene calibrated_scene(const FiringResult& result, const std::vector<ConstantRange>& ranges) {
  Scene scene = result.study.scene.scene;
  put({ranges[0].after.value, ranges[1].after.value, ranges[2].after.value}, scene.surface,
      scene.charge().kinetics);
  scene.accepted.clear();
  return scene;
}

/// What the record says of the thickest gap that did not ignite, or of the first firing where all ignited.
study::CalibrationEvidence evidence_of(const FiringResult& result, const Scene& calibrated,
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
  const SurfaceConstants constants = surface::constants_of(surface::skin_model(calibrated));
  double factor = 1.0;
  for (const Posterior* posterior : {&firings.posterior, &firings.of_doubled_prior})
    factor = std::max(factor, study::heat_factor(*posterior, launches[place].boundary, constants));
  CalibrationRun condition = result.conditions[result.rows[place].condition];
  Scene& scene = condition.input.scene.scene;
  scene.surface.localisation = calibrated.surface.localisation;
  scene.surface.exchange_time = calibrated.surface.exchange_time;
  const double friction = rise_of(condition, 0.0), all = rise_of(condition, result.rows[place].firing.gap);
  return {friction, all - friction, largest, std::min(1e4, (factor - 1.0) * all)};
}

void calibrate_on_firings(FiringResult& result) {
  for (const CalibrationRun& each : result.conditions)
    if (result.failure.empty() && !each.failure.empty())
      result.failure = each.input.label + ": " + each.failure;
  if (!result.failure.empty()) return;
  const FiringSettings& settings = settings_of<CalibrationSettings>(result.study).firings;
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
    row.predicted = middle_of(probabilities, mean_of(probabilities));
    if (study::tail_probability(probabilities, row.ignited, row.rounds) < least_tail)
      result.contradicting.push_back(row.firing.name);
  }
  if (!result.contradicting.empty()) return;
  result.next = next_firings(result, firings.posterior, settings.next_gaps);
  const Scene calibrated = calibrated_scene(result, result.constants);
  const study::CalibrationEvidence evidence = evidence_of(result, calibrated, firings, launches);
  result.record =
      CalibrationRecord{.title = result.study.study.title,
                        .calibration = {calibrated, evidence,
                                        std::make_shared<const study::FiringEvidence>(std::move(firings))}};
}

// --- tables, page and files ---

const Column initial_temperature{"initial_temperature", "T before", significant(4, kelvin),
                                 "Temperature of charge and air before."};

Column probability(const char* name, const char* heading, const char* meaning) {
  return {name, heading, significant(3, percent), meaning};
}

const Quantities<Firing> firing_quantities{
    {"name", "firing", text(), "What the rounds are called.", &Firing::name},
    {"rounds", "rounds", count(), "How many there were.", &Firing::rounds},
    {quantity::peak_pressure, &Firing::pressure},
    {initial_temperature, &Firing::temperature},
    {quantity::gap, &Firing::gap},
    {"gap_most", "gap at most", significant(6, centimetre), "The largest that it can have been.",
     &Firing::most_gap},
    {"ignited", "ignited", text(), "Whether the rounds ignited.", &Firing::ignited}};

const auto row_quantities = joined<FiringRow>(
    {of_part<FiringRow>(firing_quantities, &FiringRow::firing),
     {{probability("shown_lowest", "more than",
                   "With 95 % the probability of a round is more, by the rounds of this kind alone."),
       &FiringRow::shown, &math::Interval::lower},
      {probability("shown_highest", "less than", "With 95 % it is less, by these rounds alone."),
       &FiringRow::shown, &math::Interval::upper},
      {probability("ignition_probability", "computed",
                   "Probability that a round ignites, after all firings."),
       &FiringRow::predicted, &math::Estimate::value},
      {probability("ignition_probability_lowest", "from", "With 95 % it is more than this."),
       &FiringRow::predicted, &math::Estimate::lower},
      {probability("ignition_probability_highest", "to", "With 95 % it is less than this."),
       &FiringRow::predicted, &math::Estimate::upper}}});

Column bound(const char* name, const char* heading, const char* meaning) {
  return {name, heading, significant(4), meaning};
}

const Quantities<ConstantRange> range_quantities{
    {"key", "constant", text(), "Key of the scene, SI; or the scatter between rounds.", &ConstantRange::name},
    {bound("prior_lowest", "before: 5 %", "5 % of the prior lie below."), &ConstantRange::before,
     &Estimate::lower},
    {bound("prior_centre", "mean", "Geometric mean of the prior."), &ConstantRange::before, &Estimate::value},
    {bound("prior_highest", "95 %", "95 % of the prior lie below."), &ConstantRange::before,
     &Estimate::upper},
    {bound("lowest", "after: 5 %", "5 % of the posterior lie below."), &ConstantRange::after,
     &Estimate::lower},
    {bound("centre", "mean", "Geometric mean of the posterior, which the record has as the constant."),
     &ConstantRange::after, &Estimate::value},
    {bound("highest", "95 %", "95 % of the posterior lie below."), &ConstantRange::after, &Estimate::upper},
    {"change_of_coarser", "coarser lattice", significant(2, percent),
     "By how much the mean is higher on a lattice of half as many values a constant.",
     &ConstantRange::change_of_coarser}};
const Quantities<NextFiring> next_quantities{
    {quantity::peak_pressure, &NextFiring::pressure},
    {initial_temperature, &NextFiring::temperature},
    {quantity::gap, &NextFiring::gap},
    {probability("ignition_probability", "ignites", "Probability that the round ignites, after all firings."),
     &NextFiring::ignition},
    {"information", "tells [bit]", significant(2), "What its outcome tells of the constants, on average.",
     &NextFiring::information}};

Row facts_of(const FiringResult& result) {
  Row facts{{"failure", result.failure},
            {"contradicting", result.contradicting},
            {"quiet", 0},
            {"ignited", 0},
            {"demonstration", result.record && result.record->calibration.firings->demonstration},
            {"rows", Row::array()}};
  for (const FiringRow& row : result.rows) {
    Row& rounds = facts[row.firing.ignited ? "ignited" : "quiet"];
    rounds = rounds.get<int>() + row.firing.rounds;
    Row& facts_of_row = facts["rows"].emplace_back(json_of(row_quantities, row));
    facts_of_row["ignited_rounds"] = row.ignited;
    facts_of_row["counted_rounds"] = row.rounds;
  }
  if (!result.next.empty()) facts["next"] = json_of(next_quantities, result.next.front());
  if (result.record) facts["largest"] = centimetres(result.record->calibration.evidence.largest_gap);
  return facts;
}

std::vector<ReportTable> tables_of(const FiringResult& result) {
  const Row facts = facts_of(result);
  const auto table = [&](const char* title, const auto& quantities, const auto& rows, const char* notes) {
    return table_of(title, quantities, rows, said(notes, facts));
  };
  return {{table("Firings, and the probability that such a round ignites", row_quantities, result.rows,
                 "calibration.note.firings"),
           "firings.csv", "firings"},
          {table("The constants before and after the firings", range_quantities, result.constants,
                 "calibration.note.posterior"),
           "", "posterior"},
          {table("What one more round would tell", next_quantities, result.next, "calibration.note.next"), "",
           "next_firings"}};
}

}  // namespace

FiringResult run_firings(const StudyFile& study, const StudyOptions& options) {
  return study::run_timed<FiringResult>(
      study, options, [&](FiringResult& result) { run_conditions(result, options); }, calibrate_on_firings);
}

std::string answer(const FiringResult& result) {
  return said("calibration.firings.answer", facts_of(result)).front();
}

Report report_of(const FiringResult& result) {
  Report report{result.study.study.title, answer(result), report::remaking_command(result.study)};
  if (result.record) report.files.push_back({"calibration.json", study::to_json_text(*result.record)});
  for (ReportTable& table : tables_of(result)) report.add(std::move(table));
  report.say("## Setup\n\n" + report::setup_text(result.study));
  report.add({run_table(result.conditions), "", "runs", Shown::page});
  report.say(report::timing_sentence(result.timing));
  report.json = study_json(result.study, report,
                           {{"failure", result.failure}, {"timing", report::timing_json(result.timing)}});
  return report;
}

std::vector<ReportTable> firing_results() { return tables_of({}); }

}  // namespace launchsafe::kinds
