#include "bulk_heat.hpp"

#include "launchsafe/surface/skin.hpp"
#include "launchsafe/trace/bottom_trace.hpp"
#include "sliding_heat.hpp"

namespace launchsafe::run {

BulkHeat::BulkHeat(mpm::Simulation& simulation)
    : charge_(simulation.scene().charge()),
      closure_(static_cast<std::size_t>(simulation.scene().surface.friction)) {
  const scene::Plan plan = scene::make_plan(simulation.scene());
  reaction_ = plan.bulk_reaction.in;
  if (plan.conduction.in) conduction_.emplace(simulation);
  const bool is_read = reaction_ || conduction_ || simulation.scene().output.asks_for_snapshots();
  if (!is_read || closure_ >= trace::traced_closures) return;
  for (Charge& body : simulation.bodies_of<materials::Charge>()) {
    for (std::size_t slot = 0; slot < body.particles.mass.size(); slot += math::pack_width)
      mpm::record(body.particles, slot);
    friction_.emplace_back(body.particles.mass.size(), 0.0);
  }
}

void BulkHeat::accumulate(const mpm::Simulation& simulation) {
  auto energy = friction_.begin();
  if (energy == friction_.end()) return;
  for (const Charge& charge : simulation.bodies_of<materials::Charge>()) {
    for (std::size_t slot = 0; slot < energy->size(); ++slot) {
      materials::SlidingStep step;
      add(step, charge, slot, 1.0);
      (*energy)[slot] += materials::sliding_heat(charge.law.sliding_friction, step)[closure_];
    }
    ++energy;
  }
}

void BulkHeat::advance_to(mpm::Simulation& simulation, double time) {
  const double dt = time - time_;
  time_ = time;
  if (!(dt > 0.0)) return;
  auto energy = friction_.begin();
  for (Charge& charge : simulation.bodies_of<materials::Charge>()) {
    if (energy != friction_.end()) add_friction(charge, *energy++);
    if (reaction_) react(charge, dt);
  }
  if (conduction_) conduction_->advance(simulation, dt);
}

void BulkHeat::add_friction(Charge& charge, math::AlignedArray& energy) const {
  const double capacity = charge_.density * charge_.specific_heat;
  for (std::size_t i = 0; i < energy.size(); ++i) {
    charge.particles.temperature[i] += energy[i] / capacity;
    energy[i] = 0.0;
  }
}

void BulkHeat::react(Charge& charge, double dt) const {
  // The skin equation without air is the bulk's: a gap of nothing exchanges nothing.
  surface::SkinModel model;
  model.kinetics = charge_.kinetics;
  model.charge_density = charge_.density;
  model.specific_heat = charge_.specific_heat;
  for (double& temperature : charge.particles.temperature)
    temperature =
        surface::advance_skin(model, 0.0, surface::SkinPoint{temperature}, dt, temperature, temperature, 0.0)
            .temperature;
}

}  // namespace launchsafe::run
