// A static, axisymmetric finite element model on a rectangular mesh, its input deck for CalculiX (Abaqus'
// format), and the stresses that CalculiX (program ccx) computes: an independent assessment of the stresses
// at the charge bottom.
#pragma once

#include "launchsafe/store/program.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace launchsafe::verify {

/// Yield stress (Pa) at a plastic strain.
struct HardeningPoint {
  double plastic_strain = 0, stress = 0;
};

struct FiniteElementMaterial {
  double bulk_modulus = 0, shear_modulus = 0;  ///< Pa
  double density = 0;                          ///< kg/m3
  std::vector<HardeningPoint> hardening;       ///< from plastic strain 0 on; empty: elastic
};

/// Faces between two bodies that can part and slide, by their numbers in `FiniteElementModel::body_of`.
struct FiniteElementContact {
  int body = 0, other = 0;
  double friction = 0;  ///< Coulomb's coefficient
};

/// Quadratic elements with reduced integration (CAX8R: 8 nodes, 2 x 2 points). Neighbours share their nodes,
/// that is, are bonded, unless a contact says otherwise: there each body has its own nodes, and the faces are
/// pressed on each other by springs at their integration points (face-to-face penalty). In the frame of the
/// accelerating body the acceleration is a body force toward the base (+x).
struct FiniteElementModel {
  std::vector<double> edges_x, edges_r;  ///< lines between elements, m, rising; x grows from nose to base
  std::vector<FiniteElementMaterial> materials;
  std::vector<int> material_of;  ///< of element (i along x, j along r), at `element(i, j)`
  std::vector<int> body_of;      ///< of element, as material_of; empty: all are of body 0
  std::vector<FiniteElementContact> contacts;
  /// Pa/m, pressure for an overlap.
  double contact_stiffness = 1e15;
  /// Pa/m, times the coefficient of friction up to 0.1: shear traction over the elastic slip of faces that
  /// stick, so that the slip at the onset of sliding is the same for any friction. From four times this on at
  /// a friction of 0.1, and ten times at 0.02, points of an element stick and slide alternately: CalculiX
  /// finds no equilibrium, or stresses on the base that change by 3 % with the mesh.
  double stick_stiffness = 2e14;
  double acceleration = 0;    ///< m/s2, of the frame
  double base_pressure = 0;   ///< Pa, on the face at the largest x
  double bore_pressure = 0;   ///< Pa, on the face at the smallest r
  bool axis_held = false;     ///< no radial motion at the smallest r, which stands for the axis
  bool rigid_barrel = false;  ///< no radial motion, and no friction, at the largest r
  bool ends_held = false;     ///< no axial motion at either end: plane strain

  /// Load increment where a material may yield, as a share of the load. Plastic flow is integrated over an
  /// increment: one of 0.2 changes the pressure at the charge bottom by 0.3 %, the default by a tenth of
  /// that.
  double increment = 0.02;

  int columns() const { return static_cast<int>(edges_x.size()) - 1; }
  int rows() const { return static_cast<int>(edges_r.size()) - 1; }
  int elements() const { return columns() * rows(); }
  int element(int i, int j) const { return i + columns() * j; }
  int material(int element) const { return material_of[static_cast<std::size_t>(element)]; }
  int body(int element) const { return body_of.empty() ? 0 : body_of[static_cast<std::size_t>(element)]; }
  /// The contact between two bodies; none where they are bonded, or one.
  const FiniteElementContact* contact_between(int a, int b) const;
};

/// Integration points of an element, in the order in which CalculiX prints them: x outer, r inner.
inline constexpr int integration_points = 4;

/// One integration point of the undeformed mesh.
struct IntegrationPoint {
  double x = 0, r = 0;  ///< m
  double weight = 0;    ///< m3 per radian that it stands for
};
IntegrationPoint integration_point(const FiniteElementModel& model, int element, int point);

/// Lines from `begin` to `end`, both included, whose distances change geometrically from `first` at the begin
/// to `last` at the end (all m, > 0), each rounded down to fit.
std::vector<double> graded_edges(double begin, double end, double first, double last);

/// Every element cut in two along each direction.
FiniteElementModel refined(const FiniteElementModel& model);

/// Pa, of the stresses that stand in decks and come back.
inline constexpr double deck_stress_unit = 1e6;

/// The input deck of a static, geometrically nonlinear step that prints the stresses at all integration
/// points at its end.
std::string deck_of(const FiniteElementModel& model);

/// Pressure (compression positive) and von Mises stress, Pa.
struct StressMeasures {
  double pressure = 0, von_mises = 0;
};

/// Cauchy stress at an integration point, Pa, tension positive.
struct CauchyStress {
  double rr = 0, xx = 0, tt = 0, rx = 0;
  StressMeasures measures() const;
};

/// What a finite element computation printed.
struct FiniteElementResult {
  std::vector<CauchyStress> stress;  ///< of every element, its integration points one after the other
  const CauchyStress& at(int element, int point) const {
    return stress[static_cast<std::size_t>(element * integration_points + point)];
  }
};

/// Reads the stresses of so many elements at the last increment out of the text that ccx
/// leaves in its .dat file. Errors: corrupt.
store::Result<FiniteElementResult> read_finite_element_output(std::string_view text, int elements);

/// What ccx says its version is: "2.20". Errors: missing (it is not installed), failed.
store::Result<std::string> finite_element_version();

/// Runs ccx on the model's deck in a temporary folder of its own. Errors: missing, failed (what ccx said
/// last), corrupt, write_failed.
store::Result<FiniteElementResult> run_finite_elements(const FiniteElementModel& model,
                                                       const store::ProgramLimits& limits = {.time = 600.0});

}  // namespace launchsafe::verify
