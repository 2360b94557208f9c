// launchsafe verify: numbers that an installed program must reproduce. The laws and the mechanics have their
// full tests in the source.
#include "common_options.hpp"
#include "launchsafe/mpm/conduction.hpp"
#include "launchsafe/report/quantities.hpp"

#include <boost/algorithm/string.hpp>

namespace launchsafe::app {
namespace {

struct VerifyArguments {
  std::string filter;  ///< part of a check's group or name, case ignored
};

// ---- the laws ----

/// Shear stress over twice the shear strain (Pa), `time` seconds after a sudden strain; with the relaxation
/// times as the paper's Table 3 prints them (the law's default rates are these rounded to three digits).
double relaxation_modulus(double time, int steps) {
  materials::ViscoScramParameters solid;
  solid.relaxation_rates = {0.0, 1.0 / 1.366e-4, 1.0 / 1.366e-5, 1.0 / 1.366e-6, 1.0 / 5e-7};
  solid.flaw_size = 0.0;
  materials::ViscoScramState<double> state{};
  constexpr double strain = 1e-4;
  for (std::size_t n = 0; n < materials::maxwell_elements; ++n)
    state.elements[n].rx = 2.0 * solid.shear_moduli[n] * strain;
  materials::ViscoScramStep law(solid);
  law.set_step(time / steps);
  auto now = law.state_of(state);
  for (int k = 0; k < steps; ++k) now = law.update<double>(now, {}, 0.0).state;
  return deviator_of(now.total).rx / (2.0 * strain);
}

// ---- the skin ----

/// Time (s) to the thermal explosion of a skin at 700 K with the printed kinetics.
double induction_time() {
  surface::SkinModel model;
  model.kinetics.activation_temperature = 2.7e4;
  model.kinetics.ignition_temperature = 1e9;
  model.kinetics.burnt_temperature = 2e9;
  constexpr double dt = 1e-5;
  surface::SkinPoint point{700.0};
  double time = 0.0;
  while (!point.ignited && time < 1e-3) {
    point = surface::advance_skin(model, 0.0, point, dt, 300.0, 300.0, 0.0);
    time += point.ignited ? point.ignition_time : dt;
  }
  return point.ignited ? time : std::nan("");
}

// ---- the mechanics ----

scene::Scene block(const std::string& material, double length, double radius, double cell_size) {
  scene::Scene block;
  block.bodies = {{"block", material, 0.0, length, 0.0, radius}};
  block.numerics.cell_size = cell_size;
  block.load.base = 0.0;
  return block;
}

/// The 155 mm shell in cells of 5 mm.
scene::Scene shell_155() {
  scene::Scene shell;
  shell.bodies = {{"nose", "steel", 0.0, 0.118, 0.0, 0.0775},
                  {"charge", "charge", 0.118, 0.678, 0.0, 0.065},
                  {"wall", "steel", 0.118, 0.678, 0.065, 0.0775},
                  {"base", "steel", 0.678, 0.74, 0.0, 0.0775}};
  shell.numerics.cell_size = 5e-3;
  return shell;
}

/// To `end` (s) in equal steps no longer than the stable one; `after_step` may look at each.
void run_to(mpm::Simulation& simulation, double end, const std::function<void()>& after_step = {}) {
  const double span = end - simulation.time(), steps = std::ceil(span / simulation.stable_time_step());
  for (double step = 0.0; step < steps; step += 1.0) {
    simulation.step(span / steps);
    if (after_step) after_step();
  }
}

/// Rise (K) 10 µm deep in a half space of charge after 1 ms beside one that is 2 K hotter, so that the face
/// between them is 1 K hotter.
double conducted_rise() {
  constexpr double depth = 1e-4;
  scene::Scene strip = block("charge", 2.0 * depth, 0.5e-6, 0.5e-6);
  strip.symmetry = scene::Symmetry::plane_strain;
  mpm::Simulation simulation(strip);
  mpm::Conduction conduction(simulation);
  mpm::ParticleFields& p = simulation.bodies_of<materials::Charge>()[0].get().particles;
  for (std::size_t i = 0; i < p.x.size(); ++i)
    if (p.x[i] > depth) p.temperature[i] += 2.0;
  for (int step = 0; step < 1000; ++step) conduction.advance(simulation, 1e-6);
  const auto rise = [&](int i) { return p.temperature[p.lattice.slot(i, 0)] - strip.initial_temperature; };
  return 0.5 * (rise(179) + rise(180));
}

/// Speed (m/s) of a weak pulse along a strip of steel in a rigid barrel, by the centre of its momentum.
double longitudinal_speed() {
  scene::Scene strip = block("steel", 1.0, 0.01, 0.005);
  strip.symmetry = scene::Symmetry::plane_strain;
  strip.frame = scene::Frame::lab;
  strip.load.peak = 1e5;
  strip.load.shape = scene::LoadShape::power_exponential;
  strip.load.peak_time = 4e-5;
  strip.load.duration = 4e-4;
  mpm::Simulation simulation(strip);
  const auto place = [&] {
    double moment = 0.0, momentum = 0.0;
    simulation.for_each_body([&](const mpm::ParticleFields& p) {
      for (std::size_t i = 0; i < p.mass.size(); ++i) {
        momentum += p.mass[i] * p.velocity_x[i];
        moment += p.mass[i] * p.velocity_x[i] * p.x[i];
      }
    });
    return moment / momentum;
  };
  run_to(simulation, 1.1e-4);
  const double from = place();
  run_to(simulation, 1.6e-4);
  return (from - place()) / 5e-5;
}

/// Axial stress (Pa) at the bottom of a column of charge, 0.56 m long, at rest under its own weight at the
/// acceleration of the shell at 496 MPa.
double setback_pressure() {
  constexpr double length = 0.56;
  scene::Scene column = block("charge", length, 0.01, 5e-3);
  const double pressure = 1717.0 * length * scene::rigid_acceleration(shell_155(), 496e6);
  column.load.duration = 1.0;
  column.load.curve_time = {0.0, 1e-3, 1.0};
  column.load.curve_pressure = {0.0, pressure, pressure};
  column.numerics.damping_time = 3e-5;
  mpm::Simulation simulation(column);
  run_to(simulation, 3e-3);
  const mpm::Body<materials::Charge>& body = simulation.bodies_of<materials::Charge>()[0];
  const mpm::Lattice& lattice = body.particles.lattice;
  const int last = lattice.columns() - 1;
  const std::size_t slot = lattice.slot(last, 0);
  return (body.particles.pressure[slot] - body.deviator(slot).xx) * length / lattice.x_of(last);
}

/// Largest imbalance of energy of the shell under a pulse of 100 MPa, over the largest energy in it.
double energy_imbalance() {
  scene::Scene shell = shell_155();
  shell.load.base = 0.0;
  shell.load.peak = 100e6;
  shell.load.shape = scene::LoadShape::power_exponential;
  shell.load.peak_time = 2e-4;
  mpm::Simulation simulation(shell);
  double largest = 0.0, scale = 0.0;
  run_to(simulation, 4e-4, [&] {
    const mpm::EnergyTotals& e = simulation.energy();
    const double stored = e.kinetic + e.internal, left = stored + e.damping - e.external - e.body_force;
    // Written so that NaN stays.
    if (!std::isnan(largest) && !(std::abs(left) <= largest)) largest = std::abs(left);
    scale = std::max(scale, stored);
  });
  return largest / scale;
}

// ---- the checks ----

/// One number that the program must reproduce.
struct Check {
  std::string group, name;  ///< "air", "temperature at 496 MPa"
  double expected = 0;
  double tolerance = 0;  ///< > 0, in `unit`: largest distance from the expected number
  std::string unit;      ///< empty for a pure number
  std::string source;    ///< where the expected number comes from
  std::function<double()> compute;
  double computed = 0;  ///< once it is

  std::string title() const { return group + ": " + name; }
  double error() const { return std::abs(computed - expected); }
  /// False for anything that is not a number.
  bool pass() const { return error() <= tolerance; }
};

/// All of them: a second or so on one core.
std::vector<Check> all_checks() {
  using namespace materials;
  // What is known to a digit has half of that digit and a hair for its tolerance.
  return {
      {"steel", "Hugoniot pressure at mu = 0.01", 1.705489, 5.01e-7, "GPa", "Eq. 19 with s - 1",
       // A shock does half the pressure times the change of volume, which is one step from rest.
       [] {
         return mie_gruneisen_compress(MieGruneisenParameters{}, 0.0, 0.0, 0.0, 0.01, 0.0).pressure / 1e9;
       }},
      {"steel", "flow stress at a strain of 1 and 1000/s", 1427.9146, 5.01e-5, "MPa",
       "Johnson-Cook: 1302 (1 + 0.014 ln 1000)",
       [] { return johnson_cook_flow_stress(JohnsonCookParameters{}, 1.0, 1000.0, 298.0) / 1e6; }},
      {"jwl", "bulk modulus of the charge at rest", 10.297, 5.01e-4, "GPa", "-V dp/dV with dE = -p dV",
       [] { return UnreactedJwl{}.bulk_modulus_at_rest() / 1e9; }},
      {"virial gas", "Z of N2 at 1500 K, 50 cm3/mol", 2.07576984, 5.01e-9, "",
       "Eq. 37 corrected, three terms",  // of 1 mol in a kg
       [] {
         return ProductGas({{nitrogen(), 1.0}}, 1780.0).at(1500.0, 50e-6).compressibility;
       }},
      {"relaxation", "modulus after 10 us in 1000 steps", 1.356785, 5.01e-7, "GPa", "sum G_n exp(-t/tau_n)",
       [] { return relaxation_modulus(1e-5, 1000) / 1e9; }},
      {"cracks", "growth speed at K = 5e5", 20.09388, 5.01e-6, "m/s",
       "growth law with K1 = K' (1 + m/2)^(1/m)",
       [] { return crack_growth_speed(ViscoScramParameters{}, 5e5, ViscoScramParameters{}.toughness); }},
      {"cracks", "toughness under friction at 141 MPa, c = 30 µm", 1.827012e6, 0.501, "Pa m^0.5",
       "K0 sqrt[1 + (pi A/K0)(1 + A/K0)]",
       [] { return frictional_toughness(ViscoScramParameters{}, 141e6, 30e-6); }},
      {"air", "temperature at 496 MPa", 3398.911, 5.01e-4, "K", "T0 ratio^(2/7) from 300 K",
       [] { return adiabatic_temperature(AirParameters{}, 496e6); }},
      {"skin", "induction from 700 K, calls every 10 us", 1.645534e-4, 1.7e-10, "s",
       "quadrature of dT/(Q Z/c exp(-27000 K/T)) to 2000 K", induction_time},
      {"conduction", "share of the face's rise 10 µm deep after 1 ms", 0.430605, 5e-4, "",
       "Carslaw & Jaeger, half space: erfc", conducted_rise},
      {"bar wave", "longitudinal speed", 5905.50, 0.6, "m/s", "sqrt((K + 4/3 G)/rho)", longitudinal_speed},
      {"setback", "axial pressure at the charge bottom", 140.843, 0.14, "MPa", "rho L a at 496 MPa",
       [] { return setback_pressure() / 1e6; }},
      {"launch", "imbalance of energy under a pulse of 100 MPa, of the largest energy", 0.0, 1e-6, "",
       "conservation of energy", energy_imbalance},
  };
}

const report::Quantities<Check> check_quantities{
    {for_people(report::Column{"check", "check", keys::text(), "What is checked."}), &Check::title},
    {for_programs(report::Column{"group", "group", keys::text(), "Part of the program."}), &Check::group},
    {for_programs(report::Column{"name", "name", keys::text(), "What is checked of it."}), &Check::name},
    {"computed", "computed", keys::significant(9), "What the program computed.", &Check::computed},
    {"expected", "expected", keys::significant(9), "What it must compute.", &Check::expected},
    {for_programs(report::quantity::unit), &Check::unit},
    {"error", "error", keys::significant(3), "Their difference.", &Check::error},
    {"tolerance", "tolerance", keys::significant(3), "The largest allowed.", &Check::tolerance},
    {for_people(report::quantity::unit), &Check::unit},
    {for_programs(report::Column{"source", "source", keys::text(), "Where the expected number comes from."}),
     &Check::source},
    {for_people(report::Column{"result", "result", keys::text(), "pass or FAIL."}),
     [](const Check& check) { return check.pass() ? "pass" : "FAIL"; }}};

ExitCode perform(const VerifyArguments& arguments, Console& console) {
  std::vector<Check> checks;
  std::set<std::string> groups;
  for (Check& check : all_checks()) {
    if (stop_requested())
      console.fail("interrupted; no check was printed, and there is nothing to keep", ExitCode::interrupted);
    groups.insert(check.group);
    if (!boost::algorithm::icontains(check.title(), arguments.filter)) continue;
    check.computed = check.compute();
    checks.push_back(std::move(check));
  }
  if (checks.empty())
    console.refuse(fmt::format("--filter: found \"{}\", which no check has in its name; groups of checks: {}",
                               arguments.filter, fmt::join(groups, ", ")));
  const auto passed = static_cast<std::size_t>(std::ranges::count(checks, true, &Check::pass));
  const report::Table table = report::table_of({}, check_quantities, checks,
                                               {fmt::format("{} of {} checks pass.", passed, checks.size())});
  console.print_text(report::to_text(table, width_of_output()));
  Json rows = report::json_rows(table);
  for (std::size_t i = 0; i < checks.size(); ++i) rows[i]["pass"] = checks[i].pass();
  console.print_json({{"checks", rows}, {"passed", passed}, {"failed", checks.size() - passed}});
  return passed == checks.size() ? ExitCode::done : ExitCode::cases_failed;
}

}  // namespace

void add_verify(CLI::App& app, CommandLine& line) {
  auto [command, verify] = add_command<VerifyArguments>(app, line, "verify");
  add(command, "--filter", verify.filter);
}

}  // namespace launchsafe::app
