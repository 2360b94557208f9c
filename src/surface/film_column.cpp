#include "launchsafe/surface/film_station.hpp"

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

struct Solid {
  double density, specific_heat, conductivity;  // kg/m3, J/(kg K), W/(m K)
};

/// Thicknesses (m) of cells from the surface inward, growing exponentially to a depth that heat does not
/// reach: at 8 sqrt(alpha t) a jump at the surface has come down to erfc(4) = 1.5e-8 of itself.
std::vector<double> cells_of(const Solid& solid, double duration, std::size_t count) {
  constexpr double reach = 8.0, grading = 4.5, least_depth = 1e-6;
  const double diffusivity = solid.conductivity / (solid.density * solid.specific_heat);
  const double depth = std::max(reach * std::sqrt(diffusivity * duration), least_depth);
  const auto edge = [&](std::size_t k) {
    return depth * std::expm1(grading * static_cast<double>(k) / static_cast<double>(count)) /
           std::expm1(grading);
  };
  std::vector<double> cells;
  for (std::size_t k = 0; k < count; ++k) cells.push_back(edge(k + 1) - edge(k));
  return cells;
}

/// Shares of the mass, finer toward both walls.
std::vector<double> shares_of_air(std::size_t count) {
  constexpr double grading = 2.3;
  const auto edge = [&](std::size_t k) {
    const double share = 2.0 * static_cast<double>(k) / static_cast<double>(count) - 1.0;
    return 0.5 * (1.0 + std::tanh(grading * share) / std::tanh(grading));
  };
  std::vector<double> shares;
  for (std::size_t k = 0; k < count; ++k) shares.push_back(edge(k + 1) - edge(k));
  return shares;
}

}  // namespace

FilmColumn::FilmColumn(const FilmGrid& grid, const materials::AirParameters& air, double charge, double base)
    : grid_(&grid), air_(air), reference_(charge) {
  now_.pressure = air.initial_pressure;
  now_.cells.assign(grid.size(), 0.0);
  for (std::size_t i = grid.air_begin; i < grid.size(); ++i)
    now_.cells[i] =
        i < grid.base_begin ? grid.isentropes.without(air.initial_temperature) : base - reference_;
  now_.before = now_.cells;
  for (Cells* cells : {&rate_begin_, &rate_inner_, &rate_end_, &inner_, &end_, &guess_, &known_, &error_,
                       &share_, &inverse_, &excess_})
    cells->assign(grid.size(), 0.0);
  slope_.assign(grid.size(), 1.0);
  capacity_ = grid.capacity;
  now_.enthalpy = find_enthalpy(now_.pressure);
  conductance_ = grid.conductance;
  conductance_.push_back(0.0);
}

double FilmColumn::step(double h, const StagePressures& pressures, double heating) {
  const double weight = own_weight * h;
  const auto friction_of = [&](std::size_t i) { return i < grid_->air_begin ? heating : 0.0; };
  const double enthalpy_before = pressures[0] == now_.pressure ? now_.enthalpy : find_enthalpy(pressures[0]);

  expand_at(now_.cells, factor(pressures[0]));
  find_conductances(pressures[0]);
  find_rates(rate_begin_);
  double into_air = outer_weight * h * heat_of(rate_begin_);

  extrapolate(now_.before, now_.cells, now_.last_step > 0.0 ? 1.0 + inner_stage * h / now_.last_step : 1.0,
              guess_);
  expand_at(guess_, factor(pressures[1]));
  find_conductances(pressures[1]);
  for (std::size_t i = 0; i < now_.cells.size(); ++i)
    known_[i] = now_.cells[i] + weight * (rate_begin_[i] + 2.0 * friction_of(i));
  solve_stage(guess_, weight, inner_);
  for (std::size_t i = 0; i < now_.cells.size(); ++i) rate_inner_[i] = (inner_[i] - known_[i]) / weight;
  into_air += outer_weight * h * heat_of(rate_inner_);

  extrapolate(now_.cells, inner_, 1.0 / inner_stage, guess_);
  expand_at(guess_, factor(pressures[2]));
  find_conductances(pressures[2]);
  for (std::size_t i = 0; i < now_.cells.size(); ++i)
    known_[i] = now_.cells[i] + h * (outer_weight * (rate_begin_[i] + rate_inner_[i]) + friction_of(i));
  solve_stage(guess_, weight, end_);
  for (std::size_t i = 0; i < now_.cells.size(); ++i) rate_end_[i] = (end_[i] - known_[i]) / weight;
  into_air += weight * heat_of(rate_end_);

  now_.before.swap(now_.cells);
  now_.cells.swap(end_);
  now_.pressure = pressures[2];
  now_.enthalpy = find_enthalpy(now_.pressure);
  now_.last_step = h;
  // The work is what the enthalpy gains beyond the heat: V dp of air that gets it in three portions.
  heat_.work = now_.enthalpy - enthalpy_before - into_air;
  double charge = 0.0;  // J/(m2 K)
  for (std::size_t i = 0; i < grid_->air_begin; ++i) charge += grid_->capacity[i];
  heat_.friction = charge * heating * h;
  return error_of(h);
}

double FilmColumn::factor(double pressure) const {
  return materials::isentropic_temperature(air_, pressure) / air_.initial_temperature;
}

double FilmColumn::excess_of(std::size_t cell) const {
  if (!is_air(cell)) return now_.cells[cell];
  return grid_->isentropes.at(now_.cells[cell] * factor(now_.pressure)).temperature - reference_;
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
    if (!(share >= 0.0)) return math::not_a_number;
  }
  return most;
}

/// K, of the face between a cell of a solid and one of air.
double FilmColumn::surface_between(std::size_t in, std::size_t out, double resistance) const {
  const double solid = excess_of(in), gas = excess_of(out);
  const double through = of_air(now_.pressure, air_, reference_ + 0.5 * (solid + gas)) /
                         (air_share_ * grid_->air_mass[std::min(in, out)]) * resistance;
  // Without conductivity the resistance is infinite, and what the cell has its surface has.
  return std::isfinite(through) ? reference_ + (solid + through * gas) / (1.0 + through) : reference_ + solid;
}

double FilmColumn::charge_surface() const {
  return surface_between(grid_->air_begin - 1, grid_->air_begin, grid_->charge_resistance);
}

double FilmColumn::base_surface() const {
  return surface_between(grid_->base_begin, grid_->base_begin - 1, grid_->base_resistance);
}

double FilmColumn::compress_to(double pressure) {
  const double before = now_.enthalpy;
  now_.pressure = pressure;
  now_.enthalpy = find_enthalpy(pressure);
  return now_.enthalpy - before;
}

/// Newton's method for the state of a cell with its new enthalpy.
double FilmColumn::take_air(double more, double enthalpy) {
  constexpr double exact = 1e-14;
  constexpr int most = 20;
  const double before = now_.enthalpy, part = more / (air_share_ + more);
  // J/kg, of ideal gas alone.
  const double entering = enthalpy / grid_->mass - air_.covolume * now_.pressure;
  const double now = factor(now_.pressure), reference = materials::enthalpy(air_, reference_);
  air_share_ += more;
  for (std::size_t i = grid_->air_begin; more > 0.0 && i < grid_->base_begin; ++i) {
    double without = now_.cells[i] * now, wanted = 0.0;
    for (int count = 0; count < most; ++count) {
      const materials::CompressedAir air = grid_->isentropes.at(without);
      const double own = materials::enthalpy(air_, air.temperature) - reference;
      if (count == 0) wanted = own + part * (entering - own);
      const double change = (wanted - own) / (air_.specific_heat * air.capacity_ratio * air.slope);
      without += change;
      if (!(std::abs(change) > exact * without)) break;
    }
    now_.before[i] += without / now - now_.cells[i];  // its change in the last step stays
    now_.cells[i] = without / now;
  }
  now_.enthalpy = find_enthalpy(now_.pressure);
  return now_.enthalpy - before;
}

/// Sum m R T/p.
double FilmColumn::air_volume() const {
  return materials::specific_gas_constant(air_) * (air_share_ * grid_->mass) * mean_air() / now_.pressure;
}

double FilmColumn::covolume() const { return air_share_ * grid_->mass * air_.covolume; }

/// Over the cells of air as they are, with the heat capacities that the grid has.
template <class OfAir>
double FilmColumn::sum_of_air(OfAir of_air) const {
  const double now = factor(now_.pressure);
  double sum = 0.0;
  for (std::size_t i = grid_->air_begin; i < grid_->base_begin; ++i)
    sum += grid_->capacity[i] * of_air(grid_->isentropes.at(now_.cells[i] * now));
  return sum;
}

double FilmColumn::air_heat_capacity() const {
  return air_share_ * sum_of_air([](const materials::CompressedAir& air) { return air.capacity_ratio; });
}

/// Every cell keeps its entropy, so that its volume falls by V/p (1 - R/c_p) dp.
double FilmColumn::exponent() const {
  const double now = factor(now_.pressure), share = 1.0 - 1.0 / air_.heat_ratio;
  double volume = 0.0, falls = 0.0;
  for (std::size_t i = grid_->air_begin; i < grid_->base_begin; ++i) {
    const materials::CompressedAir air = grid_->isentropes.at(now_.cells[i] * now);
    volume += grid_->capacity[i] * air.temperature;
    falls += grid_->capacity[i] * air.temperature * (1.0 - share / air.capacity_ratio);
  }
  return volume / falls;
}

double FilmColumn::mean_air() const {
  return sum_of_air([](const materials::CompressedAir& air) { return air.temperature; }) /
         (air_.specific_heat * grid_->mass);
}

double FilmColumn::heat_between(std::size_t begin, std::size_t end) const {
  double sum = 0.0;
  for (std::size_t i = begin; i < end; ++i) sum += grid_->capacity[i] * now_.cells[i];
  return sum;
}

/// Above that of air at the reference, so that round-off is small.
double FilmColumn::find_enthalpy(double pressure) const {
  const double now = factor(pressure), reference = materials::enthalpy(air_, reference_);
  double sum = covolume() * pressure;
  for (std::size_t i = grid_->air_begin; i < grid_->base_begin; ++i) {
    const double temperature = grid_->isentropes.at(now_.cells[i] * now).temperature;
    sum += air_share_ * grid_->capacity[i] / air_.specific_heat *
           (materials::enthalpy(air_, temperature) - reference);
  }
  return sum;
}

FilmGrid film_grid(const SkinModel& model, double gap, double duration, const FilmNumerics& numerics) {
  const Solid charge{model.charge_density, model.specific_heat, model.charge_conductivity};
  const Solid steel{model.base_density, model.base_specific_heat, model.base_conductivity};
  const materials::AirParameters& air = model.surface.air;
  const double volume =
      materials::specific_gas_constant(air) * air.initial_temperature / air.initial_pressure;
  const double mass = gap / (volume + air.covolume);
  std::vector<double> inside = cells_of(charge, duration, numerics.charge_cells);
  std::reverse(inside.begin(), inside.end());
  const std::vector<double> shares = shares_of_air(numerics.gas_cells);
  const std::vector<double> beyond = cells_of(steel, duration, numerics.base_cells);

  FilmGrid grid;
  grid.isentropes = materials::Isentropes(air);
  grid.air_begin = inside.size();
  grid.base_begin = grid.air_begin + shares.size();
  for (const double dx : inside) grid.capacity.push_back(charge.density * charge.specific_heat * dx);
  for (const double share : shares) grid.capacity.push_back(air.specific_heat * mass * share);
  for (const double dx : beyond) grid.capacity.push_back(steel.density * steel.specific_heat * dx);
  grid.conductance.assign(grid.size() - 1, 0.0);
  grid.air_mass.assign(grid.size() - 1, 0.0);
  for (std::size_t k = 0; k + 1 < inside.size(); ++k)
    grid.conductance[k] = 2.0 * charge.conductivity / (inside[k] + inside[k + 1]);
  for (std::size_t k = 0; k + 1 < beyond.size(); ++k)
    grid.conductance[grid.base_begin + k] = 2.0 * steel.conductivity / (beyond[k] + beyond[k + 1]);
  for (std::size_t k = 0; k <= shares.size(); ++k) {
    const double before = k > 0 ? shares[k - 1] : 0.0, after = k < shares.size() ? shares[k] : 0.0;
    grid.air_mass[grid.air_begin - 1 + k] = 0.5 * mass * (before + after);
  }
  grid.charge_resistance = 0.5 * inside.back() / charge.conductivity;
  grid.base_resistance = 0.5 * beyond.front() / steel.conductivity;
  grid.mass = mass;
  return grid;
}

}  // namespace launchsafe::surface::detail
