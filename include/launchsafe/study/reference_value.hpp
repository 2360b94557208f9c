// What one quantity tends to on the reference meshes of an accuracy study, and errors against that.
#pragma once

#include "launchsafe/math/extrapolation.hpp"

#include <vector>

namespace launchsafe::study {

/// Values of the reference meshes, finest first, and what they tend to.
struct ReferenceValue {
  std::vector<double> values;  ///< none where a mesh has none
  math::Extrapolation limit;
  /// In the unit of the values: by how much the limit itself may be off, as the meshes share numerics that
  /// are not exact (see `inexactness_of`); NaN where nothing tells.
  double inexactness = 0;
};

/// Of values on cells of the given sizes (m), finest first; of no values where one is not finite.
ReferenceValue reference_value(std::vector<double> values, const std::vector<double>& sizes);
/// `value` minus the limit; NaN where there is none.
double error_against(const ReferenceValue& reference, double value);
/// How far `value` may be from the truth: it is so far from the finest mesh's, that within the reference's
/// uncertainty of the limit, and that within its inexactness of the truth. NaN where one of them is not
/// known.
double bound_against(const ReferenceValue& reference, double value);
/// The larger of two; NaN, which is no bound, wins.
double larger_bound(double a, double b);

}  // namespace launchsafe::study
