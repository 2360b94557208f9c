#include "calibration_parts.hpp"

#include <boost/math/tools/toms748_solve.hpp>
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

constexpr double tightness = 1e-7;  ///< K, how well the fitted rows are met at least
constexpr int most_rounds = 8;      ///< of the two fits in turn

double maximum_at(const surface::SkinModel& model, const trace::BottomTrace& trace, double gap) {
  return surface::maximum_at_stations(surface::integrate_skin(model, trace, gap), trace).temperature;
}

double misfit_of(const surface::SkinModel& model, const trace::BottomTrace& trace, const Reference& row) {
  return maximum_at(model, trace, row.gap) - row.maximum_temperature;
}

void find_misfits(const surface::SkinModel& model, const trace::BottomTrace& trace,
                  const CalibrationTargets& targets, CalibratedConstants& result) {
  result.zero_gap_misfit = misfit_of(model, trace, targets.zero_gap);
  result.wide_gap_misfit = misfit_of(model, trace, targets.wide_gap);
}

/// Positive root of a function that changes sign once, sought from `start` by factors of 2 in both
/// directions.
std::optional<double> positive_root(const std::function<double(double)>& function, double start) {
  const double at_start = function(start);
  if (!std::isfinite(at_start)) return std::nullopt;
  if (at_start == 0.0) return start;
  double low = start, high = start, at_low = at_start, at_high = at_start;
  for (int doubling = 0; doubling < 60 && !(at_low * at_high < 0.0); ++doubling) {
    low *= 0.5;
    const double below = function(low);
    if (below * at_low <= 0.0) {
      high = 2.0 * low;
      at_high = at_low;
      at_low = below;
      break;
    }
    at_low = below;
    high *= 2.0;
    const double above = function(high);
    if (above * at_high <= 0.0) {
      low = 0.5 * high;
      at_low = at_high;
      at_high = above;
      break;
    }
    at_high = above;
  }
  if (!(at_low * at_high <= 0.0)) return std::nullopt;
  std::uintmax_t iterations = 100;
  const auto [left, right] = boost::math::tools::toms748_solve(
      function, low, high, at_low, at_high, boost::math::tools::eps_tolerance<double>(46), iterations);
  return 0.5 * (left + right);
}

CalibratedConstants failed(CalibratedConstants result, std::string why) {
  result.failure = std::move(why);
  return result;
}

/// Alternates the two fits until both rows are met; empty when they are.
std::string fit_both(surface::SkinModel& model, const trace::BottomTrace& trace,
                     const CalibrationTargets& targets, CalibratedConstants& result) {
  const auto meet = [&](double& constant, const Reference& row) {
    const auto root = positive_root(
        [&](double value) {
          constant = value;
          return misfit_of(model, trace, row);
        },
        constant);
    if (root) constant = *root;
    return root.has_value();
  };
  for (int round = 0; round < most_rounds; ++round) {
    if (model.surface.localisation <= 0) model.surface.localisation = 100.0;
    if (!meet(model.surface.localisation, targets.zero_gap))
      return fmt::format("no localisation gives {:.6g} K without a gap",
                         targets.zero_gap.maximum_temperature);
    if (!meet(model.surface.exchange_time, targets.wide_gap))
      return fmt::format("no exchange time gives {:.6g} K at {:.6g} cm", targets.wide_gap.maximum_temperature,
                         100.0 * targets.wide_gap.gap);
    find_misfits(model, trace, targets, result);
    if (std::abs(result.zero_gap_misfit) <= tightness && std::abs(result.wide_gap_misfit) <= tightness)
      return {};
  }
  return "the two fits do not settle";
}

/// Least squares of all numbers of the two rows from there on, with the load held; empty where it settled.
std::string fit_all_numbers(surface::SkinModel& model, const trace::BottomTrace& trace,
                            const CalibrationTargets& targets, CalibratedConstants& result) {
  const scene::Surface start = model.surface;
  const auto set = [&](const std::vector<double>& logarithms) {
    model.surface.localisation = start.localisation * std::exp(logarithms[0]);
    model.surface.exchange_time = start.exchange_time * std::exp(logarithms[1]);
  };
  const auto misfits = [&](const std::vector<std::vector<double>>& points) {
    std::vector<std::vector<double>> all;
    for (const std::vector<double>& point : points) {
      set(point);
      all.push_back(weighted_misfits(model, trace, targets));
    }
    return std::optional(all);
  };
  const math::NonlinearFit fit = math::fit_nonlinear(misfits, {0.0, 0.0}, difference_step);
  if (std::string failure = text_of(fit); !failure.empty()) return failure;
  set(fit.unknowns);
  find_misfits(model, trace, targets, result);
  return {};
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

void put(const surface::SurfaceConstants& constants, scene::Surface& surface,
         materials::KineticsParameters& kinetics) {
  surface.localisation = constants.localisation;
  surface.exchange_time = constants.exchange_time;
  kinetics.ignition_temperature = constants.ignition_temperature;
}

CalibratedConstants calibrate(const surface::SkinModel& given, const trace::BottomTrace& trace,
                              const CalibrationTargets& targets) {
  CalibratedConstants result;
  surface::SkinModel model = untriggered(given);
  if (std::string failure = fit_both(model, trace, targets, result); !failure.empty())
    return failed(result, std::move(failure));
  if (targets.load_fitted) {
    if (std::string failure = fit_all_numbers(model, trace, targets, result); !failure.empty())
      return failed(result, std::move(failure));
  }
  result.constants.localisation = model.surface.localisation;
  result.constants.exchange_time = model.surface.exchange_time;
  result.ignition_lowest = maximum_at(model, trace, targets.safe_gap);
  result.ignition_highest = maximum_at(model, trace, targets.igniting_gap);
  if (!(result.ignition_lowest < result.ignition_highest)) {
    return failed(result, fmt::format("no ignition temperature separates {:.6g} K at {:.6g} cm from {:.6g} K "
                                      "at {:.6g} cm",
                                      result.ignition_lowest, 100.0 * targets.safe_gap,
                                      result.ignition_highest, 100.0 * targets.igniting_gap));
  }
  constexpr double near = 1.0;  // K
  if (!(result.ignition_highest < model.kinetics.burnt_temperature - near)) {
    return failed(result,
                  fmt::format("at {:.6g} cm the reaction runs away by itself, and the rows say of the "
                              "ignition temperature only that it is above {:.6g} K",
                              100.0 * targets.igniting_gap, result.ignition_lowest));
  }
  result.constants.ignition_temperature = 0.5 * (result.ignition_lowest + result.ignition_highest);
  return result;
}

}  // namespace launchsafe::kinds
