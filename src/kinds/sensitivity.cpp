#include "launchsafe/kinds/shown_surrogate.hpp"
#include "sensitivity_parts.hpp"

namespace launchsafe::kinds {

namespace {

/// Whole numbers that a double holds exactly.
constexpr double largest_seed = 9007199254740992.0;

constexpr auto assumed = Standing::assumed;

const std::vector<Key<SensitivitySettings>> sensitivity_keys{
    word_key("method", assumed,
             "Sobol's indices by differences, or of a polynomial or a Gaussian process that is fitted to "
             "fewer runs and held against others.",
             {{"sobol", SensitivityMethod::sobol}, {"polynomial-chaos", SensitivityMethod::polynomial_chaos}},
             &SensitivitySettings::method),
    number_key("seed", Dimension::count, between(0, largest_seed), assumed,
               "Seed of the design and of the bootstrap.", &SensitivitySettings::seed),
    number_key("resamples", Dimension::count, between(100, 1e6), assumed, "Resamples of the bootstrap.",
               &SensitivitySettings::resamples),
    number_key("confidence", Dimension::number, between(0.5, 0.999), assumed, "Confidence of the intervals.",
               &SensitivitySettings::confidence),
    word_key("design", assumed,
             "How the samples are laid out; a power of two of them is best for scrambled-sobol.",
             {{"scrambled-sobol", math::Design::scrambled_sobol},
              {"latin-hypercube", math::Design::latin_hypercube},
              {"monte-carlo", math::Design::monte_carlo}},
             &SensitivitySettings::design),
    number_key("samples", Dimension::count, between(2, 1e6), assumed,
               "Samples N of the inputs: each (inputs + 2) mechanical runs, of polynomial-chaos one.",
               &SensitivitySettings::samples),
    number_key("held_out", Dimension::count, between(study::fewest_held_out, 1e6), assumed,
               "Of polynomial-chaos: samples besides that are not fitted; its error is that there.",
               &SensitivitySettings::held_out),
    number_key("error_of_temperature", Dimension::temperature_difference, above(0), assumed,
               "Of polynomial-chaos: runs are added where the fit is least sure until no prediction of T max "
               "has a larger error.",
               &SensitivitySettings::temperature_error),
    number_key("error_of_critical_gap", Dimension::length, above(0), assumed, "Likewise of the critical gap.",
               &SensitivitySettings::critical_gap_error),
    number_key("most_samples", Dimension::count, between(2, 1e6), assumed,
               "With such an error: samples that are fitted at the most.",
               &SensitivitySettings::most_samples),
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
                "the record of a calibration that knows it better: " + allowed_text(key));
    refuse_at(study, axis.values_key, fmt::format("a sample of {}", value),
              "a range that cuts the normal off: " + allowed_text(key));
  }
}

void add_evaluations(StudyFile& study, const std::function<std::string(std::size_t evaluation)>& label) {
  const study::UncertainInputs drawn = uncertain_inputs(study.study);
  const std::vector<double> points = design_points(study.study);
  const std::size_t axes = study.study.axes.size(), count = points.size() / axes;
  const auto coordinates = [&](std::size_t evaluation) {
    return drawn.values_at(math::point_of_row(points, evaluation, axes));
  };
  for (std::size_t evaluation = 0; evaluation < count; ++evaluation)
    check_limits(study, coordinates(evaluation));
  add_varied_cases(study, count, coordinates,
                   [&](std::size_t evaluation, const StudyCase&) { return label(evaluation); });
}

std::string short_name(const Study& study, const SensitivityInput& input) {
  if (is_calibration(study, input)) return "calibration";
  std::string name = study.axes[input.first].name;
  for (std::size_t i = 1; i < input.count; ++i) name += " + " + study.axes[input.first + i].name;
  return name;
}

void make_saltelli(StudyFile& study) {
  const Study& s = study.study;
  const std::vector<SensitivityInput> each_input = inputs_of(s);
  const int rows = settings_of<SensitivitySettings>(s).samples;
  const std::size_t blocks = each_input.size() + 2;
  check_count(study, "samples", static_cast<double>(rows) * static_cast<double>(blocks),
              fmt::format("{} samples x ({} inputs + 2)", rows, each_input.size()));
  add_evaluations(study, [&](std::size_t evaluation) {
    const std::size_t block = evaluation % blocks;
    const bool mixed = block != math::SaltelliDesign::block_a && block != math::SaltelliDesign::block_b;
    const SensitivityInput input = mixed ? each_input[block - 2] : SensitivityInput{};
    return fmt::format("sample {} of {}", evaluation / blocks + 1,
                       mixed                                    ? fmt::format("AB({})", short_name(s, input))
                       : block == math::SaltelliDesign::block_a ? "A"
                                                                : "B");
  });
}

/// Errors are asked of a fit, and leave it room for more samples.
void check_asked_errors(const StudyFile& study) {
  const auto& own = settings_of<SensitivitySettings>(study);
  for (const char* key : {"error_of_temperature", "error_of_critical_gap", "most_samples"})
    if (study.places.contains(key) && !is_by_fit(study.study))
      refuse_at(study, key, "method = \"sobol\", which fits nothing", "method = \"polynomial-chaos\"");
  const bool asks = !std::isnan(own.temperature_error) || !std::isnan(own.critical_gap_error);
  if (asks && own.most_samples < own.samples)
    refuse_at(study, study.places.contains("most_samples") ? "most_samples" : "samples",
              fmt::format("{} samples, and {} at the most", own.samples, own.most_samples),
              "most_samples of at least samples");
  if (!asks && study.places.contains("most_samples"))
    refuse_at(study, "most_samples", "no error that is asked",
              "error_of_temperature or error_of_critical_gap beside it");
}

/// The samples that a fit begins with, and those that it is held against.
void make_chaos_samples(StudyFile& study) {
  const auto& own = settings_of<SensitivitySettings>(study);
  const auto fitted = static_cast<std::size_t>(own.samples),
             all = fitted + static_cast<std::size_t>(own.held_out);
  check_count(study, "samples", static_cast<double>(all),
              fmt::format("{} samples and {} held out", own.samples, own.held_out));
  const std::size_t fewest = math::fewest_chaos_points(study.study.axes.size());
  if (fitted < fewest)
    refuse_at(study, "samples", fmt::format("{} samples for a fit", fitted),
              fmt::format("at least {}: two an input, and 8", fewest));
  add_evaluations(study, [&](std::size_t evaluation) {
    return evaluation < fitted ? fmt::format("sample {}", evaluation + 1)
                               : fmt::format("held out {}", evaluation - fitted + 1);
  });
}

void make_sensitivity_cases(const StudySource&, StudyFile& study) {
  const std::vector<double>& gaps = study.study.gaps;
  if (gaps.size() != 1) {
    const char* whose = study.places.contains("gaps") ? "" : "no gap, and the scene's ";
    refuse_at(study, "gaps", fmt::format("{}{} gaps", whose, gaps.size()), "one gap",
              fmt::format("gaps = \"{}\"", format_quantity(gaps.back(), Dimension::length)));
  }
  check_asked_errors(study);
  if (is_by_fit(study.study)) return make_chaos_samples(study);
  make_saltelli(study);
}

double number_of(const OutputSensitivity& of, const SensitivityResult& result, std::size_t evaluation) {
  const CaseAnswer& answer = result.answers[evaluation];
  if (of.output == SensitivityOutput::critical_gap) return critical_gap_number(answer);
  const double temperature = temperature_of(answer, 0, of.inert);
  if (of.output == SensitivityOutput::maximum_temperature) return temperature;
  const StudyCase input = result.study.cases[evaluation];
  return input.scene.scene.charge().kinetics.ignition_temperature - temperature;
}

void summarise(const Study& study, OutputSensitivity& output) {
  std::vector<double> sample;
  for (std::size_t i = 0; i < output.values.size(); ++i)
    if (samples_inputs(study, i)) sample.push_back(output.values[i]);
  if (sample.size() < 2) return;
  const auto [mean, squares] = math::moments_of(sample);
  output.mean = mean;
  output.deviation = std::sqrt(squares / static_cast<double>(sample.size() - 1));
}

void estimate(const SensitivityResult& result, OutputSensitivity& output) {
  const Study& study = result.study.study;
  if (is_by_fit(study)) return estimate_by_chaos(result, output);
  output.sobol = math::sobol_indices(inputs_of(study).size(), output.values,
                                     settings_of<SensitivitySettings>(study).bootstrap());
  output.reason = output.sobol.reason;
}

OutputSensitivity sensitivity_of(const SensitivityResult& result, SensitivityOutput which) {
  OutputSensitivity output = values_of(result, which);
  if (!output.reason.empty()) return output;
  summarise(result.study.study, output);
  estimate(result, output);
  return output;
}

}  // namespace

Kind sensitivity_kind() {
  return {
      .traits = {.name = "sensitivity",
                 .gives_verdicts = false,
                 .bounds_critical_gaps = false,
                 .keeps_answers = true},
      .keys = joined({gaps_keys(), judging_keys(), calibration_record_keys(), uncertainty_keys(),
                      own_keys(sensitivity_keys)}),
      .tables = {vary_table(), correlation_table()},
      .varies = {.distributions = true, .needed = "with key and distribution, or a calibration"},
      .make_cases = make_sensitivity_cases,
      .run = outcome_of<run_sensitivity, failures_of<SensitivityResult>>,
      .files = {"histogram.svg", "surrogate.json", "ask.html", "sensitivity_*.svg"},
      .results = sensitivity_results,
  };
}

bool SensitivityResult::any_indeterminate() const {
  return std::ranges::any_of(outputs, [](const auto& each) { return !each.reason.empty(); }) ||
         !std::ranges::all_of(asked_errors(*this), &AskedError::reached);
}

std::vector<SensitivityInput> inputs_of(const Study& study) {
  const auto& own = settings_of<SensitivitySettings>(study);
  const std::size_t axes = study.axes.size();
  std::vector<SensitivityInput> inputs;
  for (std::size_t axis = 0; axis < axes; axis += inputs.back().count) {
    std::size_t end = axis + 1;
    for (std::size_t i = axis; i < end; ++i)
      for (std::size_t j = end; j < axes; ++j)
        if (own.vary_together(i, j, axes)) end = j + 1;
    inputs.push_back({axis, end - axis});
  }
  return inputs;
}

bool is_calibration(const Study& study, const SensitivityInput& input) {
  const auto& correlated = settings_of<SensitivitySettings>(study).correlated;
  return correlated && correlated->first == input.first && correlated->count == input.count;
}

study::UncertainInputs uncertain_inputs(const Study& study) {
  const auto& own = settings_of<SensitivitySettings>(study);
  return {of_each(study.axes, [](const Axis& axis) { return *axis.distribution; }), own.correlated,
          own.correlation};
}

bool samples_inputs(const Study& study, std::size_t evaluation) {
  const auto& own = settings_of<SensitivitySettings>(study);
  if (!is_by_fit(study)) return evaluation % (inputs_of(study).size() + 2) < 2;
  return evaluation < static_cast<std::size_t>(own.samples + own.held_out);
}

OutputSensitivity values_of(const SensitivityResult& result, SensitivityOutput which) {
  OutputSensitivity output;
  output.output = which;
  output.inert = which != SensitivityOutput::critical_gap && any_ignites(result.answers, 0);
  for (std::size_t i = 0; i < result.answers.size(); ++i) {
    const CaseAnswer& answer = result.answers[i];
    output.values.push_back(number_of(output, result, i));
    if (std::isfinite(output.values.back())) continue;
    ++output.missing;
    if (which == SensitivityOutput::critical_gap && is_bound(answer)) ++output.bounds;
  }
  const std::size_t all = result.answers.size(), failed = count_failed(result.answers);
  if (failed > 0)
    output.reason = fmt::format("{} of {} evaluations failed", failed, all);
  else if (output.missing > 0)
    output.reason = fmt::format("{} of {} evaluations have no number", output.missing, all);
  if (failed == 0 && which == SensitivityOutput::critical_gap)
    output.reason = gap_reason(result.answers, output.reason);
  return output;
}

SensitivityResult run_sensitivity(const StudyFile& study, const StudyOptions& options) {
  return run_timed<SensitivityResult>(
      study, options,
      [&](SensitivityResult& result) {
        study::ProgressTracker tracker(options.progress);
        result.answers = answer_cases(study, options, result.timing, tracker);
        if (!is_by_fit(study.study)) return;
        result.points = design_points(study.study);
        add_launches(result, options, tracker);
      },
      [](SensitivityResult& result) {
        for (const auto output : {SensitivityOutput::maximum_temperature, SensitivityOutput::critical_gap,
                                  SensitivityOutput::margin})
          result.outputs.push_back(sensitivity_of(result, output));
      });
}

}  // namespace launchsafe::kinds
