// A study as read from its file: what is asked of a scene, and the cases that follow. What cases differ in is
// kept, and a case is made when it is asked for.
#pragma once

#include "launchsafe/math/numbers.hpp"
#include "launchsafe/math/sampling.hpp"
#include "launchsafe/scene/constants.hpp"
#include "launchsafe/study/gap_search.hpp"

#include <boost/iterator/counting_iterator.hpp>
#include <boost/iterator/transform_iterator.hpp>

#include <any>
#include <numeric>

namespace launchsafe::study {

using math::not_a_number;

/// What a member, or a function, says of each of several.
template <class Range, class Member>
auto of_each(const Range& all, Member member) {
  std::vector<std::decay_t<std::invoke_result_t<Member, decltype(*all.begin())>>> values;
  for (const auto& each : all) values.push_back(std::invoke(member, each));
  return values;
}

/// The places of so many by a number of each, the smallest first; those with equal numbers stay as they are.
template <class Number>
std::vector<std::size_t> places_by(std::size_t count, Number number) {
  std::vector<std::size_t> places(count);
  std::iota(places.begin(), places.end(), std::size_t{0});
  std::ranges::stable_sort(places, {}, number);
  return places;
}

/// One mechanical run of a study: a complete, valid scene.
struct StudyCase {
  std::string label;           ///< "496 MPa, 30 µm, 1 mm"
  double peak_pressure = 0;    ///< Pa
  bool own_conditions = true;  ///< the load and defect of the study's scene, which the references belong to
  std::vector<double> coordinates;  ///< SI, of Study::axes
  scene::SceneFile scene;
  /// Of its scene.
  const materials::ViscoScramParameters& strength() const { return scene.scene.charge().strength; }
  bool has_defect(const materials::ViscoScramParameters& other) const {
    return strength().initial_crack_radius == other.initial_crack_radius &&
           strength().flaw_size == other.flaw_size;
  }
  double cell_size() const { return scene.scene.numerics.cell_size; }  ///< m
};

/// The cases of a study in their order. A study may have a million: of those that vary keys of one scene it
/// holds labels and values alone.
class Cases {
 public:
  /// Makes the case of these values (SI, of Study::axes), which was found valid before; its label is not set.
  using Make = std::function<StudyCase(const std::vector<double>& coordinates)>;

  std::size_t size() const { return rows_.size(); }
  bool empty() const { return rows_.empty(); }
  /// Made anew each time, in some 0.1 ms.
  const StudyCase operator[](std::size_t index) const;
  const StudyCase front() const { return (*this)[0]; }
  const StudyCase back() const { return (*this)[size() - 1]; }
  const std::string& label(std::size_t index) const { return rows_[index].label; }
  /// Of Study::axes, SI.
  const std::vector<double>& coordinates(std::size_t index) const { return rows_[index].coordinates; }

  void make_with(Make make) { make_ = std::move(make); }
  void add(std::string label, std::vector<double> coordinates);
  /// A case with a scene of its own.
  void add(StudyCase made);
  void replace(std::size_t index, StudyCase made);
  void relabel(std::size_t index, std::string label) { rows_[index].label = std::move(label); }

  auto iterator_at(std::size_t index) const {
    return boost::make_transform_iterator(boost::make_counting_iterator(index),
                                          [this](std::size_t i) { return (*this)[i]; });
  }
  auto begin() const { return iterator_at(0); }
  auto end() const { return iterator_at(size()); }

 private:
  struct Row {
    std::string label;
    std::vector<double> coordinates;
    std::shared_ptr<const StudyCase> own;  ///< with a scene of its own
  };

  std::vector<Row> rows_;
  Make make_;
};

/// What the engine has to know of a kind of study.
struct KindTraits {
  std::string name;         ///< as in `kind = "critical-gap"`
  bool judges_gaps = true;  ///< those of its study file or scene
  /// Its gaps get verdicts: each case has launches beside its own for the bounds of its critical gap, and
  /// constants come from a constants file alone. Other kinds compare numbers.
  bool gives_verdicts = true;
  bool own_scenes = false;  ///< cases may bring scenes of their own
  /// Gaps of cases with two-way coupling are run through ignition too.
  bool goes_through_ignition = false;
};

/// A scene key that the cases of a study vary.
struct Axis {
  std::string name;            ///< "peak_pressure" or, of a key without a short name, "load.exponent"
  std::string study_key;       ///< where in the study file it was asked for: "vary.0.key"
  scene::KeyDescription key;   ///< of the scene key
  std::vector<double> values;  ///< SI, in the order written; none where there is a distribution
  std::optional<math::Distribution> distribution = {};  ///< SI, of a value that is not known exactly
  std::string values_key = {};  ///< what in the study file bounds its values; empty: `study_key`
};

/// Whether constants were fitted to a published number, or it checks them.
enum class Use { check, fitted };
std::string to_string(Use use);

/// A row of published results to compare with; what it does not say is NaN or empty.
struct Reference {
  double gap = not_a_number;                  ///< m, >= 0
  std::string scene;                          ///< of its launch: a path from the folder of the row's file
  double maximum_temperature = not_a_number;  ///< K, until the exit, or over the whole launch without one
  std::string point;                          ///< where that was
  double early_temperature = not_a_number;    ///< K, highest at Study::early_time
  std::string early_point;                    ///< where that was
  double spread = not_a_number;         ///< K, highest minus lowest observation point at the exit, or the end
  double early_spread = not_a_number;   ///< K, likewise at Study::early_time
  double ignition_time = not_a_number;  ///< s; NaN for a gap that did not ignite
  double rise_begins = not_a_number;    ///< s, from when on the temperature rises fast
  double rise_ends = not_a_number;      ///< s, until when
  bool ignited() const { return ignition_time == ignition_time; }
};

/// What is not known of a launch: two standard deviations each. A share of 0 leaves its cause out.
struct Spreads {
  double peak_pressure = 0.04;        ///< share, from round to round
  double pulse_length = 0.05;         ///< share, at the same peak
  double initial_temperature = 12.0;  ///< K
};

/// Error of T max by cells and steps, K, stated in place of a companion launch.
struct StatedNumerics {
  double error = not_a_number;  ///< K; NaN: not stated
  std::string because;          ///< the ground, in words
  bool is_stated() const { return error == error; }
};

/// What a study file says, in SI.
struct Study {
  KindTraits kind;
  /// What the kind alone asks (`kinds::settings_of`); shared by copies until one is changed; null: the
  /// defaults.
  std::shared_ptr<std::any> settings;
  std::string title;
  std::string scene;          ///< path of the scene from the study file's folder, as the user wrote it
  double early_time = 10e-3;  ///< s; an instant at which temperatures are compared too
  std::vector<Reference> references;
  std::string references_file;  ///< path of a file with them, from the study file's folder; or empty

  // every kind that judges gaps
  std::vector<double> gaps;  ///< m; those of the scene where the file has none

  /// Histories of all cases are kept for the report.
  bool in_detail = false;

  std::vector<Axis> axes;              ///< of a full factorial the last is the fastest; none for other kinds
  double largest_gap = widest_search;  ///< m, where the search for the critical gap ends
  /// m: beyond all gaps of the study.
  double end_of_search() const {
    return gaps.empty() ? largest_gap : std::max(largest_gap, std::ranges::max(gaps));
  }

  /// Name or path (from the study file's folder) of a constants file; empty: that of the scene.
  std::string constants;

  // kinds that give verdicts
  Spreads spreads;
  StatedNumerics numerics;
  std::string model_names;  ///< of constants files, "a, b": names, or paths from the study file's folder
  /// Constants from these files: every case is launched under each of them too.
  std::vector<std::shared_ptr<const scene::Constants>> models;
  /// Reasons for which warnings, and intervals of the constants, are accepted; by their names.
  std::map<std::string, std::string> accepted_warnings, accepted_extrapolation;
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
  /// SHA-256 of every file that the study rests on besides its scene: another one is another study.
  std::vector<std::string> records;
  Cases cases;                                  ///< in the order that the kind says
  std::size_t most_cases = largest_case_count;  ///< a study with more is refused
  std::size_t confirmations_per_case = 0;       ///< coupled runs that may follow once its gaps are judged
};

/// As in scene files.
std::string to_string(scene::FrictionClosure closure);

}  // namespace launchsafe::study
