#include "launchsafe/mpm/conduction.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace launchsafe::mpm {
namespace {

/// Residual over the right-hand side at which the linear solve ends.
constexpr double solver_tolerance = 1e-14;
/// In exact arithmetic as many iterations as unknowns are enough; round-off takes some more.
constexpr Eigen::Index iterations_per_unknown = 4;
/// Faces closer than this share of the scene's size coincide.
constexpr double coincidence = 1e-9;

/// Conductivity (W/(m K)) and specific heat (J/(kg K)) of a body.
struct Thermal {
  double conductivity, specific_heat;
};
Thermal thermal_of(const scene::Scene& scene, const Kinematics& p) {
  if (scene.bodies[static_cast<std::size_t>(p.body)].material == scene::BodyMaterial::steel)
    return {scene.steel.strength.conductivity, scene.steel.strength.specific_heat};
  return {scene.charge.conductivity, scene.charge.specific_heat};
}

/// Bodies in the order of their particles' numbers.
std::vector<const Kinematics*> bodies_of(const Simulation& simulation) {
  std::vector<const Kinematics*> bodies;
  simulation.for_each_body([&](const Kinematics& p) { bodies.push_back(&p); });
  return bodies;
}

Eigen::Index particles_of(const Lattice& lattice) {
  return static_cast<Eigen::Index>(lattice.columns) * lattice.rows;
}

/// Calls f(number, slot) for every particle of a body whose first particle has the number `first`.
template <class F>
void for_each_particle(const Lattice& lattice, Eigen::Index first, F&& f) {
  for (int j = 0; j < lattice.rows; ++j)
    for (int i = 0; i < lattice.columns; ++i) f(first++, lattice.slot(i, j));
}

double dot(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// Solves a symmetric positive definite system by conjugate gradients, preconditioned with its diagonal. A
/// step that moves heat by much less than a spacing takes a few iterations.
Eigen::VectorXd solve(const Eigen::SparseMatrix<double>& system, const Eigen::VectorXd& right_side) {
  const Eigen::VectorXd inverse_diagonal = system.diagonal().cwiseInverse();
  Eigen::VectorXd solution = Eigen::VectorXd::Zero(right_side.size()), residual = right_side;
  Eigen::VectorXd scaled = inverse_diagonal.cwiseProduct(residual), direction = scaled;
  double energy = dot(residual, scaled);
  const double enough = solver_tolerance * solver_tolerance * energy;
  for (Eigen::Index k = 0; k < iterations_per_unknown * right_side.size() && energy > enough; ++k) {
    const Eigen::VectorXd image = system * direction;
    const double length = energy / dot(direction, image);
    solution += length * direction;
    residual -= length * image;
    scaled = inverse_diagonal.cwiseProduct(residual);
    const double next = dot(residual, scaled);
    direction = scaled + (next / energy) * direction;
    energy = next;
  }
  return solution;
}

/// Collects the links between particles into a symmetric matrix whose rows sum to 0.
class Network {
 public:
  Network(const scene::Scene& scene, const std::vector<const Kinematics*>& bodies)
      : axisymmetric_(scene.symmetry == scene::Symmetry::axisymmetric) {
    const scene::Extent extent = scene::extent_of(scene);
    tolerance_ = coincidence * std::max(extent.x_end - extent.x_begin, extent.r_end);
    Eigen::Index first = 0;
    for (const Kinematics* p : bodies) {
      parts_.push_back({p->lattice, first, thermal_of(scene, *p).conductivity});
      first += particles_of(p->lattice);
    }
    for (const Part& part : parts_) link_inside(part);
    for (const Part& a : parts_)
      for (const Part& b : parts_) {
        link_axially(a, b);
        link_radially(a, b);
      }
    matrix_.resize(first, first);
    matrix_.setFromTriplets(entries_.begin(), entries_.end());
  }
  Eigen::SparseMatrix<double> take() { return std::move(matrix_); }

  /// Area (m2 per radian or metre) across x of the ring between two radii.
  double axial_area(double r_begin, double r_end) const {
    return axisymmetric_ ? 0.5 * (r_end - r_begin) * (r_end + r_begin) : r_end - r_begin;
  }

 private:
  struct Part {
    Lattice lattice;
    Eigen::Index first;
    double conductivity;
    Eigen::Index number(int i, int j) const {
      return first + static_cast<Eigen::Index>(j) * lattice.columns + i;
    }
    double x_end() const { return lattice.x_begin + lattice.columns * lattice.spacing_x; }
    double r_end() const { return lattice.r_begin + lattice.rows * lattice.spacing_r; }
  };

  double radial_area(double r, double length) const { return axisymmetric_ ? r * length : length; }

  void link(Eigen::Index a, Eigen::Index b, double conductance) {
    entries_.emplace_back(a, a, conductance);
    entries_.emplace_back(b, b, conductance);
    entries_.emplace_back(a, b, -conductance);
    entries_.emplace_back(b, a, -conductance);
  }

  void link_inside(const Part& part) {
    const Lattice& l = part.lattice;
    for (int j = 0; j < l.rows; ++j) {
      const double r_begin = l.r_begin + j * l.spacing_r, r_end = r_begin + l.spacing_r;
      const double along_x = part.conductivity * axial_area(r_begin, r_end) / l.spacing_x;
      const double along_r = part.conductivity * radial_area(r_end, l.spacing_x) / l.spacing_r;
      for (int i = 0; i < l.columns; ++i) {
        if (i + 1 < l.columns) link(part.number(i, j), part.number(i + 1, j), along_x);
        if (j + 1 < l.rows) link(part.number(i, j), part.number(i, j + 1), along_r);
      }
    }
  }

  /// Calls f(j of a, j of b, begin, end) for particles that face each other: intervals of two lattices that
  /// overlap.
  template <class F>
  void for_each_overlap(double a_begin, double a_part, int a_count, double b_begin, double b_part,
                        int b_count, F&& f) const {
    int b = 0;
    for (int a = 0; a < a_count; ++a) {
      const double from = a_begin + a * a_part, to = from + a_part;
      while (b > 0 && b_begin + b * b_part > from) --b;
      for (; b < b_count && b_begin + b * b_part < to; ++b) {
        const double begin = std::max(from, b_begin + b * b_part),
                     end = std::min(to, b_begin + (b + 1) * b_part);
        if (end - begin > tolerance_) f(a, b, begin, end);
      }
      b = std::max(0, b - 1);
    }
  }

  /// The base-side face of `a` against the nose-side face of `b`.
  void link_axially(const Part& a, const Part& b) {
    const Lattice &la = a.lattice, &lb = b.lattice;
    if (std::abs(a.x_end() - lb.x_begin) > tolerance_) return;
    const double resistance = 0.5 * (la.spacing_x / a.conductivity + lb.spacing_x / b.conductivity);
    for_each_overlap(la.r_begin, la.spacing_r, la.rows, lb.r_begin, lb.spacing_r, lb.rows,
                     [&](int ja, int jb, double begin, double end) {
                       link(a.number(la.columns - 1, ja), b.number(0, jb),
                            axial_area(begin, end) / resistance);
                     });
  }

  /// The outer face of `a` against the inner face of `b`.
  void link_radially(const Part& a, const Part& b) {
    const Lattice &la = a.lattice, &lb = b.lattice;
    if (std::abs(a.r_end() - lb.r_begin) > tolerance_) return;
    const double resistance = 0.5 * (la.spacing_r / a.conductivity + lb.spacing_r / b.conductivity);
    for_each_overlap(la.x_begin, la.spacing_x, la.columns, lb.x_begin, lb.spacing_x, lb.columns,
                     [&](int ia, int ib, double begin, double end) {
                       link(a.number(ia, la.rows - 1), b.number(ib, 0),
                            radial_area(lb.r_begin, end - begin) / resistance);
                     });
  }

  bool axisymmetric_;
  double tolerance_ = 0;
  std::vector<Part> parts_;
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::SparseMatrix<double> matrix_;
};

}  // namespace

Conduction::Conduction(const Simulation& simulation) {
  const scene::Scene& scene = simulation.scene();
  const std::vector<const Kinematics*> bodies = bodies_of(simulation);
  Network network(scene, bodies);
  conductance_ = network.take();
  capacity_.resize(conductance_.rows());
  const scene::Extent extent = scene::extent_of(scene);
  Eigen::Index first = 0;
  for (const Kinematics* p : bodies) {
    const Thermal thermal = thermal_of(scene, *p);
    const Lattice& lattice = p->lattice;
    for_each_particle(lattice, first, [&](Eigen::Index number, std::size_t slot) {
      capacity_[number] = p->mass[slot] * thermal.specific_heat;
    });
    const bool at_base = std::abs(lattice.x_begin + lattice.columns * lattice.spacing_x - extent.x_end) <=
                         coincidence * (extent.x_end - extent.x_begin);
    for (int j = 0; at_base && j < lattice.rows; ++j) {
      const double r = lattice.r_begin + j * lattice.spacing_r;
      const double area = network.axial_area(r, r + lattice.spacing_r);
      base_.push_back({first + static_cast<Eigen::Index>(j + 1) * lattice.columns - 1, area,
                       thermal.conductivity * area / (0.5 * lattice.spacing_x)});
    }
    first += particles_of(lattice);
  }
}

void Conduction::hold_base(double temperature) {
  held_ = true;
  held_temperature_ = temperature;
}

void Conduction::heat_base(double flux) { flux_ = flux; }

void Conduction::advance(Simulation& simulation, double dt) {
  const std::vector<const Kinematics*> bodies = bodies_of(simulation);
  Eigen::VectorXd temperature(capacity_.size());
  Eigen::Index first = 0;
  for (const Kinematics* p : bodies) {
    for_each_particle(p->lattice, first, [&](Eigen::Index number, std::size_t slot) {
      temperature[number] = p->temperature[slot];
    });
    first += particles_of(p->lattice);
  }
  // (C + dt K) change = -dt K T + dt q: solved for the change, so that heat is conserved to round-off.
  Eigen::VectorXd gain = -dt * (conductance_ * temperature);
  Eigen::VectorXd diagonal = capacity_;
  for (const BaseFace& face : base_) {
    gain[face.particle] += dt * face.area * flux_;
    if (!held_) continue;
    gain[face.particle] += dt * face.conductance * (held_temperature_ - temperature[face.particle]);
    diagonal[face.particle] += dt * face.conductance;
  }
  Eigen::SparseMatrix<double> system = dt * conductance_;
  system.diagonal() += diagonal;
  Eigen::VectorXd change = solve(system, gain);
  // The mean is the solve's least certain mode, and known: what the faces let in.
  double entered = 0.0;
  for (const BaseFace& face : base_) {
    entered += dt * face.area * flux_;
    if (held_)
      entered +=
          dt * face.conductance * (held_temperature_ - temperature[face.particle] - change[face.particle]);
  }
  change.array() +=
      (entered - dot(capacity_, change)) / std::accumulate(capacity_.begin(), capacity_.end(), 0.0);

  first = 0;
  const auto apply = [&](Kinematics& p) {
    for_each_particle(p.lattice, first,
                      [&](Eigen::Index number, std::size_t slot) { p.temperature[slot] += change[number]; });
    first += particles_of(p.lattice);
  };
  for (SteelBody& body : simulation.steel()) {
    apply(body.kinematics);
    for (std::size_t slot = 0; slot < body.flow_stress.size(); ++slot)
      body.flow_stress[slot] =
          materials::johnson_cook_flow_stress(simulation.scene().steel.strength, body.plastic_strain[slot],
                                              0.0, body.kinematics.temperature[slot]);
  }
  for (ChargeBody& body : simulation.charges()) apply(body.kinematics);
}

double Conduction::heat(const Simulation& simulation) const {
  double total = 0.0;
  Eigen::Index first = 0;
  for (const Kinematics* p : bodies_of(simulation)) {
    for_each_particle(p->lattice, first, [&](Eigen::Index number, std::size_t slot) {
      total += capacity_[number] * p->temperature[slot];
    });
    first += particles_of(p->lattice);
  }
  return total;
}

}  // namespace launchsafe::mpm
