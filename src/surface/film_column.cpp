#include "film_column.hpp"

#include "launchsafe/materials/air_conductivity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace launchsafe::surface::detail {

namespace {

// TR-BDF2 as a Runge-Kutta method: weights of the three stages, the last also the implicit one's own.
constexpr double outer_weight = 0.353553390593273762;  // sqrt(2)/4
constexpr double own_weight = 0.292893218813452476;    // 1 - sqrt(2)/2
// Its difference from the embedded third order (Hosea & Shampine, Appl. Numer. Math. 20, 1996).
constexpr std::array<double, 3> error_weights{(4.0 * outer_weight - 1.0) / 3.0, -1.0 / 3.0,
                                              2.0 * own_weight / 3.0};

/// Conductance times the air's mass, density times conductivity, W kg/(m4 K).
double of_air(double pressure, const materials::AirParameters& air, double temperature) {
  const double at = std::max(temperature, 1.0);
  const double volume = materials::specific_gas_constant(air) * at / pressure + air.covolume;  // m3/kg
  return materials::air_conductivity(at) / volume;
}

}  // namespace

FilmColumn::FilmColumn(const FilmGrid& grid, const materials::AirParameters& air, double charge, double base)
    : grid_(&grid), air_(air), reference_(charge), pressure_(air.initial_pressure) {
  state_.assign(grid.size(), 0.0);
  for (std::size_t i = grid.air_begin; i < grid.size(); ++i)
    state_[i] = i < grid.base_begin ? grid.isentropes.without(air.initial_temperature) : base - reference_;
  before_ = state_;
  for (Cells* cells : {&rate_begin_, &rate_inner_, &rate_end_, &inner_, &end_, &guess_, &known_, &error_,
                       &share_, &inverse_, &excess_})
    cells->assign(grid.size(), 0.0);
  slope_.assign(grid.size(), 1.0);
  capacity_ = grid.capacity;
  enthalpy_ = find_enthalpy(pressure_);
  conductance_ = grid.conductance;
  conductance_.push_back(0.0);
}

double FilmColumn::step(double h, const StagePressures& pressures, double heating) {
  const double weight = own_weight * h;
  const auto friction_of = [&](std::size_t i) { return i < grid_->air_begin ? heating : 0.0; };
  const double enthalpy_before = pressures[0] == pressure_ ? enthalpy_ : find_enthalpy(pressures[0]);

  expand_at(state_, factor(pressures[0]));
  find_conductances(pressures[0]);
  find_rates(rate_begin_);
  double into_air = outer_weight * h * heat_of(rate_begin_);

  extrapolate(before_, state_, last_step_ > 0.0 ? 1.0 + inner_stage * h / last_step_ : 1.0, guess_);
  expand_at(guess_, factor(pressures[1]));
  find_conductances(pressures[1]);
  for (std::size_t i = 0; i < state_.size(); ++i)
    known_[i] = state_[i] + weight * (rate_begin_[i] + 2.0 * friction_of(i));
  solve_stage(guess_, weight, inner_);
  for (std::size_t i = 0; i < state_.size(); ++i) rate_inner_[i] = (inner_[i] - known_[i]) / weight;
  into_air += outer_weight * h * heat_of(rate_inner_);

  extrapolate(state_, inner_, 1.0 / inner_stage, guess_);
  expand_at(guess_, factor(pressures[2]));
  find_conductances(pressures[2]);
  for (std::size_t i = 0; i < state_.size(); ++i)
    known_[i] = state_[i] + h * (outer_weight * (rate_begin_[i] + rate_inner_[i]) + friction_of(i));
  solve_stage(guess_, weight, end_);
  for (std::size_t i = 0; i < state_.size(); ++i) rate_end_[i] = (end_[i] - known_[i]) / weight;
  into_air += weight * heat_of(rate_end_);

  before_.swap(state_);
  state_.swap(end_);
  pressure_ = pressures[2];
  enthalpy_ = find_enthalpy(pressure_);
  last_step_ = h;
  // The work is what the enthalpy gains beyond the heat: V dp of air that gets it in three portions.
  heat_.work = enthalpy_ - enthalpy_before - into_air;
  double charge = 0.0;  // J/(m2 K)
  for (std::size_t i = 0; i < grid_->air_begin; ++i) charge += grid_->capacity[i];
  heat_.friction = charge * heating * h;
  return error_of(h);
}

void FilmColumn::keep(Kept& kept) const {
  kept.state = state_;
  kept.before = before_;
  kept.pressure = pressure_;
  kept.last_step = last_step_;
  kept.enthalpy = enthalpy_;
}

void FilmColumn::restore(const Kept& kept) {
  state_ = kept.state;
  before_ = kept.before;
  pressure_ = kept.pressure;
  last_step_ = kept.last_step;
  enthalpy_ = kept.enthalpy;
}

double FilmColumn::factor(double pressure) const {
  return materials::isentropic_temperature(air_, pressure) / air_.initial_temperature;
}

double FilmColumn::excess_of(std::size_t cell) const {
  if (!is_air(cell)) return state_[cell];
  return grid_->isentropes.at(state_[cell] * factor(pressure_)).temperature - reference_;
}

/// Takes temperatures, their slopes and heat capacities at a state.
void FilmColumn::expand_at(const Cells& state, double factor) {
  excess_ = state;
  for (std::size_t i = grid_->air_begin; i < grid_->base_begin; ++i) {
    const materials::CompressedAir air = grid_->isentropes.at(state[i] * factor);
    excess_[i] = air.temperature - reference_;
    slope_[i] = factor * air.slope;
    capacity_[i] = air_share_ * grid_->capacity[i] * air.capacity_ratio;
  }
}

void FilmColumn::find_conductances(double pressure) {
  const std::size_t first = grid_->air_begin - 1, last = grid_->base_begin - 1;
  for (std::size_t face = first; face <= last; ++face) {
    const double mean = reference_ + 0.5 * (excess_[face] + excess_[face + 1]);
    conductance_[face] = of_air(pressure, air_, mean) / (air_share_ * grid_->air_mass[face]);
  }
  conductance_[first] /= 1.0 + conductance_[first] * grid_->charge_resistance;
  conductance_[last] /= 1.0 + conductance_[last] * grid_->base_resistance;
}

/// By conduction; of air those of the potential temperature, K/s.
void FilmColumn::find_rates(Cells& rates) const {
  double entering = 0.0;  // W/m2 from the left
  for (std::size_t i = 0; i < rates.size(); ++i) {
    const double leaving = i + 1 < rates.size() ? conductance_[i] * (excess_[i] - excess_[i + 1]) : 0.0;
    rates[i] = (entering - leaving) / (capacity_[i] * slope_[i]);
    entering = leaving;
  }
}

/// Only conductivities and slopes are taken at what comes out, so air is kept within a factor of 2.
void FilmColumn::extrapolate(const Cells& from, const Cells& to, double share, Cells& at) const {
  for (std::size_t i = 0; i < at.size(); ++i) at[i] = from[i] + share * (to[i] - from[i]);
  for (std::size_t i = grid_->air_begin; i < grid_->base_begin; ++i)
    at[i] = std::clamp(at[i], 0.5 * to[i], 2.0 * to[i]);
}

/// Of capacity - weight x conduction, by elimination without a difference: all that is added is positive.
void FilmColumn::factorise(double weight) {
  double left = 0.0;  // what the cells on the left add to the diagonal
  for (std::size_t i = 0; i < share_.size(); ++i) {
    const double diagonal = capacity_[i] + left, beyond = weight * conductance_[i];
    inverse_[i] = 1.0 / (diagonal + beyond);
    share_[i] = beyond * inverse_[i];
    left = diagonal * share_[i];
  }
}

void FilmColumn::solve(Cells& values) const {
  for (std::size_t i = 1; i < values.size(); ++i) values[i] += share_[i - 1] * values[i - 1];
  values.back() *= inverse_.back();
  for (std::size_t i = values.size() - 1; i-- > 0;)
    values[i] = values[i] * inverse_[i] + share_[i] * values[i + 1];
}

/// The state y with y = known + weight x (rates by conduction at y), linear about the one expanded at.
void FilmColumn::solve_stage(const Cells& about, double weight, Cells& state) {
  factorise(weight);
  for (std::size_t i = 0; i < state.size(); ++i)
    state[i] = capacity_[i] * (is_air(i) ? excess_[i] + slope_[i] * (known_[i] - about[i]) : known_[i]);
  solve(state);
  for (std::size_t i = grid_->air_begin; i < grid_->base_begin; ++i)
    state[i] = about[i] + (state[i] - excess_[i]) / slope_[i];
}

/// W/m2, that enters the air at rates of its potential temperature.
double FilmColumn::heat_of(const Cells& rates) const {
  double sum = 0.0;
  for (std::size_t i = grid_->air_begin; i < grid_->base_begin; ++i)
    sum += capacity_[i] * slope_[i] * rates[i];
  return sum;
}

double FilmColumn::error_of(double h) {
  for (std::size_t i = 0; i < error_.size(); ++i) {
    const double difference = h * (error_weights[0] * rate_begin_[i] + error_weights[1] * rate_inner_[i] +
                                   error_weights[2] * rate_end_[i]);
    error_[i] = capacity_[i] * slope_[i] * difference;
  }
  solve(error_);  // damps what is stiff, of which the difference says too much
  double most = 0.0;
  for (std::size_t i = 0; i < error_.size(); ++i) {
    const double share = std::abs(error_[i]) / (reference_ + excess_[i]);
    if (!(share <= most)) most = share;
    if (!(share >= 0.0)) return std::numeric_limits<double>::quiet_NaN();
  }
  return most;
}

double FilmColumn::charge_surface() const {
  const std::size_t in = grid_->air_begin - 1, out = grid_->air_begin;
  const double solid = excess_of(in), gas = excess_of(out);
  const double through = of_air(pressure_, air_, reference_ + 0.5 * (solid + gas)) /
                         (air_share_ * grid_->air_mass[in]) * grid_->charge_resistance;
  // Without conductivity the resistance is infinite, and what the cell has its surface has.
  return std::isfinite(through) ? reference_ + (solid + through * gas) / (1.0 + through) : reference_ + solid;
}

double FilmColumn::base_surface() const {
  const std::size_t in = grid_->base_begin, out = grid_->base_begin - 1;
  const double solid = excess_of(in), gas = excess_of(out);
  const double through = of_air(pressure_, air_, reference_ + 0.5 * (solid + gas)) /
                         (air_share_ * grid_->air_mass[out]) * grid_->base_resistance;
  return std::isfinite(through) ? reference_ + (solid + through * gas) / (1.0 + through) : reference_ + solid;
}

double FilmColumn::compress_to(double pressure) {
  const double before = enthalpy_;
  pressure_ = pressure;
  enthalpy_ = find_enthalpy(pressure);
  return enthalpy_ - before;
}

/// Newton's method for the state of a cell with its new enthalpy.
double FilmColumn::take_air(double more, double enthalpy) {
  constexpr double exact = 1e-14;
  constexpr int most = 20;
  const double before = enthalpy_, part = more / (air_share_ + more);
  // J/kg, of ideal gas alone.
  const double entering = enthalpy / grid_->mass - air_.covolume * pressure_;
  const double now = factor(pressure_), reference = materials::enthalpy(air_, reference_);
  air_share_ += more;
  for (std::size_t i = grid_->air_begin; more > 0.0 && i < grid_->base_begin; ++i) {
    double without = state_[i] * now, wanted = 0.0;
    for (int count = 0; count < most; ++count) {
      const materials::CompressedAir air = grid_->isentropes.at(without);
      const double own = materials::enthalpy(air_, air.temperature) - reference;
      if (count == 0) wanted = own + part * (entering - own);
      const double change = (wanted - own) / (air_.specific_heat * air.capacity_ratio * air.slope);
      without += change;
      if (!(std::abs(change) > exact * without)) break;
    }
    before_[i] += without / now - state_[i];  // its change in the last step stays
    state_[i] = without / now;
  }
  enthalpy_ = find_enthalpy(pressure_);
  return enthalpy_ - before;
}

/// Sum m R T/p.
double FilmColumn::air_volume() const {
  return materials::specific_gas_constant(air_) * (air_share_ * grid_->mass) * mean_air() / pressure_;
}

double FilmColumn::covolume() const { return air_share_ * grid_->mass * air_.covolume; }

double FilmColumn::air_heat_capacity() const {
  const double now = factor(pressure_);
  double capacity = 0.0;
  for (std::size_t i = grid_->air_begin; i < grid_->base_begin; ++i)
    capacity += grid_->capacity[i] * grid_->isentropes.at(state_[i] * now).capacity_ratio;
  return air_share_ * capacity;
}

/// Every cell keeps its entropy, so that its volume falls by V/p (1 - R/c_p) dp.
double FilmColumn::exponent() const {
  const double now = factor(pressure_), share = 1.0 - 1.0 / air_.heat_ratio;
  double volume = 0.0, falls = 0.0;
  for (std::size_t i = grid_->air_begin; i < grid_->base_begin; ++i) {
    const materials::CompressedAir air = grid_->isentropes.at(state_[i] * now);
    volume += grid_->capacity[i] * air.temperature;
    falls += grid_->capacity[i] * air.temperature * (1.0 - share / air.capacity_ratio);
  }
  return volume / falls;
}

double FilmColumn::mean_air() const {
  const double now = factor(pressure_);
  double sum = 0.0;
  for (std::size_t i = grid_->air_begin; i < grid_->base_begin; ++i)
    sum += grid_->capacity[i] * grid_->isentropes.at(state_[i] * now).temperature;
  return sum / (air_.specific_heat * grid_->mass);
}

double FilmColumn::charge_heat() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < grid_->air_begin; ++i) sum += grid_->capacity[i] * state_[i];
  return sum;
}

double FilmColumn::base_heat() const {
  double sum = 0.0;
  for (std::size_t i = grid_->base_begin; i < grid_->size(); ++i) sum += grid_->capacity[i] * state_[i];
  return sum;
}

/// Above that of air at the reference, so that round-off is small.
double FilmColumn::find_enthalpy(double pressure) const {
  const double now = factor(pressure), reference = materials::enthalpy(air_, reference_);
  double sum = covolume() * pressure;
  for (std::size_t i = grid_->air_begin; i < grid_->base_begin; ++i) {
    const double temperature = grid_->isentropes.at(state_[i] * now).temperature;
    sum += air_share_ * grid_->capacity[i] / air_.specific_heat *
           (materials::enthalpy(air_, temperature) - reference);
  }
  return sum;
}

}  // namespace launchsafe::surface::detail
