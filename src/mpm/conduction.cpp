#include "launchsafe/mpm/conduction.hpp"

#include <Eigen/IterativeLinearSolvers>

namespace launchsafe::mpm {
namespace {

/// Residual over the right-hand side at which the linear solve ends.
constexpr double solver_tolerance = 1e-14;
/// In exact arithmetic as many iterations as unknowns are enough; round-off takes some more.
constexpr Eigen::Index iterations_per_unknown = 4;
/// Faces closer than this share of the scene's size coincide.
constexpr double coincidence = 1e-9;

materials::Law law_of(const AnyBody& any) {
  return std::visit([](const auto& body) -> materials::Law { return body.law; }, any);
}

/// Calls f(number, slot) for every particle of a body; `next`: number of its first one, then of the next
/// body's.
template <class F>
void for_each_particle(const Lattice& lattice, Eigen::Index& next, F&& f) {
  for (int j = 0; j < lattice.rows(); ++j)
    for (int i = 0; i < lattice.columns(); ++i) f(next++, lattice.slot(i, j));
}

/// Solves a symmetric positive definite system by conjugate gradients, preconditioned with its diagonal. A
/// step that moves heat by much less than a spacing takes a few iterations. A right side that is not finite
/// is returned as it is: on it the iteration would only end at its limit.
Eigen::VectorXd solve(const Eigen::SparseMatrix<double>& system, const Eigen::VectorXd& right_side) {
  if (!right_side.allFinite()) return right_side;
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver(system);
  solver.setTolerance(solver_tolerance);
  solver.setMaxIterations(iterations_per_unknown * right_side.size());
  return solver.solve(right_side);
}

/// Collects the links between particles into a symmetric matrix whose rows sum to 0.
class Network {
 public:
  Network(const scene::Scene& scene, const std::vector<AnyBody>& bodies) {
    const scene::Extent extent = scene::extent_of(scene);
    tolerance_ = coincidence * std::max(extent.x_end - extent.x_begin, extent.r_end);
    Eigen::Index first = 0;
    for (const AnyBody& body : bodies) {
      const Lattice& lattice = particle_fields_of(body).lattice;
      parts_.push_back({lattice, first, materials::heat_conductivity(law_of(body))});
      first += static_cast<Eigen::Index>(lattice.columns()) * lattice.rows();
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

 private:
  struct Part {
    Lattice lattice;
    Eigen::Index first;
    double conductivity;
    Eigen::Index number(int i, int j) const {
      return first + static_cast<Eigen::Index>(j) * lattice.columns() + i;
    }
  };

  /// Area (m2 per radian) across x between two radii.
  static double axial_area(double r_begin, double r_end) {
    return 0.5 * (r_end - r_begin) * (r_end + r_begin);
  }

  void link(Eigen::Index a, Eigen::Index b, double conductance) {
    entries_.emplace_back(a, a, conductance);
    entries_.emplace_back(b, b, conductance);
    entries_.emplace_back(a, b, -conductance);
    entries_.emplace_back(b, a, -conductance);
  }

  void link_inside(const Part& part) {
    const Lattice& l = part.lattice;
    for (int j = 0; j < l.rows(); ++j)
      for (int i = 0; i < l.columns(); ++i) {
        const auto row = static_cast<std::size_t>(j);
        const double r_end = l.r_edges[row + 1];
        if (i + 1 < l.columns())
          link(part.number(i, j), part.number(i + 1, j),
               part.conductivity * axial_area(l.r_edges[row], r_end) / (l.x_of(i + 1) - l.x_of(i)));
        if (j + 1 < l.rows())
          link(part.number(i, j), part.number(i, j + 1),
               part.conductivity * (r_end * l.length_x(i)) / (l.r_of(j + 1) - l.r_of(j)));
      }
  }

  /// Calls f(index in a, index in b, begin, end) for particles that face each other: intervals that overlap.
  template <class F>
  void for_each_overlap(const std::vector<double>& a, const std::vector<double>& b, F&& f) const {
    std::size_t first = 0;
    for (std::size_t i = 0; i + 1 < a.size(); ++i) {
      while (first + 1 < b.size() && b[first + 1] <= a[i]) ++first;
      for (std::size_t k = first; k + 1 < b.size() && b[k] < a[i + 1]; ++k) {
        const double begin = std::max(a[i], b[k]), end = std::min(a[i + 1], b[k + 1]);
        if (end - begin > tolerance_) f(static_cast<int>(i), static_cast<int>(k), begin, end);
      }
    }
  }

  /// The base-side face of `a` against the nose-side face of `b`.
  void link_axially(const Part& a, const Part& b) {
    const Lattice &la = a.lattice, &lb = b.lattice;
    if (std::abs(la.x_end() - lb.x_begin()) > tolerance_) return;
    const double resistance =
        0.5 * (la.length_x(la.columns() - 1) / a.conductivity + lb.length_x(0) / b.conductivity);
    for_each_overlap(la.r_edges, lb.r_edges, [&](int ja, int jb, double begin, double end) {
      link(a.number(la.columns() - 1, ja), b.number(0, jb), axial_area(begin, end) / resistance);
    });
  }

  /// The outer face of `a` against the inner face of `b`.
  void link_radially(const Part& a, const Part& b) {
    const Lattice &la = a.lattice, &lb = b.lattice;
    if (std::abs(la.r_end() - lb.r_begin()) > tolerance_) return;
    const double resistance =
        0.5 * (la.length_r(la.rows() - 1) / a.conductivity + lb.length_r(0) / b.conductivity);
    for_each_overlap(la.x_edges, lb.x_edges, [&](int ia, int ib, double begin, double end) {
      link(a.number(ia, la.rows() - 1), b.number(ib, 0), lb.r_begin() * (end - begin) / resistance);
    });
  }

  double tolerance_ = 0;
  std::vector<Part> parts_;
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::SparseMatrix<double> matrix_;
};

}  // namespace

Conduction::Conduction(const Simulation& simulation) {
  conductance_ = Network(simulation.scene(), simulation.bodies()).take();
  capacity_.resize(conductance_.rows());
  Eigen::Index next = 0;
  for (const AnyBody& body : simulation.bodies()) {
    const materials::Law law = law_of(body);
    const ParticleFields& p = particle_fields_of(body);
    for_each_particle(p.lattice, next, [&](Eigen::Index number, std::size_t slot) {
      capacity_[number] = p.mass[slot] * materials::heat_capacity(law);
    });
  }
}

void Conduction::advance(Simulation& simulation, double dt) {
  Eigen::VectorXd temperature(capacity_.size());
  Eigen::Index next = 0;
  simulation.for_each_body([&](const ParticleFields& p) {
    for_each_particle(p.lattice, next, [&](Eigen::Index number, std::size_t slot) {
      temperature[number] = p.temperature[slot];
    });
  });
  // (C + dt K) change = -dt K T: solved for the change, so that heat is conserved to round-off.
  Eigen::SparseMatrix<double> system = dt * conductance_;
  system.diagonal() += capacity_;
  Eigen::VectorXd change = solve(system, -dt * (conductance_ * temperature));
  // The mean is the solve's least certain mode, and known: no heat enters.
  change.array() -= capacity_.dot(change) / capacity_.sum();

  next = 0;
  const auto apply = [&]<class Law>(Body<Law>& body) {
    ParticleFields& p = body.particles;
    for_each_particle(p.lattice, next, [&](Eigen::Index number, std::size_t slot) {
      p.temperature[slot] += change[number];
      auto state = body.at(slot);
      body.law.set_temperature(state, p.temperature[slot]);
      for (std::size_t f = 0; f < state.size(); ++f) body.state[f][slot] = state[f];
    });
  };
  for (AnyBody& body : simulation.bodies()) std::visit(apply, body);
}

}  // namespace launchsafe::mpm
