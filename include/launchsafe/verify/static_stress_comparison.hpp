// Static stresses of the particle computation against finite elements: bodies at rest in the frame that
// accelerates with them, under a pressure that rises smoothly and then stays.
#pragma once

#include "launchsafe/run/case_result.hpp"
#include "launchsafe/scene/scene.hpp"
#include "launchsafe/verify/finite_elements.hpp"

#include <atomic>
#include <functional>
#include <string>
#include <vector>

namespace launchsafe::verify {

/// Stresses are averaged over boxes of this size (m) at the bottom, with the weight r dr dx.
inline constexpr double stress_box = 5e-3;
/// Alternation is looked at up to this radius (m): beyond, the stress itself varies within a cell.
inline constexpr double alternation_radius = 0.056;

/// A box of `stress_box` x `stress_box` around r whose base side is the bottom of the charge (without one, of
/// the scene).
struct StressStation {
  std::string name;
  double r = 0;  ///< m
};

/// How far the particles may be from the reference on any mesh.
struct StressTargets {
  double inner = 0.01;           ///< of pressure and von Mises stress up to `inner_radius`
  double inner_radius = 0.0575;  ///< m
  double outer = 0.04;           ///< beyond, beside the wall
  double alternation = 1e-3;     ///< of a charge's pressure
  double ringing_share = 0.1;    ///< of these: what motion in time may be left, for the mean to count
};

/// `StressTargets::outer` of cases whose charge can slide on the wall.
inline constexpr double sliding_outer_target = 0.03;

/// A body at rest under a steady pressure on its base.
struct StaticCase {
  std::string name;         ///< for people
  std::string description;  ///< a sentence or two
  scene::Scene scene;       ///< its load rises and stays; the cell size is the caller's
  double pressure = 0;      ///< Pa, steady, on the base
  std::vector<StressStation> stations;
  std::vector<StressMeasures> exact;  ///< of every station, where there is a closed form
  StressTargets targets;
};

/// x (m) of the bottom of the charge; without one, of the base.
double bottom_of(const scene::Scene& scene);

/// The elastic shell under 50 MPa whose charge slides on wall, base and nose with a coefficient of friction.
StaticCase sliding_shell(double friction);
/// The same without friction on wall and nose, and with the base bonded.
StaticCase smooth_wall_shell();

/// The elastic shell under 50 MPa, the shell with a plastic wall under 496 MPa, a free bar, and the elastic
/// shell with contact.
std::vector<StaticCase> static_cases();

/// Finite elements on one mesh.
struct FiniteElementMeans {
  int elements = 0;
  std::vector<StressMeasures> means;  ///< of every station
  /// With contact: the largest change of a mean, as a share of it, from faces whose springs give a little to
  /// faces that do not, which the means are extrapolated to.
  double contact_correction = 0;
  double wall_time = 0;  ///< s
};

/// The particle computation on one mesh.
struct ParticleMeans {
  double cell_size = 0;  ///< m
  std::uint64_t particles = 0;
  std::string failure;                ///< why there are no means; empty where there are
  std::vector<StressMeasures> means;  ///< of every station, and over the last part of the run
  /// Largest departure of a station's value from that mean in time, as a share of it.
  double ringing_pressure = 0, ringing_von_mises = 0;
  /// Root mean square over the cells of all stations within `alternation_radius`, as a share of the
  /// pressure's: the fourth difference (p[j-2] - 4 p[j-1] + 6 p[j] - 4 p[j+1] + p[j+2])/16 along r, which is
  /// +-a where neighbours alternate by +-a, and 0 for a pressure that is cubic over five cells.
  double alternation = 0;
  double wall_time = 0;  ///< s
};

struct StaticComparison {
  StaticCase compared;
  FiniteElementMeans coarse, fine;  ///< the fine mesh has every element cut in four
  std::vector<ParticleMeans> meshes;
  /// What the particle computation is held against: closed form, else the fine finite elements.
  const std::vector<StressMeasures>& reference() const {
    return compared.exact.empty() ? fine.means : compared.exact;
  }
};

/// A sentence for every number that misses its target; empty where all are met.
std::vector<std::string> missed_targets(const StaticComparison& comparison);

/// Stresses of a thick tube under pressure inside, at its two faces.
struct TubeComparison {
  double exact_bore = 0, exact_outside = 0;        ///< hoop stress, Pa, after Lame
  double element_bore = 0, element_outside = 0;    ///< finite elements
  double particle_bore = 0, particle_outside = 0;  ///< particles
};

struct ComparisonOptions {
  std::vector<double> cell_sizes{2.5e-3, 1.25e-3};        ///< m
  const std::atomic<bool>* stop = nullptr;                ///< set from another thread to stop
  std::function<void(const std::string&)> progress = {};  ///< told what is being computed
};

/// The mesh of a case for finite elements: fine at the bottom and toward its edge, with lines along all
/// boxes. The charge's bulk modulus is that at rest.
FiniteElementModel finite_element_model(const StaticCase& compared);

/// Means of the particles of a case, from snapshots alone, on any mesh of rectangular cells with their
/// particles in the middle: the cells are those of the first snapshot, at rest; all others are averaged.
ParticleMeans particle_means(const StaticCase& compared, const std::vector<run::Snapshot>& snapshots);

/// Errors: those of run_finite_elements.
store::Result<StaticComparison> compare_static_stresses(const StaticCase& compared,
                                                        const ComparisonOptions& options = {});

/// The tube of 65/77.5 mm under 100 MPa in plane strain.
store::Result<TubeComparison> compare_tube(const ComparisonOptions& options = {});

}  // namespace launchsafe::verify
