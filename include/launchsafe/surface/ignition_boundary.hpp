// How much heat it takes until the skin of one gap ignites, for any calibrated constants of the surface:
// found once on a trace, then looked up.
#pragma once

#include "launchsafe/surface/skin.hpp"

namespace launchsafe::surface {

/// The constants of the surface that are calibrated.
struct SurfaceConstants {
  double localisation = 1.0;            ///< of friction heat, > 0
  double exchange_time = 1e-3;          ///< of the air's heat, s, > 0
  double ignition_temperature = 500.0;  ///< T1, K
};

/// Those of a model.
SurfaceConstants constants_of(const SkinModel& model);

/// From the least to the largest value.
struct Extent {
  double lowest = math::infinity, highest = -math::infinity;
  void include(double value) {
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
  }
};

/// Heat of friction goes with the localisation, heat of the air with the reciprocal of the exchange time. So
/// a factor on all heat moves a skin along a line on which their product is constant, and there is one point
/// of each such line at which ignition begins.
class IgnitionBoundary {
 public:
  /// Searches it at some values of ln(localisation * exchange_time/s) and of the ignition temperature (K),
  /// over their extents; between them it is interpolated, over the temperature by straight lines. The error
  /// of a search is below 0.1 % of the heat. The extents may be single values.
  static std::optional<IgnitionBoundary> find(const SkinModel& model, const trace::BottomTrace& trace,
                                              double gap, const Extent& log_product,
                                              const Extent& ignition_temperature);

  /// The logarithm of the factor on all heat with which ignition begins: negative where the constants ignite.
  /// The constants lie within the extents, or at their ends.
  double log_heat_margin(const SurfaceConstants& constants) const;

 private:
  using Curve = std::function<double(double log_product)>;  ///< ln(localisation) at which ignition begins
  Extent log_product_;
  std::vector<double> temperatures_;  ///< K, increasing
  std::vector<Curve> curves_;         ///< of each
};

}  // namespace launchsafe::surface
