// What a sensitivity study fitted in the place of launches, and what that predicts of one that nobody
// computed.
#pragma once

#include "launchsafe/math/polynomial_chaos.hpp"
#include "launchsafe/math/sampling.hpp"
#include "launchsafe/scene/read_scene.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

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

  /// SI, in the order of the inputs.
  std::vector<double> values_at(const std::vector<double>& point) const;
  /// The inverse; 0 and 1 for values beyond their distributions.
  std::vector<double> point_of(const std::vector<double>& values) const;
  std::vector<math::ChaosBasis> bases() const;
};

/// A number of each launch, and the polynomial that stands for it.
struct SurrogateOutput {
  std::string name;                 ///< "critical_gap", m, or "temperature_max", K
  bool inert = false;               ///< of a skin that air and friction heat and that does not react
  std::vector<double> values = {};  ///< SI, of every launch; NaN where there is none
  math::PolynomialChaos fit = {};
  std::string reason = {};  ///< why nothing is predicted; empty where something is
};

struct SurrogateRecord {
  int model_version = 0;
  scene::Scene scene;                  ///< of the launches, but for the inputs
  double gap = 0;                      ///< m, of T max
  std::vector<std::string> keys = {};  ///< of the scene: the inputs
  UncertainInputs inputs;
  std::size_t fitted = 0;      ///< so many launches, the first, are fitted; the others tell the error
  std::vector<double> points;  ///< of the unit cube, a row a launch
  std::vector<SurrogateOutput> outputs = {};

  /// The output of that name if something is predicted of it, or else nullptr.
  const SurrogateOutput* predicted(const std::string& name) const;
};

std::string to_json_text(const SurrogateRecord& record);
/// Refuses an edited record and one of another model version. `file` is named in errors.
scene::Expected<SurrogateRecord> parse_surrogate(const std::string& text, const std::string& file);

/// Of 100 launches no more than one is above value + error, and no more than one below value - error.
struct Prediction {
  double value = 0, error = 0;  ///< SI
  bool covered = false;         ///< no farther out than some launch that tells the error
};

/// The polynomial of an output with its error, which grows with the distance from the launches that were
/// fitted, and is found at those that were not: math::exponential_tolerance_factor times the mean magnitude
/// of what the polynomial misses there, or the largest where that is more, each over sqrt(1 + leverage),
/// times that of the point.
class Surrogate {
 public:
  /// Of an output that is predicted.
  Surrogate(const SurrogateRecord& record, const SurrogateOutput& output);

  Prediction at(const std::vector<double>& point) const;

 private:
  math::FittedChaos fit_;
  double error_ = 0;             ///< at a leverage of 0
  double largest_leverage_ = 0;  ///< of the launches that were not fitted
};

/// From where to where an input may be asked for, SI: all of a distribution that ends, and of a normal as far
/// as launches were fitted.
struct InputRange {
  double lower = 0, upper = 0;
};
InputRange range_of(const SurrogateRecord& record, std::size_t input);

/// Launches drawn from the inputs, by whether their critical gap is no larger than a gap.
struct PredictedIgnitions {
  std::size_t draws = 0;
  std::size_t at_least = 0, predicted = 0, at_most = 0;  ///< value + error, value, and value - error are not
  std::size_t uncovered = 0;  ///< draws farther out than any launch that tells the error
};
/// `fixed`: coordinates that every draw has; the others are drawn. Of a record that predicts critical gaps.
PredictedIgnitions predicted_ignitions(const SurrogateRecord& record, double gap,
                                       const std::vector<std::optional<double>>& fixed);

}  // namespace launchsafe::study
