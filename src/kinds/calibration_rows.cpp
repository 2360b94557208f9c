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

/// Of a straight line over the gap through what is published of the two calibrated rows. NaN without two such
/// rows, or where one of them does not have the number.
double on_line(const std::vector<Reference>& references, double gap, double Reference::*number) {
  const Reference *zero = nullptr, *wide = nullptr;
  for (const Reference& each : references)
    if (each.calibrated) (each.gap == 0.0 ? zero : wide) = &each;
  if (zero == nullptr || wide == nullptr) return not_a_number;
  return zero->*number + (wide->*number - zero->*number) * gap / wide->gap;
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
  bool fitted = reference.calibrated && row.calibratable;           ///< T max is
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
    place("T max", trace.name_of(maximum.station), reference.ignited() ? std::string{} : reference.point);
    if (reference.ignited())
      place("first ignition", history.ignition ? trace.stations[history.ignition->station].name : "none",
            reference.point);
    place("T" + at_early, trace.name_of(early.station), reference.early_point);
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
    if (!is_fitted) compared.line = on_line(study.references, reference.gap, number);
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
  void place(std::string quantity, std::string computed, const std::string& published) {
    if (!published.empty())
      row.placements.push_back({std::move(quantity), reference.gap, std::move(computed), published});
  }
  void add_places() {
    const auto add_place = [&](const std::string& at, const std::string& point, double time) {
      if (!point.empty())
        row.selection.push_back({"hottest place" + at, place_misfit(history, trace, point, time)});
    };
    add_place(at_early, reference.early_point, study.early_time);
    add_place(" at the end", reference.point, end);
  }
};

/// Over what is not fitted. NaN where any misfit is: a number that cannot be computed leaves no good mean.
double root_mean_square(const CalibrationRow& row, bool temperatures) {
  std::vector<double> misfits;
  for (const ComparedNumber& each : row.compared)
    if (each.temperature == temperatures && !each.in_seconds && each.use != Use::fitted)
      misfits.push_back(each.misfit());
  return root_mean_square_of(misfits);
}

/// Temperatures one by one, each kind of spread as the root mean square over its gaps.
void add_selection(CalibrationRow& row) {
  std::map<std::string, std::vector<double>> spreads;
  for (const ComparedNumber& each : row.compared) {
    if (each.selects && each.temperature)
      row.selection.push_back(
          {fmt::format("{} at {:.6g} cm", each.quantity, 100.0 * each.gap), each.misfit()});
    else if (each.selects)
      spreads[each.quantity].push_back(each.misfit());
  }
  for (const auto& [quantity, misfits] : spreads)
    row.selection.push_back({quantity, root_mean_square_of(misfits)});
  row.selection_root_mean_square = root_mean_square_of(of_each(row.selection, &SelectionMisfit::misfit));
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
  row.root_mean_square = root_mean_square(row, true);
  row.spread_root_mean_square = root_mean_square(row, false);
}

}  // namespace launchsafe::kinds
