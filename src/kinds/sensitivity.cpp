#include "launchsafe/kinds/sensitivity.hpp"

#include "launchsafe/math/statistics.hpp"
#include "study_keys.hpp"

namespace launchsafe::kinds {

using math::Estimate;

namespace {

/// Whole numbers that a double holds exactly.
constexpr double largest_seed = 9007199254740992.0;

constexpr auto assumed = Standing::assumed;

const std::vector<Key<SensitivitySettings>> sensitivity_keys{
    number_key("seed", Dimension::count, between(0, largest_seed), assumed,
               "Seed of the design and of the bootstrap.", &SensitivitySettings::seed),
    number_key("samples", Dimension::count, between(2, 1e6), assumed,
               "Samples of the inputs, each a mechanical run; a power of two is best.",
               &SensitivitySettings::samples),
};

/// Beyond four deviations a normal without a range may still leave the limits of its key.
void check_limits(const StudyFile& study, const std::vector<double>& coordinates) {
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    const Axis& axis = study.study.axes[i];
    const KeyDescription& key = axis.key;
    if (key.limits.contain(coordinates[i])) continue;
    const std::string value = format_quantity(coordinates[i], key.dimension);
    if (axis.distribution->kind == math::Distribution::Kind::log_normal)
      refuse_at(study, axis.study_key, fmt::format("a sample of {} {}", key.name, value),
                "constants that are better known: " + allowed_text(key));
    refuse_at(study, axis.values_key, fmt::format("a sample of {}", value),
              "a range that cuts the normal off: " + allowed_text(key));
  }
}

/// Points of the unit cube of the axes, row by row.
std::vector<double> design_points(const Study& study) {
  const auto& own = settings_of<SensitivitySettings>(study);
  return math::unit_points(static_cast<std::size_t>(own.samples), study.axes.size(), own.seed);
}

/// SI, of all axes at a point of the unit cube. Its coordinates are shares of distributions; of the constants
/// of a calibration, shares of the standard normals that they are made of.
std::vector<double> values_at(const Study& study, const std::vector<double>& point) {
  static const math::Distribution standard_normal = math::Distribution::normal(0.0, 1.0);
  std::vector<double> values;
  for (std::size_t i = 0; i < point.size(); ++i)
    values.push_back(math::quantile(*study.axes[i].distribution, point[i]));
  const auto& calibrated = settings_of<SensitivitySettings>(study).calibrated;
  if (!calibrated) return values;
  const auto& [first, count, factor] = *calibrated;
  for (std::size_t i = 0; i < count; ++i) {
    double logarithm = 0.0;
    for (std::size_t j = 0; j <= i; ++j)
      logarithm += factor[i * count + j] * math::quantile(standard_normal, point[first + j]);
    values[first + i] = study.axes[first + i].distribution->centre * std::exp(logarithm);
  }
  return values;
}

void add_evaluations(StudyFile& study) {
  const std::vector<double> points = design_points(study.study);
  const std::size_t axes = study.study.axes.size(), count = points.size() / axes;
  const auto coordinates = [&](std::size_t evaluation) {
    return values_at(study.study, math::point_of_row(points, evaluation, axes));
  };
  for (std::size_t evaluation = 0; evaluation < count; ++evaluation)
    check_limits(study, coordinates(evaluation));
  add_varied_cases(study, count, coordinates, [](std::size_t evaluation, const StudyCase&) {
    return fmt::format("sample {}", evaluation + 1);
  });
}

void make_sensitivity_cases(const StudySource&, StudyFile& study) {
  const std::vector<double>& gaps = study.study.gaps;
  const bool varied = study::varies_gap(study.study);
  if (varied && !gaps.empty())
    refuse_at(study, "gaps", "gaps beside gap.thickness in vary", "either of both");
  if (!varied && gaps.size() != 1) {
    const char* whose = study.places.contains("gaps") ? "" : "no gap, and the scene's ";
    refuse_at(study, "gaps", fmt::format("{}{} gaps", whose, gaps.size()), "one gap",
              fmt::format("gaps = \"{}\"", format_quantity(gaps.back(), Dimension::length)));
  }
  const int samples = settings_of<SensitivitySettings>(study).samples;
  check_count(study, "samples", samples, fmt::format("{} samples", samples));
  const std::size_t fewest = math::fewest_chaos_points(study.study.axes.size());
  if (static_cast<std::size_t>(samples) < fewest)
    refuse_at(study, "samples", fmt::format("{} samples for a fit", samples),
              fmt::format("at least {}: two an input, and 8", fewest));
  add_evaluations(study);
}

double number_of(const OutputSensitivity& of, const SensitivityResult& result, std::size_t evaluation) {
  const CaseRow& row = result.rows[evaluation];
  if (of.output == SensitivityOutput::critical_gap) return critical_gap_number(row);
  const double temperature = temperature_of(row, 0, of.inert);
  if (of.output == SensitivityOutput::maximum_temperature) return temperature;
  const StudyCase input = result.study.cases[evaluation];
  return input.scene.scene.charge().kinetics.ignition_temperature - temperature;
}

void summarise(OutputSensitivity& output) {
  if (output.values.size() < 2) return;
  const auto [mean, squares] = math::moments_of(output.values);
  output.mean = mean;
  output.deviation = std::sqrt(squares / static_cast<double>(output.values.size() - 1));
}

/// Why critical gaps, some of which are bounds, have no indices; with the first that is none.
std::string bounds_reason(const OutputSensitivity& output, const std::vector<CaseRow>& rows) {
  const CaseRow& first =
      *std::ranges::find_if(rows, [](const CaseRow& row) { return std::isnan(critical_gap_number(row)); });
  return fmt::format("{} of {} critical gaps are bounds, not numbers (the first without a number: {})",
                     output.bounds, rows.size(), reads_as(first.critical));
}

/// Why an output has no statistics: an evaluation of it has no number. Empty where all have one.
std::string missing_reason(const OutputSensitivity& output, const std::vector<CaseRow>& rows) {
  const std::size_t failed = count_failed(rows);
  if (failed > 0) return fmt::format("{} of {} evaluations failed", failed, rows.size());
  if (output.bounds > 0) return bounds_reason(output, rows);
  if (output.missing == 0) return {};
  return fmt::format("{} of {} evaluations have no number", output.missing, rows.size());
}

math::ChaosBasis basis_of(const Axis& axis) {
  using Kind = math::Distribution::Kind;
  const Kind kind = axis.distribution->kind;
  return kind == Kind::normal || kind == Kind::log_normal ? math::ChaosBasis::hermite
                                                          : math::ChaosBasis::legendre;
}

/// Fits a polynomial, whose terms have the indices. Their intervals are widened by the share of the variance
/// that the fit misses of what it leaves out; where that is too large there are none.
void estimate(const Study& study, OutputSensitivity& output) {
  constexpr double most_unexplained = 0.1;
  const std::vector<double> points = design_points(study);
  const math::PolynomialChaos& fit =
      output.fit.emplace(math::fit_chaos(of_each(study.axes, basis_of), points, output.values));
  output.reason = fit.reason;
  if (!output.reason.empty()) return;
  const double unexplained = std::pow(fit.leave_one_out / output.deviation, 2);
  if (unexplained > most_unexplained) {
    output.reason =
        fmt::format("the polynomial misses {:.2g} % of the variance of evaluations left out of its fit",
                    100.0 * unexplained);
    return;
  }
  std::vector<std::size_t> begins = of_each(inputs_of(study), &SensitivityInput::first);
  begins.push_back(study.axes.size());
  output.sobol = math::chaos_indices(fit, points, output.values, begins,
                                     {.seed = settings_of<SensitivitySettings>(study).seed});
  output.reason = output.sobol.reason;
  for (math::InputIndices& each : output.sobol.inputs)
    for (Estimate* estimate : {&each.first, &each.total}) {
      estimate->lower = std::max(0.0, estimate->lower - unexplained);
      estimate->upper = std::min(1.0, estimate->upper + unexplained);
    }
}

OutputSensitivity sensitivity_of(const SensitivityResult& result, SensitivityOutput which) {
  const Study& study = result.study.study;
  OutputSensitivity output;
  output.output = which;
  output.inert = which != SensitivityOutput::critical_gap && any_ignites(result.rows, 0);
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    output.values.push_back(number_of(output, result, i));
    if (std::isfinite(output.values.back())) continue;
    ++output.missing;
    if (which == SensitivityOutput::critical_gap && is_bound(result.rows[i])) ++output.bounds;
  }
  output.reason = missing_reason(output, result.rows);
  if (!output.reason.empty()) return output;
  summarise(output);
  estimate(study, output);
  return output;
}

}  // namespace

Kind sensitivity_kind() {
  return {
      .traits = {.name = "sensitivity", .gives_verdicts = false},
      .keys = joined({gaps_keys(), search_keys(), own_keys(sensitivity_keys)}),
      .tables = {vary_table()},
      .varies = {.distributions = true, .needed = "with key and distribution, or the key constants"},
      .make_cases = make_sensitivity_cases,
      .run = outcome_of<run_sensitivity, failures_of<SensitivityResult>>,
      .results = sensitivity_results,
  };
}

std::vector<SensitivityInput> inputs_of(const Study& study) {
  const auto& calibrated = settings_of<SensitivitySettings>(study).calibrated;
  std::vector<SensitivityInput> inputs;
  for (std::size_t axis = 0; axis < study.axes.size(); axis += inputs.back().count)
    inputs.push_back({axis, calibrated && calibrated->first == axis ? calibrated->count : 1});
  return inputs;
}

SensitivityResult run_sensitivity(const StudyFile& study, const StudyOptions& options) {
  return run_timed<SensitivityResult>(
      study, options,
      [&](SensitivityResult& result) {
        study::ProgressTracker tracker(options.progress);
        result.rows = draw_rows(study, options, result.timing, tracker);
      },
      [](SensitivityResult& result) {
        for (const auto output : {SensitivityOutput::maximum_temperature, SensitivityOutput::critical_gap,
                                  SensitivityOutput::margin})
          result.outputs.push_back(sensitivity_of(result, output));
      });
}

}  // namespace launchsafe::kinds
