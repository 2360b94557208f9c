// VLW virial equation of state of the gaseous products (paper Eq. 36-37, corrected: T*^(1/4) and (n-2)^n
// divide).
#pragma once

#include <string>
#include <vector>

namespace launchsafe::materials {

inline constexpr double gas_constant = 8.31446261815324;  ///< J/(mol K), exact (SI 2019)

/// Lennard-Jones potential of one gas.
struct LennardJones {
  std::string name;
  double temperature = 0;  ///< theta = epsilon/k_B, K
  double covolume = 0;     ///< b0, m3/mol
};

LennardJones nitrogen();         ///< 95.05 K, 63.78 cm3/mol [L]
LennardJones carbon_monoxide();  ///< 100.2 K, 67.22 cm3/mol [L]
LennardJones carbon_dioxide();   ///< 189 K, 113.9 cm3/mol [L]
LennardJones hydrogen();         ///< 37 K, 31.67 cm3/mol [L]
LennardJones water();            ///< 380 K, 23.5 cm3/mol [L]

struct GasComponent {
  LennardJones potential;
  double amount = 0;  ///< mol per kg of explosive
};

/// Products of Composition B per kg, carbon as a solid: N2 10.645, H2O 13.097, CO2 6.705 mol [D].
std::vector<GasComponent> composition_b_gas();

/// What the series says of a state. Where it is not valid the pressure is NaN, so that it cannot be used by
/// mistake: Z <= 0, or a pressure that falls on compression (below the critical temperature that sets in
/// before Z = 0, and no gas is like that: it condenses), or a state that is none.
struct VirialState {
  double compressibility = 0;  ///< Z = p V/(R T); kept also where it is not positive, to be reported
  double pressure = 0;         ///< Pa
  bool valid = false;          ///< Z > 0 and dp/drho > 0 at constant temperature
};

/// Reduced second virial coefficient of the Lennard-Jones potential at T* = T/theta > 0, summed until the
/// terms vanish: B* = - sum_j 2^(j+1/2)/(4 j!) Gamma((2j-1)/4) T*^(-(2j+1)/4). Relative accuracy 1e-13 for T*
/// >= 0.3 (cancellation is mild there); NaN for T* <= 0.
double reduced_second_virial(double reduced_temperature);

/// Z of one gas at T (K) and molar volume V (m3/mol): 1 + B* x + B*/T*^(1/4) sum_{n=3}^{terms} (n-2)^(-n)
/// x^(n-1), x = b0/V.
double virial_compressibility(const LennardJones& gas, double temperature, double molar_volume,
                              int terms = 3);

/// One gas, with the pressure R T Z/V.
VirialState virial_state(const LennardJones& gas, double temperature, double molar_volume, int terms = 3);

/// A mixture at the density of the gas (kg/m3): the virial coefficients, and so Z, are linear in the mole
/// fractions [A].
VirialState virial_state(const std::vector<GasComponent>& mixture, double temperature, double density,
                         int terms = 3);

}  // namespace launchsafe::materials
