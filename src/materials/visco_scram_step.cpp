#include "launchsafe/materials/visco_scram_step.hpp"

#include <algorithm>

namespace launchsafe::materials {

namespace {

/// 2 (x - 2 (1 - e^-x) + (1 - e^-2x)/2)/x^2: what a dashpot takes per G a:a when the strain a comes in evenly
/// over x relaxation times, the integral of (2 G a/x (1 - e^-y))^2/(2 G) dy from 0 to x. By its series where
/// the terms cancel.
double loss_of_even_strain(double x) {
  if (x > 0.5) return 2.0 * (x + 2.0 * std::expm1(-x) - 0.5 * std::expm1(-2.0 * x)) / (x * x);
  // (1 - e^-y)^2 = sum of (-1)^k (2^k - 2) y^k/k! from k = 2 on.
  double sum = 0.0, term = x / 6.0, power_of_two = 4.0;  // term: x^(k - 1)/(k + 1)!
  for (int k = 2; k <= 24; ++k) {
    sum += (k % 2 == 0 ? 1.0 : -1.0) * (power_of_two - 2.0) * term;
    term *= x / (k + 2);
    power_of_two *= 2.0;
  }
  return 2.0 * sum;
}

}  // namespace

ViscoScramStep::ViscoScramStep(const ViscoScramParameters& p) : parameters_(p) {
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
  friction_ = detail::friction_ratio(p, 1.0, 1.0);
  largest_radius_ = std::max(p.largest_crack_radius, 0.0);
  fastest_rate_ = *std::max_element(p.relaxation_rates.begin(), p.relaxation_rates.end());
}

void ViscoScramStep::set_step(double dt) {
  const auto& p = parameters_;
  relaxation_ = relaxation(p, dt);
  double effective = 0.0;  // sum G_n mean_n
  loss_of_strain_ = 0.0;
  for (std::size_t n = 0; n < maxwell_elements; ++n) {
    const double x = dt * p.relaxation_rates[n], g = p.shear_moduli[n], lost = -std::expm1(-x);
    const double mean = relaxation_.mean[n], decay = relaxation_.decay[n];
    factors_[n] = {1.0 - decay,    decay,
                   2.0 * g * mean, g > 0.0 ? 0.25 / g * lost * (1.0 + decay) : 0.0,
                   mean * lost,    g * loss_of_even_strain(x)};
    effective += g * mean;
    loss_of_strain_ += factors_[n].loss_of_strain;
  }
  strain_response_ = 2.0 * effective;
  share_response_ = effective / p.shear_modulus();
  const double growth = dt * p.largest_growth_speed / (1.0 + half_exponent_);  // in a step at K', m
  idle_share_ = std::min(1.0, std::pow(0x1p-54 * p.initial_crack_radius / growth, 1.0 / half_exponent_));
  // With x = dt/tau q/(1 + q)^3 is at most 4/27, at q = 1/2, and q/(1 + q) below 1.
  const double x = dt * fastest_rate_;
  couples_ =
      per_flaw_size_ > 0.0 && (x * x * 4.0 / 27.0 > detail::largest_coupling * detail::largest_coupling ||
                               x > detail::largest_crack_relaxation);
}

}  // namespace launchsafe::materials
