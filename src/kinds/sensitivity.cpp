#include "launchsafe/kinds/sensitivity.hpp"

#include "answer_values.hpp"
#include "launchsafe/study/case_answer.hpp"
#include "sensitivity_chaos.hpp"
#include "surrogate_text.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace launchsafe::kinds {

using study::Study;

bool SensitivityResult::any_indeterminate() const {
  return std::ranges::any_of(outputs, [](const auto& each) { return !each.reason.empty(); }) ||
         !std::ranges::all_of(asked_errors(*this), &AskedError::reached);
}

std::vector<SensitivityInput> inputs_of(const Study& study) {
  const auto& correlated = settings_of<SensitivitySettings>(study).correlated;
  std::vector<SensitivityInput> inputs;
  for (std::size_t axis = 0; axis < study.axes.size(); axis += inputs.back().count)
    inputs.push_back({axis, correlated && correlated->first == axis ? correlated->count : 1});
  return inputs;
}

study::UncertainInputs uncertain_inputs(const Study& study) {
  study::UncertainInputs inputs{.correlated = settings_of<SensitivitySettings>(study).correlated};
  for (const study::Axis& axis : study.axes) inputs.distributions.push_back(*axis.distribution);
  return inputs;
}

bool samples_inputs(const Study& study, std::size_t evaluation) {
  const auto& own = settings_of<SensitivitySettings>(study);
  if (!is_by_fit(study)) return evaluation % (inputs_of(study).size() + 2) < 2;
  return evaluation < static_cast<std::size_t>(own.samples + own.held_out);
}

namespace {

double number_of(const OutputSensitivity& of, const study::CaseAnswer& answer,
                 const study::StudyCase& input) {
  if (of.output == SensitivityOutput::critical_gap)
    return answer.completed() ? answer.critical.value : study::not_a_number;
  const double temperature = temperature_of(answer, 0, of.inert);
  return of.output == SensitivityOutput::margin
             ? input.scene.scene.charge().kinetics.ignition_temperature - temperature
             : temperature;
}

void summarise(const Study& study, OutputSensitivity& output) {
  std::vector<double> sample;
  for (std::size_t i = 0; i < output.values.size(); ++i) {
    if (samples_inputs(study, i) && std::isfinite(output.values[i])) sample.push_back(output.values[i]);
  }
  if (sample.size() < 2) return;
  const auto count = static_cast<double>(sample.size());
  output.mean = std::accumulate(sample.begin(), sample.end(), 0.0) / count;
  double squares = 0;
  for (const double value : sample) squares += (value - output.mean) * (value - output.mean);
  output.deviation = std::sqrt(squares / (count - 1.0));
}

void estimate(const SensitivityResult& result, OutputSensitivity& output) {
  const Study& study = result.study.study;
  const auto& own = settings_of<SensitivitySettings>(study);
  if (is_by_fit(study)) return estimate_by_chaos(result, output);
  if (own.surrogate) output.fit = fit_of(result, output);
  math::SobolOptions options;
  options.level = own.confidence;
  options.resamples = static_cast<std::size_t>(own.resamples);
  options.seed = own.seed;
  output.sobol = math::sobol_indices(inputs_of(study).size(), output.values, options);
  output.reason = output.sobol.reason;
}

OutputSensitivity sensitivity_of(const SensitivityResult& result, SensitivityOutput which) {
  OutputSensitivity output = values_of(result, which);
  summarise(result.study.study, output);
  if (output.bounds > 0) {
    output.reason = bounds_reason(output.bounds, output.values.size());
  } else {
    estimate(result, output);
  }
  return output;
}

}  // namespace

OutputSensitivity values_of(const SensitivityResult& result, SensitivityOutput which) {
  OutputSensitivity output;
  output.output = which;
  output.inert = which != SensitivityOutput::critical_gap && any_ignites(result.answers, 0);
  for (std::size_t i = 0; i < result.answers.size(); ++i) {
    const study::CaseAnswer& answer = result.answers[i];
    output.values.push_back(number_of(output, answer, result.study.cases[i]));
    if (std::isfinite(output.values.back())) continue;
    ++output.missing;
    if (which == SensitivityOutput::critical_gap && is_bound(answer)) ++output.bounds;
  }
  return output;
}

SensitivityResult run_sensitivity(const study::StudyFile& study, const study::StudyOptions& options) {
  return run_timed<SensitivityResult>(
      study, options,
      [&](SensitivityResult& result) {
        result.answers = answer_cases(study, options, result.timing);
        if (!is_by_fit(study.study) && !settings_of<SensitivitySettings>(study.study).surrogate) return;
        result.points = design_points(study.study);
        add_launches(result, options);
      },
      [](SensitivityResult& result) {
        for (const auto output : {SensitivityOutput::maximum_temperature, SensitivityOutput::critical_gap,
                                  SensitivityOutput::margin})
          result.outputs.push_back(sensitivity_of(result, output));
      });
}

}  // namespace launchsafe::kinds
