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

/// Conductance times the air's mass, p k/(R T), W kg/(m4 K).
double of_air(double pressure, double gas_constant, double temperature) {
  const double at = std::max(temperature, 1.0);
  return pressure / gas_constant * materials::air_conductivity(at) / at;
}

}  // namespace

FilmColumn::FilmColumn(const FilmGrid& grid, const materials::AirParameters& air, double charge, double base)
    : grid_(&grid),
      air_(air),
      gas_constant_(gas_constant(air)),
      reference_(charge),
      pressure_(air.initial_pressure) {
  state_.assign(grid.size(), 0.0);
  for (std::size_t i = grid.air_begin; i < grid.size(); ++i)
    state_[i] = i < grid.base_begin ? air.initial_temperature : base - reference_;
  before_ = state_;
  for (Cells* cells : {&excess_, &rate_begin_, &rate_inner_, &rate_end_, &inner_, &end_, &guess_, &known_,
                       &error_, &share_, &inverse_})
    cells->assign(grid.size(), 0.0);
  conductance_ = grid.conductance;
  conductance_.push_back(0.0);
}

double FilmColumn::step(double h, const StagePressures& pressures, double heating) {
  const double weight = own_weight * h;
  const std::array<double, 3> factors{factor(pressures[0]), factor(pressures[1]), factor(pressures[2])};
  const auto friction_of = [&](std::size_t i) { return i < grid_->air_begin ? heating : 0.0; };

  find_excess(state_, factors[0], excess_);
  find_conductances(excess_, pressures[0]);
  find_rates(excess_, factors[0], rate_begin_);

  extrapolate(before_, state_, last_step_ > 0.0 ? 1.0 + inner_stage * h / last_step_ : 1.0, guess_);
  find_excess(guess_, factors[1], excess_);
  find_conductances(excess_, pressures[1]);
  for (std::size_t i = 0; i < state_.size(); ++i)
    known_[i] = state_[i] + weight * (rate_begin_[i] + 2.0 * friction_of(i));
  solve_stage(known_, weight, factors[1], inner_);
  for (std::size_t i = 0; i < state_.size(); ++i) rate_inner_[i] = (inner_[i] - known_[i]) / weight;

  extrapolate(state_, inner_, 1.0 / inner_stage, guess_);
  find_excess(guess_, factors[2], excess_);
  find_conductances(excess_, pressures[2]);
  for (std::size_t i = 0; i < state_.size(); ++i)
    known_[i] = state_[i] + h * (outer_weight * (rate_begin_[i] + rate_inner_[i]) + friction_of(i));
  solve_stage(known_, weight, factors[2], end_);
  for (std::size_t i = 0; i < state_.size(); ++i) rate_end_[i] = (end_[i] - known_[i]) / weight;

  account(h, factors, heating);
  before_.swap(state_);
  state_.swap(end_);
  pressure_ = pressures[2];
  last_step_ = h;
  find_excess(state_, factors[2], excess_);
  return error_of(excess_, h, factors[2]);
}

void FilmColumn::keep(Kept& kept) const {
  kept.state = state_;
  kept.before = before_;
  kept.pressure = pressure_;
  kept.last_step = last_step_;
}

void FilmColumn::restore(const Kept& kept) {
  state_ = kept.state;
  before_ = kept.before;
  pressure_ = kept.pressure;
  last_step_ = kept.last_step;
}

double FilmColumn::factor(double pressure) const {
  return materials::isentropic_temperature(air_, pressure) / air_.initial_temperature;
}

double FilmColumn::excess_of(std::size_t cell) const {
  return is_air(cell) ? state_[cell] * factor(pressure_) - reference_ : state_[cell];
}

/// Temperatures above the reference, K.
void FilmColumn::find_excess(const Cells& state, double factor, Cells& excess) const {
  excess = state;
  for (std::size_t i = grid_->air_begin; i < grid_->base_begin; ++i)
    excess[i] = state[i] * factor - reference_;
}

void FilmColumn::find_conductances(const Cells& excess, double pressure) {
  const std::size_t first = grid_->air_begin - 1, last = grid_->base_begin - 1;
  for (std::size_t face = first; face <= last; ++face) {
    const double mean = reference_ + 0.5 * (excess[face] + excess[face + 1]);
    conductance_[face] = of_air(pressure, gas_constant_, mean) / grid_->air_mass[face];
  }
  conductance_[first] /= 1.0 + conductance_[first] * grid_->charge_resistance;
  conductance_[last] /= 1.0 + conductance_[last] * grid_->base_resistance;
}

/// By conduction; of air those of the potential temperature, K/s.
void FilmColumn::find_rates(const Cells& excess, double factor, Cells& rates) const {
  double entering = 0.0;  // W/m2 from the left
  for (std::size_t i = 0; i < excess.size(); ++i) {
    const double leaving = i + 1 < excess.size() ? conductance_[i] * (excess[i] - excess[i + 1]) : 0.0;
    rates[i] = (entering - leaving) / (grid_->capacity[i] * (is_air(i) ? factor : 1.0));
    entering = leaving;
  }
}

/// Only conductivities are taken at what comes out, so air is kept within a factor of 2.
void FilmColumn::extrapolate(const Cells& from, const Cells& to, double share, Cells& at) const {
  for (std::size_t i = 0; i < at.size(); ++i) at[i] = from[i] + share * (to[i] - from[i]);
  for (std::size_t i = grid_->air_begin; i < grid_->base_begin; ++i)
    at[i] = std::clamp(at[i], 0.5 * to[i], 2.0 * to[i]);
}

/// Of capacity - weight x conduction, by elimination without a difference: all that is added is positive.
void FilmColumn::factorise(double weight) {
  double left = 0.0;  // what the cells on the left add to the diagonal
  for (std::size_t i = 0; i < share_.size(); ++i) {
    const double diagonal = grid_->capacity[i] + left, beyond = weight * conductance_[i];
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

/// The state y with y = known + weight x (rates by conduction at y).
void FilmColumn::solve_stage(const Cells& known, double weight, double factor, Cells& state) {
  factorise(weight);
  find_excess(known, factor, state);
  for (std::size_t i = 0; i < state.size(); ++i) state[i] *= grid_->capacity[i];
  solve(state);
  for (std::size_t i = grid_->air_begin; i < grid_->base_begin; ++i)
    state[i] = (state[i] + reference_) / factor;
}

/// W/m2, that enters the air at rates of its potential temperature.
double FilmColumn::heat_of(const Cells& rates, double factor) const {
  double sum = 0.0;
  for (std::size_t i = grid_->air_begin; i < grid_->base_begin; ++i) sum += grid_->capacity[i] * rates[i];
  return factor * sum;
}

/// The work is that on air which gets its heat in three portions, at the begin, the inner stage and the end
/// of the step: exact for those, so that it is what the enthalpy gains beyond them.
void FilmColumn::account(double h, const std::array<double, 3>& factors, double heating) {
  double potential = 0.0;  // J/m2
  for (std::size_t i = grid_->air_begin; i < grid_->base_begin; ++i)
    potential += grid_->capacity[i] * state_[i];
  const double rise = factors[2] - factors[0];
  heat_.work = potential * rise + outer_weight * h * heat_of(rate_begin_, factors[0]) * rise / factors[0] +
               outer_weight * h * heat_of(rate_inner_, factors[1]) * (factors[2] - factors[1]) / factors[1];
  double charge = 0.0;  // J/(m2 K)
  for (std::size_t i = 0; i < grid_->air_begin; ++i) charge += grid_->capacity[i];
  heat_.friction = charge * heating * h;
}

double FilmColumn::error_of(const Cells& excess, double h, double factor) {
  for (std::size_t i = 0; i < error_.size(); ++i) {
    const double difference = h * (error_weights[0] * rate_begin_[i] + error_weights[1] * rate_inner_[i] +
                                   error_weights[2] * rate_end_[i]);
    error_[i] = grid_->capacity[i] * difference * (is_air(i) ? factor : 1.0);
  }
  solve(error_);  // damps what is stiff, of which the difference says too much
  double most = 0.0;
  for (std::size_t i = 0; i < error_.size(); ++i) {
    const double share = std::abs(error_[i]) / (reference_ + excess[i]);
    if (!(share <= most)) most = share;
    if (!(share >= 0.0)) return std::numeric_limits<double>::quiet_NaN();
  }
  return most;
}

double FilmColumn::charge_surface() const {
  const std::size_t in = grid_->air_begin - 1, out = grid_->air_begin;
  const double solid = excess_of(in), gas = excess_of(out);
  const double through = of_air(pressure_, gas_constant_, reference_ + 0.5 * (solid + gas)) /
                         grid_->air_mass[in] * grid_->charge_resistance;
  // Without conductivity the resistance is infinite, and what the cell has its surface has.
  return std::isfinite(through) ? reference_ + (solid + through * gas) / (1.0 + through) : reference_ + solid;
}

double FilmColumn::base_surface() const {
  const std::size_t in = grid_->base_begin, out = grid_->base_begin - 1;
  const double solid = excess_of(in), gas = excess_of(out);
  const double through = of_air(pressure_, gas_constant_, reference_ + 0.5 * (solid + gas)) /
                         grid_->air_mass[out] * grid_->base_resistance;
  return std::isfinite(through) ? reference_ + (solid + through * gas) / (1.0 + through) : reference_ + solid;
}

double FilmColumn::compress_to(double pressure) {
  const double before = air_enthalpy();
  pressure_ = pressure;
  return air_enthalpy() - before;
}

/// Of an ideal gas, sum m R T/p, with R/c_p times the enthalpy c_p m T.
double FilmColumn::air_volume() const {
  return (air_.heat_ratio - 1.0) / air_.heat_ratio * air_enthalpy() / pressure_;
}

double FilmColumn::air_heat_capacity() const {
  double capacity = 0.0;
  for (std::size_t i = grid_->air_begin; i < grid_->base_begin; ++i) capacity += grid_->capacity[i];
  return capacity;
}

double FilmColumn::mean_air() const { return air_enthalpy() / air_heat_capacity(); }

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

double FilmColumn::air_enthalpy() const {
  double sum = 0.0;
  for (std::size_t i = grid_->air_begin; i < grid_->base_begin; ++i) sum += grid_->capacity[i] * state_[i];
  return factor(pressure_) * sum;
}

}  // namespace launchsafe::surface::detail
