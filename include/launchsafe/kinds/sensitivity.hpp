// The study of kind sensitivity: which inputs the answer depends on, with intervals.
#pragma once

#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/math/polynomial_chaos.hpp"
#include "launchsafe/study/case_rows.hpp"

namespace launchsafe::kinds {

/// The constants of a calibration among the inputs. They vary together: their logarithms are normal, with the
/// covariance of its fit.
struct CalibratedInputs {
  std::size_t first = 0, count = 0;  ///< among Study::axes, whose distributions have their medians
  std::vector<double> factor;        ///< of the covariance of the logarithms (math::covariance_factor)
};

/// What a study file of this kind says besides; its inputs are Study::axes, with distributions.
struct SensitivitySettings {
  int samples = 64;        ///< of the inputs, to which a polynomial is fitted
  std::uint64_t seed = 1;  ///< of design and bootstrap
  std::optional<CalibratedInputs> calibrated = {};
};

/// What has indices of its own: an axis, or all constants of a calibration, as indices need independent
/// inputs.
struct SensitivityInput {
  std::size_t first = 0, count = 1;  ///< among Study::axes
};
std::vector<SensitivityInput> inputs_of(const study::Study& study);

/// One output of a case as a number.
enum class SensitivityOutput {
  maximum_temperature,  ///< K, T max at the study's gap; see OutputSensitivity::inert
  critical_gap,         ///< m
  margin                ///< K, ignition temperature minus that maximum temperature
};

/// What an output depends on.
struct OutputSensitivity {
  SensitivityOutput output;
  /// Temperature and margin are those of a skin that does not react, GapRow::heated: so where
  /// any evaluation ignites, since T max then jumps to that of the burning skin. Kinetics do not show in
  /// them.
  bool inert = false;
  std::vector<double> values;  ///< of every evaluation; NaN where there is none
  std::size_t missing = 0;  ///< evaluations without a number: failed runs, or a critical gap that is a bound
  std::size_t bounds = 0;   ///< of these, critical gaps that are bounds
  double mean = study::not_a_number,
         deviation = study::not_a_number;         ///< over the evaluations
  math::SobolIndices sobol;                       ///< where there are indices, of every input
  std::optional<math::PolynomialChaos> fit = {};  ///< none where an evaluation has no number
  /// Why there are no indices, fit, mean and deviation: an evaluation without a number, or what they say
  /// themselves. Empty where there are.
  std::string reason;
};

struct SensitivityResult : StudyResult {
  std::vector<study::CaseRow> rows;  ///< one for each of StudyFile::cases
  std::vector<OutputSensitivity> outputs;
};

SensitivityResult run_sensitivity(const study::StudyFile& study, const study::StudyOptions& options = {});

/// Which inputs matter, as far as the intervals tell them apart; what cannot be told; what failed.
std::string answer(const SensitivityResult& result);
/// Nothing in it differs between two runs of a study: no times, rates, dates or hosts.
report::Report report_of(const SensitivityResult& result);

/// A row for every input of every output: its distribution, and indices with their intervals, or the reason
/// where there are none. The method is in the notes.
report::Table sensitivity_table(const SensitivityResult& result);
/// A row for every output, and for every evaluation: its inputs, outputs and failure.
report::Table output_table(const SensitivityResult& result);
report::Table evaluation_table(const SensitivityResult& result);

/// Total order of every input with its interval.
report::Plot sensitivity_plot(const SensitivityResult& result, const OutputSensitivity& output);

}  // namespace launchsafe::kinds
