// Air that loses what the skin gains: one air volume and all skins together (AirModel::balance).
#include "intervals.hpp"
#include "skin_equation.hpp"

#include <algorithm>
#include <cmath>

namespace launchsafe::surface::detail {

namespace {

/// Air and skins at one instant, and the account of what passed between them (J/m2 of bottom).
struct BalanceState {
  double air = 0;  ///< K
  std::vector<SkinPoint> points;
  double given = 0;      ///< by the air
  double taken = 0;      ///< by the skins
  double exchanged = 0;  ///< sum of magnitudes
};

/// One interval between samples with what drives it.
class BalanceInterval {
 public:
  BalanceInterval(const SkinModel& model, const Intervals& intervals, const std::vector<double>& shares,
                  double gap, std::size_t interval)
      : model_(model),
        intervals_(intervals),
        shares_(shares),
        trigger_(trigger_of(model)),
        interval_(interval),
        length_(intervals.length(interval)),
        rate_(intervals.exchange_rate(interval)),
        ratio_(heat_capacity_ratio(model, gap)),
        capacity_(model.surface.air.density * gap * model.surface.air.specific_heat),
        pressure_(intervals.pressure(interval)) {}

  /// The state at the end by `pieces` symmetric steps: half the exchange, all sources, half the exchange.
  /// Second order in the length of a piece; ending with the exchange keeps it right where the exchange is
  /// stiff.
  BalanceState run(BalanceState state, int pieces) const {
    const double piece = length_ / pieces;
    for (int k = 0; k < pieces; ++k) {
      const double begin = k * piece;
      exchange(state, begin, 0.5 * piece);
      compress(state, static_cast<double>(k) / pieces, static_cast<double>(k + 1) / pieces);
      heat(state, begin, piece);
      exchange(state, begin + 0.5 * piece, 0.5 * piece);
    }
    return state;
  }

  /// Largest difference of two states relative to the temperature. That of the air counts by what it can
  /// still do to the skin.
  double distance(const BalanceState& a, const BalanceState& b) const {
    double most = ratio_ * std::abs(a.air - b.air) / a.air;
    for (std::size_t station = 0; station < a.points.size(); ++station) {
      most = std::max(most, std::abs(a.points[station].temperature / b.points[station].temperature - 1.0));
    }
    return most;
  }

 private:
  /// Exact over h (s): the difference of air and mean skin decays with both capacities, that of a skin and
  /// the mean skin with the skin's alone.
  void exchange(BalanceState& state, double time, double h) const {
    double mean = 0.0;
    for (std::size_t station = 0; station < shares_.size(); ++station) {
      mean += shares_[station] * state.points[station].temperature;
    }
    const double gone = -std::expm1(-(1.0 + ratio_) / ratio_ * rate_ * h);
    const double loss = (state.air - mean) * gone / (1.0 + ratio_);  // of the air, K
    const double evening = std::expm1(-rate_ * h);
    double gained = 0.0;  // by the mean skin, K
    for (std::size_t station = 0; station < shares_.size(); ++station) {
      SkinPoint& point = state.points[station];
      const double before = point.temperature;
      const double after = before + ratio_ * loss + evening * (before - mean);
      gained += shares_[station] * (after - before);
      point.temperature = after;
      if (!point.ignited) {
        const double heating = rate_ * (state.air - before) + intervals_.friction_heating(interval_, station);
        release(model_, trigger_, point, before, heating, time, h);
      }
    }
    const double air = state.air - loss;
    state.given += capacity_ * (state.air - air);
    state.taken += capacity_ / ratio_ * gained;
    state.exchanged += capacity_ * std::abs(loss);
    state.air = air;
  }

  void compress(BalanceState& state, double from, double to) const {
    const materials::AirParameters& air = model_.surface.air;
    state.air *= materials::adiabatic_temperature(air, pressure_.at(to)) /
                 materials::adiabatic_temperature(air, pressure_.at(from));
  }

  /// Friction and reaction over h (s), without exchange.
  void heat(BalanceState& state, double time, double h) const {
    SkinEquation equation;
    equation.air = model_.initial_temperature;
    for (std::size_t station = 0; station < shares_.size(); ++station) {
      SkinPoint& point = state.points[station];
      if (point.ignited) continue;
      equation.heating = intervals_.friction_heating(interval_, station);
      point = advance(model_, equation, point, h);
      if (!point.ignited) continue;
      point.ignition_time += time;
      point.chemical_share = chemical_share(model_, trigger_.temperature,
                                            equation.heating + rate_ * (state.air - trigger_.temperature));
    }
  }

  const SkinModel& model_;
  const Intervals& intervals_;
  const std::vector<double>& shares_;
  Trigger trigger_;
  std::size_t interval_;
  double length_;    // s
  double rate_;      // 1/s, of the skin
  double ratio_;     // kappa h: capacity of the air over that of the skin
  double capacity_;  // J/(m2 K), of the air
  IntervalPressure pressure_;
};

/// Halves the pieces until that changes nothing beyond the tolerance. `pieces` enters as a guess and leaves
/// as used.
BalanceState refine(const BalanceInterval& interval, const BalanceState& state, double tolerance,
                    int& pieces) {
  constexpr int most_pieces = 512;
  BalanceState coarse = interval.run(state, pieces);
  while (true) {
    BalanceState fine = interval.run(state, 2 * pieces);
    // Written so that a state that is not a number ends the search.
    if (!(interval.distance(fine, coarse) > tolerance) || 2 * pieces >= most_pieces) return fine;
    pieces *= 2;
    coarse = std::move(fine);
  }
}

}  // namespace

SkinHistory integrate_balance(const SkinModel& model, const trace::BottomTrace& trace, double gap) {
  const Intervals intervals(model, trace, gap);
  const std::vector<double> shares = area_shares(trace);
  const std::size_t stations = trace.stations.size();
  SkinHistory history;
  if (trace.samples() == 0) return history;
  history.temperature.assign(trace.samples() * stations, model.initial_temperature);

  BalanceState state;
  state.air = materials::adiabatic_temperature(model.surface.air, intervals.pressure_at(0));
  state.points.assign(stations, SkinPoint{model.initial_temperature});
  history.air_temperature.push_back(state.air);
  int pieces = 1;
  for (std::size_t interval = 0; interval < intervals.count(); ++interval) {
    const BalanceInterval balance(model, intervals, shares, gap, interval);
    const std::vector<SkinPoint> before = state.points;
    state = refine(balance, state, model.relative_tolerance, pieces);
    pieces = std::max(1, pieces / 2);
    history.air_temperature.push_back(state.air);
    for (std::size_t station = 0; station < stations; ++station) {
      const SkinPoint& point = state.points[station];
      history.temperature[(interval + 1) * stations + station] = point.temperature;
      if (point.ignited && !before[station].ignited) {
        note_ignition(history, trace, station, trace.time[interval] + point.ignition_time,
                      point.chemical_share);
      }
    }
  }
  history.energy_residual =
      state.exchanged > 0.0 ? std::abs(state.given - state.taken) / state.exchanged : 0.0;
  return history;
}

}  // namespace launchsafe::surface::detail
