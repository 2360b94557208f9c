#include "launchsafe/surface/ignition_boundary.hpp"

// clang-format off
#include <math.h>  // Boost 1.74's pchip.hpp calls ::isnan without including it, so this comes first.
#include <boost/math/interpolators/pchip.hpp>
// clang-format on

#include <cassert>

namespace launchsafe::surface {
namespace {

/// Evenly spread values over an extent, no farther apart than `step` and at least four, as cubic
/// interpolation needs; one where the extent is a single value.
std::vector<double> values_over(const Extent& extent, double step) {
  const double length = extent.highest - extent.lowest;
  if (!(length > 0.0)) return {extent.lowest};
  const auto intervals = static_cast<std::size_t>(std::max(3.0, std::ceil(length / step)));
  std::vector<double> values;
  for (std::size_t i = 0; i < intervals; ++i)
    values.push_back(extent.lowest + length * static_cast<double>(i) / static_cast<double>(intervals));
  values.push_back(extent.highest);
  return values;
}

/// ln(localisation) at which ignition begins where the product with the exchange time and the ignition
/// temperature are given; nothing where a temperature is not a number, or where no heat within e^40 of the
/// model's own decides.
std::optional<double> critical_log_localisation(SkinModel model, const trace::BottomTrace& trace, double gap,
                                                double log_product, double ignition_temperature,
                                                double start) {
  constexpr double farthest = 40.0, tolerance = 1e-3;
  model.kinetics.ignition_temperature = ignition_temperature;
  const auto ignites_at = [&](double log_localisation) {
    model.surface.localisation = std::exp(log_localisation);
    model.surface.exchange_time = std::exp(log_product - log_localisation);
    return IgnitionOfGaps(model, trace)(gap);
  };
  const auto at_start = ignites_at(start);
  if (!at_start) return std::nullopt;
  // The other side of the boundary is sought in steps that grow.
  double step = *at_start ? -0.25 : 0.25, near = start, far = start + step;
  for (;; near = far, far += step *= 2.0) {
    if (std::abs(far - start) > farthest) return std::nullopt;
    const auto ignites_there = ignites_at(far);
    if (!ignites_there) return std::nullopt;
    if (*ignites_there != *at_start) break;
  }
  double safe = std::min(near, far), igniting = std::max(near, far);
  while (igniting - safe > tolerance) {
    const double middle = 0.5 * (safe + igniting);
    const auto ignites_there = ignites_at(middle);
    if (!ignites_there) return std::nullopt;
    (*ignites_there ? igniting : safe) = middle;
  }
  return 0.5 * (safe + igniting);
}

/// A value of an extent, which only round-off has left.
double within(const Extent& extent, double value) {
  assert(std::abs(value - std::clamp(value, extent.lowest, extent.highest)) < 1e-6);
  return std::clamp(value, extent.lowest, extent.highest);
}

}  // namespace

SurfaceConstants constants_of(const SkinModel& model) {
  return {model.surface.localisation, model.surface.exchange_time, model.kinetics.ignition_temperature};
}

std::optional<IgnitionBoundary> IgnitionBoundary::find(const SkinModel& model,
                                                       const trace::BottomTrace& trace, double gap,
                                                       const Extent& log_product,
                                                       const Extent& ignition_temperature) {
  constexpr double product_step = 0.75, temperature_step = 25.0;  // K
  // Without a gap there is no air, and the exchange time does nothing.
  const std::vector<double> products =
      gap > 0.0 ? values_over(log_product, product_step) : std::vector{log_product.lowest};
  IgnitionBoundary boundary;
  boundary.log_product_ = log_product;
  boundary.temperatures_ = values_over(ignition_temperature, temperature_step);
  for (const double temperature : boundary.temperatures_) {
    std::vector<double> critical;
    double start = std::log(model.surface.localisation);
    for (const double product : products) {
      const auto at = critical_log_localisation(model, trace, gap, product, temperature, start);
      if (!at) return std::nullopt;
      critical.push_back(start = *at);
    }
    if (critical.size() < 2)
      boundary.curves_.emplace_back([value = critical.front()](double) { return value; });
    else
      boundary.curves_.emplace_back(boost::math::interpolators::pchip<std::vector<double>>(
          std::vector<double>(products), std::move(critical)));
  }
  return boundary;
}

double IgnitionBoundary::log_heat_margin(const SurfaceConstants& constants) const {
  const double log_localisation = std::log(constants.localisation);
  const double log_product = within(log_product_, log_localisation + std::log(constants.exchange_time));
  const double temperature =
      within({temperatures_.front(), temperatures_.back()}, constants.ignition_temperature);
  const auto above = std::ranges::lower_bound(temperatures_, temperature);
  const std::size_t upper = std::min<std::size_t>(above - temperatures_.begin(), temperatures_.size() - 1);
  const std::size_t lower = upper > 0 && temperature < temperatures_[upper] ? upper - 1 : upper;
  const double at_lower = curves_[lower](log_product);
  if (lower == upper) return at_lower - log_localisation;
  const double share = (temperature - temperatures_[lower]) / (temperatures_[upper] - temperatures_[lower]);
  return at_lower + share * (curves_[upper](log_product) - at_lower) - log_localisation;
}

}  // namespace launchsafe::surface
