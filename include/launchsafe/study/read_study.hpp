// A study from a file: what is asked of a scene, read and validated before anything is computed.
#pragma once

#include "launchsafe/math/sampling.hpp"
#include "launchsafe/scene/plausibility.hpp"
#include "launchsafe/scene/read_scene.hpp"
#include "launchsafe/scene/scene_keys.hpp"
#include "launchsafe/study/calibration_domain.hpp"
#include "launchsafe/study/cited_limit.hpp"
#include "launchsafe/study/model_form.hpp"
#include "launchsafe/verify/stress_test.hpp"

#include <cstddef>
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

enum class StudyKind { critical_gap, calibration, sweep, sensitivity, accuracy, stability };
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

/// A scene key with the values that it takes in one [[settings]] of an accuracy study.
struct SettingsAxis {
  scene::KeyDescription key;
  std::vector<scene::Value> values;
};

/// One [[case]] of a stability study: a launch that is extreme, or whose computation is, and what must hold.
struct HardLaunch {
  std::string group, name;
  std::string must_hold;                  ///< a sentence
  std::vector<verify::Outcome> expected;  ///< acceptable ones; empty: anything but WRONG
  /// Steps within which a broken computation must be caught; 0: any number.
  std::uint64_t caught_within = 0;
  std::vector<double> gaps;            ///< m, to judge; all on one run
  std::optional<std::size_t> run;      ///< of StudyFile::cases; none for a case of the reader
  std::optional<std::size_t> against;  ///< of StudyFile::cases: a safe computation of the same launch
  std::string must_refuse;             ///< a case of the reader: what its message must say; else empty
  std::string refusal;                 ///< what the reader said; empty where it took the scene
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
  bool calibrated = false;        ///< constants are fitted to the maximum temperature; otherwise a hold-out
  bool early_calibrated = false;  ///< the load is fitted to the temperature at Study::early_time
  bool selection = false;         ///< the rest of the row was used to choose the model, apart from T max
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
  std::vector<CitedLimit> cited_limits;  ///< kinds critical-gap and sweep
  std::string
      references_file;  ///< path of a file with the references, from the study file's folder; or empty

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
  /// none, or states one that does not apply; of several cases with settings of their own the largest.
  double numerical_uncertainty = not_a_number;
  bool numerical_uncertainty_assumed = false;

  // kind calibration
  std::vector<double> meshes;              ///< m, cell sizes; empty: the scene's
  bool compare_kinetics = false;           ///< calibrate with every named kinetics, not only the scene's
  double ignition_lowest = not_a_number;   ///< K, published bracket of the ignition temperature
  double ignition_highest = not_a_number;  ///< K
  /// s, two instants between which the published temperature without a gap rises fast; empty: the scene's
  /// load
  std::vector<double> fast_rise;

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

  // kind accuracy
  std::vector<double> reference_cell_sizes;         ///< m, finest first once read; at least three
  std::vector<std::vector<SettingsAxis>> settings;  ///< every combination within each
  std::vector<double> times;                        ///< s, at which temperatures are compared too

  // kind stability
  bool laws = true;  ///< the laws by themselves too (verify::law_stress_tests)

  // kinds that may use the record of a calibration
  std::string calibration_record;                   ///< path from the study file's folder; empty: none
  Calibration calibration = shipped_calibration();  ///< where the constants of the scene are known

  // kinds that give verdicts
  std::string model_form_record;                 ///< path from the study file's folder; empty: none
  std::optional<ModelFormRecord> model_form;     ///< what it says
  double model_form_uncertainty = not_a_number;  ///< K, of T max, instead of a record; NaN: not stated

  // kinds that may use the record of an accuracy study
  std::string accuracy;  ///< path of the record from the study file's folder; empty: none
  double setting_tolerance =
      not_a_number;  ///< K, of T max; picks a setting from the record; NaN: the scene's
  /// K, of T max by the calibrated constants on the rows that they were fitted to; NaN: not stated
  double fit_uncertainty = not_a_number;
  /// K, of T max by what is not known of the launch, for the study's own scene; NaN: not stated
  double input_uncertainty = not_a_number;

  /// What the study itself states, rather than its scene, and is not plausible; accepted or not.
  std::vector<scene::Implausible> implausible;
};

/// K. By so much was T max of the 155 mm shell seen to move between meshes of 1 to 10 mm with one set of
/// constants.
inline constexpr double assumed_numerical_uncertainty = 60.0;
/// K, on a grid that does not run along the charge, or with other than one particle a cell: the largest bound
/// that the record of the 155 mm shell has for such numerics is 99 K.
inline constexpr double assumed_uncertainty_off_grid = 100.0;

/// K, where no record of other models speaks of a launch: more than any alternative that counts moves T max
/// of the 155 mm shell, 0.0173 cm at 550 MPa, some 45 K (reports/model_form).
inline constexpr double assumed_model_form = 50.0;

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
  double numerical_uncertainty = assumed_numerical_uncertainty;  ///< K, of T max with these numerics
  /// K; the rise of T max above the initial temperature for which that was found; NaN where it holds for any.
  /// Hotter skins have proportionally larger errors.
  double rise_of_uncertainty = not_a_number;
  double pressure_ratio = 1.0;  ///< peak pressure over that of the study's scene
  scene::SceneFile scene;
};

/// Largest number of cases of a study.
inline constexpr std::size_t largest_case_count = 1'000'000;

/// A valid study with its scene and its cases.
struct StudyFile {
  Study study;
  std::string file;                              ///< as named by the user
  std::map<std::string, scene::Place> places;    ///< of every key the user gave
  std::map<std::string, std::string> overrides;  ///< [set]: scene key, value as people read it
  scene::SceneFile scene;                        ///< with the overrides
  std::string uncertainty_source;                ///< where the numerical uncertainty comes from, a clause
  std::string chosen_setting;  ///< what a tolerance picked from an accuracy record, for people; else empty
  /// critical-gap: pressures x crack radii x flaw sizes, the last fastest; calibration: the meshes; sweep:
  /// the axes, the last fastest; sensitivity: the evaluations of the design, in its order.
  std::vector<StudyCase> cases;
  std::size_t most_cases = largest_case_count;  ///< a study with more is refused
  std::vector<HardLaunch> launches;  ///< kind stability, in the order written; their runs are among the cases
};

/// What the command line adds to a study file.
struct StudyRequest {
  /// K; the cheapest setting of the study's accuracy record whose T max is known to that replaces the
  /// scene's.
  std::optional<double> tolerance;
  std::size_t most_cases = largest_case_count;  ///< a study with more is refused; each takes some 10 kB
};

/// Reads and validates a study file and its scene. Nothing is computed. Never throws.
scene::Expected<StudyFile> read_study(const std::filesystem::path& file, const StudyRequest& request = {});
/// The same from text; `file` is named in errors, and the scene is sought from its folder.
scene::Expected<StudyFile> parse_study(std::string_view text, const std::filesystem::path& file,
                                       const StudyRequest& request = {});

/// The keys of a study file and of its tables, "reference.gap" being that of one [[reference]], for
/// documentation. Sentences end with the kinds that a key belongs to, unless it belongs to all.
std::vector<scene::DocumentedKey> describe_study_keys();

}  // namespace launchsafe::study
