// Stress tests of the laws. Every assessment takes the law as a function, so that a test
// can hand it a broken one and see that it says so.
#pragma once

#include "launchsafe/materials/ideal_gas.hpp"
#include "launchsafe/materials/johnson_cook.hpp"
#include "launchsafe/materials/jwl.hpp"
#include "launchsafe/materials/mie_gruneisen.hpp"
#include "launchsafe/materials/visco_scram.hpp"
#include "launchsafe/materials/vlw.hpp"
#include "launchsafe/mpm/conduction.hpp"
#include "launchsafe/surface/skin.hpp"
#include "launchsafe/verify/stress_test.hpp"

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace launchsafe::verify::law_tests {

/// Compares measured numbers with their bounds and gives the outcome of a stress test.
class Bounds {
 public:
  /// A number >= 0 that must not exceed its bound; NaN exceeds any. Repeated under one name, the worst share
  /// of the bound counts.
  void at_most(const std::string& what, double value, double bound);
  /// A fact that must hold, told by what it would mean if it did not.
  void never(const std::string& fault, bool happened);
  /// The law refused: it returned NaN or a flag.
  void caught(const std::string& reason);

  /// WRONG where a bound or a fact is broken; else caught where the law refused; else held.
  Finding finding() const;

 private:
  struct Measure {
    std::string what;
    double value, bound;
    bool good() const { return value <= bound; }
  };
  std::vector<Measure> measures_;
  std::vector<std::string> faults_, reasons_;
};

/// A stress test that is WRONG where `assess` finds a bound or a fact broken.
struct LawTest {
  std::string group, name, must_hold;  ///< as in StressTest
  std::function<void(Bounds&)> assess;
};
using LawTests = std::vector<LawTest>;

/// Processor time (s) that a step of the charge may take, fifty times what the longest takes. It is not part
/// of the finding, which is thus the same in every run.
inline constexpr double longest_step = 0.05;

// ---- the laws, as what they are called with ----

using SkinLaw =
    std::function<surface::SkinPoint(const surface::SkinModel&, double gap, surface::SkinPoint, double dt,
                                     double air_begin, double air_end, double friction_heating)>;
using HistoryLaw =
    std::function<surface::SkinHistory(const surface::SkinModel&, const trace::BottomTrace&, double gap)>;
using Solid = materials::ViscoScramParameters;
using SolidState = materials::ViscoScramState<double>;
/// Advances the state by a strain increment over dt (s) under a pressure (Pa).
using SolidLaw = std::function<materials::ViscoScramDissipation<double>(
    const Solid&, double dt, SolidState&, math::Deviator<double> strain, double pressure)>;
using ReturnLaw = std::function<materials::JohnsonCookReturn<double>(
    const materials::JohnsonCookParameters&, math::Deviator<double> trial, double plastic_strain,
    double temperature, double dt)>;
using FlowLaw = std::function<double(const materials::JohnsonCookParameters&, double plastic_strain,
                                     double plastic_rate, double temperature)>;
using JwlLaw = std::function<materials::JwlState<double>(const materials::JwlParameters&, double v0,
                                                         double p0, double energy0, double v1)>;
/// One adiabatic step without heat.
using SteelPressureLaw = std::function<materials::MieGruneisenState<double>(
    const materials::MieGruneisenParameters&, double mu0, double p0, double energy0, double mu1)>;
using ValidityLaw = std::function<bool(const materials::MieGruneisenParameters&, double mu)>;
using GasLaw = std::function<materials::VirialState(double temperature, double density)>;
using AirLaw = std::function<double(const materials::AirParameters&, double pressure)>;
using ConductionLaw = std::function<void(mpm::Conduction&, mpm::Simulation&, double dt)>;

// ---- the assessments ----

/// A skin by itself under constant friction heating (K/s), called every `step` seconds from `temperature` (K)
/// on: it must arrive at every temperature when the quadrature of dT/rate says so, and ignite when it says
/// so.
void assess_explosion(Bounds&, const SkinLaw&, const surface::SkinModel&, double temperature, double heating,
                      double step);
/// An inert skin under air of a constant temperature (K) and air that rises linearly, against the exact
/// solutions, called every `step` seconds.
void assess_exchange(Bounds&, const SkinLaw&, double exchange_time, double step);
/// The printed exchange: after n calls the distance to the air is (1 - kappa h)^n of the first one, whatever
/// the step.
void assess_printed_exchange(Bounds&, const SkinLaw&, double gap, double step);
/// Inert charge, film of air and base under a load that rises linearly within `rise` (s) to `peak` (Pa).
void assess_film(Bounds&, const HistoryLaw&, double gap, double rise, double peak);

/// A solid without cracks whose last element has the relaxation time `tau` (s): every element against its
/// exact solution, and the work against what is stored and lost.
void assess_relaxation(Bounds&, const SolidLaw&, double tau, double step);
/// The same with cracks at a fixed ratio q = (c/a)^3 after a sudden strain, against the eigenvectors of the
/// linear system; and the time a step takes.
void assess_cracked_relaxation(Bounds&, const SolidLaw&, double tau, double step, double q);
/// Crack growth under a held strain that first gives `stress` (Pa): one step against a thousand.
void assess_growth(Bounds&, const SolidLaw&, double stress, double pressure, double step);

/// A trial stress of von Mises `q` (Pa) returned to the yield surface.
void assess_return(Bounds&, const ReturnLaw&, double q, double plastic_strain, double temperature, double dt);
/// The flow stress against the published formula in long double.
void assess_flow_stress(Bounds&, const FlowLaw&, double plastic_strain, double plastic_rate,
                        double temperature);

/// From rest to the relative volume `v` in so many steps, against the isentrope in closed form.
void assess_jwl(Bounds&, const JwlLaw&, const materials::JwlParameters&, double v, int steps);
/// From compression `mu0` to `mu1` in so many steps, against a fine fourth-order integration of de = -p dv.
void assess_steel_pressure(Bounds&, const SteelPressureLaw&, double mu0, double mu1, int steps);
/// A density at or beyond the pole, or none: the law must say so.
void assess_steel_validity(Bounds&, const ValidityLaw&, double mu);
/// A gas that is valid has a finite, positive pressure that rises with its density; one that is not has none.
void assess_gas(Bounds&, const GasLaw&, double temperature, double density);
void assess_second_virial(Bounds&, const std::function<double(double)>& law, double reduced_temperature);
void assess_air(Bounds&, const AirLaw&, double ratio);

/// A law called with a denormal argument (its result is the sum of all it gives): finite, and not slow.
void assess_denormals(Bounds&, const std::function<double(double)>& law);

/// Checkered temperatures in the shell, conducted in steps of a Fourier number of the charge's cells.
void assess_conduction(Bounds&, const ConductionLaw&, double fourier_number);

// ---- the tests, by topic ----

/// "1 ns", "10 us", "1 ms", "infinity".
std::string duration_text(double seconds);

/// One step of the charge's strength law, as a run calls it.
materials::ViscoScramDissipation<double> advance_solid(const Solid& solid, double dt, SolidState& state,
                                                       math::Deviator<double> strain, double pressure);

/// The first number of eight: runs compute the laws on a Pack, studies and checks on a double.
inline double first_of(double number) { return number; }
inline double first_of(const math::Pack& numbers) { return numbers[0]; }

LawTests explosion_tests();
LawTests exchange_tests();
LawTests film_tests();
LawTests relaxation_tests();
LawTests growth_tests();
LawTests conduction_tests();
LawTests steel_tests();
LawTests charge_pressure_tests();
LawTests gas_tests();
LawTests denormal_tests();

}  // namespace launchsafe::verify::law_tests
