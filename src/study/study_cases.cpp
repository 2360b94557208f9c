#include "launchsafe/study/study_cases.hpp"

#include <tbb/parallel_for.h>

#include <cassert>

namespace launchsafe::study {
namespace {

using scene::SceneFile;

SceneFile with_all(const SceneFile& scene, const std::vector<Change>& changes) {
  return scene::with_keys(scene, {changes.begin(), changes.end()});
}

/// The change that a fault of all together is about: of the key that it names, else the first.
const Change& change_at_fault(const std::vector<Change>& changes, const scene::InputError& error) {
  const auto named = std::ranges::find(changes, error.key, &Change::name);
  return named != changes.end() ? *named : changes.front();
}

/// Whether other values of a key make another launch, and not only another computation of the same one.
bool is_condition(const scene::KeyDescription& key) {
  const auto begins = [&](const char* prefix) { return key.name.starts_with(prefix); };
  return key.name != gap_key && key.standing != scene::Standing::calibrated &&
         key.acts_on != keys::ActsOn::nothing && key.acts_on != keys::ActsOn::numerics &&
         !begins("numerics.") && !begins("output.") && !begins("physics.");
}

/// What varied cases are made from.
struct Start {
  SceneFile scene;
  std::vector<Axis> axes;
  std::vector<bool> condition;  ///< of the axes: another value is another launch
  double peak = 0;              ///< Pa, of the scene
};

/// There may be many cases, and nothing can be wrong with a geometry that no case changes: its places are
/// left out.
Start start_of(const StudyFile& study) {
  Start start{
      study.scene, study.study.axes, {}, scene::PressureHistory(study.scene.scene.load).stated_peak()};
  start.scene.places.clear();
  for (const Axis& axis : start.axes) start.condition.push_back(is_condition(axis.key));
  return start;
}

/// The only gap of a case is a list of one.
scene::Value value_of(const Axis& axis, double coordinate) {
  if (axis.key.kind == scene::KeyKind::number) return coordinate;
  return std::vector{coordinate};
}

std::vector<Change> changes_of(const StudyFile& study, const std::vector<double>& coordinates) {
  std::vector<Change> changes;
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    const Axis& axis = study.study.axes[i];
    const std::string& key = axis.values_key.empty() ? axis.study_key : axis.values_key;
    changes.push_back({axis.key.name, value_of(axis, coordinates[i]), place_of_key(study, key), key});
  }
  return changes;
}

/// Whether a case is of the load and defect of the study's scene.
bool is_own(const Start& start, const StudyCase& made) {
  const materials::ViscoScramParameters& own = start.scene.scene.charge().strength;
  for (std::size_t i = 0; i < made.coordinates.size(); ++i)
    if (start.condition[i] && made.coordinates[i] != number_in(start.scene, start.axes[i].key.name))
      return false;
  return made.peak_pressure == start.peak && made.has_defect(own);
}

StudyCase varied_case(const Start& start, std::vector<double> coordinates, SceneFile scene) {
  StudyCase made = case_of({}, std::move(scene));
  made.coordinates = std::move(coordinates);
  made.own_conditions = is_own(start, made);
  return made;
}

/// A case that was found valid.
StudyCase known_case(const Start& start, const std::vector<double>& coordinates) {
  std::vector<scene::KeyChange> changes;
  for (std::size_t i = 0; i < coordinates.size(); ++i)
    changes.push_back({start.axes[i].key.name, value_of(start.axes[i], coordinates[i]), {}});
  return varied_case(start, coordinates, scene::with_keys(start.scene, changes, true));
}

/// One value of every axis: the place in their product, the last axis fastest.
std::vector<double> values_at(const std::vector<Axis>& axes, std::size_t place) {
  std::vector<double> values(axes.size());
  for (std::size_t i = axes.size(); i-- > 0; place /= axes[i].values.size())
    values[i] = axes[i].values[place % axes[i].values.size()];
  return values;
}

/// "496 MPa, 30 µm, 1 mm", peak pressure, crack radius and flaw size, and the temperature where it varies,
/// ", 219 K", if nothing else does; otherwise every axis by its name: "peak_pressure 496 MPa,
/// load.steepness 1.4".
std::string case_label(const Study& study, const StudyCase& made) {
  const bool of_launch = std::ranges::all_of(study.axes, [](const Axis& axis) {
    return std::ranges::find(named_axes(), axis.name, &NamedAxis::name) != named_axes().end();
  });
  if (of_launch) {
    const bool warmed = std::ranges::find(study.axes, "initial_temperature", &Axis::name) != study.axes.end();
    return fmt::format("{:.6g} MPa, {:.6g} µm, {:.6g} mm{}", 1e-6 * made.peak_pressure,
                       1e6 * made.strength().initial_crack_radius, 1e3 * made.strength().flaw_size,
                       warmed ? fmt::format(", {:.6g} K", made.scene.scene.initial_temperature) : "");
  }
  std::string text;
  for (std::size_t i = 0; i < study.axes.size(); ++i)
    text += fmt::format("{}{} {}", i == 0 ? "" : ", ", study.axes[i].name,
                        scene::format_value(study.axes[i].key, made.coordinates[i]));
  return text;
}

}  // namespace

std::string to_string(scene::FrictionClosure closure) { return std::string(scene::word_of(closure)); }

std::string to_string(Use use) { return use == Use::fitted ? "fitted" : "check"; }

const StudyCase Cases::operator[](std::size_t index) const {
  const Row& row = rows_[index];
  StudyCase made = row.own ? *row.own : make_(row.coordinates);
  made.label = row.label;
  return made;
}

void Cases::add(std::string label, std::vector<double> coordinates) {
  rows_.push_back({std::move(label), std::move(coordinates), nullptr});
}

void Cases::add(StudyCase made) {
  rows_.push_back({made.label, made.coordinates, std::make_shared<const StudyCase>(std::move(made))});
}

void Cases::replace(std::size_t index, StudyCase made) {
  rows_[index] = {made.label, made.coordinates, std::make_shared<const StudyCase>(std::move(made))};
}

std::vector<std::string> differences(const scene::Scene& scene, const scene::Scene& other) {
  std::vector<std::string> names;
  for (const auto& key : scene::scene_keys()) {
    const bool is_used = key.is_used(scene);
    if (is_used != key.is_used(other) || (is_used && !same_value(key.get(scene), key.get(other))))
      names.push_back(key.name);
  }
  const auto compare = [&](const char* name, const auto& ours, const auto& theirs, auto same) {
    if (!std::ranges::equal(ours, theirs, same)) names.emplace_back(name);
  };
  compare("body", scene.bodies, other.bodies, [](const scene::Body& a, const scene::Body& b) {
    return a.material == b.material && same_number(a.x_begin, b.x_begin) && same_number(a.x_end, b.x_end) &&
           same_number(a.r_begin, b.r_begin) && same_number(a.r_end, b.r_end);
  });
  compare("interface", scene.interfaces, other.interfaces,
          [](const scene::Interface& a, const scene::Interface& b) {
            return a.body == b.body && a.condition == b.condition && a.friction == b.friction;
          });
  compare("observation_point", scene.output.observation_points, other.output.observation_points,
          [](const scene::ObservationPoint& a, const scene::ObservationPoint& b) {
            return same_number(a.x, b.x) && same_number(a.r, b.r);
          });
  return names;
}

bool same_number(double a, double b) { return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b)); }

bool same_value(const scene::Value& a, const scene::Value& b) { return scene::same_value(a, b, 1e-9); }

std::string text_of(const SceneFile& scene, const Change& change) {
  return scene::format_value(scene::describe_key(scene, change.name, change.place), change.value);
}

scene::Expected<scene::SceneFile> with_changes(const scene::SceneFile& scene,
                                               const std::vector<Change>& changes) {
  if (changes.empty()) return scene;
  auto changed = scene::caught([&] { return with_all(scene, changes); });
  if (changed) return changed;
  scene::InputError error = changed.error();
  const Change& change = change_at_fault(changes, error);
  if (error.key != change.name) {
    error.found = fmt::format("{}, with which {} is {}", text_of(scene, change), error.key, error.found);
    error.allowed = fmt::format("values with which {} is {}", error.key, error.allowed);
  }
  error.file = change.place.file;
  error.line = change.place.line;
  error.column = change.place.column;
  error.key = change.study_key;
  return error;
}

StudyCase case_of(std::string label, SceneFile scene) {
  const scene::Scene& s = scene.scene;
  StudyCase made;
  made.label = std::move(label);
  made.peak_pressure = scene::PressureHistory(s.load).stated_peak();
  made.own_conditions = false;
  made.scene = std::move(scene);
  return made;
}

void add_varied_cases(StudyFile& study, std::size_t count, const CoordinatesOf& coordinates_of,
                      const LabelOf& label_of) {
  const auto start = std::make_shared<const Start>(start_of(study));
  std::vector<std::pair<std::string, std::vector<double>>> rows(count);  // label, coordinates
  std::atomic<std::size_t> first_fault = count;
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    if (i > first_fault) return;
    std::vector<double> coordinates = coordinates_of(i);
    auto scene = with_changes(start->scene, changes_of(study, coordinates));
    if (!scene) {
      for (std::size_t known = first_fault; i < known;)
        if (first_fault.compare_exchange_weak(known, i)) break;
      return;
    }
    const StudyCase made = varied_case(*start, std::move(coordinates), std::move(*scene));
    rows[i] = {label_of(i, made), made.coordinates};
  });
  if (first_fault < count)
    throw with_changes(start->scene, changes_of(study, coordinates_of(first_fault))).error();
  for (auto& [label, coordinates] : rows) study.cases.add(std::move(label), std::move(coordinates));
  study.cases.make_with(
      [start](const std::vector<double>& coordinates) { return known_case(*start, coordinates); });
}

void make_factorial(StudyFile& study) {
  const std::vector<Axis>& axes = study.study.axes;
  double count = 1.0;
  std::vector<std::string> sizes;
  for (const Axis& axis : axes) {
    count *= static_cast<double>(axis.values.size());
    sizes.push_back(fmt::format("{} of {}", axis.values.size(), axis.name));
  }
  const std::string key = axes.empty() ? std::string{} : axes.front().study_key;
  check_count(study, key, count, fmt::format("{}", fmt::join(sizes, " x ")));
  add_varied_cases(
      study, static_cast<std::size_t>(count), [&](std::size_t place) { return values_at(axes, place); },
      [&](std::size_t, const StudyCase& made) { return case_label(study.study, made); });
}

void check_count(const StudyFile& study, const std::string& key, double count, const std::string& what) {
  if (!(count <= static_cast<double>(study.most_cases)))
    refuse_at(study, key, fmt::format("{:.0f} mechanical runs, {}", count, what),
              fmt::format("at most {} mechanical runs", study.most_cases));
}

bool varies_gap(const Study& study) {
  return std::ranges::any_of(study.axes, [](const Axis& axis) { return axis.key.name == gap_key; });
}

void settle_gaps(StudyFile& study) {
  if (!study.study.kind.judges_gaps || !study.study.gaps.empty()) return;
  if (varies_gap(study.study)) return;  // each case has its own
  study.study.gaps = study.scene.scene.surface.gaps;
  if (study.study.gaps.empty())
    refuse_at(study, "gaps", "no gap", "at least one gap, in the study or its scene");
}

}  // namespace launchsafe::study
