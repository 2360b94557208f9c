#include "bulk_heat.hpp"

#include "launchsafe/surface/skin.hpp"
#include "launchsafe/trace/bottom_trace.hpp"

namespace launchsafe::run {

BulkHeat::BulkHeat(const mpm::Simulation& simulation)
    : charge_(simulation.scene().charge()),
      closure_(static_cast<std::size_t>(simulation.scene().surface.friction)) {
  const scene::Plan plan = scene::make_plan(simulation.scene());
  reaction_ = plan.bulk_reaction.in;
  if (plan.conduction.in) conduction_.emplace(simulation);
  for (const Charge& body : simulation.bodies_of<materials::Charge>())
    friction_before_.emplace_back(body.kinematics.x.size(), 0.0);
}

void BulkHeat::advance_to(mpm::Simulation& simulation, double time) {
  const double dt = time - time_;
  time_ = time;
  if (!(dt > 0.0)) return;
  auto before = friction_before_.begin();
  for (Charge& charge : simulation.bodies_of<materials::Charge>()) {
    add_friction(charge, *before++);
    if (reaction_) react(charge, dt);
  }
  if (conduction_) conduction_->advance(simulation, dt);
}

void BulkHeat::add_friction(Charge& charge, math::AlignedArray& before) const {
  if (closure_ >= trace::traced_closures) return;
  const double capacity = charge_.eos.initial_density * charge_.specific_heat;
  const math::AlignedArray& energy = charge[materials::Charge::friction_literal + closure_];
  for (std::size_t i = 0; i < energy.size(); ++i)
    charge.kinematics.temperature[i] += (energy[i] - before[i]) / capacity;
  before = energy;
}

void BulkHeat::react(Charge& charge, double dt) const {
  // The skin equation without air is the bulk's: a gap of nothing exchanges nothing.
  surface::SkinModel model;
  model.kinetics = charge_.kinetics;
  model.charge_density = charge_.eos.initial_density;
  model.specific_heat = charge_.specific_heat;
  for (double& temperature : charge.kinematics.temperature)
    temperature =
        surface::advance_skin(model, 0.0, surface::SkinPoint{temperature}, dt, temperature, temperature, 0.0)
            .temperature;
}

}  // namespace launchsafe::run
