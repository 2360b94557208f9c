// The charge: Maxwell elements from 1 ps to infinity, with and without cracks, against exact solutions, and
// crack growth far beyond its runaway.

// GCC 12 sees uninitialised registers in its own AVX-512 intrinsics as Eigen uses them (GCC bug 105593).
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wuninitialized"

#include "launchsafe/run/processor_time.hpp"
#include "law_tests.hpp"

#include <Eigen/Dense>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace launchsafe::verify::law_tests {

namespace {

using materials::maxwell_elements;

Solid solid_with(double tau) {
  Solid solid;
  solid.relaxation_rates[maxwell_elements - 1] = 1.0 / tau;  // 0 for infinity
  return solid;
}

/// (1 - e^-x)/x and (x - 1 + e^-x)/x^2.
double mean_decay(double x) { return x > 0.0 ? -std::expm1(-x) / x : 1.0; }
double mean_response(double x) {
  if (x < 1e-2) return 0.5 - x * (1.0 / 6.0 - x * (1.0 / 24.0 - x * (1.0 / 120.0 - x / 720.0)));
  return (x + std::expm1(-x)) / (x * x);
}

/// Shear stress over the sudden shear strain that it followed, for cracks at a fixed q. With the elastic
/// strains y_n of the elements, S_n = d_n y_n, d_n = 2 G_n:
/// (D + q d d^T/(2 G)) y' = d e' - D y/tau: symmetric, so its eigenvectors are exact.
class CrackedSolid {
 public:
  CrackedSolid(const Solid& solid, double q) {
    for (int n = 0; n < size; ++n) {
      d_(n) = 2e-9 * solid.shear_moduli[static_cast<std::size_t>(n)];  // GPa
      loss_(n) = d_(n) * solid.relaxation_rates[static_cast<std::size_t>(n)];
    }
    const Matrix inertia = Matrix(d_.asDiagonal()) + (q / d_.sum()) * d_ * d_.transpose();
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> solver(Matrix(loss_.asDiagonal()), inertia);
    rates_ = solver.eigenvalues().cwiseMax(0.0);
    const Vector shares = solver.eigenvectors().transpose() * d_;
    weights_ = shares.cwiseAbs2();
    at_once_ = solver.eigenvectors() * shares;  // elastic strains right after a unit strain
  }
  /// Pa per unit strain.
  double stress(double time) const { return 1e9 * (weights_.array() * (-rates_.array() * time).exp()).sum(); }
  double element_at_once(std::size_t n) const {
    return 1e9 * d_(static_cast<int>(n)) * at_once_(static_cast<int>(n));
  }

 private:
  static constexpr int size = static_cast<int>(maxwell_elements);
  using Matrix = Eigen::Matrix<double, size, size>;
  using Vector = Eigen::Matrix<double, size, 1>;
  Vector d_, loss_, rates_, weights_, at_once_;
};

constexpr double tau_from = 1e-12, tau_to = 1.0;
constexpr double steps_of_case[] = {1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4};

std::vector<double> taus() {
  std::vector<double> all;
  for (double tau = tau_from; tau < 3.0 * tau_to; tau *= 10.0) all.push_back(tau);
  all.push_back(std::numeric_limits<double>::infinity());
  return all;
}

constexpr double runaway = 24e6;  // Pa, model section 4

/// Elements that a sudden strain has just brought to a von Mises stress (Pa) together.
SolidState strained(const Solid& solid, double stress) {
  SolidState state{};
  state.crack_radius = solid.initial_crack_radius;
  for (std::size_t n = 0; n < materials::maxwell_elements; ++n)
    state.elements[n].rx = stress / std::sqrt(3.0) * solid.shear_moduli[n] / solid.shear_modulus();
  return state;
}

/// Elastic energy (J/m3) of the elements and of the open cracks: sum S_n:S_n/(4 G_n) + q S:S/(4 G).
double energy_of(const Solid& solid, const SolidState& state) {
  const auto total = materials::total_deviator(state);
  double energy = materials::crack_strain_ratio(solid, state.crack_radius) * math::contract(total, total) /
                  (4.0 * solid.shear_modulus());
  for (std::size_t n = 0; n < materials::maxwell_elements; ++n)
    energy += math::contract(state.elements[n], state.elements[n]) / (4.0 * solid.shear_moduli[n]);
  return energy;
}

/// State and dissipation (J/m3) after a held strain.
struct HeldStrain {
  SolidState state{};
  double viscous = 0.0, crack = 0.0;
};

HeldStrain hold_strain(Bounds& bounds, const SolidLaw& law, const Solid& solid, double stress,
                       double pressure, double dt, int steps) {
  HeldStrain held{strained(solid, stress)};
  for (int k = 0; k < steps; ++k) {
    const double before = held.state.crack_radius;
    const auto loss = law(solid, dt / steps, held.state, {}, pressure);
    held.viscous += loss.viscous;
    held.crack += loss.crack;
    bounds.never("a crack heals", held.state.crack_radius < before);
    bounds.never("a number is not finite",
                 !std::isfinite(held.state.crack_radius + loss.viscous + loss.crack));
    bounds.never("a crack passes its bound", held.state.crack_radius > solid.largest_crack_radius);
    bounds.at_most("growth, share of what the largest speed allows",
                   (held.state.crack_radius - before) / (solid.largest_growth_speed * dt / steps),
                   1.0 + 1e-9);
    bounds.never("cracks give energy back", loss.crack < 0.0);
    bounds.at_most("negative viscous dissipation, share of the energy",
                   std::max(0.0, -loss.viscous) / energy_of(solid, strained(solid, stress)), 1e-12);
  }
  return held;
}

}  // namespace

void assess_relaxation(Bounds& bounds, const SolidLaw& law, double tau, double step) {
  Solid solid = solid_with(tau);
  solid.flaw_size = 0.0;
  constexpr double rate = 100.0;  // 1/s
  constexpr int loading = 100, all = 200;
  SolidState state{};
  const double load_time = loading * step;
  double work = 0.0, lost = 0.0;
  for (std::size_t n = 0; n < maxwell_elements; ++n) {
    const double x = load_time * solid.relaxation_rates[n];
    work += 4.0 * solid.shear_moduli[n] * rate * rate * load_time * load_time * mean_response(x);
  }
  for (int k = 1; k <= all; ++k) {
    const bool loads = k <= loading;
    const auto loss = law(solid, step, state, {0.0, 0.0, loads ? rate * step : 0.0}, 0.0);
    bounds.at_most("negative dissipation, share of the work", std::max(0.0, -loss.viscous) / work, 1e-13);
    bounds.never("the dissipation is not finite", !std::isfinite(loss.viscous));
    lost += loss.viscous;
    for (std::size_t n = 0; n < maxwell_elements; ++n) {
      const double s = solid.relaxation_rates[n], loaded = std::min(k, loading) * step;
      const double top = 2.0 * solid.shear_moduli[n] * rate * load_time * mean_decay(load_time * s);
      const double exact = 2.0 * solid.shear_moduli[n] * rate * loaded * mean_decay(loaded * s) *
                           std::exp(-s * (k - std::min(k, loading)) * step);
      bounds.at_most("distance of an element from its exact stress, share of its largest",
                     std::abs(state.elements[n].rx - exact) / top, 1e-12);
    }
  }
  double stored = 0.0;
  for (std::size_t n = 0; n < maxwell_elements; ++n) {
    stored += math::contract(state.elements[n], state.elements[n]) / (4.0 * solid.shear_moduli[n]);
  }
  bounds.at_most("energy that is neither stored nor lost, share of the work",
                 std::abs(work - stored - lost) / work, 1e-12);
}

void assess_cracked_relaxation(Bounds& bounds, const SolidLaw& law, double tau, double step, double q) {
  Solid solid = solid_with(tau);
  solid.growth = false;
  const CrackedSolid exact(solid, q);
  constexpr double strain = 1e-3;
  SolidState state{};
  state.crack_radius = std::cbrt(q) * solid.flaw_size;
  for (std::size_t n = 0; n < maxwell_elements; ++n) state.elements[n].rx = strain * exact.element_at_once(n);
  const double largest = strain * exact.stress(0.0);
  for (int k = 1; k <= 5; ++k) {
    const double begin = run::thread_processor_time();
    const auto loss = law(solid, step, state, {}, 0.0);
    bounds.never("a step takes longer than 50 ms", run::thread_processor_time() - begin > longest_step);
    bounds.at_most("distance from the exact stress, share of the first",
                   std::abs(materials::total_deviator(state).rx - strain * exact.stress(k * step)) / largest,
                   5e-3);
    bounds.at_most("negative dissipation, share of the energy",
                   std::max(0.0, -loss.viscous) / (largest * strain), 1e-13);
  }
}

void assess_growth(Bounds& bounds, const SolidLaw& law, double stress, double pressure, double step) {
  Solid solid;
  if (!(pressure > 0.0)) solid.face_friction = 0.0;
  const double begin = run::thread_processor_time();
  const HeldStrain coarse = hold_strain(bounds, law, solid, stress, pressure, step, 1);
  bounds.never("a step takes longer than 50 ms", run::thread_processor_time() - begin > longest_step);
  const HeldStrain fine = hold_strain(bounds, law, solid, stress, pressure, step, 1000);
  bounds.at_most("crack radius of one step against a thousand, share",
                 std::abs(coarse.state.crack_radius / fine.state.crack_radius - 1.0), 0.01);
  const double energy = energy_of(solid, strained(solid, stress));
  const auto stress_of = [](const HeldStrain& held) {
    return math::von_mises(materials::total_deviator(held.state));
  };
  bounds.at_most("stress of one step against a thousand, share of the first",
                 std::abs(stress_of(coarse) - stress_of(fine)) / stress, 1e-3);
  for (const HeldStrain* held : {&coarse, &fine}) {
    // Strain is held: no work is done on the solid.
    const double left = energy - energy_of(solid, held->state) - held->viscous - held->crack;
    bounds.at_most("energy that is neither stored nor lost, share", std::abs(left) / energy, 1e-2);
  }
}

LawTests relaxation_tests() {
  LawTests tests;
  const std::string group = "stiff: Maxwell elements";
  for (const double tau : taus()) {
    const std::string name = "tau " + duration_text(tau);
    tests.push_back({group, name + ", steps 1 ns to 0.1 ms",
                     "Every element follows its exact solution to 1e-12 under a ramp and after it; no step "
                     "gives energy back; work is stored or lost to 1e-12.",
                     [tau](Bounds& bounds) {
                       for (const double step : steps_of_case)
                         assess_relaxation(bounds, advance_solid, tau, step);
                     }});
    if (tau > 1e-6) continue;  // slower than the law's own fastest element
    for (const double q : {2.7e-5, 0.5, 27.0, 1000.0}) {
      tests.push_back({group, fmt::format("{}, cracks at (c/a)^3 = {:g}, steps 1 ns to 0.1 ms", name, q),
                       "After a sudden strain the stress is that of the exact eigenvectors to 0.5 %; a step "
                       "takes no longer than 50 ms however short tau is.",
                       [tau, q](Bounds& bounds) {
                         for (const double step : steps_of_case)
                           assess_cracked_relaxation(bounds, advance_solid, tau, step, q);
                       }});
    }
  }
  return tests;
}

LawTests growth_tests() {
  LawTests tests;
  for (const double factor : {1.0, 10.0, 1000.0}) {
    for (const double pressure : {0.0, 141e6, 5e9}) {
      const std::string under =
          pressure > 0.0 ? fmt::format("under {:g} MPa with friction", 1e-6 * pressure) : "without friction";
      tests.push_back(
          {"stiff: crack growth",
           fmt::format("{:g} times the stress of runaway, {}, steps 1 ns to 0.1 ms", factor, under),
           "Cracks grow, stay finite and bounded, never faster than v_max; one step agrees with a thousand "
           "to the 1 % of its radius that a sub-step may grow; energy is stored or lost to 1 %; no step "
           "takes longer than 50 ms.",
           [factor, pressure](Bounds& bounds) {
             for (const double step : {1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4})
               assess_growth(bounds, advance_solid, factor * runaway, pressure, step);
           }});
    }
  }
  return tests;
}

}  // namespace launchsafe::verify::law_tests
