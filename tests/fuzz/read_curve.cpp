// Pressure curves from any bytes. Whatever is read must be a curve, must read back the same from any other
// way of writing it, and must be a pressure at any time, smoothed or not; whatever is not must say why.
#include "fuzz_input.hpp"
#include "launchsafe/scene/load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace launchsafe;

void check_curve(const scene::PressureCurve& curve) {
  fuzz::require(curve.time.size() >= 2 && curve.time.size() == curve.pressure.size(),
                "a curve has at least two points");
  for (std::size_t i = 0; i < curve.time.size(); ++i) {
    fuzz::require(std::isfinite(curve.time[i]) && (i == 0 || curve.time[i] > curve.time[i - 1]),
                  "times are finite and increase");
    fuzz::require(curve.pressure[i] >= 0.0 && curve.pressure[i] <= scene::largest_load,
                  "pressures are in their range");
  }
}

/// A file of the curve: its numbers in a unit that is `scale` of SI.
std::string written(const scene::PressureCurve& curve, const std::string& header,
                    const std::string& separator, double time_scale, double pressure_scale) {
  std::string text = header + "\n";
  for (std::size_t i = 0; i < curve.time.size(); ++i)
    text += fmt::format("{:.17e}{}{:.17e}\n", curve.time[i] / time_scale, separator,
                        curve.pressure[i] / pressure_scale);
  return text;
}

/// Reads the curve back from a text; equal to within `tolerance`, relative, where rounding to another unit
/// leaves it a curve at all.
void check_again(const scene::PressureCurve& curve, const std::string& text, double tolerance) {
  const auto again = scene::caught([&] { return scene::parse_pressure_curve(text, "again.csv"); });
  if (!again && tolerance > 0.0) return;
  fuzz::require(again.has_value(), "what was read and written can be read",
                again ? std::string{} : again.error().message() + "\n" + text);
  fuzz::require(again->time.size() == curve.time.size(), "no point is lost", text);
  for (std::size_t i = 0; i < curve.time.size(); ++i) {
    const auto same = [&](double a, double b) {
      return std::abs(a - b) <= tolerance * std::abs(a) + 1e-300 * tolerance;
    };
    fuzz::require(same(curve.time[i], again->time[i]) && same(curve.pressure[i], again->pressure[i]),
                  "what was read and written is the same curve", text);
  }
}

void check_written_anew(const scene::PressureCurve& curve) {
  check_again(curve, written(curve, "time_s,pressure_Pa", ",", 1, 1), 0.0);
  check_again(curve, written(curve, "\xEF\xBB\xBFTime [s];Pressure [Pa]", ";", 1, 1), 0.0);
  constexpr double roundings = 1e-14, psi = 6894.757293168361;
  check_again(curve, written(curve, "time_ms\tpressure_psi", "\t", 1e-3, psi), roundings);
}

void check_history(const scene::PressureCurve& curve) {
  scene::Load load;
  load.curve_time = curve.time;
  load.curve_pressure = curve.pressure;
  const double length = curve.time.back() - curve.time.front();
  for (const double smoothing : {0.0, 0.1 * length, length}) {
    load.smoothing = smoothing;
    const scene::PressureHistory history(load);
    const double stated = history.stated_peak(), peak = history.peak();
    fuzz::require(peak >= 0.0 && peak <= stated * (1.0 + 1e-6) + 1e-3,
                  "the peak is no more than the stated one",
                  fmt::format("{} of {}, window {}", peak, stated, smoothing));
    for (int i = 0; i <= 16; ++i) {
      const double pressure = history.at(curve.time.front() + length * i / 16);
      fuzz::require(pressure >= 0.0 && pressure <= stated * (1.0 + 1e-6) + 1e-3,
                    "the load is a pressure up to its peak", fmt::format("{} of {}", pressure, stated));
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto curve = scene::caught([&] {
    return scene::parse_pressure_curve(std::string(reinterpret_cast<const char*>(data), size), "curve.csv");
  });
  if (!curve) {
    fuzz::require_told(curve.error());
    return 0;
  }
  check_curve(*curve);
  check_written_anew(*curve);
  check_history(*curve);
  return 0;
}
