#include "launchsafe/mpm/body_step.hpp"

namespace launchsafe::mpm {
namespace {

using math::Deviator;

/// Strain increment of a step, split as the material laws want it.
struct Increment {
  Pack volumetric;  ///< trace of the strain increment
  Deviator<Pack> deviator;
  math::Rotation<Pack> rotation;
};

Increment increment_of(const Gathered& g, double dt) {
  const Pack volumetric = (g.rate_rr + g.rate_xx + g.rate_tt) * dt;
  const Pack third = volumetric * (1.0 / 3.0);
  return {volumetric,
          {g.rate_rr * dt - third, g.rate_xx * dt - third, (g.vr_by_x + g.vx_by_r) * (0.5 * dt)},
          math::rotation_of((g.vr_by_x - g.vx_by_r) * (0.5 * dt))};
}

/// Density after a volumetric strain increment: rho exp(-tr) to second order.
Pack compressed(Pack density, Pack volumetric) {
  return density * (1.0 - 0.5 * volumetric) / (1.0 + 0.5 * volumetric);
}

/// Cauchy stress of a Pack and the stress power of the step (J per m3).
struct Stressed {
  Deviator<Pack> deviator;
  Pack pressure;
  Pack density;
  Pack work;
};

Pack load(const math::AlignedArray& field, std::size_t slot) { return Pack::load(field.data() + slot); }
void store(math::AlignedArray& field, std::size_t slot, Pack value) { value.store(field.data() + slot); }

Stressed update_material(SteelBody& body, const scene::Steel& steel, std::size_t slot,
                         const Increment& increment, double dt, Pack volume, StepTotals& totals) {
  const auto& strength = steel.strength;
  Kinematics& p = body.kinematics;
  const Deviator<Pack> old = math::rotate(
      Deviator<Pack>{load(body.stress_rr, slot), load(body.stress_xx, slot), load(body.stress_rx, slot)},
      increment.rotation);
  Deviator<Pack> stress = old + Pack(2.0 * strength.shear_modulus) * increment.deviator;
  Pack heat(0.0);  // J/kg
  const Pack density0 = load(p.density, slot);
  const Pack density1 = compressed(density0, increment.volumetric);
  if (any(math::von_mises(stress) > load(body.flow_stress, slot))) {
    const Pack strain = load(body.plastic_strain, slot), temperature = load(p.temperature, slot);
    const auto result = materials::johnson_cook_return(strength, stress, strain, temperature, Pack(dt));
    stress = result.stress;
    heat = Pack(strength.taylor_quinney) * result.plastic_work / density1;
    const Pack new_strain = strain + result.plastic_strain_increment;
    const Pack new_temperature = temperature + heat * (1.0 / strength.specific_heat);
    totals.plastic += volume * result.plastic_work;
    store(body.plastic_strain, slot, new_strain);
    store(p.temperature, slot, new_temperature);
    store(body.flow_stress, slot,
          materials::johnson_cook_flow_stress(strength, new_strain, Pack(0.0), new_temperature));
  }
  const double reference = steel.eos.density;
  const Pack pressure0 = load(p.pressure, slot);
  const Pack mu0 = density0 * (1.0 / reference) - 1.0, mu1 = density1 * (1.0 / reference) - 1.0;
  const auto state =
      materials::mie_gruneisen_compress(steel.eos, mu0, pressure0, load(body.energy, slot), mu1, heat);
  totals.hugoniot_guard += select(materials::mie_gruneisen_is_valid(steel.eos, mu1), Pack(0.0), Pack(1.0));
  store(body.energy, slot, state.energy);
  store(body.stress_rr, slot, stress.rr);
  store(body.stress_xx, slot, stress.xx);
  store(body.stress_rx, slot, stress.rx);
  const Pack work = contract(Pack(0.5) * (old + stress), increment.deviator) -
                    0.5 * (pressure0 + state.pressure) * increment.volumetric;
  return {stress, state.pressure, density1, work};
}

/// The charge's law with what it needs beside the scene's parameters.
struct ChargeLaw {
  const scene::Charge& charge;
  const materials::Relaxation<double>& relaxation;
};

/// Friction heat of the step by closure, J per m3 of initial volume (paper Eq. 39, localisation 1).
void add_friction(ChargeBody& body, const scene::Charge& charge, std::size_t slot, Pack pressure,
                  Pack density, Pack total_strain, Pack inelastic_strain) {
  const Pack sliding =
      charge.sliding_friction * max(pressure, Pack(0.0)) * charge.eos.initial_density / density;
  store(body.friction[0], slot, load(body.friction[0], slot) + sliding * total_strain);
  store(body.friction[1], slot, load(body.friction[1], slot) + sliding * inelastic_strain);
}

Stressed update_material(ChargeBody& body, const ChargeLaw& law, std::size_t slot, const Increment& increment,
                         double, Pack volume, StepTotals& totals) {
  const scene::Charge& charge = law.charge;
  Kinematics& p = body.kinematics;
  const double reference = charge.eos.initial_density;
  const Pack density0 = load(p.density, slot);
  const Pack density1 = compressed(density0, increment.volumetric);
  const Pack pressure0 = load(p.pressure, slot);
  const auto eos = materials::jwl_compress(charge.eos, reference / density0, pressure0,
                                           load(body.energy, slot), reference / density1);
  const Pack cutoff(-charge.tension_cutoff);
  const Pack pressure = max(eos.pressure, cutoff);
  totals.tension_cutoff += select(eos.pressure < cutoff, Pack(1.0), Pack(0.0));
  store(body.energy, slot, eos.energy);

  materials::ViscoScramState<Pack> state;
  for (std::size_t n = 0; n < materials::maxwell_elements; ++n) {
    const auto& element = body.elements[n];
    state.elements[n] =
        math::rotate(Deviator<Pack>{load(element[0], slot), load(element[1], slot), load(element[2], slot)},
                     increment.rotation);
  }
  state.crack_radius = load(body.crack_radius, slot);
  const Deviator<Pack> old = total_deviator(state);
  const auto loss = visco_scram_update(charge.cracks, law.relaxation, state, increment.deviator, pressure);
  for (std::size_t n = 0; n < materials::maxwell_elements; ++n) {
    store(body.elements[n][0], slot, state.elements[n].rr);
    store(body.elements[n][1], slot, state.elements[n].xx);
    store(body.elements[n][2], slot, state.elements[n].rx);
  }
  store(body.crack_radius, slot, state.crack_radius);
  totals.crack_at_bound +=
      select(state.crack_radius >= Pack(charge.cracks.largest_crack_radius), Pack(1.0), Pack(0.0));
  totals.viscous += volume * loss.viscous;
  totals.crack += volume * loss.crack;
  add_friction(body, charge, slot, pressure, density1, math::equivalent_strain(increment.deviator),
               loss.inelastic_strain);
  const Deviator<Pack> stress = total_deviator(state);
  const Pack work = contract(Pack(0.5) * (old + stress), increment.deviator) -
                    0.5 * (pressure0 + pressure) * increment.volumetric;
  return {stress, pressure, density1, work};
}

/// FLIP velocity update with an optional share of PIC. Adds the kinetic energy that the share takes out, and
/// the time-centred kinetic energy of the step's begin.
void update_velocity(Kinematics& p, const Gathered& g, std::size_t slot, Pack mass, double pic_fraction,
                     StepTotals& totals) {
  const Pack old_vx = load(p.velocity_x, slot), old_vr = load(p.velocity_r, slot);
  const Pack vx = old_vx + g.change_x, vr = old_vr + g.change_r;
  const Pack new_vx = vx + pic_fraction * (g.velocity_x - vx),
             new_vr = vr + pic_fraction * (g.velocity_r - vr);
  store(p.velocity_x, slot, new_vx);
  store(p.velocity_r, slot, new_vr);
  const Pack half_mass = 0.5 * mass;
  totals.pic_loss += half_mass * (vx * vx + vr * vr - new_vx * new_vx - new_vr * new_vr);
  totals.centred_kinetic += half_mass * (old_vx * vx + old_vr * vr);
}

/// Everything but the rare sub-steps is inlined: a call would pass its Packs through memory.
template <class Body, class Law>
[[gnu::flatten]] void advance_body(Body& body, const Law& law, Grid& grid, const StepContext& context,
                                   StepTotals& totals) {
  Kinematics& p = body.kinematics;
  const StencilContext reading{grid, context.read_origin, p.half_x, p.half_r, context.axisymmetric};
  const StencilContext writing{grid, context.write_origin, p.half_x, p.half_r, context.axisymmetric};
  for (std::size_t slot = 0; slot < p.x.size(); slot += math::pack_width) {
    const Pack mass = load(p.mass, slot);
    const Mask real = mass > Pack(0.0);
    const Pack x0 = load(p.x, slot), r0 = load(p.r, slot);
    const Stencil old_stencil = stencil_of(reading, x0, r0);
    const Gathered g = gather(grid, old_stencil, real & old_stencil.inside);
    update_velocity(p, g, slot, mass, context.pic_fraction, totals);
    const Pack x1 = x0 + context.dt * g.velocity_x, r1 = r0 + context.dt * g.velocity_r;
    store(p.x, slot, x1);
    store(p.r, slot, r1);

    const Pack old_volume = mass / load(p.density, slot);
    const Increment increment = increment_of(g, context.dt);
    const Stressed s = update_material(body, law, slot, increment, context.dt, old_volume, totals);
    store(p.density, slot, s.density);
    store(p.pressure, slot, s.pressure);
    const Pack volume = mass / s.density;
    totals.internal += 0.5 * (old_volume + volume) * s.work;

    const Stencil stencil = stencil_of(writing, x1, r1);
    totals.off_grid += select(real & !stencil.inside, Pack(1.0), Pack(0.0));
    const Scattered given{mass,
                          load(p.velocity_x, slot),
                          load(p.velocity_r, slot),
                          volume,
                          s.deviator.rr - s.pressure,
                          s.deviator.xx - s.pressure,
                          s.deviator.tt() - s.pressure,
                          s.deviator.rx};
    scatter(grid, stencil, given, real & stencil.inside);
  }
}

template <class Modulus>
Speeds largest_speeds(const Kinematics& p, double shear_modulus, Modulus&& bulk_modulus) {
  Pack sound(0.0), particle(0.0);
  for (std::size_t slot = 0; slot < p.x.size(); slot += math::pack_width) {
    const Pack density = load(p.density, slot);
    const Pack modulus = bulk_modulus(slot, density) + (4.0 / 3.0) * shear_modulus;
    sound = max(modulus / density, sound);
    particle = max(math::abs(load(p.velocity_x, slot)) + math::abs(load(p.velocity_r, slot)), particle);
  }
  return {math::largest(sound), math::largest(particle)};
}

}  // namespace

void advance(SteelBody& body, const scene::Steel& steel, Grid& grid, const StepContext& context,
             StepTotals& totals) {
  advance_body(body, steel, grid, context, totals);
}

void advance(ChargeBody& body, const scene::Charge& charge, Grid& grid, const StepContext& context,
             StepTotals& totals) {
  advance_body(body, ChargeLaw{charge, context.relaxation}, grid, context, totals);
}

void scatter_initial(const Kinematics& p, Grid& grid, const StepContext& context) {
  const StencilContext writing{grid, context.write_origin, p.half_x, p.half_r, context.axisymmetric};
  for (std::size_t slot = 0; slot < p.x.size(); slot += math::pack_width) {
    const Pack mass = load(p.mass, slot);
    const Stencil stencil = stencil_of(writing, load(p.x, slot), load(p.r, slot));
    const Pack none(0.0);
    const Scattered given{mass, load(p.velocity_x, slot), load(p.velocity_r, slot), none, none, none, none,
                          none};
    scatter(grid, stencil, given, (mass > none) & stencil.inside);
  }
}

Speeds speeds_of(const SteelBody& body, const scene::Steel& steel) {
  const Kinematics& p = body.kinematics;
  return largest_speeds(p, steel.strength.shear_modulus, [&](std::size_t slot, Pack density) {
    return materials::mie_gruneisen_bulk_modulus(steel.eos, density * (1.0 / steel.eos.density) - 1.0,
                                                 load(p.pressure, slot));
  });
}

Speeds speeds_of(const ChargeBody& body, const scene::Charge& charge) {
  const Kinematics& p = body.kinematics;
  return largest_speeds(p, charge.cracks.shear_modulus(), [&](std::size_t slot, Pack density) {
    return materials::jwl_bulk_modulus(charge.eos, charge.eos.initial_density / density,
                                       load(body.energy, slot));
  });
}

}  // namespace launchsafe::mpm
