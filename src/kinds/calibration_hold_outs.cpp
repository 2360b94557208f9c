#include "calibration_hold_outs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace launchsafe::kinds {

using namespace study;
using namespace report;
namespace {

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

void predict(const Study& study, const surface::SkinModel& model, const trace::BottomTrace& trace,
             CalibrationRow& row) {
  for (const Reference& reference : study.references)
    RowPrediction(study, model, trace, reference, row).add_all();
  add_selection(row);
  row.root_mean_square = root_mean_square(row.hold_outs, true);
  row.spread_root_mean_square = root_mean_square(row.hold_outs, false);
}

}  // namespace launchsafe::kinds
