#include "launchsafe/study/read_study.hpp"

#include "launchsafe/scene/mesh.hpp"
#include "launchsafe/study/calibration.hpp"
#include "study_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace launchsafe::study {
namespace {

using scene::Dimension, scene::InputError, scene::Place, scene::SceneFile, scene::Value;
using Fault = std::optional<InputError>;

Place place_of_key(const StudyFile& study, const std::string& key) {
  const auto found = study.places.find(key);
  return found == study.places.end() ? Place{study.file} : found->second;
}

InputError fault_at(const StudyFile& study, const std::string& key, std::string found, std::string allowed) {
  return scene::error_at(place_of_key(study, key), key, std::move(found), std::move(allowed));
}

Fault read_references(const toml::table& root, StudyFile& study) {
  const toml::node* node = root.get("reference");
  if (!node || (node->is_array() && node->as_array()->empty())) return std::nullopt;
  if (!node->is_array_of_tables()) {
    return scene::error_at(scene::place_of(*node, study.file), "reference", scene::found_text(*node),
                           "tables, each written [[reference]]");
  }
  for (const toml::node& element : *node->as_array()) {
    Reference reference;
    auto read = scene::read_table(*element.as_table(), detail::reference_keys(), {}, study.file, reference);
    if (!read) {
      InputError error = read.error();
      error.key = "reference." + error.key;
      return error;
    }
    const std::size_t index = study.study.references.size();
    for (auto& [key, place] : *read) study.places[fmt::format("reference.{}.{}", index, key)] = place;
    study.study.references.push_back(std::move(reference));
  }
  return std::nullopt;
}

Fault read_scene_of(StudyFile& study, const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / study.study.scene;
  std::error_code status;
  if (!std::filesystem::exists(path, status)) {
    const auto missing = scene::read_text_file(path);
    return scene::error_at(place_of_key(study, "scene"), "scene",
                           fmt::format("\"{}\", which does not exist", study.study.scene),
                           "a scene file, by its path from the study file's folder",
                           missing ? std::string{} : missing.error().suggestion);
  }
  auto read = scene::read_scene(path);
  if (!read) return read.error();
  study.scene = std::move(*read);
  return std::nullopt;
}

/// One override of [set], and those of the tables in it.
Fault apply_override(const toml::node& node, const std::string& name, StudyFile& study) {
  const Place place = scene::place_of(node, study.file);
  if (const toml::table* table = node.as_table()) {
    for (const auto& [key, inner] : *table) {
      const std::string dotted = name.empty() ? std::string(key.str()) : name + "." + std::string(key.str());
      if (Fault fault = apply_override(inner, dotted, study)) return fault;
    }
    return std::nullopt;
  }
  const auto in_set = [&name](InputError error) {
    if (error.key == name) error.key = "set." + name;
    return error;
  };
  const auto key = scene::describe_key(study.scene, name, place);
  if (!key) return in_set(key.error());
  const auto value = scene::read_value(node, *key, study.file);
  if (!value) return in_set(value.error());
  auto changed = scene::with_key(study.scene, name, *value, place);
  if (!changed) return in_set(changed.error());
  study.scene = std::move(*changed);
  study.overrides[name] = scene::format_value(*key, *value);
  return std::nullopt;
}

Fault apply_overrides(const toml::table& root, StudyFile& study) {
  const toml::node* node = root.get("set");
  if (!node) return std::nullopt;
  if (!node->is_table()) {
    return scene::error_at(scene::place_of(*node, study.file), "set", scene::found_text(*node),
                           "a table, written [set], of scene keys");
  }
  return apply_override(*node, "", study);
}

/// Keys of the other kind, which would silently do nothing.
Fault check_kinds(const StudyFile& study) {
  const std::string kind = to_string(study.study.kind);
  const std::pair<const std::string, Place>* first = nullptr;
  for (const auto& given : study.places) {
    const std::string of = detail::kind_of_key(given.first);
    if (of.empty() || of == kind) continue;
    if (!first || given.second.line < first->second.line) first = &given;
  }
  if (!first) return std::nullopt;
  return scene::error_at(first->second, first->first,
                         "a key of kind \"" + detail::kind_of_key(first->first) + '"',
                         "keys of kind \"" + kind + '"');
}

Fault check_twice(const StudyFile& study, const std::string& key, Dimension dimension,
                  std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto twice = std::adjacent_find(values.begin(), values.end(), [](double a, double b) {
    return b - a <= 1e-9 * std::max(std::abs(b), 1e-6);
  });
  if (twice == values.end()) return std::nullopt;
  return fault_at(study, key, scene::format_quantity(*twice, dimension) + " twice", "each value once");
}

Fault check_lists(const StudyFile& study) {
  const Study& s = study.study;
  if (Fault fault = check_twice(study, "gaps", Dimension::length, s.gaps)) return fault;
  if (Fault fault = check_twice(study, "peak_pressures", Dimension::pressure, s.peak_pressures)) return fault;
  if (Fault fault = check_twice(study, "crack_radii", Dimension::length, s.crack_radii)) return fault;
  if (Fault fault = check_twice(study, "flaw_sizes", Dimension::length, s.flaw_sizes)) return fault;
  return check_twice(study, "meshes", Dimension::length, s.meshes);
}

Fault check_references(const StudyFile& study) {
  const auto& references = study.study.references;
  for (std::size_t i = 0; i < references.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (std::abs(references[i].gap - references[j].gap) > 1e-9) continue;
      InputError error =
          fault_at(study, fmt::format("reference.{}.gap", i),
                   scene::format_quantity(references[i].gap, Dimension::length) + " twice", "each gap once");
      error.key = "reference.gap";
      return error;
    }
  }
  const ReferenceLine& line = study.study.reference_line;
  if (std::isnan(line.slope) == std::isnan(line.intercept)) return std::nullopt;
  const bool slope = !std::isnan(line.slope);
  return fault_at(study, slope ? "reference_line.slope" : "reference_line.intercept",
                  slope ? "a slope without an intercept" : "an intercept without a slope",
                  "both reference_line.slope and reference_line.intercept");
}

Fault check_scene(const StudyFile& study) {
  const scene::Scene& scene = study.scene.scene;
  if (!scene::has_material(scene, scene::BodyMaterial::charge))
    return fault_at(study, "scene", "a scene without a charge", "a scene with a charge");
  if (scene.output.observation_points.empty()) {
    return fault_at(study, "scene", "a scene without observation points",
                    "a scene with observation points at the charge bottom, on which verdicts rest");
  }
  if (!study.study.peak_pressures.empty() && !scene.load.curve_time.empty() && !scene.load.rescale_to_peak) {
    return fault_at(study, "peak_pressures", "peak pressures for a measured curve that is not rescaled",
                    "peak pressures with load.rescale_to_peak = true in the scene");
  }
  if (study.study.early_time > scene.load.duration) {
    return fault_at(
        study, "early_time", scene::format_quantity(study.study.early_time, Dimension::time),
        "a time within the load's duration, " + scene::format_quantity(scene.load.duration, Dimension::time));
  }
  return std::nullopt;
}

/// A scene key varied by a list of the study; no values: as in the scene.
struct Axis {
  std::string list;  ///< key of the study
  std::string key;   ///< key of the scene
  std::vector<double> values;
};

Fault add_cases(StudyFile& study, const std::vector<Axis>& axes, std::size_t depth, const SceneFile& scene) {
  if (depth == axes.size()) {
    const scene::Scene& s = scene.scene;
    StudyCase made{"",
                   scene::PressureHistory(s.load).peak(),
                   s.charge.cracks.initial_crack_radius,
                   s.charge.cracks.flaw_size,
                   s.numerics.cell_size,
                   true,
                   scene};
    made.label = study.study.kind == StudyKind::calibration
                     ? fmt::format("{:.6g} mm", 1e3 * made.cell_size)
                     : fmt::format("{:.6g} MPa, {:.6g} um, {:.6g} mm", 1e-6 * made.peak_pressure,
                                   1e6 * made.crack_radius, 1e3 * made.flaw_size);
    const scene::Scene& own = study.scene.scene;
    made.own_conditions = made.peak_pressure == own.load.peak &&
                          made.crack_radius == own.charge.cracks.initial_crack_radius &&
                          made.flaw_size == own.charge.cracks.flaw_size;
    study.cases.push_back(std::move(made));
    return std::nullopt;
  }
  const Axis& axis = axes[depth];
  if (axis.values.empty()) return add_cases(study, axes, depth + 1, scene);
  for (const double value : axis.values) {
    const auto changed = scene::with_key(scene, axis.key, Value(value), place_of_key(study, axis.list));
    if (!changed) return changed.error();
    if (Fault fault = add_cases(study, axes, depth + 1, *changed)) return fault;
  }
  return std::nullopt;
}

Fault make_cases(StudyFile& study) {
  Study& s = study.study;
  if (s.kind == StudyKind::calibration) {
    if (auto targets = calibration_targets(study); !targets) return targets.error();
    return add_cases(study, {{"meshes", "numerics.cell_size", s.meshes}}, 0, study.scene);
  }
  if (s.gaps.empty()) s.gaps = study.scene.scene.surface.gaps;
  if (s.gaps.empty()) return fault_at(study, "gaps", "no gap", "at least one gap, in the study or its scene");
  return add_cases(study,
                   {{"peak_pressures", "load.peak", s.peak_pressures},
                    {"crack_radii", "charge.crack_radius", s.crack_radii},
                    {"flaw_sizes", "charge.flaw_size", s.flaw_sizes}},
                   0, study.scene);
}

/// A stated uncertainty belongs to the scene's own numerics on a grid that runs along the charge's edges.
/// Without one, or elsewhere, nothing is known, and a large one is assumed, so that no verdict is SAFE on the
/// strength of silence.
void settle_numerical_uncertainty(StudyFile& study) {
  Study& s = study.study;
  const bool other_numerics =
      std::any_of(study.overrides.begin(), study.overrides.end(),
                  [](const auto& each) { return each.first.starts_with("numerics."); });
  const bool unstated = !std::isfinite(s.numerical_uncertainty);
  if (!unstated && !other_numerics && scene::charge_edges_off_grid(study.scene.scene).empty()) return;
  s.numerical_uncertainty_assumed = unstated || s.numerical_uncertainty < assumed_numerical_uncertainty;
  if (s.numerical_uncertainty_assumed) s.numerical_uncertainty = assumed_numerical_uncertainty;
}

}  // namespace

scene::Expected<StudyFile> parse_study(std::string_view text, const std::filesystem::path& path) {
  const auto table = scene::parse_toml(text, path.string());
  if (!table) return table.error();
  StudyFile study;
  study.file = path.string();
  auto read = scene::read_table(*table, detail::study_keys(), {"set", "reference"}, study.file, study.study);
  if (!read) return read.error();
  study.places = std::move(*read);
  if (Fault fault = check_kinds(study)) return *fault;
  if (Fault fault = read_references(*table, study)) return *fault;
  if (Fault fault = check_lists(study)) return *fault;
  if (Fault fault = check_references(study)) return *fault;
  if (Fault fault = read_scene_of(study, path.parent_path())) return *fault;
  if (Fault fault = apply_overrides(*table, study)) return *fault;
  if (Fault fault = check_scene(study)) return *fault;
  settle_numerical_uncertainty(study);
  if (Fault fault = make_cases(study)) return *fault;
  if (study.study.title.empty()) study.study.title = study.scene.scene.title;
  return study;
}

scene::Expected<StudyFile> read_study(const std::filesystem::path& file) {
  const auto text = scene::read_text_file(file);
  if (!text) return text.error();
  return parse_study(*text, file);
}

}  // namespace launchsafe::study
