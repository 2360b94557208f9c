#include "launchsafe/kinds/shown_surrogate.hpp"
#include "sensitivity_parts.hpp"

namespace launchsafe::kinds {

using study::Surrogate, study::SurrogateOutput, study::SurrogateRecord;

namespace {

SurrogateRecord launches_of(const SensitivityResult& result) {
  const Study& study = result.study.study;
  const auto& own = settings_of<SensitivitySettings>(study);
  SurrogateRecord record{.scene = result.study.scene.scene,
                         .gap = study.gaps.front(),
                         .keys = of_each(study.axes, [](const Axis& axis) { return axis.key.name; }),
                         .inputs = uncertain_inputs(study),
                         .points = result.points,
                         .held_out = std::vector<std::size_t>(static_cast<std::size_t>(own.held_out))};
  std::iota(record.held_out.begin(), record.held_out.end(), static_cast<std::size_t>(own.samples));
  scene::clear_remarks(record.scene);
  return record;
}

SurrogateOutput unfitted(const SensitivityResult& result, const OutputSensitivity& output) {
  return {.name = shown_output(output.output).column.name,
          .gap = result.study.study.gaps.front(),
          .inert = output.inert,
          .values = output.values};
}

std::vector<std::size_t> columns_of(const Study& study) {
  return of_each(inputs_of(study), &SensitivityInput::count);
}

/// By differences, as of launches, of as many predictions as it takes.
math::SobolIndices indices_of_predictions(const Study& study, const Surrogate& surrogate,
                                          const math::SobolOptions& options) {
  constexpr std::size_t rows = 1024;
  const std::vector<std::size_t> columns = columns_of(study);
  const math::CopulaDraws drawn = uncertain_inputs(study).draws();
  const math::SaltelliDesign design =
      math::saltelli_design(math::Design::scrambled_sobol, rows, columns, options.seed);
  std::vector<double> values;
  for (std::size_t evaluation = 0; evaluation < design.evaluations(); ++evaluation)
    values.push_back(surrogate.at(drawn.at(design.point(evaluation))).value);
  return math::sobol_indices(columns.size(), values, options);
}

/// What is asked of an output.
double asked_error(const Study& study, SensitivityOutput output) {
  const auto& own = settings_of<SensitivitySettings>(study);
  if (output == SensitivityOutput::maximum_temperature) return own.temperature_error;
  return output == SensitivityOutput::critical_gap ? own.critical_gap_error : not_a_number;
}

/// Launches that would lessen the error that is most times what is asked; none where all are reached.
std::vector<double> next_points(const SensitivityResult& result, std::size_t count) {
  const Study& study = result.study.study;
  const SurrogateRecord record = launches_of(result);
  double worst = 1.0;
  SurrogateOutput of;
  for (const auto which : {SensitivityOutput::maximum_temperature, SensitivityOutput::critical_gap}) {
    const double asked = asked_error(study, which);
    const OutputSensitivity output = values_of(result, which);
    if (std::isnan(asked) || !output.reason.empty()) continue;
    SurrogateOutput fitted = unfitted(result, output);
    fit_output(record, fitted);
    if (!fitted.reason.empty()) continue;
    const double excess = Surrogate(record, fitted).largest_error() / asked;
    if (!(excess > worst)) continue;
    worst = excess;
    of = std::move(fitted);
  }
  if (of.values.empty()) return {};
  return least_sure_points(
      record, of, count,
      math::hashed(settings_of<SensitivitySettings>(study).seed, 2 + result.answers.size()));
}

/// Computes launches at these points and adds them; false where they are not all there.
bool add_round(SensitivityResult& result, const std::vector<double>& points, const StudyOptions& options,
               study::ProgressTracker& tracker) {
  const study::UncertainInputs inputs = uncertain_inputs(result.study.study);
  const std::size_t axes = result.study.study.axes.size(), known = result.answers.size();
  const auto& own = settings_of<SensitivitySettings>(result.study);
  const std::size_t designed = static_cast<std::size_t>(own.samples + own.held_out);
  StudyFile round = result.study;
  round.cases = {};
  const auto values_at = [&](std::size_t row) {
    return inputs.values_at(math::point_of_row(points, row, axes));
  };
  const auto label_of = [&](std::size_t row, const auto&) {
    return fmt::format("added {}", known - designed + row + 1);
  };
  try {
    add_varied_cases(round, points.size() / axes, values_at, label_of);
  } catch (const scene::InputError&) {
    return false;
  }
  const std::vector<CaseAnswer> answers = answer_cases(round, options, result.timing, tracker);
  if (std::ranges::count(answers, RunOutcome::not_stored, &CaseAnswer::outcome) > 0 ||
      stop_requested(options))
    return false;
  for (std::size_t row = 0; row < answers.size(); ++row) {
    result.study.cases.add(round.cases.label(row), round.cases.coordinates(row));
    result.answers.push_back(answers[row]);
  }
  result.points.insert(result.points.end(), points.begin(), points.end());
  return true;
}

/// Points of the unit cube as the design has them.
std::vector<double> independent_points(const Study& study) {
  const auto& own = settings_of<SensitivitySettings>(study);
  if (!is_by_fit(study)) {
    const auto rows = static_cast<std::size_t>(own.samples);
    const math::SaltelliDesign design = math::saltelli_design(own.design, rows, columns_of(study), own.seed);
    std::vector<double> points;
    for (std::size_t evaluation = 0; evaluation < design.evaluations(); ++evaluation) {
      const std::vector<double> point = design.point(evaluation);
      points.insert(points.end(), point.begin(), point.end());
    }
    return points;
  }
  const auto of = [&](math::Design design, int count, std::uint64_t seed) {
    return math::unit_points(design, static_cast<std::size_t>(count), study.axes.size(), seed);
  };
  std::vector<double> points = of(own.design, own.samples, own.seed);
  const std::vector<double> held_out = of(math::Design::monte_carlo, own.held_out, math::hashed(own.seed, 1));
  points.insert(points.end(), held_out.begin(), held_out.end());
  return points;
}

}  // namespace

std::vector<double> design_points(const Study& study) {
  const math::CopulaDraws drawn = uncertain_inputs(study).draws();
  const std::vector<double> independent = independent_points(study);
  const std::size_t axes = study.axes.size();
  std::vector<double> points;
  for (std::size_t row = 0; row < independent.size() / axes; ++row)
    std::ranges::copy(drawn.at(math::point_of_row(independent, row, axes)), std::back_inserter(points));
  return points;
}

void estimate_by_chaos(const SensitivityResult& result, OutputSensitivity& output) {
  const Study& study = result.study.study;
  const auto& own = settings_of<SensitivitySettings>(study);
  const SurrogateRecord record = launches_of(result);
  SurrogateOutput& fit = output.fit.emplace(unfitted(result, output));
  fit_output(record, fit);
  output.reason = fit.reason;
  if (!output.reason.empty()) return;
  std::vector<std::size_t> begins = of_each(inputs_of(study), &SensitivityInput::first);
  begins.push_back(study.axes.size());
  const math::FiniteRows rows = record.fitted_rows(fit.values);
  // The terms of a polynomial are independent of each other where the inputs are.
  output.sobol = fit.fit.by_process() || !own.correlation.empty()
                     ? indices_of_predictions(study, Surrogate(record, fit), own.bootstrap())
                     : math::chaos_indices(fit.fit.chaos, rows.points, rows.values, begins, own.bootstrap());
  output.reason = output.sobol.reason;
  for (math::InputIndices& each : output.sobol.inputs)
    for (math::Estimate* estimate : {&each.first, &each.total}) {
      estimate->lower = std::max(0.0, estimate->lower - fit.error.unexplained);
      estimate->upper = std::min(1.0, estimate->upper + fit.error.unexplained);
    }
}

void add_launches(SensitivityResult& result, const StudyOptions& options, study::ProgressTracker& tracker) {
  constexpr std::size_t round = 8;
  const auto& own = settings_of<SensitivitySettings>(result.study);
  if (!options.shard.whole()) return;
  for (;;) {
    const std::size_t fitted = result.answers.size() - static_cast<std::size_t>(own.held_out);
    const auto most = static_cast<std::size_t>(own.most_samples), left = most - std::min(fitted, most);
    if (left == 0 || stop_requested(options)) return;
    const std::vector<double> points = next_points(result, std::min(round, left));
    if (points.empty() || !add_round(result, points, options, tracker)) return;
  }
}

std::vector<AskedError> asked_errors(const SensitivityResult& result) {
  std::vector<AskedError> errors;
  for (const OutputSensitivity& output : result.outputs) {
    const double asked = asked_error(result.study.study, output.output);
    if (std::isnan(asked)) continue;
    errors.push_back({output.output, asked});
    if (output.fit && output.fit->reason.empty())
      errors.back().found = Surrogate(launches_of(result), *output.fit).largest_error();
  }
  return errors;
}

SurrogateRecord surrogate_record(const SensitivityResult& result) {
  SurrogateRecord record = launches_of(result);
  for (const OutputSensitivity& output : result.outputs) {
    if (output.output == SensitivityOutput::margin) continue;  // of T max and the ignition temperature
    record.outputs.push_back(output.fit ? *output.fit : unfitted(result, output));
    record.outputs.back().reason = output.reason;
  }
  predict_from_sound_launches(record, result.answers);
  return record;
}

}  // namespace launchsafe::kinds
