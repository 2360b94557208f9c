// Particles of one body as arrays of their fields.
//
// A body is a lattice of particles in rows along x. Every row is padded to whole Packs with massless lanes.
// With several particles a cell, a row is split into sub-rows of every k-th particle, so that neighbouring
// lanes lie in neighbouring cells and a Pack reads and writes consecutive nodes.
#pragma once

#include "launchsafe/materials/laws.hpp"
#include "launchsafe/math/aligned_array.hpp"
#include "launchsafe/mpm/burning.hpp"
#include "launchsafe/scene/mesh.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace launchsafe::mpm {

/// The lattice at rest: which slot holds the particle (column i along x, row j along r), and its rectangle.
struct Lattice {
  std::vector<double> x_edges, r_edges;  ///< m, of columns and rows; one more than there are
  int stride = 1;                        ///< particles per cell, in each direction
  int padded_columns = 0;

  int columns() const { return static_cast<int>(x_edges.size()) - 1; }
  int rows() const { return static_cast<int>(r_edges.size()) - 1; }
  std::size_t slots() const {
    return static_cast<std::size_t>(padded_columns) * r_edges.size() -
           static_cast<std::size_t>(padded_columns);
  }
  std::size_t slot(int i, int j) const;
  double x_begin() const { return x_edges.front(); }
  double x_end() const { return x_edges.back(); }
  double r_begin() const { return r_edges.front(); }
  double r_end() const { return r_edges.back(); }
  /// Lengths of column i and row j, and their centres, m.
  double length_x(int i) const {
    return x_edges[static_cast<std::size_t>(i) + 1] - x_edges[static_cast<std::size_t>(i)];
  }
  double length_r(int j) const {
    return r_edges[static_cast<std::size_t>(j) + 1] - r_edges[static_cast<std::size_t>(j)];
  }
  double x_of(int i) const {
    return 0.5 * (x_edges[static_cast<std::size_t>(i)] + x_edges[static_cast<std::size_t>(i) + 1]);
  }
  double r_of(int j) const {
    return 0.5 * (r_edges[static_cast<std::size_t>(j)] + r_edges[static_cast<std::size_t>(j) + 1]);
  }
};

/// Fields of the particles of a body that every law needs. Slots that only pad a row have mass 0 and never
/// change.
struct ParticleFields {
  Lattice lattice;
  int body = 0;                               ///< index into Scene::bodies
  math::AlignedArray x, r;                    ///< m
  math::AlignedArray velocity_x, velocity_r;  ///< m/s
  math::AlignedArray mass;                    ///< kg per radian, or per metre of depth
  math::AlignedArray inertia_x, inertia_r;    ///< the same with the inertial factors: what resists forces
  math::AlignedArray volume_ratio;            ///< V, the volume over that at rest
  math::AlignedArray pressure;                ///< Pa, compression positive
  math::AlignedArray temperature;             ///< K

  /// Increments of the last step at the particles marked by `record`; empty while none is marked.
  std::vector<std::uint8_t> recorded;               ///< by Pack of slots
  std::array<math::AlignedArray, 3> strain_change;  ///< deviatoric strain increment rr, xx, rx
  /// Pa: stress deviator rr, xx, rx less the one before, turned with the step's rotation.
  std::array<math::AlignedArray, 3> stress_change;

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

namespace detail {
template <class Laws>
struct BodiesOf;
template <class... Law>
struct BodiesOf<std::variant<Law...>> {
  using type = std::variant<Body<Law>...>;
};
}  // namespace detail

/// A body of any law.
using AnyBody = detail::BodiesOf<materials::Law>::type;

/// Particles that tile the body exactly, at rest and free of stress.
AnyBody make_body(const scene::Scene& scene, int body);

const ParticleFields& particle_fields_of(const AnyBody& body);

/// Sum of the particle masses, kg of the whole shell (2 pi radians) or per metre of depth.
double mass_of(const ParticleFields& particles, scene::Symmetry symmetry);

}  // namespace launchsafe::mpm
