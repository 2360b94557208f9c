// A study from a file: what is asked of a scene, read and validated before anything is computed.
#pragma once

#include "launchsafe/math/sampling.hpp"
#include "launchsafe/scene/read_scene.hpp"
#include "launchsafe/scene/scene_keys.hpp"

#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace launchsafe::study {

inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

enum class StudyKind { critical_gap, calibration, sweep, sensitivity };
std::string to_string(StudyKind kind);

/// A scene key varied by a study.
struct Axis {
  std::string name;            ///< as the user wrote it: "peak_pressure" or "load.exponent"
  scene::KeyDescription key;   ///< of the scene key
  std::vector<double> values;  ///< SI; those of a sweep, in the order written
};

/// An axis of a sensitivity study: a scene key that is not known exactly.
struct UncertainInput {
  std::string name;  ///< as of Axis
  scene::KeyDescription key;
  math::Distribution distribution;  ///< SI
};

/// How a sensitivity study asks.
enum class SensitivityMethod {
  sobol,  ///< first- and total-order indices (Saltelli 2010, Jansen 1999): samples x (inputs + 2) evaluations
  morris  ///< elementary effects (Morris 1991): trajectories x (inputs + 1) evaluations, a cheap first look
};
std::string to_string(SensitivityMethod method);

/// A row of published results to compare with; what it does not say is NaN or empty.
struct Reference {
  double gap = not_a_number;                  ///< m, >= 0
  double maximum_temperature = not_a_number;  ///< K, over the whole launch
  std::string point;                          ///< where that was
  double early_temperature = not_a_number;    ///< K, highest at Study::early_time
  std::string early_point;                    ///< where that was
  double spread = not_a_number;               ///< K, highest minus lowest observation point at the end
  double early_spread = not_a_number;         ///< K, likewise at Study::early_time
  double ignition_time = not_a_number;        ///< s; NaN for a gap that did not ignite
  bool calibrated = false;                    ///< used to calibrate; otherwise a hold-out
  bool ignited() const { return ignition_time == ignition_time; }
};

/// Straight line of maximum temperature against gap as published: slope in K per cm (as printed), intercept
/// in K.
struct ReferenceLine {
  double slope = not_a_number;
  double intercept = not_a_number;
  bool given() const { return slope == slope && intercept == intercept; }
};

/// What a study file says, in SI.
struct Study {
  StudyKind kind = StudyKind::critical_gap;
  std::string title;
  std::string scene;          ///< path of the scene from the study file's folder, as the user wrote it
  double early_time = 10e-3;  ///< s; an instant at which temperatures are compared too
  std::vector<Reference> references;
  ReferenceLine reference_line;

  // every kind that judges gaps
  std::vector<double> gaps;  ///< m; those of the scene where the file has none; one for kind sensitivity

  // kind critical-gap
  std::vector<double> peak_pressures;  ///< Pa; empty: the scene's
  std::vector<double> crack_radii;     ///< m, c(0); empty: the scene's
  std::vector<double> flaw_sizes;      ///< m, a; empty: the scene's
  double tolerance = 1e-6;             ///< m, largest width of the bracket of the critical gap
  double largest_gap = 1e-3;           ///< m, where the search for the critical gap ends
  bool confirm = true;                 ///< complete coupled runs on both sides of the bracket
  /// K, of the maximum temperature, from a mesh study. `assumed_numerical_uncertainty` where the file states
  /// none, or states one that does not apply (see `settle_numerical_uncertainty`).
  double numerical_uncertainty = not_a_number;
  bool numerical_uncertainty_assumed = false;

  // kind calibration
  std::vector<double> meshes;              ///< m, cell sizes; empty: the scene's
  bool compare_kinetics = false;           ///< calibrate with every named kinetics, not only the scene's
  double ignition_lowest = not_a_number;   ///< K, published bracket of the ignition temperature
  double ignition_highest = not_a_number;  ///< K

  // kind sweep
  std::vector<Axis> axes;  ///< all but the gap, in the order written

  // kind sensitivity
  SensitivityMethod method = SensitivityMethod::sobol;
  std::vector<UncertainInput> inputs;
  math::Design design = math::Design::latin_hypercube;
  int samples = 64;        ///< N: rows of the matrices A and B
  int trajectories = 10;   ///< of Morris
  int levels = 4;          ///< of Morris, even
  std::uint64_t seed = 1;  ///< of design and bootstrap
  int resamples = 1000;    ///< of the bootstrap
  double confidence = 0.95;
};

/// One mechanical run of a study: a complete, valid scene.
struct StudyCase {
  std::string label;           ///< "496 MPa, 30 um, 1 mm", or "2.5 mm" for the mesh of a calibration
  double peak_pressure = 0;    ///< Pa
  double crack_radius = 0;     ///< m
  double flaw_size = 0;        ///< m
  double cell_size = 0;        ///< m
  bool own_conditions = true;  ///< the load and defect of the study's scene, which the references belong to
  /// SI; of Study::axes or Study::inputs, in their order; empty for the other kinds
  std::vector<double> coordinates;
  scene::SceneFile scene;
};

/// K. By so much was T max of the 155 mm shell seen to move between meshes of 1 to 10 mm with one set of
/// constants.
inline constexpr double assumed_numerical_uncertainty = 60.0;

/// A valid study with its scene and its cases.
struct StudyFile {
  Study study;
  std::string file;                              ///< as named by the user
  std::map<std::string, scene::Place> places;    ///< of every key the user gave
  std::map<std::string, std::string> overrides;  ///< [set]: scene key, value as people read it
  scene::SceneFile scene;                        ///< with the overrides
  /// critical-gap: pressures x crack radii x flaw sizes, the last fastest; calibration: the meshes; sweep:
  /// the axes, the last fastest; sensitivity: the evaluations of the design, in its order.
  std::vector<StudyCase> cases;
};

/// Reads and validates a study file and its scene. Nothing is computed. Never throws.
scene::Expected<StudyFile> read_study(const std::filesystem::path& file);
/// The same from text; `file` is named in errors, and the scene is sought from its folder.
scene::Expected<StudyFile> parse_study(std::string_view text, const std::filesystem::path& file);

/// The keys of a study file and of its tables, "reference.gap" being that of one [[reference]], for
/// documentation. Sentences end with the kinds that a key belongs to, unless it belongs to all.
std::vector<scene::DocumentedKey> describe_study_keys();

}  // namespace launchsafe::study
