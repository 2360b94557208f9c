// One particle of the explosive charge, sheared at a constant rate, without any mesh.
//
// In the law of the charge (Visco-SCRAM), parallel Maxwell elements lie in series with penny cracks. Until
// the cracks run, the stress is that of the Maxwell elements, which has a closed form; then they grow,
// the stress falls, and the work turns into heat. The program prints the path as CSV.
#include "launchsafe/materials/charge.hpp"

#include <cmath>
#include <cstdio>

namespace {

using namespace launchsafe;
using materials::Charge;

constexpr double strain_rate = 1000.0;         // 1/s, of the tensor component rx
constexpr double largest_strain = 0.03;        // of the same
constexpr double initial_temperature = 300.0;  // K
constexpr int steps = 12000, steps_per_line = 100;

/// Shear stress (Pa) at a time (s) of the Maxwell elements alone, without cracks: the sum over the elements
/// of 2 G tau rate (1 - exp(-t/tau)).
double uncracked_stress(const Charge& charge, double time) {
  double stress = 0.0;
  for (std::size_t n = 0; n < materials::maxwell_elements; ++n) {
    const double modulus = charge.strength.shear_moduli[n], rate = charge.strength.relaxation_rates[n];
    const double effective_time = rate > 0.0 ? -std::expm1(-rate * time) / rate : time;
    stress += 2.0 * modulus * strain_rate * effective_time;
  }
  return stress;
}

}  // namespace

int main() {
  const Charge charge;  // composition B, with cracks of 30 um
  Charge::Integrator integrator(charge);
  const double time_step = largest_strain / strain_rate / steps;  // s
  integrator.set_step(time_step);

  // Shear keeps the volume, and the axes are taken to turn along with the particle, so that its spin is 0.
  materials::Increment<double> increment{};
  increment.deviator.rx = strain_rate * time_step;
  increment.volume_before = increment.volume_after = 1.0;  // volume over that at rest

  materials::State<Charge, double> state = charge.initial_state(initial_temperature);
  double pressure = 0.0, temperature = initial_temperature, heat = 0.0;  // Pa, K, J/m3
  std::puts("strain,stress_Pa,uncracked_stress_Pa,crack_radius_m,heat_J_per_m3,temperature_K");
  for (int step = 1; step <= steps; ++step) {
    const materials::Response<double> response = integrator.update(increment, state, pressure, temperature);
    pressure = response.pressure;
    heat += response.viscous + response.crack;
    if (step % steps_per_line != 0) continue;
    const double time = step * time_step;
    // The law leaves the temperature to the mechanics. Here no heat is conducted away (adiabatic), and all
    // that cracks and Maxwell elements dissipate becomes heat.
    std::printf("%.6e,%.6e,%.6e,%.6e,%.6e,%.6f\n", strain_rate * time, response.deviator.rx,
                uncracked_stress(charge, time), state[Charge::crack_radius], heat,
                initial_temperature + heat / (charge.initial_density() * charge.specific_heat));
  }
}
