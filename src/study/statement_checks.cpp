// Statements of a publication against what a study computed.
#include "launchsafe/materials/ideal_gas.hpp"
#include "launchsafe/study/published_statements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <list>

namespace launchsafe::study {
namespace {

using Q = StatementQuantity;
using Agreement = StatementCheck::Agreement;
using trace::BottomTrace, trace::Station;

/// The skin of one gap on the trace of its case.
struct Launch {
  const surface::SkinHistory& skin;
  const BottomTrace& trace;

  double temperature(std::size_t station, double time) const {
    return surface::temperature_at_time(skin, trace, station, time);
  }
  double temperature_at_sample(std::size_t station, std::size_t sample) const {
    return skin.temperature[sample * trace.stations.size() + station];
  }
};

/// The ring in which an observation point lies, or that has the name; rings tile the bottom.
std::size_t station_at(const BottomTrace& trace, const std::string& name) {
  const auto& stations = trace.stations;
  const auto named = std::find_if(stations.begin(), stations.end(),
                                  [&name](const Station& each) { return each.name == name; });
  if (named == stations.end()) return stations.size();
  const auto distance = [&](const Station& ring) {
    return ring.observation ? HUGE_VAL : std::abs(ring.r - named->r);
  };
  const auto nearest =
      std::min_element(stations.begin(), stations.end(),
                       [&](const Station& a, const Station& b) { return distance(a) < distance(b); });
  return static_cast<std::size_t>(nearest - stations.begin());
}

/// "S13 (G13)": a ring with the observation points in it.
std::string name_with_points(const BottomTrace& trace, std::size_t ring) {
  std::string points;
  for (const Station& each : trace.stations)
    if (each.observation && station_at(trace, each.name) == ring)
      points += (points.empty() ? "" : ", ") + each.name;
  const std::string& name = trace.stations.at(ring).name;
  return points.empty() ? name : fmt::format("{} ({})", name, points);
}

std::string part_of(const BottomTrace& trace, std::size_t ring) {
  double outermost = 0, innermost = HUGE_VAL;
  for (const Station& each : trace.stations) {
    if (each.observation) continue;
    outermost = std::max(outermost, each.r);
    innermost = std::min(innermost, each.r);
  }
  // Middles of rings: half a ring lies beyond the outermost, as far as the innermost is from the axis.
  const double share = trace.stations.at(ring).r / (outermost + innermost);
  return bottom_parts()[share < 1.0 / 3.0 ? 0 : share < 2.0 / 3.0 ? 1 : 2];
}

/// A temperature of the stations that verdicts rest on.
double lowest_at(const Launch& launch, double time) {
  return surface::maximum_at_time(launch.skin, launch.trace, time).temperature -
         surface::spread_at_time(launch.skin, launch.trace, time);
}

/// The highest temperature of the launch at one ring, or at all of them.
double highest_of(const Launch& launch, std::optional<std::size_t> ring) {
  if (!ring) return surface::maximum_at_stations(launch.skin, launch.trace).temperature;
  double highest = -HUGE_VAL;
  for (std::size_t sample = 0; sample < launch.skin.time.size(); ++sample)
    highest = std::max(highest, launch.temperature_at_sample(*ring, sample));
  return highest;
}

/// When a ring, or the first of them, comes to a temperature; NaN where none does.
double time_of_level(const Launch& launch, std::optional<std::size_t> ring, double level) {
  const std::vector<double>& time = launch.skin.time;
  double first = HUGE_VAL;
  for (std::size_t station = 0; station < launch.trace.stations.size(); ++station) {
    if (ring ? station != *ring : launch.trace.stations[station].observation) continue;
    for (std::size_t sample = 1; sample < time.size() && time[sample - 1] < first; ++sample) {
      const double before = launch.temperature_at_sample(station, sample - 1),
                   after = launch.temperature_at_sample(station, sample);
      if (!(before < level && after >= level)) continue;
      first = std::min(
          first, time[sample - 1] + (time[sample] - time[sample - 1]) * (level - before) / (after - before));
      break;
    }
  }
  return std::isfinite(first) ? first : not_a_number;
}

void set_number(StatementCheck& check, double value) { check.low = check.high = value; }

void set_time(StatementCheck& check, double time, const std::string& otherwise) {
  set_number(check, time);
  if (std::isfinite(time)) return;
  check.reason = otherwise;
  check.agreement = Agreement::differs;
}

/// A statement that names a place agrees where the computed one is the same.
void set_place(StatementCheck& check, std::string place, bool same) {
  check.place = std::move(place);
  check.agreement = same ? Agreement::agrees : Agreement::differs;
}

void set_point(StatementCheck& check, const BottomTrace& trace, std::size_t ring) {
  set_place(check, name_with_points(trace, ring), station_at(trace, check.statement.value) == ring);
}

/// Where a number lies beyond what is published, and whether that is within the tolerance.
void judge_number(StatementCheck& check) {
  const PublishedStatement& said = check.statement;
  if (!std::isfinite(check.low) || !std::isfinite(check.high)) return;
  const double below = std::min(0.0, check.low - said.low), above = std::max(0.0, check.high - said.high);
  check.difference = above > -below ? above : below;
  // The last bits of numbers that were read in other units do not count.
  const double slack = 1e-9 * std::max(std::abs(said.low), std::abs(said.high));
  check.agreement =
      std::abs(check.difference) <= said.tolerance + slack ? Agreement::agrees : Agreement::differs;
}

void check_launch(const Launch& launch, StatementCheck& check) {
  const PublishedStatement& said = check.statement;
  const auto& [skin, trace] = launch;
  const auto ring =
      said.point.empty() ? std::optional<std::size_t>{} : std::optional(station_at(trace, said.point));
  const auto hottest = surface::maximum_at_time(skin, trace, said.time);
  switch (said.quantity) {
    case Q::region:
      check.low = lowest_at(launch, said.time);
      check.high = hottest.temperature;
      break;
    case Q::temperature:
      set_number(check, std::isnan(said.time) ? highest_of(launch, ring)
                        : ring                ? launch.temperature(*ring, said.time)
                                              : hottest.temperature);
      break;
    case Q::hottest_point:
      set_point(check, trace, hottest.station);
      break;
    case Q::hottest_part: {
      std::string part = part_of(trace, hottest.station);
      const bool same = part == said.value;
      set_place(check, std::move(part), same);
      break;
    }
    case Q::spread:
      set_number(check, surface::spread_at_time(skin, trace, said.time));
      break;
    case Q::fast_rise_begins:
      set_time(check, fast_rise_of(skin, trace).begins, "it does not rise fast");
      break;
    case Q::fast_rise_ends:
      set_time(check, fast_rise_of(skin, trace).ends, "it still rises fast at the end");
      break;
    case Q::reaches:
      set_time(check, time_of_level(launch, ring, said.level),
               fmt::format("not reached: {:.1f} K at most", highest_of(launch, ring)));
      break;
    case Q::ignition_time:
      set_time(check, skin.ignition ? skin.ignition->time : not_a_number, "no ignition");
      break;
    case Q::ignition_point:
      if (skin.ignition) {
        set_point(check, trace, skin.ignition->station);
      } else {
        set_place(check, "no ignition", false);
      }
      break;
    default:
      break;
  }
}

void check_case(const CaseOutcome& outcome, StatementCheck& check) {
  const auto& pressure = outcome.result.mechanics.trace.chamber_pressure;
  const materials::AirParameters& air = outcome.input.scene.scene.surface.air;
  switch (check.statement.quantity) {
    case Q::peak_pressure:
      set_number(check, *std::max_element(pressure.begin(), pressure.end()));
      break;
    case Q::air_temperature:
      set_number(check, materials::adiabatic_temperature(air, check.statement.ratio * air.initial_pressure));
      break;
    case Q::critical_gap:
      set_number(check, outcome.critical.value);
      if (outcome.critical.kind == CriticalGapKind::value) break;
      check.reason = to_string(outcome.critical.kind);
      check.agreement = Agreement::differs;
      break;
    case Q::slope:
      if (outcome.fit) set_number(check, outcome.fit->ordinary.slope);
      break;
    case Q::intercept:
      if (outcome.fit) set_number(check, outcome.fit->ordinary.intercept);
      break;
    default:
      break;
  }
}

StatementCheck begun(const PublishedStatement& statement, double gap) {
  StatementCheck check;
  check.statement = statement;
  check.gap = gap;
  return check;
}

/// Histories of gaps, integrated where the study has not done so.
class Histories {
 public:
  explicit Histories(const CaseOutcome& outcome) : outcome_(outcome) {}

  const surface::SkinHistory& of(double gap) {
    const auto same = [gap](const surface::SkinHistory& each) { return std::abs(each.gap - gap) <= 1e-9; };
    for (const run::GapResult& each : outcome_.result.gaps)
      if (same(each.skin)) return each.skin;
    const auto found = std::find_if(integrated_.begin(), integrated_.end(), same);
    if (found != integrated_.end()) return *found;
    const surface::SkinModel model = surface::skin_model(outcome_.input.scene.scene);
    integrated_.push_front(surface::integrate_skin(model, outcome_.result.mechanics.trace, gap));
    return integrated_.front();
  }

 private:
  const CaseOutcome& outcome_;
  std::list<surface::SkinHistory> integrated_;  ///< which stay where they are
};

}  // namespace

FastRise fast_rise_of(const surface::SkinHistory& skin, const BottomTrace& trace) {
  constexpr double half_window = 0.25e-3;  // s
  std::vector<double> time, highest;
  for (std::size_t sample = 0; sample < skin.time.size(); ++sample) {
    if (skin.ignition && skin.time[sample] >= skin.ignition->time) break;
    time.push_back(skin.time[sample]);
    highest.push_back(surface::maximum_at_time(skin, trace, skin.time[sample]).temperature);
  }
  std::vector<double> middle, rate;
  for (const double t : time) {
    if (t < time.front() + half_window || t > time.back() - half_window) continue;
    middle.push_back(t);
    rate.push_back((trace::interpolate(time, highest, t + half_window) -
                    trace::interpolate(time, highest, t - half_window)) /
                   (2.0 * half_window));
  }
  FastRise fast;
  if (rate.size() < 2) return fast;
  const double half = 0.5 * *std::max_element(rate.begin(), rate.end());
  const auto crossing = [&](std::size_t i) {
    return middle[i] + (middle[i + 1] - middle[i]) * (half - rate[i]) / (rate[i + 1] - rate[i]);
  };
  for (std::size_t i = 0; i + 1 < rate.size(); ++i) {
    if (rate[i] <= half && rate[i + 1] > half && std::isnan(fast.begins)) fast.begins = crossing(i);
    if (rate[i] > half && rate[i + 1] <= half) fast.ends = crossing(i);
  }
  if (!rate.empty() && rate.back() > half) fast.ends = not_a_number;
  return fast;
}

std::vector<StatementCheck> check_statements(const Study& study, const CaseOutcome& outcome) {
  const BottomTrace& trace = outcome.result.mechanics.trace;
  Histories histories(outcome);
  std::vector<StatementCheck> checks;
  for (const PublishedStatement& statement : study.statements) {
    std::vector<double> gaps = statement.gaps;
    if (gaps.empty()) gaps.push_back(not_a_number);
    for (const double gap : gaps) {
      StatementCheck& check = checks.emplace_back(begun(statement, gap));
      if (statement.quantity == Q::not_computed) continue;
      if (!outcome.completed() || trace.samples() == 0) {
        check.reason = outcome.failure;
        continue;
      }
      std::isnan(gap) ? check_case(outcome, check) : check_launch({histories.of(gap), trace}, check);
      judge_number(check);
    }
  }
  return checks;
}

}  // namespace launchsafe::study
