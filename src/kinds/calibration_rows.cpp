// What a calibrated model computes for the published rows, beside them.
#include "calibration_parts.hpp"

namespace launchsafe::kinds {

using study::Use;

namespace {

double root_mean_square_of(const std::vector<double>& misfits) {
  return std::sqrt(math::sum_of_squares(misfits) / static_cast<double>(misfits.size()));  // NaN of none
}

/// K by which the station at a published place is colder at a time (s) than the hottest; NaN without one.
double place_misfit(const surface::SkinHistory& history, const BottomTrace& trace, const std::string& place,
                    double time) {
  const trace::Station* found = keys::find_named(trace.stations, place);
  if (found == nullptr) return not_a_number;
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
struct RowComparison {
  const Study& study;
  const SkinModel& model;
  const BottomTrace& trace;
  const Reference& reference;
  CalibrationRow& row;

  surface::SkinHistory history = surface::integrate_skin(model, trace, reference.gap);
  std::string at_early = fmt::format(" at {:.6g} ms", 1e3 * study.early_time);
  double end = trace.time.empty() ? 0.0 : trace.time.back();        ///< s
  Use rest = reference.selection ? Use::chosen_by : Use::held_out;  ///< of what is not fitted
  bool fitted = reference.calibrated;                               ///< T max is
  bool all_fitted = fitted && settings_of<CalibrationSettings>(study).load_fitted;

  void add_all() {
    const auto maximum = surface::maximum_at_stations(history, trace);
    const auto early = surface::maximum_at_time(history, trace, study.early_time);
    add_temperature("T max", maximum.temperature, &Reference::maximum_temperature, fitted);
    add_temperature("T" + at_early, early.temperature, &Reference::early_temperature, all_fitted);
    add_rise();
    add("spread at the end", spread_at(end), reference.spread, spread());
    add("spread" + at_early, spread_at(study.early_time), reference.early_spread, spread());
    // T1 was set so that this gap ignites: when it does is not held out.
    add("ignition time", history.ignition ? history.ignition->time : not_a_number, reference.ignition_time,
        {.temperature = false, .in_seconds = true, .use = Use::chosen_by});
    if (reference.selection && reference.gap == 0.0) add_places();
  }

  double spread_at(double time) const { return surface::spread_at_time(history, trace, time); }
  ComparedNumber spread() const {
    return {.temperature = false, .selects = reference.selection, .use = rest};
  }

  void add(std::string quantity, double computed, double published, ComparedNumber number) {
    if (!std::isfinite(published)) return;
    number.quantity = std::move(quantity);
    number.gap = reference.gap;
    number.computed = computed;
    number.published = published;
    row.compared.push_back(std::move(number));
  }
  void add_temperature(std::string quantity, double computed, double Reference::*number, bool is_fitted) {
    const bool early = number == &Reference::early_temperature;
    if (!early && reference.ignited()) return;
    // Without a gap the temperature at the early time tells of the load, not of the interfaces.
    ComparedNumber compared{.selects = early && reference.selection && reference.gap > 0.0,
                            .use = is_fitted ? Use::fitted : rest};
    add(std::move(quantity), computed, reference.*number, std::move(compared));
  }
  void add_rise() {
    if (!std::isfinite(reference.rise_begins) && !std::isfinite(reference.rise_ends)) return;
    const FastRise rise = fast_rise(surface::integrate_skin(untriggered(model), trace, reference.gap), trace);
    const ComparedNumber instant{
        .temperature = false, .in_seconds = true, .use = all_fitted ? Use::fitted : rest};
    add("fast rise begins", rise.begins, reference.rise_begins, instant);
    add("fast rise ends", rise.unfinished ? not_a_number : rise.ends, reference.rise_ends, instant);
  }
  void add_places() {
    const auto add_place = [&](const std::string& point, double time) {
      if (!point.empty()) row.selection.push_back(place_misfit(history, trace, point, time));
    };
    add_place(reference.early_point, study.early_time);
    add_place(reference.point, end);
  }
};

/// Over what is not fitted. NaN where any misfit is: a number that cannot be computed leaves no good mean.
double root_mean_square(const CalibrationRow& row) {
  std::vector<double> misfits;
  for (const ComparedNumber& each : row.compared)
    if (each.temperature && each.use != Use::fitted) misfits.push_back(each.misfit());
  return root_mean_square_of(misfits);
}

/// Temperatures one by one, each kind of spread as the root mean square over its gaps.
void add_selection(CalibrationRow& row) {
  std::map<std::string, std::vector<double>> spreads;
  for (const ComparedNumber& each : row.compared) {
    if (each.selects && each.temperature)
      row.selection.push_back(each.misfit());
    else if (each.selects)
      spreads[each.quantity].push_back(each.misfit());
  }
  for (const auto& [quantity, misfits] : spreads) row.selection.push_back(root_mean_square_of(misfits));
  row.selection_root_mean_square = root_mean_square_of(row.selection);
}

}  // namespace

MisfitBound misfit_bound(const CalibrationRow& row) {
  MisfitBound bound;
  for (const ComparedNumber& each : row.compared) bound.count += each.temperature && each.use != Use::fitted;
  const double misfit = row.root_mean_square;
  if (bound.count > 0)
    bound.root_mean_square = std::isnan(misfit) ? std::numeric_limits<double>::infinity() : misfit;
  bound.factor = math::one_sided_student_factor(bound.count, 0.95);
  return bound;
}

void compare(const Study& study, const SkinModel& model, const BottomTrace& trace, CalibrationRow& row) {
  for (const Reference& reference : study.references)
    RowComparison{study, model, trace, reference, row}.add_all();
  add_selection(row);
  row.root_mean_square = root_mean_square(row);
}

}  // namespace launchsafe::kinds
