#include "launchsafe/materials/visco_scram.hpp"

#include <algorithm>

namespace launchsafe::materials {

using math::Pack;

namespace {

using Vector = math::DeviatorVector<double>;

/// Share of its radius that a crack may grow in one part of a divided step.
constexpr double growth_per_part = 0.01;
/// Share of the bounds on coupling that one part keeps to.
constexpr double coupling_share_of_part = 0.7;

/// So many of the shortest relaxation times after the begin of a step, what relaxes fastest follows the rest,
/// and a part may be a share of the time since the begin: the number of parts then goes with the logarithm of
/// dt/tau, not with dt/tau itself, which has no bound (tau = 1 ps, dt = 0.1 ms: 1e8). Relaxation that is
/// still going on at the time t has a time scale of about t, of which the share resolves it.
constexpr double settled_relaxations = 64.0;
constexpr double share_of_settled = 0.02;
/// No part is shorter than this share of the step, so that the time left falls in round-off too.
constexpr double shortest_share = 1e-9;

/// (1 - e^-x)/x, the mean of the decay e^-x over x relaxation times. By its series below 1e-2, so that
/// neither 1/tau = 0 nor a tiny step loses digits.
double mean_decay(double x, double decay) {
  if (!(x < 1e-2)) return (1.0 - decay) / x;
  return 1.0 - x * (0.5 - x * (1.0 / 6.0 - x * (1.0 / 24.0 - x * (1.0 / 120.0 - x * (1.0 / 720.0)))));
}

/// 2 (x - 2 (1 - e^-x) + (1 - e^-2x)/2)/x^2: what a dashpot takes per G a:a when the strain a comes in evenly
/// over x relaxation times, the integral of (2 G a/x (1 - e^-y))^2/(2 G) dy from 0 to x; `lost` is 1 - e^-x.
/// By its series where the terms cancel.
double loss_of_even_strain(double x, double lost) {
  if (x > 0.5) return 2.0 * (x - 2.0 * lost - 0.5 * std::expm1(-2.0 * x)) / (x * x);
  // (1 - e^-y)^2 = sum of (-1)^k (2^k - 2) y^k/k! from k = 2 on.
  double sum = 0.0, more = 1.0, term = x / 6.0, power_of_two = 4.0;  // term: x^(k - 1)/(k + 1)!
  for (int k = 2; k <= 24 && std::abs(more) > 1e-18 * sum; ++k) {
    more = (k % 2 == 0 ? 1.0 : -1.0) * (power_of_two - 2.0) * term;
    sum += more;
    term *= x / (k + 2);
    power_of_two *= 2.0;
  }
  return 2.0 * sum;
}

Vector lane_of(const math::DeviatorVector<Pack>& all, std::size_t lane) {
  return {all.hoop[lane], all.difference[lane], all.shear[lane]};
}

void set_lane(math::DeviatorVector<Pack>& all, std::size_t lane, const Vector& value) {
  all.hoop.set(lane, value.hoop);
  all.difference.set(lane, value.difference);
  all.shear.set(lane, value.shear);
}

}  // namespace

ViscoScram::ViscoScram(const ViscoScramParameters& p) : parameters_(p) {
  const bool has_flaws = p.flaw_size > 0.0;
  first_relaxes_ = p.relaxation_rates[0] > 0.0;
  grows_ = p.growth && has_flaws;
  half_exponent_ = 0.5 * p.growth_exponent;
  whole_half_exponent_ = static_cast<int>(std::clamp(half_exponent_, 0.0, 64.0));
  half_exponent_is_whole_ =
      whole_half_exponent_ > 0 && !(half_exponent_ > static_cast<double>(whole_half_exponent_));
  compliance_ = 0.5 / p.shear_modulus();
  per_flaw_size_ = has_flaws ? 1.0 / p.flaw_size : 0.0;
  // K^2 = pi c 3/2 S:S at the middle of the step, over K'^2 = K0^2 (1 + 2/m).
  const double transition = p.toughness * p.toughness * (1.0 + 1.0 / half_exponent_);
  intensity_factor_ = grows_ ? 0.25 * detail::pi * 1.5 / transition : 0.0;
  const double friction =
      p.face_friction * std::sqrt(45.0 / (2.0 * (3.0 - 2.0 * p.face_friction * p.face_friction)));
  friction_ = friction / p.toughness;
  largest_radius_ = std::max(p.largest_crack_radius, 0.0);
  fastest_rate_ = *std::max_element(p.relaxation_rates.begin(), p.relaxation_rates.end());
}

ViscoScram::Factors ViscoScram::factors_of(double dt) const {
  Factors factors{.dt = dt};
  double effective = 0.0;  // sum G_n mean_n
  for (std::size_t n = 0; n < maxwell_elements; ++n) {
    const double x = dt * parameters_.relaxation_rates[n], g = parameters_.shear_moduli[n];
    const double decay = std::exp(-x), lost = -std::expm1(-x), mean = mean_decay(x, decay);
    factors.elements[n] = {1.0 - decay,    decay,
                           2.0 * g * mean, g > 0.0 ? 0.25 / g * lost * (1.0 + decay) : 0.0,
                           mean * lost,    g * loss_of_even_strain(x, lost)};
    effective += g * mean;
    factors.loss_of_strain += factors.elements[n].loss_of_strain;
  }
  factors.strain_response = 2.0 * effective;
  factors.share_response = effective / parameters_.shear_modulus();
  return factors;
}

void ViscoScram::set_step(double dt) {
  const auto& p = parameters_;
  factors_ = factors_of(dt);
  const double growth = dt * p.largest_growth_speed / (1.0 + half_exponent_);  // in a step at K', m
  idle_share_ = std::min(1.0, std::pow(0x1p-54 * p.initial_crack_radius / growth, 1.0 / half_exponent_));
  // With x = dt/tau q/(1 + q)^3 is at most 4/27, at q = 1/2, and q/(1 + q) below 1.
  const double x = dt * fastest_rate_;
  couples_ =
      per_flaw_size_ > 0.0 && (x * x * 4.0 / 27.0 > detail::largest_coupling * detail::largest_coupling ||
                               x > detail::largest_crack_relaxation);
}

double ViscoScram::growth_speed(double crack_radius, Vector stress, double pressure) const {
  if (!grows_ || !(crack_radius < parameters_.largest_crack_radius)) return 0.0;
  const double drive = intensity(crack_radius, 2.0 * stress);
  if (idle(crack_radius, drive, pressure)) return 0.0;
  const double share = drive / detail::toughening(friction_ratio(pressure, crack_radius));
  return parameters_.largest_growth_speed * speed_at(share).speed;
}

/// Length (s) of a part of a divided step that begins `elapsed` seconds after it.
double ViscoScram::longest_part(const State<double>& state, double growth_speed, double elapsed) const {
  const double q = strain_ratio(state.crack_radius), stiffening = 1.0 + q;
  const double share = stiffening / math::max(q, 1e-100);
  const double coupled = math::min(detail::largest_coupling * stiffening * std::sqrt(share),
                                   detail::largest_crack_relaxation * share);
  double longest = coupling_share_of_part / math::max(fastest_rate_, 1e-100) * coupled;
  if (elapsed * fastest_rate_ > settled_relaxations) longest = math::max(longest, share_of_settled * elapsed);
  if (growth_speed > 0.0) longest = math::min(growth_per_part * state.crack_radius / growth_speed, longest);
  return math::max(longest, shortest_share * factors_.dt);
}

/// The lanes go part by part together, each in parts of its own: lanes that are alike share their factors.
ViscoScram::Result<Pack> ViscoScram::divided_update(const State<Pack>& start,
                                                    math::DeviatorVector<Pack> strain, Pack pressure,
                                                    math::Mask lanes) const {
  struct Lane {
    Result<double> at{};
    Vector strain{};
    double pressure = 0, remaining = 0;
  };
  std::array<Lane, math::pack_width> all{};
  for (std::size_t lane = 0; lane < math::pack_width; ++lane) {
    if (lanes.lanes[lane] == 0) continue;
    all[lane] = {{{lane_of(start.total, lane), {}, start.crack_radius[lane]}, 0.0, 0.0},
                 lane_of(strain, lane),
                 pressure[lane],
                 factors_.dt};
    for (std::size_t n = 0; n < kept_elements; ++n)
      all[lane].at.state.elements[n] = lane_of(start.elements[n], lane);
  }
  Factors factors;
  const auto advance = [&](Lane& lane) {
    const State<double> begin = lane.at.state;
    const double radius = begin.crack_radius, ratio = strain_ratio(radius), viscous = lane.at.viscous;
    const double speed = growth_speed(radius, begin.total, lane.pressure);
    const double limit = longest_part(begin, speed, factors_.dt - lane.remaining);
    const bool last = lane.remaining <= limit * (1.0 + 1e-9);
    const double dt = last ? lane.remaining : limit;
    if (dt != factors.dt) factors = factors_of(dt);
    const Vector part = (dt / factors_.dt) * lane.strain;
    const auto begun = drive(begin, part, ratio, factors);
    const auto grown = [&](double mean_speed) {
      return math::max(radius, math::min(radius + dt * mean_speed, largest_radius_));
    };
    const double predicted = grown(speed);
    const Vector stress = stress_at(strain_ratio(predicted), begun, factors);
    const double end = grown(0.5 * (speed + growth_speed(predicted, stress, lane.pressure)));
    lane.at.state.crack_radius = end;
    lane.at.state.total = stress_at(strain_ratio(end), begun, factors);
    finish(begin, part, ratio, strain_ratio(end), begun, factors, lane.at);
    lane.at.viscous += viscous;
    lane.at.crack +=
        0.5 * compliance_ * (strain_ratio(end) - ratio) * contract(begin.total, lane.at.state.total);
    lane.remaining = last ? 0.0 : lane.remaining - dt;
  };
  const auto is_left = [](const Lane& lane) { return lane.remaining > 0.0; };
  while (std::ranges::any_of(all, is_left))
    for (Lane& lane : all)
      if (is_left(lane)) advance(lane);

  Result<Pack> result{start, Pack(0.0), Pack(0.0)};
  for (std::size_t lane = 0; lane < math::pack_width; ++lane) {
    const Result<double>& end = all[lane].at;
    set_lane(result.state.total, lane, end.state.total);
    for (std::size_t n = 0; n < kept_elements; ++n)
      set_lane(result.state.elements[n], lane, end.state.elements[n]);
    result.state.crack_radius.set(lane, end.state.crack_radius);
    result.viscous.set(lane, end.viscous);
    result.crack.set(lane, end.crack);
  }
  return result;
}

ViscoScram::Result<double> ViscoScram::divided_update(const State<double>& state, Vector strain,
                                                      double pressure, bool) const {
  const auto same = [](const Vector& v) {
    return math::DeviatorVector<Pack>{Pack(v.hoop), Pack(v.difference), Pack(v.shear)};
  };
  State<Pack> start{same(state.total), {}, Pack(state.crack_radius)};
  for (std::size_t n = 0; n < kept_elements; ++n) start.elements[n] = same(state.elements[n]);
  math::Mask first{};
  first.lanes[0] = -1;
  const Result<Pack> end = divided_update(start, same(strain), Pack(pressure), first);
  Result<double> result{
      {lane_of(end.state.total, 0), {}, end.state.crack_radius[0]}, end.viscous[0], end.crack[0]};
  for (std::size_t n = 0; n < kept_elements; ++n)
    result.state.elements[n] = lane_of(end.state.elements[n], 0);
  return result;
}

}  // namespace launchsafe::materials
