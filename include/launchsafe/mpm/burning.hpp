// Particles of a charge that burn: explosive and gas at one pressure in place of the law's own pressure, and
// the deviator in the part that is explosive still.
#pragma once

#include "launchsafe/materials/burning_mixture.hpp"
#include "launchsafe/math/pack.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace launchsafe::mpm {

/// One of them.
struct BurningParticle {
  std::size_t slot = 0;
  double rest_volume = 0;  ///< m3 per radian or metre
  materials::BurningState state;
  double to_burn = 0;       ///< share of its mass that burns in the next step
  double to_add = 0;        ///< J/kg of the particle, thermal, from 0 K, that the gas from that gets
  double start_energy = 0;  ///< J/m3, when it began to burn
  double added = 0;         ///< J/m3, with what has burnt
};

/// Those of one body.
class Burning {
 public:
  /// `slots`: of the body's particles.
  Burning(materials::BurningMixture law, std::size_t slots)
      : law_(std::move(law)), packs_(slots / math::pack_width, 0), index_(slots, none) {}

  /// Whether some particle of the Pack at a slot burns.
  bool any_in_pack(std::size_t slot) const { return packs_[slot / math::pack_width] != 0; }
  /// The particle in a slot; null where it does not burn.
  BurningParticle* find(std::size_t slot) {
    return index_[slot] == none ? nullptr : &particles_[index_[slot]];
  }
  const BurningParticle* find(std::size_t slot) const {
    return index_[slot] == none ? nullptr : &particles_[index_[slot]];
  }
  /// The same, which starts to burn at volume ratio V if it does not yet.
  BurningParticle& start(std::size_t slot, double rest_volume, double volume);
  const std::vector<BurningParticle>& particles() const { return particles_; }
  const materials::BurningMixture& law() const { return law_; }
  /// False once a particle was outside of the gas law.
  bool valid() const;

 private:
  static constexpr std::uint32_t none = UINT32_MAX;
  materials::BurningMixture law_;
  std::vector<std::uint8_t> packs_;
  std::vector<std::uint32_t> index_;
  std::vector<BurningParticle> particles_;
};

/// Shares of explosive in the volumes of a Pack of particles, and its own volume ratios; 1 and the particle's
/// where nothing burns.
struct SolidParts {
  math::Pack share_before, share_after;
  math::Pack volume_before, volume_after;
  math::Pack pressure;  ///< Pa, of those that burn
  math::Mask burns;
};

/// Burns what is to burn and brings explosive and gas of a Pack of particles to one pressure, while the
/// particles go from `volume_before` to `volume_after`.
SolidParts advance_burning(Burning& burning, std::size_t slot, math::Pack volume_before,
                           math::Pack volume_after);

}  // namespace launchsafe::mpm
