// Particles of one body: arrays, and only those that the body's material needs.
//
// A body is a lattice of particles in rows along x. Every row is padded to whole Packs with massless lanes.
// With several particles a cell, a row is split into sub-rows of every k-th particle, so that neighbouring
// lanes lie in neighbouring cells and a Pack reads and writes consecutive nodes.
#pragma once

#include "launchsafe/materials/visco_scram.hpp"
#include "launchsafe/math/aligned_array.hpp"
#include "launchsafe/scene/mesh.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace launchsafe::mpm {

/// The lattice: which slot holds the particle (column i along x, row j along r).
struct Lattice {
  int columns = 0, rows = 0, stride = 1;  ///< stride: particles per cell
  int padded_columns = 0;
  double x_begin = 0, r_begin = 0;      ///< corner of the body, m
  double spacing_x = 0, spacing_r = 0;  ///< m

  std::size_t slots() const {
    return static_cast<std::size_t>(padded_columns) * static_cast<std::size_t>(rows);
  }
  std::size_t slot(int i, int j) const;
  /// Initial centre of column i, row j, m.
  double x_of(int i) const { return x_begin + (i + 0.5) * spacing_x; }
  double r_of(int j) const { return r_begin + (j + 0.5) * spacing_r; }
};

/// What every body has. Massless slots have mass 0 and never change.
struct Kinematics {
  Lattice lattice;
  int body = 0;                               ///< index into Scene::bodies
  double half_x = 0, half_r = 0;              ///< particle half-lengths, m, constant (uGIMP)
  math::AlignedArray x, r;                    ///< m
  math::AlignedArray velocity_x, velocity_r;  ///< m/s
  math::AlignedArray mass;                    ///< kg per radian, or per metre of depth
  math::AlignedArray density;                 ///< kg/m3
  math::AlignedArray pressure;                ///< Pa, compression positive
  math::AlignedArray temperature;             ///< K
};

struct SteelBody {
  Kinematics kinematics;
  math::AlignedArray stress_rr, stress_xx, stress_rx;  ///< deviator, Pa
  math::AlignedArray energy;                           ///< J/kg
  math::AlignedArray plastic_strain;
  math::AlignedArray flow_stress;  ///< Pa at the reference rate: below it nothing yields
};

struct ChargeBody {
  Kinematics kinematics;
  std::array<std::array<math::AlignedArray, 3>, materials::maxwell_elements>
      elements;                     ///< S_n: rr, xx, rx, Pa
  math::AlignedArray crack_radius;  ///< m
  math::AlignedArray energy;        ///< J per m3 of initial volume
  /// Friction heat since the start by closure (literal, inelastic), J per m3 of initial volume,
  /// localisation 1.
  std::array<math::AlignedArray, 2> friction;
};

/// Particles that tile the body exactly, at rest and free of stress.
SteelBody make_steel_body(const scene::Scene& scene, int body);
ChargeBody make_charge_body(const scene::Scene& scene, int body);

/// Sum of the particle masses, kg of the whole shell (2 pi radians) or per metre of depth.
double mass_of(const Kinematics& particles, scene::Symmetry symmetry);

/// Stress deviator of one charge particle, and its axial component, Pa.
math::Deviator<double> deviator(const ChargeBody& charge, std::size_t slot);
double axial_deviator(const ChargeBody& charge, std::size_t slot);

}  // namespace launchsafe::mpm
