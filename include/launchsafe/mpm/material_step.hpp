// Update of a Pack of particles from its deformation increment, common to both formulations: constitutive
// law, energies, velocity.
#pragma once

#include "launchsafe/mpm/body.hpp"
#include "launchsafe/mpm/step.hpp"

namespace launchsafe::mpm {

inline Pack load(const math::AlignedArray& field, std::size_t slot) {
  return Pack::load(field.data() + slot);
}
inline void store(math::AlignedArray& field, std::size_t slot, Pack value) {
  value.store(field.data() + slot);
}

/// Deformation increment of a step at a Pack of particles.
struct Deformation {
  materials::Increment<Pack> increment;
  Pack rest_volume;  ///< m3 per radian
};

/// Cauchy stress at the end of a step, Pa: deviator tension positive, pressure compression positive.
struct StressUpdate {
  math::Deviator<Pack> deviator;
  Pack pressure;
};

/// Stores the strain increment of a step at a Pack of particles.
inline void store_increment(ParticleFields& p, std::size_t slot, const math::Deviator<Pack>& strain) {
  store(p.strain_change[0], slot, strain.rr);
  store(p.strain_change[1], slot, strain.xx);
  store(p.strain_change[2], slot, strain.rx);
}

/// Stores what a law made of a step at a Pack of particles, and adds the energies and limiter events of the
/// step to `totals`. `d` is that of the particles, `strain` the deviatoric increment of what friction heats.
template <class Law>
[[gnu::always_inline]] inline StressUpdate keep_response(Body<Law>& body, std::size_t slot,
                                                         const Deformation& d,
                                                         const materials::State<Law, Pack>& state,
                                                         const materials::Response<Pack>& response,
                                                         const math::Deviator<Pack>& strain, Pack temperature,
                                                         ParticleTotals& totals) {
  ParticleFields& p = body.particles;
  const Pack pressure_before = load(p.pressure, slot);
  materials::store_state<Law>(state,
                              [&](std::size_t field, Pack value) { store(body.state[field], slot, value); });
  store(p.pressure, slot, response.pressure);
  store(p.volume_ratio, slot, d.increment.volume_after);
  if constexpr (Law::heats_itself) store(p.temperature, slot, temperature);
  if (!p.recorded.empty() && p.recorded[slot / math::pack_width] != 0) store_increment(p, slot, strain);

  const Pack volume0 = d.increment.volume_before, volume1 = d.increment.volume_after;
  const Pack work = contract(response.deviator_before + response.deviator, d.increment.deviator);
  const Pack internal = d.rest_volume * (0.25 * (volume0 + volume1) * work -
                                         0.5 * (pressure_before + response.pressure) * (volume1 - volume0));
  totals.internal += internal;
  if constexpr (Law::is_explosive) {
    totals.charge_work += internal;
    // materials::sliding_heat of the total strain, Pack by Pack.
    totals.charge_friction += d.rest_volume * volume1 * body.law.sliding_friction *
                              (math::max(response.pressure, Pack(0.0)) * math::equivalent_strain(strain));
  }
  const Pack volume_before = d.rest_volume * volume0;
  totals.plastic += volume_before * response.plastic;
  totals.viscous += volume_before * response.viscous;
  totals.crack += volume_before * response.crack;
  totals.tension_cutoff += response.tension_cutoff;
  totals.pressure_guard += response.pressure_guard;
  totals.crack_at_bound += response.crack_at_bound;
  return {response.deviator, response.pressure};
}

/// `update_material` of a Pack of particles some of which burn: the law sees the explosive that is left,
/// whose stress counts with its part of the volume. The skin is parallel to the charge's bottom, so that the
/// gas is a layer across x: the strain of the explosive is that of the particle less what the layer grows
/// along x. Arguments by value, so that the step of others need not keep them in memory.
template <class Law>
[[gnu::noinline, gnu::cold]] StressUpdate update_burning(Body<Law>& body, std::size_t slot, Deformation d,
                                                         ParticleTotals& totals) {
  ParticleFields& p = body.particles;
  materials::Increment<Pack> increment = d.increment;
  const SolidParts solid = advance_burning(*p.burning, slot, increment.volume_before, increment.volume_after);
  const auto growth = [](Pack before, Pack after) { return 2.0 * (after - before) / (after + before); };
  const Pack layer = growth(increment.volume_before, increment.volume_after) -
                     growth(solid.volume_before, solid.volume_after);
  increment.deviator.rr += (1.0 / 3.0) * layer;
  increment.deviator.xx -= (2.0 / 3.0) * layer;
  increment.volume_before = solid.volume_before;
  increment.volume_after = solid.volume_after;
  auto state = materials::load_state<Law>([&](std::size_t field) { return load(body.state[field], slot); });
  Pack temperature = load(p.temperature, slot);
  auto response = body.integrator.update(increment, state, load(p.pressure, slot), temperature);
  response.pressure = select(solid.burns, solid.pressure, response.pressure);
  response.deviator_before = solid.share_before * response.deviator_before;
  response.deviator = solid.share_after * response.deviator;
  for (Pack* energy : {&response.plastic, &response.viscous, &response.crack}) *energy *= solid.share_before;
  return keep_response(body, slot, d, state, response, increment.deviator, temperature, totals);
}

/// Advances the constitutive law of a Pack of particles, stores their state and adds the energies and limiter
/// events of the step to `totals`. `burns`: some particles of the body may burn; the mere question costs
/// those that cannot a tenth of their time, as the call behind it takes the registers of the loop around it.
template <bool burns, class Law>
[[gnu::always_inline]] inline StressUpdate update_material(Body<Law>& body, std::size_t slot,
                                                           const Deformation& d, ParticleTotals& totals) {
  ParticleFields& p = body.particles;
  if constexpr (burns)
    if (p.burning->any_in_pack(slot)) return update_burning(body, slot, Deformation(d), totals);
  auto state = materials::load_state<Law>([&](std::size_t field) { return load(body.state[field], slot); });
  Pack temperature = load(p.temperature, slot);
  const auto response = body.integrator.update(d.increment, state, load(p.pressure, slot), temperature);
  return keep_response(body, slot, d, state, response, d.increment.deviator, temperature, totals);
}

/// FLIP velocity update with an optional share of PIC. Adds the kinetic energy that the PIC share dissipates
/// and the time-centred kinetic energy at the step's begin to `totals` (J). The inertia is the mass in that
/// balance, kg.
[[gnu::always_inline]] inline void update_velocity(ParticleFields& p, std::size_t slot, Pack inertia_x,
                                                   Pack inertia_r, Pack velocity_increment_x,
                                                   Pack velocity_increment_r, Pack grid_x, Pack grid_r,
                                                   double pic_fraction, ParticleTotals& totals) {
  const Pack old_x = load(p.velocity_x, slot), old_r = load(p.velocity_r, slot);
  const Pack flip_x = old_x + velocity_increment_x, flip_r = old_r + velocity_increment_r;
  const Pack new_x = flip_x + pic_fraction * (grid_x - flip_x),
             new_r = flip_r + pic_fraction * (grid_r - flip_r);
  store(p.velocity_x, slot, new_x);
  store(p.velocity_r, slot, new_r);
  const Pack half_x = 0.5 * inertia_x, half_r = 0.5 * inertia_r;
  totals.pic_loss += half_x * (flip_x * flip_x - new_x * new_x) + half_r * (flip_r * flip_r - new_r * new_r);
  totals.centred_kinetic += half_x * (old_x * flip_x) + half_r * (old_r * flip_r);
}

/// Bulk moduli (Pa) of a Pack of particles, with those of the particles that burn in place of the law's.
[[gnu::noinline, gnu::cold]] inline Pack with_burning(const Burning& burning, std::size_t slot,
                                                      Pack modulus) {
  for (std::size_t lane = 0; lane < math::pack_width; ++lane)
    if (const BurningParticle* particle = burning.find(slot + lane))
      modulus.set(lane, particle->state.bulk_modulus);
  return modulus;
}

/// Largest squared longitudinal sound speed (m2/s2) of a Pack of particles.
template <class Law>
Pack sound_speed_squared(const Body<Law>& body, std::size_t slot) {
  const ParticleFields& p = body.particles;
  auto state = materials::load_state<Law>([&](std::size_t field) { return load(body.state[field], slot); });
  const Pack volume = load(p.volume_ratio, slot);
  Pack bulk_modulus = body.integrator.bulk_modulus(state, volume, load(p.pressure, slot));
  if constexpr (Law::is_explosive)
    if (p.burning && p.burning->any_in_pack(slot)) [[unlikely]]
      bulk_modulus = with_burning(*p.burning, slot, bulk_modulus);
  const Pack modulus = bulk_modulus + (4.0 / 3.0) * body.law.shear_modulus();
  return modulus * volume * (1.0 / body.law.initial_density());
}

}  // namespace launchsafe::mpm
