#include "study_scene.hpp"

#include "launchsafe/scene/acceptance.hpp"
#include "launchsafe/scene/interfaces.hpp"
#include "launchsafe/study/calibration_record.hpp"
#include "launchsafe/study/case_uncertainty.hpp"
#include "launchsafe/study/study_cases.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <vector>

namespace launchsafe::kinds {

using study::Fault, study::StudyFile;

namespace {

using scene::Dimension, scene::Place;

/// One override of a table.
Fault add_override(const study::Leaf& leaf, const std::string& table_name, StudyFile& study,
                   std::vector<study::Change>& changes) {
  const Place place = scene::place_of(*leaf.node, study.file);
  const auto key = scene::describe_key(study.scene, leaf.name, place);
  if (!key) return study::in_table(key.error(), table_name);
  const auto value = scene::read_value(*leaf.node, *key, study.file);
  if (!value) return study::in_table(value.error(), table_name);
  if (auto note = scene::note_on_former_word(*leaf.node, *key, place))
    study.scene.notes.push_back(std::move(*note));
  study.overrides[leaf.name] = scene::format_value(*key, *value);
  changes.push_back({leaf.name, *value, study.overrides[leaf.name], table_name + "." + leaf.name, place});
  return std::nullopt;
}

Fault apply_overrides(const OverrideTable& overrides, StudyFile& study) {
  if (!overrides.node) return std::nullopt;
  if (!overrides.node->is_table()) {
    return scene::error_at(scene::place_of(*overrides.node, study.file), overrides.name,
                           scene::found_text(*overrides.node),
                           fmt::format("a table, written [{}], of scene keys", overrides.name));
  }
  std::vector<study::Change> changes;
  for (const study::Leaf& leaf : study::leaves_as_written(*overrides.node->as_table()))
    if (Fault fault = add_override(leaf, overrides.name, study, changes)) return fault;
  auto changed = with_changes(study.scene, changes, study.study.kind.judges_closing_gaps);
  if (!changed) return changed.error();
  study.scene = std::move(*changed);
  return std::nullopt;
}

Fault check_scene(const StudyFile& study) {
  const scene::Scene& scene = study.scene.scene;
  if (!scene::has_charge(scene))
    return fault_at(study, "scene", "a scene without a charge", "a scene with a charge");
  if (scene.surface.model == scene::GapModel::closing && !study.study.kind.judges_closing_gaps)
    return fault_at(study, "scene", "a scene whose gap closes", study::only_reservoir);
  if (!study.study.kind.own_scenes && study.study.early_time > scene::end_time(scene.load)) {
    return fault_at(study, "early_time", scene::format_quantity(study.study.early_time, Dimension::time),
                    "a time within the load's duration, " +
                        scene::format_quantity(scene::end_time(scene.load), Dimension::time));
  }
  return std::nullopt;
}

}  // namespace

scene::Expected<scene::SceneFile> read_named_scene(const std::string& name,
                                                   const std::filesystem::path& folder,
                                                   const std::string& key, const Place& place) {
  const std::filesystem::path path = folder / name;
  std::error_code status;
  if (std::filesystem::exists(path, status)) return scene::read_scene(path);
  const auto missing = scene::read_text_file(path);
  return scene::error_at(place, key, fmt::format("\"{}\", which does not exist", name),
                         "a scene file, by its path from the study file's folder",
                         missing ? std::string{} : missing.error().suggestion);
}

Fault settle_scene(const StudySource& source, const std::vector<OverrideTable>& overrides, StudyFile& study,
                   std::optional<study::AccuracyRecord>& record) {
  auto scene = read_named_scene(study.study.scene, source.folder, "scene", place_of_key(study, "scene"));
  if (!scene) return scene.error();
  study.scene = std::move(*scene);
  for (const OverrideTable& each : overrides) {
    if (Fault fault = apply_overrides(each, study)) return fault;
  }
  if (Fault fault = use_calibration(study, source.folder)) return fault;
  if (Fault fault = scene::check_expected_velocity(study.scene)) return fault;
  if (Fault fault = read_model_form(study, source.folder)) return fault;
  auto read = read_record(study, source.folder);
  if (!read) return read.error();
  record = std::move(*read);
  const double wanted = source.tolerance.value_or(study.study.setting_tolerance);
  if (std::isfinite(wanted)) {
    if (Fault fault = choose_setting(study, record, wanted)) return fault;
  }
  return check_scene(study);
}

Fault settle_acceptances(const toml::table& root, const StudyKeys& keys, StudyFile& study) {
  std::vector<scene::KeyDescription> known = scene::acceptable_keys(study.scene.scene);
  known.insert(known.end(), keys.begin(), keys.end());
  auto accepted = scene::read_acceptances(root, known, study.file);
  if (!accepted) return accepted.error();
  for (const auto& key : keys) {
    const scene::Value value = key.get(study.study);
    if (!study.places.contains(key.name) || scene::is_plausible(key, value)) continue;
    study.study.implausible.push_back(
        scene::implausible(*accepted, key, key.name, value, scene::plausible_text(key)));
  }
  for (scene::Acceptance& each : *accepted)
    if (!scene::find_key(keys, each.key)) scene::accept(study.scene.scene.accepted, std::move(each));
  return std::nullopt;
}

}  // namespace launchsafe::kinds
