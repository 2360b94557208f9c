// What a study fitted in the place of launches, and what that predicts of one that nobody
// computed.
#pragma once

#include "launchsafe/math/statistics.hpp"
#include "launchsafe/math/surrogates.hpp"
#include "launchsafe/scene/read_scene.hpp"

namespace launchsafe::study {

/// Inputs that vary together, as the calibration that fitted them found: their logarithms are normal.
struct CorrelatedInputs {
  std::size_t first = 0, count = 0;  ///< among the inputs, whose distributions say median and deviation
  std::vector<double> factor;        ///< of the covariance of the logarithms (math::covariance_factor)
  bool has(std::size_t input) const { return input >= first && input < first + count; }
};

/// Inputs of a launch that are not known exactly. A point of the open unit cube has a coordinate for each:
/// the share of its distribution below it or, of those that vary together, of the standard normals that they
/// are made of.
struct UncertainInputs {
  std::vector<math::Distribution> distributions = {};  ///< SI
  std::optional<CorrelatedInputs> correlated = {};
  /// As a study states it: of the normal scores of all coordinates, row by row, positive definite. Empty
  /// where it states none.
  std::vector<double> correlation = {};

  /// SI, in the order of the inputs.
  std::vector<double> values_at(const std::vector<double>& point) const;
  /// The inverse; 0 and 1 for values beyond their distributions.
  std::vector<double> point_of(const std::vector<double>& values) const;
  std::vector<math::ChaosBasis> bases() const;
  /// Points as the inputs are drawn, with the coordinates that every draw has.
  math::CopulaDraws draws(std::vector<std::optional<double>> fixed) const {
    return {correlation, std::move(fixed)};
  }
  math::CopulaDraws draws() const { return draws(std::vector<std::optional<double>>(distributions.size())); }
};

/// What stands for a number of launches: the polynomial, or the process where that misses less of what is
/// left out.
struct SurrogateFit {
  math::PolynomialChaos chaos = {};
  math::GaussianProcess process = {.reason = "none was fitted"};
  bool by_process() const { return process.reason.empty() && process.leave_one_out < chaos.leave_one_out; }
  double leave_one_out() const { return by_process() ? process.leave_one_out : chaos.leave_one_out; }
};

/// How far a fit is off launches that it has not seen; the output's unit.
struct HeldOutError {
  std::size_t launches = 0;  ///< with a number
  double root_mean_square = math::not_a_number, largest = root_mean_square;
  double unexplained = root_mean_square;  ///< the mean square as a share of the variance of what was fitted
};

/// A number of each launch, and the fit that stands for it.
struct SurrogateOutput {
  std::string name;    ///< "critical_gap", m, or "temperature_max", K, of several gaps with the gap behind it
  double gap = 0;      ///< m, of T max
  bool inert = false;  ///< of a skin that air and friction heat and that does not react
  std::vector<double> values = {};  ///< SI, of every launch; NaN where there is none
  SurrogateFit fit = {};
  HeldOutError error = {};
  std::string reason = {};  ///< why nothing is predicted; empty where something is
};

struct SurrogateRecord {
  scene::Scene scene;                  ///< of the launches, but for the inputs
  double gap = 0;                      ///< m, which a question is about that names none
  std::vector<std::string> keys = {};  ///< of the scene: the inputs
  UncertainInputs inputs = {};
  bool drawn = true;                       ///< from the inputs; else these are ranges and say nothing of how
                                           ///< often
  std::vector<double> points = {};         ///< of the unit cube, a row a launch
  std::vector<std::size_t> held_out = {};  ///< rows that are not fitted and tell the error, ascending
  std::vector<SurrogateOutput> outputs = {};

  std::size_t fitted() const { return points.size() / keys.size() - held_out.size(); }
  /// Points of the rows that are fitted, and the values there, NaN too.
  math::FiniteRows fitted_rows(const std::vector<double>& values) const;
  /// The output of that name if something is predicted of it, or else nullptr.
  const SurrogateOutput* predicted(const std::string& name) const;
};

/// The error of a fit is known from no fewer launches that were not fitted.
inline constexpr std::size_t fewest_held_out = 30;

/// Fits an output that has its values, and finds its error. Nothing is predicted of one without a fit, or
/// where the fit misses more than a tenth of the variance, or where fewer than `fewest_held_out` launches
/// tell.
void fit_output(const SurrogateRecord& record, SurrogateOutput& output);

std::string to_json_text(const SurrogateRecord& record);
/// Refuses an edited record and one of another model version. `file` is named in errors.
scene::Expected<SurrogateRecord> parse_surrogate(const std::string& text, const std::string& file);

/// Of 100 launches no more than one is above value + error, and no more than one below value - error.
struct Prediction {
  double value = 0, error = 0;  ///< SI
  bool covered = false;         ///< no farther out than some launch that tells the error
};

/// The fit of an output with its error, which grows with the distance from the launches that were
/// fitted, and is found at those that were not: math::exponential_tolerance_factor times the mean magnitude
/// of what the fit misses there, or the largest where that is more, each over sqrt(1 + leverage),
/// times that of the point.
class Surrogate {
 public:
  /// Of an output that is predicted.
  Surrogate(const SurrogateRecord& record, const SurrogateOutput& output);

  Prediction at(const std::vector<double>& point) const;
  /// The largest error of a point that is covered.
  double largest_error() const;

  /// By how much the fit is off each launch that was not fitted and has a number.
  const std::vector<double>& misses() const { return misses_; }

  // What others need to predict the same.
  const std::variant<math::FittedChaos, math::FittedProcess>& fit() const { return fit_; }
  double error_without_leverage() const { return error_; }
  double largest_leverage() const { return largest_leverage_; }

 private:
  math::FitValue fitted_at(const std::vector<double>& point) const;

  std::variant<math::FittedChaos, math::FittedProcess> fit_;
  std::vector<double> misses_;
  double error_ = 0;             ///< at a leverage of 0
  double largest_leverage_ = 0;  ///< of the launches that were not fitted
};

/// Points of the unit cube where further launches would tell most of an output that is predicted: the draws
/// with the largest error, one after the other, each taken for computed before the next is chosen.
std::vector<double> least_sure_points(SurrogateRecord record, SurrogateOutput output, std::size_t count,
                                      std::uint64_t seed);

/// From where to where inputs may be asked for, SI: all of a distribution that ends, and of a normal as far
/// as launches were fitted.
std::vector<math::Interval> ranges_of(const SurrogateRecord& record);

/// Launches drawn from the inputs, by whether their critical gap is no larger than a gap.
struct PredictedIgnitions {
  std::size_t draws = 0;
  std::size_t predicted = 0;  ///< the value of the fit is not
  /// Value + error, and value - error, are not. Of the draws that are not covered none, and all: they may do
  /// either.
  std::size_t at_least = 0, at_most = 0;
  std::size_t uncovered = 0;  ///< draws farther out than any launch that tells the error
};
PredictedIgnitions ignitions_of(const std::vector<Prediction>& critical_gaps, double gap);
/// What they are compared in: whole ones of a length (m), so that a page can have all draws and say the same.
inline long long nanometres(double length) { return std::llround(1e9 * length); }
/// Critical gaps of such draws. `fixed`: coordinates that every draw has. Of a record that predicts them.
std::vector<Prediction> drawn_critical_gaps(const SurrogateRecord& record,
                                            const std::vector<std::optional<double>>& fixed = {});

}  // namespace launchsafe::study
