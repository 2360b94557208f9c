// Which physics a scene needs, and what of the scene its mechanics depends on.
#include "launchsafe/scene/plan.hpp"

#include "launchsafe/scene/read_scene.hpp"

namespace launchsafe::scene {
namespace {

/// Numbers of 8 bytes that the mechanics holds for a particle beside the state of its law, with what pads
/// rows: place, velocity, mass, density, pressure, temperature, stiffness against hourglassing. And bytes for
/// a cell, about.
constexpr double numbers_per_particle = 12.0;
constexpr double bytes_per_number = 8.0;
/// The matrix of conduction, for a particle, measured: it is held twice while it is made.
constexpr double bytes_of_conduction = 340.0;
constexpr double bytes_per_cell = 128.0;

/// Setback is exceeded where waves run to and fro in the charge; the bound allows for as much again.
constexpr double pressure_margin = 2.0;

/// What the user forced, or what the plan decides.
Term switched(const char* title, const char* member, Switch user, bool needed, const std::string& reason) {
  if (user == Switch::automatic) return {title, member, needed, false, reason};
  const bool in = user == Switch::on;
  return {title, member, in, true, (in ? "forced on; " : "forced off; ") + reason};
}

/// Verdicts rest on the charge's temperature; heat in the rest only softens it a little.
Material material_to_conduct(const Scene& scene) {
  std::vector<Material> used = used_materials(scene);
  if (has_charge(scene)) std::erase_if(used, [](const Material& each) { return !is_explosive(each.law); });
  return *std::ranges::max_element(used, [&](const Material& a, const Material& b) {
    return diffusion_length(a.law, end_time(scene.load)) < diffusion_length(b.law, end_time(scene.load));
  });
}

Term plan_conduction(const Scene& scene, const CellRange& cells) {
  constexpr double bound = 0.05;  // diffusion length over cell size
  const Material material = material_to_conduct(scene);
  const double length = diffusion_length(material.law, end_time(scene.load));
  const double share = length / cells.shortest();
  return switched(
      "heat conduction", "conduction", scene.physics.conduction, share > bound,
      fmt::format("heat diffuses {} in the {} over the run, {:.3g} of a cell of {}; left out up to {:.3g}",
                  length_text(length), material.name, share, length_text(cells.shortest()), bound));
}

Term plan_bulk_reaction(const Scene& scene) {
  constexpr double bound = 0.1;  // K of self-heating over the run
  if (!has_charge(scene)) return {"bulk reaction", "bulk_reaction", false, false, "no charge"};
  const double temperature = bulk_temperature_bound(scene);
  const double heating =
      materials::arrhenius_heating(scene.charge().kinetics, scene.charge().specific_heat, temperature) *
      end_time(scene.load);
  return switched(
      "bulk reaction", "bulk_reaction", scene.physics.bulk_reaction, heating > bound,
      fmt::format("the bulk of the charge stays below {:.4g} K, where the reaction heats it by {:.2g} K "
                  "over the run; left out up to {:.3g} K",
                  temperature, heating, bound));
}

/// What a charge alone has.
std::vector<Term> terms_of_charge(const Scene& scene) {
  const Surface& surface = scene.surface;
  const auto& strength = scene.charge().strength;
  const double largest = surface.gaps.empty() ? 0.0 : std::ranges::max(surface.gaps);
  const double friction = scene.charge().sliding_friction;
  const bool heats = surface.friction != FrictionClosure::none && friction * surface.localisation > 0.0;
  const bool cracks = strength.flaw_size > 0.0 && strength.initial_crack_radius > 0.0;
  const bool growth = cracks && strength.growth;
  std::vector<Term> terms{
      {"skin of the bottom", "surface", true, false,
       fmt::format("{} gaps on one bottom trace", surface.gaps.size())},
      {"air in the gap", "air", largest > 0.0, false, "gaps up to " + length_text(largest)},
      {"friction heat", "friction_heat", heats, false,
       fmt::format("closure \"{}\", localisation {:.6g}, sliding friction {:.3g}", word_of(surface.friction),
                   surface.localisation, friction)},
      {"cracks", "cracks", cracks, false,
       fmt::format("crack radius {} at flaw size {}", length_text(strength.initial_crack_radius),
                   length_text(strength.flaw_size))},
      {"crack growth", "crack_growth", growth, false,
       fmt::format("charge.crack_growth {}, up to {:.4g} m/s", strength.growth,
                   strength.largest_growth_speed)},
      {"crack friction", "crack_friction", growth && strength.face_friction > 0.0, false,
       fmt::format("coefficient {:.3g} of closed crack faces that grow", strength.face_friction)}};
  if (!has_charge(scene))
    for (Term& term : terms) term = {term.title, term.member, false, false, "no charge"};
  return terms;
}

Term plan_inertial_scaling(const Scene& scene) {
  const double scaling = scene.numerics.inertial_scaling, selective = scene.numerics.selective_inertia;
  return {
      "inertial scaling", "inertial_scaling", scaling * selective * selective > 1.0, false,
      fmt::format("inertia times {:.4g}; steps {:.3g} times longer, with up to {:.4g} times the inertia in "
                  "cells that need it",
                  scaling, std::sqrt(scaling) * selective, selective * selective)};
}

/// Work of the run of a gap from the start, with its skin, over that of the launch.
double coupled_share(const Scene& scene) {
  // Measured on the 155 mm shell: each step that follows an ignition checks its stability.
  constexpr double cost_of_burning = 2.5;
  return 1.0 + cost_of_burning * scene.combustion.duration / end_time(scene.load);
}

Term plan_coupling(const Scene& scene) {
  const Combustion& combustion = scene.combustion;
  const bool couples = has_charge(scene) && scene.coupling == Coupling::two_way;
  return {"coupling", "coupling", couples, false,
          !couples ? "one-way: runs end with the launch, and what ignites does not burn"
                   : fmt::format("two-way: every gap that ignites is computed once more, and on through "
                                 "combustion for {} or to {} at the bottom",
                                 time_text(combustion.duration), pressure_text(combustion.stop_pressure))};
}

Term plan_snapshots(const Scene& scene) {
  const Output& output = scene.output;
  return {"snapshots", "snapshots", output.asks_for_snapshots(), false,
          fmt::format("{} times, {} events", output.snapshot_times.size(), output.snapshot_events.size())};
}

/// At rest: CFL times the shortest time in which sound crosses a cell, with the inertial factors.
double time_step_at_rest(const Scene& scene, const CellRange& mesh) {
  const Numerics& numerics = scene.numerics;
  if (numerics.formulation == Formulation::updated_lagrangian)
    return numerics.time_step_factor * mesh.shortest() / longitudinal_speed(scene) *
           std::sqrt(numerics.inertial_scaling);
  double shortest = std::numeric_limits<double>::infinity();
  for (const Body& body : scene.bodies)
    shortest = std::min(shortest, cells_of(scene, body).shortest() / longitudinal_speed(law_of(scene, body)));
  return numerics.time_step_factor * numerics.selective_inertia * std::sqrt(numerics.inertial_scaling) *
         shortest;
}

void count_work(const Scene& scene, const CellRange& mesh, Plan& plan) {
  for (const Material& material : used_materials(scene)) {
    MaterialParticles& count = plan.by_material.emplace_back(MaterialParticles{material.name});
    for (const Body& body : scene.bodies)
      if (body.material == material.name) count.particles += particles_of(scene, body).total();
    const double bytes =
        bytes_per_number * (numbers_per_particle + static_cast<double>(state_size(material.law))) +
        (plan.conducts ? bytes_of_conduction : 0.0);
    plan.memory += bytes * static_cast<double>(count.particles);
  }
  plan.cells = static_cast<std::int64_t>(mesh.nx) * mesh.nr;
  plan.time_step = time_step_at_rest(scene, mesh);
  const double steps = std::ceil(end_time(scene.load) / plan.time_step - 1e-9);
  plan.steps = counted(steps);
  plan.work = steps * static_cast<double>(plan.particles());
  if (plan.couples) plan.coupled_work = coupled_share(scene) * plan.work;
  plan.memory += bytes_per_cell * static_cast<double>(plan.cells);
}

/// Which inputs reach the mechanics of a launch.
struct Felt {
  bool conducts = false, reacts = false, stores_temperatures = false;

  bool contains(ActsOn acts_on) const {
    if (acts_on == ActsOn::heat) return conducts || reacts || stores_temperatures;
    if (acts_on == ActsOn::conduction) return conducts;
    if (acts_on == ActsOn::chemistry) return reacts;
    return keys::reaches_mechanics(acts_on);
  }

  /// Sets all others, and what does nothing anyway, to their defaults, where they have one.
  template <class Owner>
  void keep_alone(const std::vector<Key<Owner>>& keys, Owner& owner) const {
    for (const Key<Owner>& key : keys)
      if (!(key.is_used(owner) && contains(key.acts_on)) && key.standing != Standing::input &&
          key.get(owner) != key.default_value())
        key.set(owner, key.default_value());
  }
};

/// What no body is made of stands at its default.
void settle_materials(Scene& part, const Felt& felt) {
  for (Material& material : part.materials) {
    const bool used = is_used(part, material.name);
    std::visit(
        [&]<class Law>(Law& law) {
          static const std::vector<Key<Law>> keys = Law::parameters();
          if (!used) law = Law{};
          felt.keep_alone(keys, law);
        },
        material.law);
  }
}

}  // namespace

std::int64_t Plan::particles() const {
  std::int64_t total = 0;
  for (const MaterialParticles& each : by_material) total += each.particles;
  return total;
}

double longitudinal_speed(const materials::Law& law) {
  return std::sqrt((bulk_modulus(law) + 4.0 / 3.0 * shear_modulus(law)) / initial_density(law));
}

double longitudinal_speed(const Scene& scene) {
  double largest = 0.0;
  for (const Material& each : used_materials(scene))
    largest = std::max(largest, longitudinal_speed(each.law));
  return largest;
}

double diffusion_length(const materials::Law& law, double time) {
  return std::sqrt(heat_conductivity(law) * time / (initial_density(law) * heat_capacity(law)));
}

double setback_pressure(const Scene& scene) {
  const Extent charge = charge_extent(scene);
  const double acceleration = rigid_acceleration(scene, PressureHistory(scene.load).peak());
  return scene.charge().density * (charge.x_end - charge.x_begin) * acceleration;
}

double bulk_temperature_bound(const Scene& scene) {
  const Charge& charge = scene.charge();
  const double pressure = pressure_margin * setback_pressure(scene);
  const double bulk = charge.bulk_modulus();
  const auto& rates = charge.strength.relaxation_rates;
  const auto slowest = static_cast<std::size_t>(std::ranges::min_element(rates) - rates.begin());
  const double work =
      (1.0 + charge.sliding_friction) * pressure * pressure / charge.strength.shear_moduli[slowest];
  const double compressed = scene.initial_temperature * std::exp(charge.eos.omega * pressure / bulk);
  return compressed + work / (charge.density * charge.specific_heat);
}

Plan make_plan(const Scene& scene) {
  const CellRange mesh = cells_of(scene);
  Plan plan;
  plan.terms = terms_of_charge(scene);
  for (const Term& term : {plan_conduction(scene, mesh), plan_bulk_reaction(scene),
                           plan_inertial_scaling(scene), plan_coupling(scene), plan_snapshots(scene)})
    plan.terms.push_back(term);
  const auto is_in = [&](std::string_view member) {
    return std::ranges::find(plan.terms, member, &Term::member)->in;
  };
  plan.conducts = is_in("conduction");
  plan.reacts = is_in("bulk_reaction");
  plan.couples = is_in("coupling");
  count_work(scene, mesh, plan);
  return plan;
}

LargestChanges largest_changes(const Load& load, double window) {
  constexpr std::size_t parts = 8;  // of the window
  const PressureHistory history(load);
  const double end = end_time(load);
  LargestChanges changes;
  const auto compare = [&changes](double before, double here, double after) {
    changes.rise = std::max({changes.rise, here - before, after - here});
    changes.fall = std::max({changes.fall, before - here, here - after});
  };
  std::vector<double> times = history.marks();
  times.push_back(history.peak_time());
  for (const double time : times)
    compare(time > window ? history.at(time - window) : 0.0, history.at(time),
            history.at(std::min(end, time + window)));
  // A sample is before, here and after; a window too short for so many is taken as longer.
  const double between = std::max(window / parts, end * 1e-6);
  std::vector<double> samples;
  for (double time = 0.0; time < end; time += between) samples.push_back(history.at(time));
  for (std::size_t i = 0; i < samples.size(); ++i)
    compare(i > parts ? samples[i - parts] : 0.0, samples[i],
            i + parts < samples.size() ? samples[i + parts] : history.at(end));
  return changes;
}

double transit_time(const Scene& scene) {
  const Extent charge = charge_extent(scene);
  return std::max(charge.x_end - charge.x_begin, charge.r_end) /
         longitudinal_speed(materials::Law(scene.charge()));
}

/// A load that rises faster shakes a shell whose inertia is selective. On the 155 mm shell with steps four
/// times as long T max changes by 1.1 K or less with pulses of a half, a quarter and an eighth of the
/// published width (from 10 to 90 % of the peak in 0.6 ms), and with a thirtieth it ignites or does not.
bool changes_too_fast_for_selective_inertia(const Scene& scene) {
  constexpr double shortest = 0.5e-3, transits = 2.5, share = 0.8;
  const double window = std::max(shortest, transits * transit_time(scene));
  const LargestChanges changes = largest_changes(scene.load, window);
  return std::max(changes.rise, changes.fall) > share * PressureHistory(scene.load).peak();
}

double usual_selective_inertia(const Scene& scene) {
  constexpr double measured = 4.0;
  const Numerics& numerics = scene.numerics;
  const bool is_possible = numerics.formulation == Formulation::total_lagrangian;
  const bool was_measured = has_charge(scene) && scene.coupling == Coupling::one_way &&
                            scene.load.curve_time.empty() && !(numerics.inertial_scaling > 1.0) &&
                            !changes_too_fast_for_selective_inertia(scene);
  return is_possible && was_measured ? measured : 1.0;
}

Scene mechanical_part(const Scene& scene) {
  const bool conducts = plan_conduction(scene, cells_of(scene)).in, reacts = plan_bulk_reaction(scene).in;
  Scene part = scene;
  // Of a gap, and of what follows its ignition, the mechanics knows nothing.
  std::erase_if(part.output.snapshot_times, [&](double time) {
    return scene.coupling == Coupling::two_way && time > end_time(scene.load) * (1.0 + 1e-12);
  });
  std::erase(part.output.snapshot_events, Event::ignition);
  clear_remarks(part);
  part.interfaces = sliding_interfaces(scene);
  const Felt felt{conducts, reacts, part.output.asks_for_snapshots()};
  felt.keep_alone(scene_keys(), part);
  settle_materials(part, felt);
  // The plan's decisions instead of what they rest on.
  part.physics = {.conduction = conducts ? Switch::on : Switch::off,
                  .bulk_reaction = reacts ? Switch::on : Switch::off};
  std::ranges::sort(part.output.snapshot_times);
  return part;
}

}  // namespace launchsafe::scene
