// The cases of a study: what they differ in is kept, and a case is made when it is asked for.
#pragma once

#include "launchsafe/scene/read_scene.hpp"

#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace launchsafe::study {

inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// K. By so much was T max of the 155 mm shell seen to move between meshes of 1 to 10 mm with one set of
/// constants.
inline constexpr double assumed_numerical_uncertainty = 60.0;
/// One mechanical run of a study: a complete, valid scene.
struct StudyCase {
  std::string label;           ///< "496 MPa, 30 µm, 1 mm", or "2.5 mm" for the mesh of a calibration
  double peak_pressure = 0;    ///< Pa
  double crack_radius = 0;     ///< m
  double flaw_size = 0;        ///< m
  double cell_size = 0;        ///< m
  bool own_conditions = true;  ///< the load and defect of the study's scene, which the references belong to
  std::vector<double> coordinates;                               ///< SI, of Study::axes
  double numerical_uncertainty = assumed_numerical_uncertainty;  ///< K, of T max with these numerics
  bool numerical_uncertainty_assumed = false;  ///< neither stated for these numerics nor of a record
  std::string why_assumed;                     ///< what of a record does not hold here, a clause
  /// K; the rise of T max above the initial temperature for which that was found; NaN where it holds for any.
  /// Hotter skins have proportionally larger errors.
  double rise_of_uncertainty = not_a_number;
  /// m, up to which that holds; beyond, it is the assumed one at the least.
  double covered_gap = std::numeric_limits<double>::infinity();
  double pressure_ratio = 1.0;  ///< peak pressure over that of the study's scene
  scene::SceneFile scene;
  /// The terms of a gap that closes, where it does: the scene has the reservoir beside which they are looked
  /// at.
  std::optional<scene::Surface> closing;
  /// K, the bound that an accuracy record has for this case; NaN where it has none or none was taken.
  double recorded_uncertainty() const {
    const bool is_recorded = rise_of_uncertainty == rise_of_uncertainty && !numerical_uncertainty_assumed;
    return is_recorded ? numerical_uncertainty : not_a_number;
  }
};

/// The scene in which the gap of a case closes, on its own terms; the scene of one without such.
scene::Scene closing_scene(const StudyCase& input);

/// The cases of a study in their order. A study may have a million: of those that vary keys of one scene it
/// holds labels and values alone.
class Cases {
 public:
  /// Makes the case of these values (SI, of Study::axes), which was found valid before; its label is not set.
  using Make = std::function<StudyCase(const std::vector<double>& coordinates)>;
  /// Fills what is known of a case besides its scene.
  using Complete = std::function<void(StudyCase& made)>;

  std::size_t size() const { return rows_.size(); }
  bool empty() const { return rows_.empty(); }
  /// Made anew each time, in some 0.1 ms.
  const StudyCase operator[](std::size_t index) const;
  const StudyCase front() const { return (*this)[0]; }
  const StudyCase back() const { return (*this)[size() - 1]; }
  const std::string& label(std::size_t index) const { return rows_[index].label; }
  /// Of Study::axes, SI.
  const std::vector<double>& coordinates(std::size_t index) const { return rows_[index].coordinates; }
  /// Rather than one that follows from its coordinates.
  bool has_own_scene(std::size_t index) const { return rows_[index].own != nullptr; }

  void make_with(Make make) { make_ = std::move(make); }
  void complete_with(Complete complete) { complete_ = std::move(complete); }
  void reserve(std::size_t count) { rows_.reserve(count); }
  void add(std::string label, std::vector<double> coordinates);
  /// A case with a scene of its own.
  void add(StudyCase made);
  void replace(std::size_t index, StudyCase made);
  void relabel(std::size_t index, std::string label) { rows_[index].label = std::move(label); }

  class Iterator {
   public:
    using value_type = StudyCase;
    using difference_type = std::ptrdiff_t;
    Iterator(const Cases& cases, std::size_t index) : cases_(&cases), index_(index) {}
    const StudyCase operator*() const { return (*cases_)[index_]; }
    Iterator& operator++() {
      ++index_;
      return *this;
    }
    bool operator==(const Iterator&) const = default;

   private:
    const Cases* cases_;
    std::size_t index_;
  };
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, size()}; }

 private:
  struct Row {
    std::string label;
    std::vector<double> coordinates;
    std::shared_ptr<const StudyCase> own;  ///< with a scene of its own
  };

  std::vector<Row> rows_;
  Make make_;
  Complete complete_;
};

}  // namespace launchsafe::study
