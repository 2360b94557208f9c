#include "launchsafe/scene/load.hpp"
#include "launchsafe/scene/toml_reader.hpp"

#include <sstream>

namespace launchsafe::scene {
namespace {

constexpr std::size_t least_quiet_points = 10;
// Shares of the peak.
constexpr double rise_share = 0.02, trigger_share = 0.01, largest_share_below_zero = 0.05;
/// What a gauge resolves.
constexpr double resolution_share = 1e-3;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The first point of the launch: after the last one before the peak that lies below the level.
std::size_t last_passage(const std::vector<double>& pressure, double level) {
  const auto peak = std::ranges::max_element(pressure);
  const auto below = std::find_if(std::make_reverse_iterator(peak), pressure.rend(),
                                  [level](double each) { return each < level; });
  return static_cast<std::size_t>(pressure.rend() - below);
}

/// Points that the rise has certainly not reached: the foot of the rise is not quiet, half of what is before
/// it is left to that.
std::vector<double> quiet_points(const std::vector<double>& pressure) {
  const auto peak = std::ranges::max_element(pressure);
  const double lowest = *std::min_element(pressure.begin(), peak + 1);
  const std::size_t rise = last_passage(pressure, lowest + rise_share * (*peak - lowest));
  return {pressure.begin(), pressure.begin() + static_cast<std::ptrdiff_t>(rise / 2)};
}

/// Sets what is below zero to 0.
void remove_negative(CleanedRecord& cleaned, const std::string& file) {
  for (double& pressure : cleaned.curve.pressure) {
    if (pressure >= 0.0) continue;
    ++cleaned.points_below_zero;
    cleaned.lowest = std::min(cleaned.lowest, pressure);
    pressure = 0.0;
  }
  const double allowed = largest_share_below_zero * cleaned.peak;
  if (cleaned.lowest >= -allowed) return;
  throw error_at({file}, "pressure", pressure_text(-cleaned.lowest) + " below the offset",
                 fmt::format("pressures no further below zero than {}: another offset, or a record without a "
                             "drift of its gauge",
                             pressure_text(allowed)));
}

/// Offset of the record, from the user or from its quiet part.
void find_offset(const PressureCurve& record, const GaugeCleaning& cleaning, CleanedRecord& cleaned,
                 const std::string& file) {
  const std::vector<double> quiet = quiet_points(record.pressure);
  if (quiet.size() >= least_quiet_points) {
    cleaned.quiet_points = quiet.size();
    cleaned.offset = median(quiet);
  } else if (!cleaning.offset) {
    throw error_at(
        {file}, "pressure",
        fmt::format("{} points before the rise, from which no offset can be found", quiet.size()),
        fmt::format("a record with {} of them, or an offset: --offset \"0 MPa\"", 2 * least_quiet_points));
  }
  if (!cleaning.offset) return;
  const double found = cleaned.offset;
  cleaned.offset = *cleaning.offset;
  if (cleaned.quiet_points == 0) return;
  const double peak = *std::ranges::max_element(record.pressure) - found;
  const double allowed = resolution_share * peak;
  if (std::abs(cleaned.offset - found) <= allowed) return;
  throw error_at({file}, "--offset",
                 fmt::format("an offset of {}, while the {} points before the rise show {}",
                             pressure_text(cleaned.offset), cleaned.quiet_points, pressure_text(found)),
                 fmt::format("within {}, {:g} % of the peak, of that; or no offset, and that is taken",
                             pressure_text(allowed), 100.0 * resolution_share));
}

CleanedRecord cleaned_record(const PressureCurve& record, const GaugeCleaning& cleaning,
                             const std::string& file) {
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
    cleaned.curve.time.push_back(record.time[i] - cleaned.start);
    cleaned.curve.pressure.push_back(pressure[i]);
  }
  if (cleaned.curve.time.size() < 2)
    throw error_at({file}, "pressure", "a record that ends where the launch begins",
                   "one of the whole launch");
  remove_negative(cleaned, file);
  cleaned.peak_time = record.time[static_cast<std::size_t>(peak - pressure.begin())] - cleaned.start;
  return cleaned;
}

}  // namespace

Expected<CleanedRecord> clean(const PressureCurve& record, const GaugeCleaning& cleaning,
                              const std::string& file) {
  return caught([&] { return cleaned_record(record, cleaning, file); });
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
