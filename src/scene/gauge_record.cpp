// From what a pressure gauge recorded to a curve that a scene takes.
#include "launchsafe/scene/load.hpp"
#include "launchsafe/scene/toml_reader.hpp"

#include <sstream>

namespace launchsafe::scene {
namespace {

constexpr std::size_t least_quiet_points = 10;
/// Shares of the peak; the last one is what a gauge resolves.
constexpr double rise_share = 0.02, trigger_share = 0.01, largest_share_below_zero = 0.05,
                 resolution_share = 1e-3;

/// The first point of the launch: after the last one before the peak that lies below the level.
std::size_t last_passage(const std::vector<double>& pressure, double level) {
  const auto peak = std::ranges::max_element(pressure);
  const auto below = std::find_if(std::make_reverse_iterator(peak), pressure.rend(),
                                  [level](double each) { return each < level; });
  return static_cast<std::size_t>(pressure.rend() - below);
}

/// Points that the rise has certainly not reached, in order of size: the foot of the rise is not quiet, and
/// half of what is before it is left to that.
std::vector<double> quiet_points(const std::vector<double>& pressure) {
  const auto peak = std::ranges::max_element(pressure);
  const double lowest = *std::min_element(pressure.begin(), peak + 1);
  const std::size_t rise = last_passage(pressure, lowest + rise_share * (*peak - lowest));
  std::vector<double> quiet(pressure.begin(), pressure.begin() + static_cast<std::ptrdiff_t>(rise / 2));
  std::ranges::sort(quiet);
  return quiet;
}

/// Offset of the record, from the user or from its quiet part.
void find_offset(const PressureCurve& record, const GaugeCleaning& cleaning, CleanedRecord& cleaned,
                 const std::string& file) {
  const std::vector<double> quiet = quiet_points(record.pressure);
  const bool is_quiet = quiet.size() >= least_quiet_points;
  if (!is_quiet && !cleaning.offset)
    throw error_at(
        {file}, "pressure",
        fmt::format("{} points before the rise, from which no offset can be found", quiet.size()),
        fmt::format("a record with {} of them, or an offset: --offset \"0 MPa\"", 2 * least_quiet_points));
  cleaned.quiet_points = is_quiet ? quiet.size() : 0;
  const double found = is_quiet ? quiet[quiet.size() / 2] : *cleaning.offset;
  cleaned.offset = cleaning.offset.value_or(found);
  const double allowed = resolution_share * (*std::ranges::max_element(record.pressure) - found);
  if (std::abs(cleaned.offset - found) <= allowed) return;
  throw error_at({file}, "--offset",
                 fmt::format("an offset of {}, while the {} points before the rise show {}",
                             pressure_text(cleaned.offset), cleaned.quiet_points, pressure_text(found)),
                 fmt::format("within {} of that, or no offset, and that is taken", pressure_text(allowed)));
}

}  // namespace

CleanedRecord clean(const PressureCurve& record, const GaugeCleaning& cleaning, const std::string& file) {
  CleanedRecord cleaned;
  find_offset(record, cleaning, cleaned, file);
  std::vector<double> pressure = record.pressure;
  for (double& each : pressure) each -= cleaned.offset;
  const auto peak = std::ranges::max_element(pressure);
  cleaned.peak = *peak;
  cleaned.trigger = cleaning.trigger.value_or(trigger_share * cleaned.peak);
  if (!(cleaned.trigger > 0.0 && cleaned.trigger < cleaned.peak))
    throw error_at({file}, "pressure",
                   fmt::format("a largest pressure of {} above the offset, and a trigger of {}",
                               pressure_text(cleaned.peak), pressure_text(cleaned.trigger)),
                   "a trigger between zero and the peak: --trigger \"5 MPa\"");
  cleaned.points_before = last_passage(pressure, cleaned.trigger);
  cleaned.start = record.time[cleaned.points_before];
  for (std::size_t i = cleaned.points_before; i < pressure.size(); ++i) {
    cleaned.points_below_zero += pressure[i] < 0.0 ? 1 : 0;
    cleaned.lowest = std::min(cleaned.lowest, pressure[i]);
    cleaned.curve.time.push_back(record.time[i] - cleaned.start);
    cleaned.curve.pressure.push_back(std::max(0.0, pressure[i]));
  }
  if (cleaned.curve.time.size() < 2)
    throw error_at({file}, "pressure", "a record that ends where the launch begins",
                   "one of the whole launch");
  if (const double allowed = largest_share_below_zero * cleaned.peak; cleaned.lowest < -allowed)
    throw error_at({file}, "pressure", pressure_text(-cleaned.lowest) + " below the offset",
                   fmt::format("pressures no further below zero than {}: another offset, or a record without "
                               "a drift of its gauge",
                               pressure_text(allowed)));
  cleaned.peak_time = record.time[static_cast<std::size_t>(peak - pressure.begin())] - cleaned.start;
  return cleaned;
}

std::string csv_of(const PressureCurve& curve, const std::string& remarks) {
  std::string text;
  std::istringstream lines(remarks);
  for (std::string line; std::getline(lines, line);) text += "# " + line + "\n";
  text += "time_ms,pressure_MPa\n";
  for (std::size_t i = 0; i < curve.time.size(); ++i)
    text += fmt::format("{:.9g},{:.9g}\n", 1e3 * curve.time[i], 1e-6 * curve.pressure[i]);
  return text;
}

}  // namespace launchsafe::scene
