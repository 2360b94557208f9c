#include "launchsafe/mpm/simulation.hpp"

namespace launchsafe::mpm {
namespace {

/// Calls f(form) for the form that is at work.
template <class Form, class F>
auto with(Form& form, F&& f) {
  if (auto* total = std::get_if<TotalLagrangian>(&form)) return f(*total);
  return f(std::get<UpdatedLagrangian>(form));
}

}  // namespace

Simulation::Simulation(scene::Scene scene)
    : scene_(std::move(scene)), load_(scene_.load), pressure_(load_.at(0.0)) {
  for (std::size_t i = 0; i < scene_.bodies.size(); ++i)
    bodies_.push_back(make_body(scene_, static_cast<int>(i)));
  for_each_body([&](const ParticleFields& p) {
    for (const double mass : p.mass) {
      total_mass_ += mass;
      particles_ += mass > 0.0 ? 1 : 0;
    }
  });
  for (const scene::ChamberFace& face : scene::chamber_of(scene_).faces) {
    if (!face.across_x()) continue;
    const Lattice& lattice = particle_fields_of(bodies_[face.body]).lattice;
    for (int j = 0; j < lattice.rows(); ++j) {
      const double r = lattice.r_of(j), area = r * lattice.length_r(j);
      if (r > face.begin && r < face.end) loaded_area_ -= face.direction() * area;
    }
  }
  if (scene_.numerics.formulation == scene::Formulation::total_lagrangian)
    form_.emplace<TotalLagrangian>(scene_, bodies_);
  else
    form_.emplace<UpdatedLagrangian>(scene_, bodies_);
}

void Simulation::reset_grid() {
  with(form_, [](auto& form) { form.reset_grid(); });
}

void Simulation::burn(int body, std::size_t slot, double share, double fresh_energy) {
  auto& charge = std::get<Body<materials::Charge>>(bodies_[static_cast<std::size_t>(body)]);
  ParticleFields& p = charge.particles;
  if (!p.burning) {
    const materials::ProductGas gas(materials::composition_b_gas(), charge.law.specific_heat);
    p.burning.emplace(
        materials::BurningMixture(charge.law.eos, charge.law.density, gas, charge.law.tension_cutoff),
        p.mass.size());
  }
  BurningParticle& particle =
      p.burning->start(slot, p.mass[slot] / charge.law.initial_density(), p.volume_ratio[slot]);
  particle.to_burn += share;
  particle.to_add += share * fresh_energy;
}

bool Simulation::within_gas_law() const {
  bool within = true;
  for_each_body([&](const ParticleFields& p) { within = within && (!p.burning || p.burning->valid()); });
  return within;
}

double Simulation::stable_time_step() const {
  return with(form_, [](const auto& form) { return form.stable_time_step(); });
}

double Simulation::acceleration_under(double pressure) const { return pressure * loaded_area_ / total_mass_; }

void Simulation::step(double dt) {
  balance_ = energy_;
  const double damping_time = scene_.numerics.damping_time;
  // The acceleration is taken when the pressure is, so that the two balance.
  const StepInput input{dt, pressure_, acceleration_under(pressure_),
                        damping_time > 0.0 ? std::exp(-dt / damping_time) : 1.0,
                        scene_.numerics.pic_fraction};
  const StepTotals totals = with(form_, [&](auto& form) { return form.step(input); });
  time_ += dt;
  pressure_ = load_.at(time_);
  add_to_energy(totals, input);
}

/// Work of forces that change in the step counts with their mean, as stresses do.
void Simulation::add_to_energy(const StepTotals& totals, const StepInput& begin) {
  const double dt = begin.dt, pressure = 0.5 * (begin.pressure + pressure_);
  const double acceleration = 0.5 * (begin.acceleration + acceleration_under(pressure_));
  const ParticleTotals& p = totals.particles;
  const NodeTotals& n = totals.nodes;
  // The motion of all as one mass takes its energy from the work on it to the last digit and says nothing of
  // the computation.
  const BulkMotion& bulk = totals.bulk;
  const double bulk_velocity = bulk.momentum / bulk.inertia;
  balance_.kinetic = sum(p.centred_kinetic) - 0.5 * bulk.old_momentum * bulk_velocity;
  energy_.external += pressure * totals.chamber_flow * dt;
  energy_.body_force += acceleration * (sum(n.momentum) + totals.contact.momentum) * dt;
  energy_.internal += sum(p.internal) + sum(p.hourglass);
  energy_.hourglass += sum(p.hourglass);
  energy_.plastic += sum(p.plastic);
  energy_.viscous += sum(p.viscous);
  energy_.crack += sum(p.crack);
  energy_.charge_work += sum(p.charge_work);
  energy_.charge_friction += sum(p.charge_friction);
  energy_.damping += sum(n.lost_before) + sum(n.damping) + sum(p.pic_loss);
  balance_.damping += sum(n.lost_before);
  for (EnergyBalance* energy : {&energy_, &balance_}) {
    energy->damping += totals.contact.way_back_loss;
    energy->contact += totals.contact.loss;
  }
  events_.tension_cutoff += sum(p.tension_cutoff);
  events_.pressure_guard += sum(p.pressure_guard);
  events_.crack_at_bound += sum(p.crack_at_bound);
  events_.off_grid += sum(p.off_grid);
  events_.distorted += sum(p.distorted);
}

double Simulation::axial_momentum() const {
  double total = 0.0;
  for_each_body([&](const ParticleFields& p) {
    double body = 0.0;
    for (std::size_t i = 0; i < p.mass.size(); ++i) body += p.inertia_x[i] * p.velocity_x[i];
    total += body / scene_.numerics.inertial_scaling;
  });
  return total;
}

}  // namespace launchsafe::mpm
