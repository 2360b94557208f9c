// The study of kind sensitivity: which inputs the answer depends on, with intervals.
#pragma once

#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/study/case_answer.hpp"
#include "launchsafe/study/surrogate.hpp"

namespace launchsafe::kinds {

/// How indices of first and total order follow from evaluations.
enum class SensitivityMethod {
  sobol,            ///< differences (Saltelli 2010, Jansen 1999): samples x (inputs + 2) evaluations
  polynomial_chaos  ///< a fit to the samples, whose error is that at as many more as held out
};

/// Two inputs that vary together, as the study file states it, by their scene keys.
struct StatedCorrelation {
  std::string one, other;
  double coefficient = 0;  ///< of their normal scores
};

/// What a study file of this kind says besides; its inputs are Study::axes, with distributions.
struct SensitivitySettings {
  SensitivityMethod method = SensitivityMethod::sobol;
  math::Design design = math::Design::latin_hypercube;
  int samples = 64;   ///< N: rows of the matrices A and B, or evaluations that are fitted
  int held_out = 32;  ///< evaluations that are not
  // Of a fit that is to err less: the error of a prediction (Surrogate::largest_error), NaN where none is
  // asked, and up to how many evaluations are fitted for it.
  double temperature_error = study::not_a_number;   ///< K
  double critical_gap_error = study::not_a_number;  ///< m
  int most_samples = 256;
  std::uint64_t seed = 1;  ///< of design and bootstrap
  int resamples = 1000;    ///< of the bootstrap
  double confidence = 0.95;
  std::optional<study::CorrelatedInputs> correlated = {};  ///< of Study::axes, by the record of a calibration
  std::vector<StatedCorrelation> stated = {};
  std::vector<double> correlation = {};  ///< that this makes: UncertainInputs::correlation
  /// Whether two of so many axes vary together, by the record of a calibration or as stated.
  bool vary_together(std::size_t one, std::size_t other, std::size_t axes) const {
    return (correlated && correlated->has(one) && correlated->has(other)) ||
           (!correlation.empty() && correlation[one * axes + other] != 0.0);
  }
  math::SobolOptions bootstrap() const { return {confidence, static_cast<std::size_t>(resamples), seed}; }
};

/// What has indices of its own: an axis, or those that vary together, since indices need independent inputs.
struct SensitivityInput {
  std::size_t first = 0, count = 1;  ///< among Study::axes
};
std::vector<SensitivityInput> inputs_of(const study::Study& study);
/// Whether an input is all the constants of a calibration and nothing else.
bool is_calibration(const study::Study& study, const SensitivityInput& input);

/// Whether the indices are those of a fit.
inline bool is_by_fit(const study::Study& study) {
  return settings_of<SensitivitySettings>(study).method == SensitivityMethod::polynomial_chaos;
}

/// What the study draws from, in the order of Study::axes.
study::UncertainInputs uncertain_inputs(const study::Study& study);

/// Whether an evaluation is a draw from the distributions of the inputs, rather than one made for
/// differences, or where a fit was least sure: the blocks A and B of a Saltelli design, and the samples that
/// a fit begins with or is held against.
bool samples_inputs(const study::Study& study, std::size_t evaluation);

/// One output of a case as a number.
enum class SensitivityOutput {
  maximum_temperature,  ///< K, T max of the verdict at the study's gap; see OutputSensitivity::inert
  critical_gap,         ///< m
  margin                ///< K, ignition temperature minus that maximum temperature
};

/// What an output depends on.
struct OutputSensitivity {
  SensitivityOutput output;
  /// Temperature and margin are those of a skin that does not react, GapVerdict::heated: so where
  /// any evaluation ignites, since T max then jumps to that of the burning skin. Kinetics do not show in
  /// them.
  bool inert = false;
  std::vector<double> values;  ///< of every evaluation; NaN where there is none
  std::size_t missing = 0;  ///< evaluations without a number: failed runs, or a critical gap that is a bound
  std::size_t bounds = 0;   ///< of these, critical gaps that are bounds
  double mean = study::not_a_number,
         deviation = study::not_a_number;          ///< over the evaluations that sample the inputs
  math::SobolIndices sobol;                        ///< where there are indices, of every input
  std::optional<study::SurrogateOutput> fit = {};  ///< of a study by fit
  /// Why there are no indices, fit, mean and deviation: an evaluation without a number, or what they say
  /// themselves. Empty where there are.
  std::string reason;
};

struct SensitivityResult : StudyResult {
  std::vector<study::CaseAnswer> answers;  ///< one for each of StudyFile::cases
  std::vector<OutputSensitivity> outputs;
  /// Of a fit: points of the unit cube, a row a case. Behind those of the design are those
  /// that were added, where the fit was least sure, for the errors that are asked of it.
  std::vector<double> points = {};
  bool any_indeterminate() const;  ///< an output without indices, or with a larger error than is asked
};

/// An error that is asked of a fit, and what it came to.
struct AskedError {
  SensitivityOutput output;
  double asked = study::not_a_number;  ///< K or m
  double found = study::not_a_number;  ///< NaN where nothing is predicted
  bool reached() const { return found <= asked; }
};
/// Of a study that has its outputs.
std::vector<AskedError> asked_errors(const SensitivityResult& result);

SensitivityResult run_sensitivity(const study::StudyFile& study, const study::StudyOptions& options = {});

/// Which inputs matter, as far as the intervals tell them apart; what cannot be told; what failed.
std::string answer(const SensitivityResult& result);
/// Nothing in it differs between two runs of a study: no times, rates, dates or hosts.
report::Report report_of(const SensitivityResult& result);

/// A row for every input: its distribution, and indices with their intervals. Method, N, design, seed and
/// confidence are in the notes; so is the reason where an output has no indices. The second has all outputs
/// below each other, for other programs.
report::Table sensitivity_table(const SensitivityResult& result, const OutputSensitivity& output);
report::Table sensitivity_table(const SensitivityResult& result);
/// A row for every output, and for every evaluation: its inputs, outputs and failure.
report::Table output_table(const SensitivityResult& result);
report::Table evaluation_table(const SensitivityResult& result);

/// First and total order of every input with their intervals.
report::Plot sensitivity_plot(const SensitivityResult& result, const OutputSensitivity& output);

}  // namespace launchsafe::kinds
