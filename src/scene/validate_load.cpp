#include "validate_load.hpp"

#include "launchsafe/scene/load_roughness.hpp"
#include "launchsafe/scene/pressure_curve.hpp"
#include "scene_fault.hpp"
#include "validate_end.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <vector>

namespace launchsafe::scene {
namespace {

/// Whether a peak was given that the measured curve makes useless. A study that gives a scene a curve
/// replaces its peak.
bool has_useless_peak(const SceneFile& file) {
  const auto peak = file.given.find("load.peak"), curve = file.given.find("load.curve");
  if (peak == file.given.end()) return false;
  const bool replaced = curve != file.given.end() && curve->second.place.file != file.file &&
                        peak->second.place.file == file.file;
  return !replaced;
}

/// A measured curve beside a peak that would silently do nothing, and one that ends too early. A scene
/// written back has its curve's points rather than their file, and every key: its peak is no sign of a
/// mistake.
Fault check_curve_use(const SceneFile& file) {
  const Load& load = file.scene.load;
  if (load.curve_time.empty()) return std::nullopt;
  if (!load.curve_file.empty() && !load.rescale_to_peak && has_useless_peak(file)) {
    return fault_at(file, "load.peak",
                    pressure_text(load.peak) + " beside a measured curve, which has a peak of its own",
                    "load.curve alone, or both with load.rescale_to_peak = true");
  }
  if (load.duration && load.curve_time.back() < read_time(load) * (1.0 - 1e-9)) {
    const char* key = load.curve_file.empty() ? "load.curve_time" : "load.curve";
    return fault_at(file, key, "a curve that ends at " + time_text(load.curve_time.back()),
                    "a curve that lasts until the end of the launch, " + time_text(*load.duration) +
                        ", or no load.duration, with which it ends at its last point");
  }
  return std::nullopt;
}

/// Numbers of the other analytic shape would silently do nothing.
Fault check_shape(const SceneFile& file) {
  const bool bell = file.scene.load.shape == LoadShape::bell;
  const std::vector<std::string> of_bell{"load.width", "load.steepness"}, of_power{"load.exponent"};
  for (const std::string& key : bell ? of_power : of_bell) {
    if (file.given.contains(key))
      return fault_at(
          file, key,
          fmt::format("a number that the shape \"{}\" does not have", word_of(file.scene.load.shape)),
          fmt::format("{}, or another load.shape", fmt::join(bell ? of_bell : of_power, " and ")));
  }
  return std::nullopt;
}

/// A curve of next to nothing has no shape that could be scaled.
Fault check_rescaling(const SceneFile& file) {
  constexpr double least_peak = 1.0;  // Pa
  const Load& load = file.scene.load;
  if (load.curve_pressure.empty() || !load.rescale_to_peak) return std::nullopt;
  const double measured = *std::max_element(load.curve_pressure.begin(), load.curve_pressure.end());
  if (measured >= least_peak) return std::nullopt;
  return fault_at(file, "load.rescale_to_peak",
                  fmt::format("true with a curve whose largest pressure is {}", pressure_text(measured)),
                  "a curve that reaches " + pressure_text(least_peak));
}

Fault check_smoothing(const SceneFile& file) {
  const Load& load = file.scene.load;
  if (!(load.smoothing > 0.0)) return std::nullopt;
  const std::string window = time_text(load.smoothing);
  if (load.curve_time.empty())
    return fault_at(file, "load.smoothing", window + " without a measured curve",
                    "a window only together with load.curve");
  const double length = load.curve_time.back() - load.curve_time.front();
  if (load.smoothing >= least_smoothing_share * length && load.smoothing <= length) return std::nullopt;
  return fault_at(file, "load.smoothing", window,
                  fmt::format("a window from {} to that of the measured curve, {}, or 0 ms for none",
                              time_text(least_smoothing_share * length), time_text(length)));
}

}  // namespace

std::optional<InputError> fault_of_load(const SceneFile& file) {
  const Load& load = file.scene.load;
  if (load.curve_time.size() != load.curve_pressure.size()) {
    return fault_at(file, "load.curve_pressure",
                    fmt::format("{} values for {} times", load.curve_pressure.size(), load.curve_time.size()),
                    "one pressure for every time");
  }
  if (load.curve_time.size() == 1) {
    return fault_at(file, "load.curve_time", "1 point", "a curve of at least two points");
  }
  const auto& times = load.curve_time;
  const auto late = std::adjacent_find(times.begin(), times.end(),
                                       [](double a, double b) { return !(b - a > least_curve_interval); });
  if (late != times.end()) {
    return fault_at(file, "load.curve_time",
                    fmt::format("{} followed by {}", time_text(*late), time_text(*std::next(late))),
                    "times in increasing order, more than " + time_text(least_curve_interval) + " apart");
  }
  if (Fault fault = check_shape(file)) return fault;
  if (Fault fault = check_curve_use(file)) return fault;
  if (Fault fault = check_rescaling(file)) return fault;
  if (times.empty() && load.rescale_to_peak) {
    return fault_at(file, "load.rescale_to_peak", "true without a measured curve",
                    "true together with load.curve");
  }
  if (Fault fault = check_smoothing(file)) return fault;
  if (times.empty() && load.base > load.peak) {
    return fault_at(
        file, file.given.contains("load.base") ? "load.base" : "load.peak",
        fmt::format("a base of {} and a peak of {}", pressure_text(load.base), pressure_text(load.peak)),
        "a base pressure of at most the peak");
  }
  return fault_of_end(file);
}

}  // namespace launchsafe::scene
