#include "launchsafe/mpm/body.hpp"

namespace launchsafe::mpm {

using math::Pack;

BurningParticle& Burning::start(std::size_t slot, double rest_volume, double volume) {
  if (BurningParticle* already = find(slot)) return *already;
  index_[slot] = static_cast<std::uint32_t>(particles_.size());
  packs_[slot / math::pack_width] = 1;
  BurningParticle particle;
  particle.slot = slot;
  particle.rest_volume = rest_volume;
  particle.state = law_.unburnt(volume);
  particle.start_energy = particle.state.energy;
  return particles_.emplace_back(particle);
}

bool Burning::valid() const {
  return std::all_of(particles_.begin(), particles_.end(),
                     [](const BurningParticle& each) { return each.state.valid; });
}

SolidParts advance_burning(Burning& burning, std::size_t slot, Pack volume_before, Pack volume_after) {
  SolidParts parts{Pack(1.0), Pack(1.0), volume_before, volume_after, Pack(0.0), Pack(0.0) > Pack(0.0)};
  Pack burns(0.0);
  for (std::size_t lane = 0; lane < math::pack_width; ++lane) {
    BurningParticle* particle = burning.find(slot + lane);
    if (particle == nullptr) continue;
    const materials::BurningState before = particle->state;
    const double to_burn = particle->to_burn;
    const materials::BurningStep step{volume_before[lane], volume_after[lane], to_burn,
                                      to_burn > 0.0 ? particle->to_add / to_burn : 0.0};
    particle->state = burning.law().advance(before, step);
    const materials::BurningState& after = particle->state;
    particle->to_burn = particle->to_add = 0.0;
    particle->added +=
        burning.law().solid_density() * (after.burnt_share - before.burnt_share) * step.fresh_energy;
    parts.share_before.set(lane, before.solid_share(step.volume_before));
    parts.share_after.set(lane, after.solid_share(step.volume_after));
    parts.volume_before.set(lane, before.solid_volume);
    parts.volume_after.set(lane, after.solid_volume);
    parts.pressure.set(lane, after.pressure);
    burns.set(lane, 1.0);
  }
  parts.burns = burns > Pack(0.5);
  return parts;
}

}  // namespace launchsafe::mpm
