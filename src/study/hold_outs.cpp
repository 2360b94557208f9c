#include "hold_outs.hpp"

#include <fmt/format.h>

#include <cmath>

namespace launchsafe::study::detail {
namespace {

std::string name_of(const trace::BottomTrace& trace, const surface::Maximum& maximum) {
  return maximum.station < trace.stations.size() ? trace.stations[maximum.station].name : std::string{};
}

/// Collects what a reference has a number for.
class Collector {
 public:
  Collector(CalibrationRow& row, double gap) : row_(row), gap_(gap) {}
  void temperature(std::string quantity, double predicted, double published) {
    add({std::move(quantity), gap_, predicted, published, true, false});
  }
  void spread(std::string quantity, double predicted, double published) {
    add({std::move(quantity), gap_, predicted, published, false, false});
  }
  void time(std::string quantity, double predicted, double published) {
    add({std::move(quantity), gap_, predicted, published, false, true});
  }
  void place(std::string quantity, std::string predicted, const std::string& published) {
    if (!published.empty())
      row_.placements.push_back({std::move(quantity), gap_, std::move(predicted), published});
  }

 private:
  void add(HoldOut hold_out) {
    if (std::isfinite(hold_out.published)) row_.hold_outs.push_back(std::move(hold_out));
  }
  CalibrationRow& row_;
  double gap_;
};

void predict_row(const Study& study, const surface::SkinModel& model, const trace::BottomTrace& trace,
                 const Reference& reference, CalibrationRow& row) {
  const std::string at_early = fmt::format(" at {:.6g} ms", 1e3 * study.early_time);
  const surface::SkinHistory history = surface::integrate_skin(model, trace, reference.gap);
  const auto maximum = surface::maximum_at_stations(history, trace);
  const auto early = surface::maximum_at_time(history, trace, study.early_time);
  const double end = trace.time.empty() ? 0.0 : trace.time.back();
  Collector collect(row, reference.gap);
  const bool fitted = reference.calibrated && row.calibratable;
  if (!fitted && !reference.ignited())
    collect.temperature("T max", maximum.temperature, reference.maximum_temperature);
  collect.temperature("T" + at_early, early.temperature, reference.early_temperature);
  collect.spread("spread at the end", surface::spread_at_time(history, trace, end), reference.spread);
  collect.spread("spread" + at_early, surface::spread_at_time(history, trace, study.early_time),
                 reference.early_spread);
  collect.time("ignition time", history.ignition ? history.ignition->time : not_a_number,
               reference.ignition_time);
  collect.place("T max", name_of(trace, maximum), reference.ignited() ? std::string{} : reference.point);
  if (reference.ignited()) {
    collect.place("first ignition",
                  history.ignition ? trace.stations[history.ignition->station].name : "none",
                  reference.point);
  }
  collect.place("T" + at_early, name_of(trace, early), reference.early_point);
}

/// NaN where any of the misfits is: a row with a prediction that failed has no good mean.
double root_mean_square(const std::vector<HoldOut>& hold_outs, bool temperatures) {
  double sum = 0;
  int count = 0;
  for (const HoldOut& each : hold_outs) {
    if (each.temperature != temperatures || each.in_seconds) continue;
    sum += each.misfit() * each.misfit();
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : not_a_number;
}

}  // namespace

void predict(const Study& study, const surface::SkinModel& model, const trace::BottomTrace& trace,
             CalibrationRow& row) {
  for (const Reference& reference : study.references) predict_row(study, model, trace, reference, row);
  row.root_mean_square = root_mean_square(row.hold_outs, true);
  row.spread_root_mean_square = root_mean_square(row.hold_outs, false);
}

}  // namespace launchsafe::study::detail
