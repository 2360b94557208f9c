#include "launchsafe/study/study_cases.hpp"

#include "launchsafe/study/study_axes.hpp"

#include <fmt/format.h>

#include <utility>

namespace launchsafe::study {
namespace {

using scene::SceneFile;

/// What one value of an axis does to scene and label.
struct Step {
  Change change;
  double value = 0;  ///< SI
  std::string label;
};
using Steps = std::vector<Step>;

Steps steps_of(const StudyFile& study, const Axis& axis) {
  Steps steps;
  for (const double value : axis.values) {
    const std::string text = scene::format_value(axis.key, value);
    steps.push_back({{axis.key.name, value, text, axis.study_key, place_of_key(study, axis.study_key)},
                     value,
                     axis.name + " " + text});
  }
  return steps;
}

/// Whether other values of a key make another launch, and not only another computation of the same one.
bool is_condition(const scene::KeyDescription& key) {
  return key.standing != scene::Standing::calibrated && !key.name.starts_with("numerics.") &&
         !key.name.starts_with("output.") && !key.name.starts_with("physics.");
}

/// One step of every axis: the place in their product, the last axis fastest.
std::vector<const Step*> steps_at(const std::vector<Steps>& axes, std::size_t place) {
  std::vector<const Step*> steps(axes.size());
  for (std::size_t i = axes.size(); i-- > 0; place /= axes[i].size())
    steps[i] = &axes[i][place % axes[i].size()];
  return steps;
}

}  // namespace

StudyCase case_of(std::string label, SceneFile scene) {
  const scene::Scene& s = scene.scene;
  StudyCase made;
  made.label = std::move(label);
  made.peak_pressure = scene::PressureHistory(s.load).stated_peak();
  made.crack_radius = s.charge().strength.initial_crack_radius;
  made.flaw_size = s.charge().strength.flaw_size;
  made.cell_size = s.numerics.cell_size;
  made.own_conditions = false;
  made.scene = std::move(scene);
  return made;
}

SceneFile without_places(SceneFile scene) {
  scene.places.clear();
  return scene;
}

CaseMaker::CaseMaker(StudyFile& study)
    : study_(study), own_peak_(scene::PressureHistory(study.scene.scene.load).stated_peak()) {
  for (const Axis& axis : study.study.axes) {
    own_.push_back(number_in(study.scene, axis.key.name));
    condition_.push_back(is_condition(axis.key));
  }
}

void CaseMaker::add(std::string label, std::vector<double> coordinates, SceneFile scene) {
  StudyCase made = case_of(std::move(label), std::move(scene));
  made.pressure_ratio = made.peak_pressure / own_peak_;
  made.coordinates = std::move(coordinates);
  made.own_conditions = is_own(made);
  study_.cases.push_back(std::move(made));
}

bool CaseMaker::is_own(const StudyCase& made) const {
  const materials::ViscoScramParameters& own = study_.scene.scene.charge().strength;
  for (std::size_t i = 0; i < made.coordinates.size(); ++i) {
    if (condition_[i] && made.coordinates[i] != own_[i]) return false;
  }
  return made.peak_pressure == own_peak_ && made.crack_radius == own.initial_crack_radius &&
         made.flaw_size == own.flaw_size;
}

std::string launch_label(const StudyCase& made, const std::string&) {
  return fmt::format("{:.6g} MPa, {:.6g} um, {:.6g} mm", 1e-6 * made.peak_pressure, 1e6 * made.crack_radius,
                     1e3 * made.flaw_size);
}

Fault make_factorial(StudyFile& study, LabelOf label) {
  std::vector<Steps> axes;
  double count = 1.0;
  std::vector<std::string> sizes;
  for (const Axis& axis : study.study.axes) {
    axes.push_back(steps_of(study, axis));
    count *= static_cast<double>(axis.values.size());
    sizes.push_back(fmt::format("{} of {}", axis.values.size(), axis.study_key));
  }
  const std::string key = axes.empty() ? std::string{} : study.study.axes.front().study_key;
  if (Fault fault = check_count(study, key, count, fmt::format("{}", fmt::join(sizes, " x ")))) return fault;
  study.cases.reserve(static_cast<std::size_t>(count));
  const SceneFile start = without_places(study.scene);
  CaseMaker maker(study);
  for (std::size_t place = 0; place < static_cast<std::size_t>(count); ++place) {
    std::vector<Change> changes;
    std::vector<double> coordinates;
    std::string text;
    for (const Step* step : steps_at(axes, place)) {
      changes.push_back(step->change);
      coordinates.push_back(step->value);
      text += (text.empty() ? "" : ", ") + step->label;
    }
    auto scene = with_changes(start, changes);
    if (!scene) return scene.error();
    maker.add({}, std::move(coordinates), std::move(*scene));
    study.cases.back().label = label(study.cases.back(), text);
  }
  return std::nullopt;
}

Fault check_count(const StudyFile& study, const std::string& key, double count, const std::string& what) {
  if (count <= static_cast<double>(study.most_cases)) return std::nullopt;
  return fault_at(study, key, fmt::format("{:.0f} mechanical runs, {}", count, what),
                  fmt::format("at most {} mechanical runs", study.most_cases));
}

Fault settle_gaps(StudyFile& study) {
  const std::string& key = study.study.kind.gaps_key;
  if (key.empty() || !study.study.gaps.empty()) return std::nullopt;
  study.study.gaps = study.scene.scene.surface.gaps;
  if (!study.study.gaps.empty()) return std::nullopt;
  return fault_at(study, key, "no gap", "at least one gap, in the study or its scene");
}

}  // namespace launchsafe::study
