#include "calibration_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::kinds {

using study::Reference;

namespace {

constexpr double rate_window = 0.5e-3;  ///< s
constexpr double fast_share = 0.15;     ///< of the largest rate

/// Highest temperature of the stations at every sample, K.
std::vector<double> highest_temperatures(const surface::SkinHistory& history,
                                         const trace::BottomTrace& trace) {
  std::vector<double> highest(history.time.size(), 0.0);
  const std::size_t stations = trace.stations.size();
  for (std::size_t sample = 0; sample < highest.size(); ++sample) {
    for (std::size_t station = 0; station < stations; ++station) {
      if (!trace.stations[station].observation)
        highest[sample] = std::max(highest[sample], history.temperature[sample * stations + station]);
    }
  }
  return highest;
}

/// Where the straight line between two samples meets a value.
double crossing(const std::vector<double>& time, const std::vector<double>& rate, std::size_t sample,
                double value) {
  const double share = (value - rate[sample]) / (rate[sample + 1] - rate[sample]);
  return time[sample] + share * (time[sample + 1] - time[sample]);
}

void add_misfits(std::vector<double>& misfits, const surface::SkinModel& model,
                 const trace::BottomTrace& trace, const Reference& row, double early_time) {
  const auto history = surface::integrate_skin(model, trace, row.gap);
  const FastRise rise = fast_rise(history, trace);
  const auto add = [&](double computed, double published, double weight) {
    if (std::isfinite(published)) misfits.push_back((computed - published) / weight);
  };
  add(surface::maximum_at_stations(history, trace).temperature, row.maximum_temperature, temperature_weight);
  add(surface::maximum_at_time(history, trace, early_time).temperature, row.early_temperature,
      temperature_weight);
  add(rise.begins, row.rise_begins, instant_weight);
  add(rise.ends, row.rise_ends, instant_weight);
}

}  // namespace

FastRise fast_rise(const surface::SkinHistory& history, const trace::BottomTrace& trace) {
  const std::vector<double> highest = highest_temperatures(history, trace);
  std::vector<double> time, rate;
  for (const double middle : history.time) {
    const double before = middle - 0.5 * rate_window, after = middle + 0.5 * rate_window;
    if (before < history.time.front() || after > history.time.back()) continue;
    time.push_back(middle);
    rate.push_back((trace::interpolate(history.time, highest, after) -
                    trace::interpolate(history.time, highest, before)) /
                   rate_window);
  }
  FastRise rise;
  if (rate.empty()) return rise;
  const double threshold = fast_share * *std::ranges::max_element(rate);
  const auto fast = [threshold](double value) { return value > threshold; };
  const auto first = std::ranges::find_if(rate, fast);
  if (first == rate.end()) return rise;
  const auto begin = static_cast<std::size_t>(first - rate.begin());
  const auto end =
      static_cast<std::size_t>(std::find_if(rate.rbegin(), rate.rend(), fast).base() - rate.begin());
  rise.begins = begin == 0 ? time.front() : crossing(time, rate, begin - 1, threshold);
  rise.unfinished = end == rate.size();
  rise.ends = rise.unfinished ? time.back() : crossing(time, rate, end - 1, threshold);
  return rise;
}

surface::SkinModel untriggered(surface::SkinModel model) {
  model.kinetics.ignition_temperature = model.kinetics.burnt_temperature;
  return model;
}

std::size_t fitted_numbers(const Reference& row) {
  std::size_t count = 0;
  for (const double number : {row.maximum_temperature, row.early_temperature, row.rise_begins, row.rise_ends})
    count += std::isfinite(number);
  return count;
}

std::vector<double> weighted_misfits(const surface::SkinModel& model, const trace::BottomTrace& trace,
                                     const CalibrationTargets& targets) {
  std::vector<double> misfits;
  for (const Reference* row : {&targets.zero_gap, &targets.wide_gap})
    add_misfits(misfits, untriggered(model), trace, *row, targets.early_time);
  return misfits;
}

std::string text_of(const math::NonlinearFit& fit) {
  using enum math::FitFailure;
  switch (fit.failure) {
    case none:
      return {};
    case too_few_residuals:
      return "the rows have fewer numbers than are to be fitted";
    case not_computable:
      return "a number of the rows cannot be computed";
    case singular:
      return fmt::format("the numbers of the rows do not determine all that is fitted (condition {:.2g})",
                         fit.condition);
    case does_not_settle:
      return "the least-squares fit does not settle";
  }
  return {};
}

}  // namespace launchsafe::kinds
