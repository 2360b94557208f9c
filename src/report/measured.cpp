#include "launchsafe/report/measured.hpp"

#include "launchsafe/report/number.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::report {
namespace {

/// By this share a number may be off as it is binary: 0.29 is a hair below its 29 hundredths.
constexpr double round_off = 1e-12;

int leading_place(double value) { return static_cast<int>(std::floor(std::log10(value) + round_off)); }

double cut(double value, int decimals, double direction) {
  const double scale = std::pow(10.0, decimals), scaled = value * scale;
  const double nearest = std::round(scaled);
  if (std::abs(scaled - nearest) <= round_off * std::max(1.0, std::abs(scaled))) return nearest / scale;
  return (direction < 0 ? std::floor(scaled) : std::ceil(scaled)) / scale;
}

}  // namespace

int decimals_for(double uncertainty) {
  if (!(uncertainty > 0.0) || !std::isfinite(uncertainty)) return 0;
  const int place = leading_place(uncertainty);
  const bool begins_with_one = uncertainty < 2.0 * std::pow(10.0, place) * (1.0 - round_off);
  return std::max(0, (begins_with_one ? 1 : 0) - place);
}

double rounded_down(double value, int decimals) { return cut(value, decimals, -1.0); }
double rounded_up(double value, int decimals) { return cut(value, decimals, 1.0); }

std::string Measured::text(const std::string& unit) const {
  const std::string middle = fixed(value, decimals), up = fixed(plus, decimals),
                    down = fixed(minus, decimals);
  const std::string end = unit.empty() ? "" : " " + unit;
  if (up == down) return fmt::format("{} ± {}{}", middle, up, end);
  return fmt::format("{} +{} −{}{}", middle, up, down, end);
}

Measured measured(double value, double minus, double plus) {
  Measured shown;
  const double uncertainty = std::max(minus, plus);
  shown.decimals = decimals_for(uncertainty);
  const int place = leading_place(uncertainty);
  if (value != 0 && place >= leading_place(std::abs(value)))
    shown.decimals = std::max(shown.decimals, 1 - place);
  shown.value = rounded_down(value, shown.decimals);
  shown.minus = rounded_up(minus, shown.decimals);
  // The value went down, and its upper end must not.
  shown.plus = rounded_up(std::max(plus, minus == plus ? plus : value + plus - shown.value), shown.decimals);
  return shown;
}

std::optional<Measured> measured_gap(double value, double uncertainty, double model_form) {
  if (!std::isfinite(value) || !std::isfinite(uncertainty) || !(uncertainty > 0.0)) return std::nullopt;
  return measured(value, uncertainty, std::isfinite(model_form) ? uncertainty - model_form : uncertainty);
}

std::string allowed_text(double value, int decimals) {
  return fixed(rounded_down(value, decimals), decimals);
}

std::string uncertain_text(double value, int digits) {
  if (!(value > 0.0) || !std::isfinite(value)) return fixed(value, 0);
  const int decimals = digits - 1 - leading_place(value);
  if (decimals >= 0) return significant(rounded_up(value, decimals), digits);
  const double unit = std::pow(10.0, -decimals);
  return fixed(unit * rounded_up(value / unit, 0), 0);
}

}  // namespace launchsafe::report
