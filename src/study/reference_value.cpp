#include "launchsafe/study/reference_value.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace launchsafe::study {

ReferenceValue reference_value(std::vector<double> values, const std::vector<double>& sizes) {
  ReferenceValue reference;
  if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); }))
    values.clear();
  reference.values = std::move(values);
  if (!reference.values.empty()) reference.limit = math::extrapolate(reference.values, sizes);
  return reference;
}

double error_against(const ReferenceValue& reference, double value) {
  if (reference.values.empty()) return std::numeric_limits<double>::quiet_NaN();
  return value - reference.limit.value;
}

double bound_against(const ReferenceValue& reference, double value) {
  if (reference.values.empty()) return std::numeric_limits<double>::quiet_NaN();
  return std::abs(value - reference.values.front()) + reference.limit.uncertainty + reference.inexactness;
}

double larger_bound(double a, double b) {
  return std::isnan(a) || std::isnan(b) ? std::numeric_limits<double>::quiet_NaN() : std::max(a, b);
}

}  // namespace launchsafe::study
