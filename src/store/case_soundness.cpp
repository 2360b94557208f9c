#include "case_soundness.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>

namespace launchsafe::store {
namespace {

using trace::BottomTrace;

/// Whether times are finite and each is later than the one before.
bool increase(const std::vector<double>& times) {
  return std::all_of(times.begin(), times.end(), [](double time) { return std::isfinite(time); }) &&
         std::adjacent_find(times.begin(), times.end(), std::greater_equal<>()) == times.end();
}

bool are_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

std::string fault_in_trace(const BottomTrace& trace, bool completed) {
  if (!increase(trace.time)) return "the times of the trace do not increase";
  if (!completed) return {};
  for (const auto* history : {&trace.chamber_pressure, &trace.bottom_pressure, &trace.mean_chamber_pressure,
                              &trace.mean_bottom_pressure, &trace.steps}) {
    if (history->size() != trace.samples()) return "a history of the completed run is cut short";
    if (!are_finite(*history)) return "a history of the completed run holds what is no number";
  }
  for (const auto& friction : trace.friction) {
    if (!are_finite(friction)) return "the friction of the completed run holds what is no number";
  }
  return {};
}

std::string fault_in_gap(const run::GapResult& gap, const BottomTrace& trace) {
  if (!(gap.gap >= 0.0) || gap.gap != gap.skin.gap) return "a gap is none";
  if (!increase(gap.skin.time)) return "the times of a skin do not increase";
  if (gap.sampling_error < 0.0) return "an error is negative";
  const std::size_t stations = trace.stations.size();
  const auto is_absent = [stations](const auto& place) { return place && place->station >= stations; };
  if (is_absent(gap.skin.ignition)) return "an ignition is nowhere";
  if (gap.skin.ignition && trace.stations[gap.skin.ignition->station].observation)
    return "an ignition is not at a station";
  return {};
}

}  // namespace

std::string fault_in(const run::CaseResult& result) {
  const run::MechanicsResult& mechanics = result.mechanics;
  const bool completed = mechanics.status == run::RunStatus::completed;
  if (!(mechanics.end_time >= 0.0)) return "the time reached is none";
  if (std::string fault = fault_in_trace(mechanics.trace, completed); !fault.empty()) return fault;
  for (const run::GapResult& gap : result.gaps) {
    if (std::string fault = fault_in_gap(gap, mechanics.trace); !fault.empty()) return fault;
  }
  return {};
}

}  // namespace launchsafe::store
