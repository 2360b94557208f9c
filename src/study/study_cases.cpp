#include "study_cases.hpp"

#include "changed_scene.hpp"
#include "launchsafe/math/sensitivity.hpp"
#include "launchsafe/study/calibration.hpp"
#include "study_axes.hpp"
#include "study_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace launchsafe::study::detail {
namespace {

using scene::SceneFile;

/// The scene that cases start from, without the places of its geometry: there may be many cases, and nothing
/// can be wrong with a geometry that no case changes.
SceneFile lean(SceneFile scene) {
  scene.places.clear();
  return scene;
}

/// What one value of an axis does to scene and label.
struct Step {
  Change change;
  double value = 0;  ///< SI
  std::string label;
};
using Steps = std::vector<Step>;

Steps steps_of(const StudyFile& study, const std::string& study_key, const std::string& name,
               const scene::KeyDescription& key, const std::vector<double>& values) {
  Steps steps;
  for (const double value : values) {
    const std::string text = scene::format_value(key, value);
    steps.push_back(
        {{key.name, value, text, study_key, place_of_key(study, study_key)}, value, name + " " + text});
  }
  return steps;
}

/// The steps of a list of the study; none where it is empty, and the scene's value stays.
void add_list(std::vector<Steps>& axes, const StudyFile& study, const std::string& list, const char* key,
              const std::vector<double>& values) {
  if (values.empty()) return;
  const auto description = varied_key(study, key, list, place_of_key(study, list));
  axes.push_back(steps_of(study, list, key, *description, values));
}

std::vector<Steps> axes_of(const StudyFile& study) {
  const Study& s = study.study;
  std::vector<Steps> axes;
  add_list(axes, study, "meshes", "numerics.cell_size", s.meshes);
  add_list(axes, study, "peak_pressures", "load.peak", s.peak_pressures);
  add_list(axes, study, "crack_radii", "charge.crack_radius", s.crack_radii);
  add_list(axes, study, "flaw_sizes", "charge.flaw_size", s.flaw_sizes);
  for (const Axis& axis : s.axes)
    axes.push_back(steps_of(study, "axes." + axis.name, axis.name, axis.key, axis.values));
  return axes;
}

/// "496 MPa, 30 um, 1 mm", or "2.5 mm" for the mesh of a calibration.
std::string plain_label(StudyKind kind, const StudyCase& made) {
  if (kind == StudyKind::calibration) return fmt::format("{:.6g} mm", 1e3 * made.cell_size);
  return fmt::format("{:.6g} MPa, {:.6g} um, {:.6g} mm", 1e-6 * made.peak_pressure, 1e6 * made.crack_radius,
                     1e3 * made.flaw_size);
}

/// Whether other values of a key make another launch, and not only another computation of the same one.
bool is_condition(const scene::KeyDescription& key) {
  return key.standing != scene::Standing::calibrated && !key.name.starts_with("numerics.") &&
         !key.name.starts_with("output.") && !key.name.starts_with("physics.");
}

/// Makes cases of valid scenes.
class CaseMaker {
 public:
  explicit CaseMaker(StudyFile& study)
      : study_(study), own_peak_(scene::PressureHistory(study.scene.scene.load).stated_peak()) {
    for (const Axis& axis : study.study.axes) add_key(axis.key);
    for (const UncertainInput& input : study.study.inputs) add_key(input.key);
  }

  /// An empty label: that of the load and defect.
  void add(std::string label, std::vector<double> coordinates, SceneFile scene) {
    const scene::Scene& s = scene.scene;
    const materials::ViscoScramParameters& strength = s.charge().strength;
    StudyCase made;
    made.peak_pressure = scene::PressureHistory(s.load).stated_peak();
    made.pressure_ratio = made.peak_pressure / own_peak_;
    made.crack_radius = strength.initial_crack_radius;
    made.flaw_size = strength.flaw_size;
    made.cell_size = s.numerics.cell_size;
    made.own_conditions = is_own(made, coordinates);
    made.label = label.empty() ? plain_label(study_.study.kind, made) : std::move(label);
    made.coordinates = std::move(coordinates);
    made.scene = std::move(scene);
    study_.cases.push_back(std::move(made));
  }

 private:
  void add_key(const scene::KeyDescription& key) {
    own_.push_back(number_in(study_.scene, key.name));
    condition_.push_back(is_condition(key));
  }

  bool is_own(const StudyCase& made, const std::vector<double>& coordinates) const {
    const materials::ViscoScramParameters& own = study_.scene.scene.charge().strength;
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
      if (condition_[i] && coordinates[i] != own_[i]) return false;
    }
    return made.peak_pressure == own_peak_ && made.crack_radius == own.initial_crack_radius &&
           made.flaw_size == own.flaw_size;
  }

  StudyFile& study_;
  double own_peak_;
  std::vector<double> own_;      ///< of the axes or inputs in the study's scene, SI
  std::vector<bool> condition_;  ///< of the axes or inputs
};

/// Walks through the product of the axes, the last one fastest; what a branch has in common is done once.
class FactorialBuilder {
 public:
  FactorialBuilder(StudyFile& study, std::vector<Steps> axes)
      : maker_(study), axes_(std::move(axes)), labelled_(study.study.kind == StudyKind::sweep) {}

  Fault build(ChangedScene scene, const std::string& label, std::vector<double> coordinates) {
    const std::size_t depth = coordinates.size();
    if (depth == axes_.size()) {
      if (!scene.complete()) return scene.error();
      maker_.add(labelled_ ? label : std::string{},
                 labelled_ ? std::move(coordinates) : std::vector<double>{}, scene.take());
      return std::nullopt;
    }
    coordinates.push_back(0.0);
    for (const Step& step : axes_[depth]) {
      ChangedScene changed = scene;
      changed.apply(step.change);
      coordinates.back() = step.value;
      if (Fault fault =
              build(std::move(changed), label.empty() ? step.label : label + ", " + step.label, coordinates))
        return fault;
    }
    return std::nullopt;
  }

 private:
  CaseMaker maker_;
  std::vector<Steps> axes_;
  bool labelled_;
};

Fault check_count(const StudyFile& study, const std::string& key, double count, const std::string& what) {
  if (count <= static_cast<double>(study.most_cases)) return std::nullopt;
  return fault_at(study, key, fmt::format("{:.0f} mechanical runs, {}", count, what),
                  fmt::format("at most {} mechanical runs", study.most_cases));
}

Fault make_factorial(StudyFile& study) {
  std::vector<Steps> axes = axes_of(study);
  double count = 1.0;
  std::vector<std::string> sizes;
  for (const Steps& steps : axes) {
    count *= static_cast<double>(steps.size());
    sizes.push_back(fmt::format("{} of {}", steps.size(), steps.front().change.study_key));
  }
  const std::string key = axes.empty() ? std::string{} : axes.front().front().change.study_key;
  if (Fault fault = check_count(study, key, count, fmt::format("{}", fmt::join(sizes, " x ")))) return fault;
  study.cases.reserve(static_cast<std::size_t>(count));
  const ChangedScene start(lean(study.scene));
  return FactorialBuilder(study, std::move(axes)).build(start, "", {});
}

std::string input_key(std::size_t input, const char* key) { return fmt::format("input.{}.{}", input, key); }

/// Builds the cases of a design. Most evaluations differ from an earlier one in a single input.
class DesignBuilder {
 public:
  explicit DesignBuilder(StudyFile& study) : study_(study), maker_(study), start_(lean(study.scene)) {}

  /// The next evaluation at a point of the unit cube; `alike` is an earlier one that it resembles, or
  /// nullptr.
  Fault add(std::string label, const std::vector<double>& unit_point, const StudyCase* alike) {
    const std::vector<UncertainInput>& inputs = study_.study.inputs;
    std::vector<double> coordinates = coordinates_of(inputs, unit_point);
    ChangedScene scene(alike ? alike->scene : start_);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      if (alike && alike->coordinates[i] == coordinates[i]) continue;
      if (Fault fault = check_limits(i, coordinates[i])) return fault;
      scene.apply(change_of(i, coordinates[i]));
    }
    if (!scene.complete()) return named(scene.error());
    maker_.add(std::move(label), std::move(coordinates), scene.take());
    return std::nullopt;
  }

 private:
  /// Beyond four deviations a normal without a range may still leave the limits of its key.
  Fault check_limits(std::size_t input, double value) const {
    const scene::KeyDescription& key = study_.study.inputs[input].key;
    if (key.limits.contain(value)) return std::nullopt;
    return named(fault_at(study_, input_key(input, "deviation"),
                          fmt::format("a sample of {}", scene::format_quantity(value, key.dimension)),
                          "a range that cuts the normal off: " + scene::allowed_text(key)));
  }

  Change change_of(std::size_t input, double value) const {
    const scene::KeyDescription& key = study_.study.inputs[input].key;
    const bool cut = study_.places.contains(input_key(input, "range"));
    const std::string study_key = input_key(input, cut ? "range" : "deviation");
    return {key.name, value, scene::format_value(key, value), study_key, place_of_key(study_, study_key)};
  }

  /// People do not number their inputs.
  static scene::InputError named(scene::InputError error) {
    error.key = "input" + error.key.substr(error.key.rfind('.'));
    return error;
  }

  StudyFile& study_;
  CaseMaker maker_;
  SceneFile start_;
};

Fault make_saltelli(StudyFile& study) {
  const Study& s = study.study;
  const std::size_t rows = static_cast<std::size_t>(s.samples), inputs = s.inputs.size();
  const double count = static_cast<double>(rows) * static_cast<double>(inputs + 2);
  if (Fault fault =
          check_count(study, "samples", count, fmt::format("{} samples x ({} inputs + 2)", rows, inputs)))
    return fault;
  study.cases.reserve(rows * (inputs + 2));
  const math::SaltelliDesign design = math::saltelli_design(s.design, rows, inputs, s.seed);
  DesignBuilder builder(study);
  for (std::size_t evaluation = 0; evaluation < design.evaluations(); ++evaluation) {
    const std::size_t row = evaluation / design.blocks(), block = evaluation % design.blocks();
    const bool mixed = block != design.block_a && block != design.block_b;
    const std::string name = mixed                     ? fmt::format("AB({})", s.inputs[block - 2].name)
                             : block == design.block_a ? "A"
                                                       : "B";
    const StudyCase* alike = mixed ? &study.cases[design.index(design.block_a, row)] : nullptr;
    if (Fault fault =
            builder.add(fmt::format("sample {} of {}", row + 1, name), design.point(evaluation), alike))
      return fault;
  }
  return std::nullopt;
}

Fault make_morris(StudyFile& study) {
  const Study& s = study.study;
  const std::size_t trajectories = static_cast<std::size_t>(s.trajectories), inputs = s.inputs.size();
  const double count = static_cast<double>(trajectories) * static_cast<double>(inputs + 1);
  if (Fault fault = check_count(study, "trajectories", count,
                                fmt::format("{} trajectories x ({} inputs + 1)", trajectories, inputs)))
    return fault;
  study.cases.reserve(trajectories * (inputs + 1));
  const auto levels = static_cast<std::size_t>(s.levels);
  const math::MorrisDesign design = math::morris_design(trajectories, levels, inputs, s.seed);
  DesignBuilder builder(study);
  for (std::size_t evaluation = 0; evaluation < design.evaluations(); ++evaluation) {
    const std::size_t trajectory = evaluation / (inputs + 1), step = evaluation % (inputs + 1);
    std::string label = fmt::format("trajectory {}, start", trajectory + 1);
    const StudyCase* alike = nullptr;
    if (step > 0) {
      const std::size_t changed = design.changed[trajectory * inputs + step - 1];
      label = fmt::format("trajectory {}, step {} ({})", trajectory + 1, step, s.inputs[changed].name);
      alike = &study.cases.back();
    }
    if (Fault fault = builder.add(std::move(label), design.point(evaluation), alike)) return fault;
  }
  return std::nullopt;
}

/// Gaps of a study that judges them: its own, else the scene's.
Fault settle_gaps(StudyFile& study) {
  Study& s = study.study;
  if (!s.gaps.empty()) return std::nullopt;
  s.gaps = study.scene.scene.surface.gaps;
  const bool one = s.kind == StudyKind::sensitivity;
  if (s.gaps.empty()) {
    return fault_at(study,
                    one                          ? "gap"
                    : s.kind == StudyKind::sweep ? "axes.gap"
                                                 : "gaps",
                    "no gap", one ? "one gap" : "at least one gap, in the study or its scene");
  }
  if (!one || s.gaps.size() == 1) return std::nullopt;
  const std::string last = scene::format_quantity(s.gaps.back(), scene::Dimension::length);
  return fault_at(study, "gap", fmt::format("no gap, and {} gaps in the scene", s.gaps.size()), "one gap",
                  fmt::format("gap = \"{}\"", last));
}

}  // namespace

std::vector<double> coordinates_of(const std::vector<UncertainInput>& inputs,
                                   const std::vector<double>& unit_point) {
  std::vector<double> coordinates;
  for (std::size_t i = 0; i < inputs.size(); ++i)
    coordinates.push_back(math::quantile(inputs[i].distribution, unit_point[i]));
  return coordinates;
}

Fault make_cases(StudyFile& study) {
  if (study.study.kind == StudyKind::calibration) {
    if (auto targets = calibration_targets(study); !targets) return targets.error();
    return make_factorial(study);
  }
  if (Fault fault = settle_gaps(study)) return fault;
  if (study.study.kind == StudyKind::accuracy) return make_accuracy_cases(study);
  if (study.study.kind == StudyKind::stability) return std::nullopt;  // each has a scene of its own
  if (study.study.kind != StudyKind::sensitivity) return make_factorial(study);
  return study.study.method == SensitivityMethod::sobol ? make_saltelli(study) : make_morris(study);
}

}  // namespace launchsafe::study::detail
