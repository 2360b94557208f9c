// Particles of one body as arrays of their fields.
//
// A body is a lattice of particles in rows along x. Every row is padded to whole Packs with massless lanes.
// With several particles a cell, a row is split into sub-rows of every k-th particle, so that neighbouring
// lanes lie in neighbouring cells and a Pack reads and writes consecutive nodes.
#pragma once

#include "launchsafe/materials/burning_mixture.hpp"
#include "launchsafe/scene/plan.hpp"

namespace launchsafe::mpm {

// Particles of a charge that burn: explosive and gas at one pressure in place of the law's own pressure, and
// the deviator in the part that is explosive still.

/// One of them.
struct BurningParticle {
  std::size_t slot = 0;
  double rest_volume = 0;  ///< m3 per radian
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

/// The lattice at rest: which slot holds the particle (column i along x, row j along r), and its rectangle.
struct Lattice {
  std::vector<double> x_edges, r_edges;  ///< m, of columns and rows; one more than there are
  int stride = 1;                        ///< particles per cell, in each direction
  int padded_columns = 0;

  int columns() const { return static_cast<int>(x_edges.size()) - 1; }
  int rows() const { return static_cast<int>(r_edges.size()) - 1; }
  std::size_t slots() const { return static_cast<std::size_t>(padded_columns) * (r_edges.size() - 1); }
  std::size_t slot(int i, int j) const;
  double x_begin() const { return x_edges.front(); }
  double x_end() const { return x_edges.back(); }
  double r_begin() const { return r_edges.front(); }
  double r_end() const { return r_edges.back(); }
  /// Lengths of column i and row j, and their centres, m.
  double length_x(int i) const { return edge(x_edges, i + 1) - edge(x_edges, i); }
  double length_r(int j) const { return edge(r_edges, j + 1) - edge(r_edges, j); }
  double x_of(int i) const { return 0.5 * (edge(x_edges, i) + edge(x_edges, i + 1)); }
  double r_of(int j) const { return 0.5 * (edge(r_edges, j) + edge(r_edges, j + 1)); }

 private:
  static double edge(const std::vector<double>& edges, int i) { return edges[static_cast<std::size_t>(i)]; }
};

/// Fields of the particles of a body that every law needs. Slots that only pad a row have mass 0 and never
/// change.
struct ParticleFields {
  Lattice lattice;
  int body = 0;                               ///< index into Scene::bodies
  math::AlignedArray x, r;                    ///< m
  math::AlignedArray velocity_x, velocity_r;  ///< m/s
  math::AlignedArray mass;                    ///< kg per radian
  math::AlignedArray inertia_x, inertia_r;    ///< the same with the inertial factors: what resists forces
  math::AlignedArray volume_ratio;            ///< V, the volume over that at rest
  math::AlignedArray pressure;                ///< Pa, compression positive
  math::AlignedArray temperature;             ///< K

  /// Increment of the last step at the particles marked by `record`; empty while none is marked.
  std::vector<std::uint8_t> recorded;               ///< by Pack of slots
  std::array<math::AlignedArray, 3> strain_change;  ///< deviatoric strain increment rr, xx, rx

  std::optional<Burning> burning;  ///< of a charge from its ignition on
};

/// Makes every step store the increments of strain and stress of the particle in a slot, and of the others of
/// its Pack.
void record(ParticleFields& particles, std::size_t slot);

/// A body of particles of its material.
template <class Law>
struct Body {
  Law law;
  typename Law::Integrator integrator;  ///< of the law
  ParticleFields particles;
  std::array<math::AlignedArray, Law::state.size()> state;

  math::AlignedArray& operator[](std::size_t field) { return state[field]; }
  const math::AlignedArray& operator[](std::size_t field) const { return state[field]; }
  /// The state of one particle.
  materials::State<Law, double> at(std::size_t slot) const {
    materials::State<Law, double> values;
    for (std::size_t f = 0; f < values.size(); ++f) values[f] = state[f][slot];
    return values;
  }
  /// Its stress deviator, Pa.
  math::Deviator<double> deviator(std::size_t slot) const { return Law::deviator(at(slot)); }
};

/// A body of any law.
using AnyBody = boost::mp11::mp_transform<Body, materials::Law>;

/// Particles that tile the body exactly, at rest and free of stress.
AnyBody make_body(const scene::Scene& scene, int body);

const ParticleFields& particle_fields_of(const AnyBody& body);

/// Sum of the particle masses, kg of the whole shell (2 pi radians).
double mass_of(const ParticleFields& particles);

}  // namespace launchsafe::mpm
