// Localisation, exchange time and ignition temperature from three published rows, on one trace, and what they
// predict for the others.
#include "launchsafe/kinds/calibration.hpp"

#include <boost/math/tools/toms748_solve.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>

namespace launchsafe::kinds {

using namespace study;
using namespace report;

namespace {

constexpr double tightness = 1e-7;  ///< K, how well the fitted rows are met at least
constexpr int most_rounds = 8;      ///< of the two fits in turn

double maximum_at(const surface::SkinModel& model, const trace::BottomTrace& trace, double gap) {
  return surface::maximum_at_stations(surface::integrate_skin(model, trace, gap), trace).temperature;
}

/// Without the trigger: nothing happens at T1, and self-heating that runs away ends at T2.
surface::SkinModel untriggered(surface::SkinModel model) {
  model.kinetics.ignition_temperature = model.kinetics.burnt_temperature;
  return model;
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
  const auto misfit = [&](const Reference& row) {
    return maximum_at(model, trace, row.gap) - row.maximum_temperature;
  };
  for (int round = 0; round < most_rounds; ++round) {
    const auto localisation = positive_root(
        [&](double value) {
          model.surface.localisation = value;
          return misfit(targets.zero_gap);
        },
        model.surface.localisation > 0 ? model.surface.localisation : 100.0);
    if (!localisation) {
      return fmt::format("no localisation gives {:.6g} K without a gap",
                         targets.zero_gap.maximum_temperature);
    }
    model.surface.localisation = *localisation;
    const auto exchange_time = positive_root(
        [&](double value) {
          model.surface.exchange_time = value;
          return misfit(targets.wide_gap);
        },
        model.surface.exchange_time);
    if (!exchange_time) {
      return fmt::format("no exchange time gives {:.6g} K at {:.6g} cm", targets.wide_gap.maximum_temperature,
                         100.0 * targets.wide_gap.gap);
    }
    model.surface.exchange_time = *exchange_time;
    result.zero_gap_misfit = misfit(targets.zero_gap);
    result.wide_gap_misfit = misfit(targets.wide_gap);
    if (std::abs(result.zero_gap_misfit) <= tightness && std::abs(result.wide_gap_misfit) <= tightness)
      return {};
  }
  return "the two fits do not settle";
}

std::string name_of(const trace::BottomTrace& trace, const surface::Maximum& maximum) {
  return maximum.station < trace.stations.size() ? trace.stations[maximum.station].name : std::string{};
}

double root_mean_square_of(const std::vector<double>& misfits) {
  double sum = 0;
  for (const double each : misfits) sum += each * each;
  return misfits.empty() ? not_a_number : std::sqrt(sum / static_cast<double>(misfits.size()));
}

/// K by which the station at a published place is colder at a time (s) than the hottest one; NaN without such
/// a place.
double place_misfit(const surface::SkinHistory& history, const trace::BottomTrace& trace,
                    const std::string& place, double time) {
  const auto found = std::find_if(trace.stations.begin(), trace.stations.end(),
                                  [&](const trace::Station& each) { return each.name == place; });
  if (found == trace.stations.end()) return not_a_number;
  double nearest = std::numeric_limits<double>::infinity(), there = not_a_number;
  for (std::size_t station = 0; station < trace.stations.size(); ++station) {
    const trace::Station& each = trace.stations[station];
    if (each.observation || !(std::abs(each.r - found->r) < nearest)) continue;
    nearest = std::abs(each.r - found->r);
    there = surface::temperature_at_time(history, trace, station, time);
  }
  return there - surface::maximum_at_time(history, trace, time).temperature;
}

/// What one published row says of one calibrated model.
class RowPrediction {
 public:
  RowPrediction(const Study& study, const surface::SkinModel& model, const trace::BottomTrace& trace,
                const Reference& reference, CalibrationRow& row)
      : study_(study),
        reference_(reference),
        trace_(trace),
        history_(surface::integrate_skin(model, trace, reference.gap)),
        at_early_(fmt::format(" at {:.6g} ms", 1e3 * study.early_time)),
        end_(trace.time.empty() ? 0.0 : trace.time.back()),
        row_(row) {}

  void add_all() {
    const auto maximum = surface::maximum_at_stations(history_, trace_);
    const auto early = surface::maximum_at_time(history_, trace_, study_.early_time);
    const Use chosen = reference_.selection ? Use::selection : Use::held_out;
    const bool fitted = reference_.calibrated && row_.calibratable;
    if (!fitted && !reference_.ignited())
      add("T max", maximum.temperature, reference_.maximum_temperature, {.temperature = true});
    add("T" + at_early_, early.temperature, reference_.early_temperature,
        {.temperature = true, .use = reference_.early_calibrated ? Use::calibration : chosen});
    add("spread at the end", spread_at(end_), reference_.spread, {.temperature = false, .use = chosen});
    add("spread" + at_early_, spread_at(study_.early_time), reference_.early_spread,
        {.temperature = false, .use = chosen});
    // T1 was set so that this gap ignites: when it does is no prediction.
    add("ignition time", history_.ignition ? history_.ignition->time : not_a_number, reference_.ignition_time,
        {.temperature = false, .in_seconds = true, .use = Use::calibration});
    place("T max", name_of(trace_, maximum), reference_.ignited() ? std::string{} : reference_.point);
    if (reference_.ignited()) {
      place("first ignition", history_.ignition ? trace_.stations[history_.ignition->station].name : "none",
            reference_.point);
    }
    place("T" + at_early_, name_of(trace_, early), reference_.early_point);
    if (reference_.selection && reference_.gap == 0.0) add_places();
  }

 private:
  double spread_at(double time) const { return surface::spread_at_time(history_, trace_, time); }

  void add(std::string quantity, double predicted, double published, HoldOut kind) {
    if (!std::isfinite(published)) return;
    kind.quantity = std::move(quantity);
    kind.gap = reference_.gap;
    kind.predicted = predicted;
    kind.published = published;
    row_.hold_outs.push_back(std::move(kind));
  }
  void place(std::string quantity, std::string predicted, const std::string& published) {
    if (!published.empty())
      row_.placements.push_back({std::move(quantity), reference_.gap, std::move(predicted), published});
  }
  void add_places() {
    const auto add_place = [&](const std::string& at, const std::string& point, double time) {
      const double misfit = place_misfit(history_, trace_, point, time);
      if (!point.empty()) row_.selection.push_back({"hottest place" + at, misfit});
    };
    add_place(at_early_, reference_.early_point, study_.early_time);
    add_place(" at the end", reference_.point, end_);
  }

  const Study& study_;
  const Reference& reference_;
  const trace::BottomTrace& trace_;
  surface::SkinHistory history_;
  std::string at_early_;  ///< " at 10 ms"
  double end_;            ///< s
  CalibrationRow& row_;
};

/// Over what is held out. NaN where any of the misfits is: a row with a prediction that failed has no good
/// mean.
double root_mean_square(const std::vector<HoldOut>& hold_outs, bool temperatures) {
  std::vector<double> misfits;
  for (const HoldOut& each : hold_outs) {
    if (each.temperature == temperatures && !each.in_seconds && each.use == Use::held_out)
      misfits.push_back(each.misfit());
  }
  return root_mean_square_of(misfits);
}

/// Temperatures one by one, each kind of spread as the root mean square over its gaps.
void add_selection(CalibrationRow& row) {
  std::map<std::string, std::vector<double>> spreads;
  for (const HoldOut& each : row.hold_outs) {
    if (each.use != Use::selection) continue;
    if (each.temperature) {
      row.selection.push_back(
          {fmt::format("{} at {:.6g} cm", each.quantity, 100.0 * each.gap), each.misfit()});
    } else {
      spreads[each.quantity].push_back(each.misfit());
    }
  }
  for (const auto& [quantity, misfits] : spreads)
    row.selection.push_back({quantity, root_mean_square_of(misfits)});
  std::vector<double> all;
  for (const SelectionMisfit& each : row.selection) all.push_back(each.misfit);
  row.selection_root_mean_square = root_mean_square_of(all);
}

}  // namespace

void Constants::put_into(scene::Surface& surface, materials::KineticsParameters& kinetics) const {
  surface.localisation = localisation;
  surface.exchange_time = exchange_time;
  kinetics.ignition_temperature = ignition_temperature;
}

CalibratedConstants calibrate(const surface::SkinModel& given, const trace::BottomTrace& trace,
                              const CalibrationTargets& targets) {
  CalibratedConstants result;
  surface::SkinModel model = untriggered(given);
  if (std::string failure = fit_both(model, trace, targets, result); !failure.empty())
    return failed(result, std::move(failure));
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

void predict(const Study& study, const surface::SkinModel& model, const trace::BottomTrace& trace,
             CalibrationRow& row) {
  for (const Reference& reference : study.references)
    RowPrediction(study, model, trace, reference, row).add_all();
  add_selection(row);
  row.root_mean_square = root_mean_square(row.hold_outs, true);
  row.spread_root_mean_square = root_mean_square(row.hold_outs, false);
}

}  // namespace launchsafe::kinds
