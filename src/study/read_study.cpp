#include "launchsafe/study/read_study.hpp"

#include "changed_scene.hpp"
#include "cited_limits.hpp"
#include "hard_launches.hpp"
#include "launchsafe/scene/acceptance.hpp"
#include "launchsafe/scene/interfaces.hpp"
#include "study_axes.hpp"
#include "study_calibration.hpp"
#include "study_cases.hpp"
#include "study_keys.hpp"
#include "study_settings.hpp"
#include "study_uncertainty.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace launchsafe::study {
namespace {

using detail::Fault, detail::fault_at, detail::place_of_key, detail::check_twice;
using scene::Dimension, scene::InputError, scene::Place;

Fault read_references(const toml::table& root, const std::string& file, StudyFile& study) {
  const toml::node* node = root.get("reference");
  if (!node || (node->is_array() && node->as_array()->empty())) return std::nullopt;
  if (!node->is_array_of_tables()) {
    return scene::error_at(scene::place_of(*node, file), "reference", scene::found_text(*node),
                           "tables, each written [[reference]]");
  }
  for (const toml::node& element : *node->as_array()) {
    Reference reference;
    auto read = scene::read_table(*element.as_table(), detail::reference_keys(), {}, file, reference);
    if (!read) return detail::in_table(read.error(), "reference");
    const std::size_t index = study.study.references.size();
    for (auto& [key, place] : *read) study.places[fmt::format("reference.{}.{}", index, key)] = place;
    study.study.references.push_back(std::move(reference));
  }
  return std::nullopt;
}

/// The references of a file of their own, which several studies share.
Fault read_references_file(StudyFile& study, const std::filesystem::path& folder) {
  const std::string& name = study.study.references_file;
  if (name.empty()) return std::nullopt;
  if (!study.study.references.empty())
    return fault_at(study, "references", "a file of references beside [[reference]]", "one of both");
  const std::string file = (folder / name).string();
  const auto text = scene::read_text_file(file);
  if (!text) {
    return fault_at(study, "references", fmt::format("\"{}\", which cannot be read", name),
                    "a file with [[reference]], by its path from the study file's folder",
                    text.error().suggestion);
  }
  const auto table = scene::parse_toml(*text, file);
  if (!table) return table.error();
  for (const auto& [key, node] : *table) {
    if (key.str() != "reference") {
      return scene::error_at(scene::place_of(node, file), std::string(key.str()),
                             "a key of another kind of file", "only [[reference]]");
    }
  }
  return read_references(*table, file, study);
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
Fault apply_override(const toml::node& node, const std::string& name, StudyFile& study,
                     detail::ChangedScene& scene) {
  const Place place = scene::place_of(node, study.file);
  if (const toml::table* table = node.as_table()) {
    for (const auto& [key, inner] : *table) {
      const std::string dotted = name.empty() ? std::string(key.str()) : name + "." + std::string(key.str());
      if (Fault fault = apply_override(inner, dotted, study, scene)) return fault;
    }
    return std::nullopt;
  }
  const auto key = scene::describe_key(study.scene, name, place);
  if (!key) return detail::in_table(key.error(), "set");
  const auto value = scene::read_value(node, *key, study.file);
  if (!value) return detail::in_table(value.error(), "set");
  study.overrides[name] = scene::format_value(*key, *value);
  scene.apply({name, *value, study.overrides[name], "set." + name, place});
  return std::nullopt;
}

Fault apply_overrides(const toml::table& root, StudyFile& study) {
  const toml::node* node = root.get("set");
  if (!node) return std::nullopt;
  if (!node->is_table()) {
    return scene::error_at(scene::place_of(*node, study.file), "set", scene::found_text(*node),
                           "a table, written [set], of scene keys");
  }
  detail::ChangedScene scene(study.scene);
  if (Fault fault = apply_override(*node, "", study, scene)) return fault;
  if (!scene.complete()) return scene.error();
  study.scene = scene.take();
  return std::nullopt;
}

/// A scene accepts the values that stand in it: where the study gives a key others, it has to accept them
/// itself.
void drop_acceptances_of_other_values(StudyFile& study) {
  std::set<std::string> changed;
  for (const auto& [key, value] : study.overrides) changed.insert(key);
  if (!study.study.peak_pressures.empty()) changed.insert("load.peak");
  if (!study.study.crack_radii.empty()) changed.insert("charge.crack_radius");
  if (!study.study.flaw_sizes.empty()) changed.insert("charge.flaw_size");
  for (const Axis& axis : study.study.axes) changed.insert(axis.key.name);
  for (const UncertainInput& input : study.study.inputs) changed.insert(input.key.name);
  // A reason for how the charge is held, or for all that is foreign, was given of the scene's own interfaces.
  std::set<std::string> dropped = changed;
  for (const std::string& key : changed) {
    if (!key.starts_with("interface.")) continue;
    dropped.insert(scene::foreign_calibration);
    for (const auto& other : scene::interface_keys())
      dropped.insert(key.substr(0, key.rfind('.') + 1) + other.name);
  }
  std::erase_if(study.scene.scene.accepted, [&](const auto& each) { return dropped.contains(each.key); });
}

/// The acceptances of the study: those of scene keys go to its scene, those of its own keys beside what it
/// states. Needs the overrides and what varies.
Fault read_accepted(const toml::table& root, StudyFile& study) {
  drop_acceptances_of_other_values(study);
  std::vector<std::string> known = scene::acceptable_names(study.scene.scene);
  for (const auto& key : detail::study_keys()) known.push_back(key.name);
  auto accepted = scene::read_acceptances(root, known, study.file);
  if (!accepted) return accepted.error();
  for (const auto& key : detail::study_keys()) {
    const scene::Value value = key.get(study.study);
    if (!study.places.contains(key.name) || scene::is_plausible(key, value)) continue;
    study.study.implausible.push_back({key.name, scene::format_value(key, value), scene::plausible_text(key),
                                       scene::reason_for(*accepted, key.name)});
  }
  for (scene::Acceptance& each : *accepted) {
    // "calibration" accepts all that is foreign to it, whatever record the study's key of that name names.
    if (each.key == scene::foreign_calibration || !scene::find_key(detail::study_keys(), each.key))
      scene::accept(study.scene.scene.accepted, std::move(each));
  }
  return std::nullopt;
}

/// The tables that are read apart from the keys, as far as the file has them.
void note_tables(const toml::table& root, StudyFile& study) {
  for (const char* name : {"reference", "cited_limit", "axes", "input", "settings", "case"}) {
    if (const toml::node* node = root.get(name)) study.places[name] = scene::place_of(*node, study.file);
  }
}

/// The earliest key given for which `foreign` holds; nullptr if there is none.
template <class Foreign>
const std::pair<const std::string, Place>* first_foreign(const StudyFile& study, Foreign foreign) {
  const std::pair<const std::string, Place>* first = nullptr;
  for (const auto& given : study.places) {
    if (foreign(given.first) && (!first || given.second.line < first->second.line)) first = &given;
  }
  return first;
}

/// What to write for a key of kind critical-gap in a study of another kind; empty if there is nothing like
/// it.
std::string same_in_kind(const std::string& key, StudyKind kind) {
  if (kind == StudyKind::sensitivity) return key == "gaps" ? "gap" : "";
  if (kind == StudyKind::critical_gap && key == "gap") return "gaps";
  if (kind != StudyKind::sweep) return {};
  if (key == "gaps" || key == "gap") return "gap in [axes]";
  if (key == "peak_pressures") return "peak_pressure in [axes]";
  if (key == "crack_radii") return "crack_radius in [axes]";
  if (key == "flaw_sizes") return "flaw_size in [axes]";
  return {};
}

/// Keys of other kinds, which would silently do nothing.
Fault check_kinds(const StudyFile& study) {
  const StudyKind kind = study.study.kind;
  const auto* first = first_foreign(study, [kind](const std::string& key) {
    const auto kinds = detail::kinds_of_key(key);
    return !kinds.empty() && std::find(kinds.begin(), kinds.end(), kind) == kinds.end();
  });
  if (!first) return std::nullopt;
  std::vector<std::string> kinds;
  for (const StudyKind each : detail::kinds_of_key(first->first)) kinds.push_back(to_string(each));
  return fault_at(study, first->first, "a key of kind " + scene::quoted_list(kinds),
                  "keys of kind \"" + to_string(kind) + '"', same_in_kind(first->first, kind));
}

/// Keys of the other method, likewise, and what the limits of single keys do not say.
Fault check_method(const StudyFile& study) {
  const Study& s = study.study;
  if (s.kind != StudyKind::sensitivity) return std::nullopt;
  const auto* first = first_foreign(study, [&s](const std::string& key) {
    const auto method = detail::method_of_key(key);
    return method && *method != s.method;
  });
  if (first) {
    return fault_at(study, first->first,
                    "a key of method \"" + to_string(*detail::method_of_key(first->first)) + '"',
                    "keys of method \"" + to_string(s.method) + '"');
  }
  if (s.levels % 2 == 0) return std::nullopt;
  return fault_at(study, "levels", fmt::format("{}", s.levels), "an even number of levels",
                  fmt::format("{}", s.levels + 1));
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
  if (!scene::has_charge(scene))
    return fault_at(study, "scene", "a scene without a charge", "a scene with a charge");
  if (!study.study.peak_pressures.empty() && !scene.load.curve_time.empty() && !scene.load.rescale_to_peak) {
    return fault_at(study, "peak_pressures", "peak pressures for a measured curve that is not rescaled",
                    "peak pressures with load.rescale_to_peak = true in the scene");
  }
  // The launches of a stability study last differently long.
  if (study.study.kind != StudyKind::stability && study.study.early_time > scene.load.duration) {
    return fault_at(
        study, "early_time", scene::format_quantity(study.study.early_time, Dimension::time),
        "a time within the load's duration, " + scene::format_quantity(scene.load.duration, Dimension::time));
  }
  return std::nullopt;
}

/// The axes of a sweep, or the inputs of a sensitivity study.
Fault read_what_varies(const toml::table& root, StudyFile& study) {
  if (study.study.kind == StudyKind::sweep) {
    if (Fault fault = detail::read_axes(root, study)) return fault;
  }
  if (study.study.kind == StudyKind::sensitivity) {
    if (Fault fault = detail::read_inputs(root, study)) return fault;
  }
  if (study.study.kind == StudyKind::accuracy) {
    if (Fault fault = detail::read_settings(root, study)) return fault;
  }
  return detail::check_load_axes(study);
}

}  // namespace

scene::Expected<StudyFile> parse_study(std::string_view text, const std::filesystem::path& path,
                                       const StudyRequest& request) {
  const auto table = scene::parse_toml(text, path.string());
  if (!table) return table.error();
  StudyFile study;
  study.file = path.string();
  study.most_cases = request.most_cases;
  auto read =
      scene::read_table(*table, detail::study_keys(),
                        {"set", "reference", "cited_limit", "axes", "input", "settings", "case", "accept"},
                        study.file, study.study);
  if (!read) return read.error();
  study.places = std::move(*read);
  note_tables(*table, study);
  if (Fault fault = check_kinds(study)) return *fault;
  if (Fault fault = check_method(study)) return *fault;
  if (Fault fault = read_references(*table, study.file, study)) return *fault;
  if (Fault fault = read_references_file(study, path.parent_path())) return *fault;
  if (Fault fault = detail::read_cited_limits(*table, study)) return *fault;
  if (Fault fault = check_lists(study)) return *fault;
  if (Fault fault = check_references(study)) return *fault;
  if (Fault fault = read_scene_of(study, path.parent_path())) return *fault;
  if (Fault fault = apply_overrides(*table, study)) return *fault;
  if (Fault fault = detail::use_calibration(study, path.parent_path())) return *fault;
  if (Fault fault = detail::read_model_form(study, path.parent_path())) return *fault;
  const auto record = detail::read_record(study, path.parent_path());
  if (!record) return record.error();
  const double tolerance = request.tolerance.value_or(study.study.setting_tolerance);
  if (std::isfinite(tolerance)) {
    if (Fault fault = detail::choose_setting(study, *record, tolerance)) return *fault;
  }
  if (Fault fault = check_scene(study)) return *fault;
  if (Fault fault = read_what_varies(*table, study)) return *fault;
  if (Fault fault = read_accepted(*table, study)) return *fault;
  if (Fault fault = detail::make_cases(study)) return *fault;
  if (Fault fault = detail::read_hard_launches(*table, study, path.parent_path())) return *fault;
  // A stability study states what each of its cases is judged with.
  if (study.study.kind != StudyKind::stability) detail::settle_uncertainty(study, *record);
  if (study.study.title.empty()) study.study.title = study.scene.scene.title;
  return study;
}

scene::Expected<StudyFile> read_study(const std::filesystem::path& file, const StudyRequest& request) {
  const auto text = scene::read_text_file(file);
  if (!text) return text.error();
  return parse_study(*text, file, request);
}

}  // namespace launchsafe::study
