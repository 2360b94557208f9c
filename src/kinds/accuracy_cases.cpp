// A study of kind accuracy as a file: its reference meshes, its settings, and the cases that follow from
// both.
#include "answer_tables.hpp"
#include "launchsafe/kinds/accuracy.hpp"
#include "launchsafe/scene/mesh.hpp"
#include "launchsafe/store/sha256.hpp"
#include "study_keys.hpp"

#include <fmt/format.h>

#include <set>

namespace launchsafe::kinds {

using study::Change, study::Fault, study::StudyFile;

namespace {

using scene::KeyDescription, scene::KeyKind, scene::Place, scene::Value;

constexpr std::size_t least_reference_meshes = 3;
constexpr const char* cell_size_key = "numerics.cell_size";

Fault read_axis(const study::Leaf& leaf, std::size_t block, StudyFile& study) {
  const Place place = scene::place_of(*leaf.node, study.file);
  const std::string key = fmt::format("settings.{}.{}", block, leaf.name);
  study.places[key] = place;
  if (leaf.name == "gap.thickness" || leaf.name == "gap.opens_by_cooling") {
    return fault_at(study, key, leaf.name + " as a setting",
                    "numerics keys, frame, friction.closure, ...; the gaps are the study's");
  }
  auto description = scene::describe_key(study.scene, leaf.name, place);
  if (!description) return scene::within("settings", description.error());
  const auto values = scene::read_values(*leaf.node, *description, study.file);
  if (!values) return scene::within("settings", values.error());
  SettingsAxis& axis = settings_of<AccuracySettings>(study.study).settings[block].emplace_back();
  for (const Value& value : *values)
    axis.push_back({leaf.name, value, scene::format_value(*description, value), key, place});
  return std::nullopt;
}

Fault check_reference_meshes(StudyFile& study) {
  std::vector<double>& sizes = settings_of<AccuracySettings>(study.study).reference_cell_sizes;
  std::ranges::sort(sizes);
  const std::string key = "reference_cell_sizes";
  if (Fault fault = check_twice(study, key, scene::Dimension::length, sizes)) return fault;
  if (sizes.size() >= least_reference_meshes) return std::nullopt;
  return fault_at(
      study, key, fmt::format("{} cell sizes", sizes.size()),
      fmt::format("at least {}, from which the reference is extrapolated", least_reference_meshes));
}

/// Of one grid to the next. Between grids that are nearer to each other the values differ by less than their
/// ripple, which would pass for convergence; Celik et al. (2008) ask for 1.3 as a rule.
constexpr double least_refinement = 1.2;

/// Grids beside the charge's edge converge to something else, and two nominal sizes may be one grid.
Fault check_reference_grids(const StudyFile& study) {
  const std::size_t count = settings_of<AccuracySettings>(study.study).reference_cell_sizes.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::string size = scene::format_quantity(
        settings_of<AccuracySettings>(study.study).reference_cell_sizes[i], scene::Dimension::length);
    const scene::Scene& scene = study.cases[i].scene.scene;
    if (const std::string edges = scene::charge_edges_off_grid(scene); !edges.empty()) {
      return fault_at(study, "reference_cell_sizes",
                      fmt::format("{}, whose grid does not run along the charge: {}", size, edges),
                      "cells that divide the outer radius and the radius of the charge, rounded up a little");
    }
    if (i == 0) continue;
    const scene::CellRange finer = scene::cells_of(study.cases[i - 1].scene.scene),
                           mesh = scene::cells_of(scene);
    if (!(mesh.shortest_r > finer.shortest_r && mesh.shortest_x > finer.shortest_x))
      return fault_at(study, "reference_cell_sizes",
                      fmt::format("{}, whose fitted grid is not coarser than the one before it", size),
                      "cell sizes that make different grids");
    if (mesh.shortest_r >= least_refinement * finer.shortest_r &&
        mesh.shortest_x >= least_refinement * finer.shortest_x)
      continue;
    return fault_at(study, "reference_cell_sizes",
                    fmt::format("{}, whose fitted grid is less than {} times as coarse as the one before it",
                                size, least_refinement),
                    "grids far enough apart to show how T max moves with them");
  }
  return std::nullopt;
}

/// "cell_size 0.5 cm, inertial_scaling 16".
std::string label_of(const std::vector<Change>& changes) {
  std::string label;
  for (const Change& change : changes) {
    const std::string name = change.key.substr(change.key.rfind('.') + 1);
    label += fmt::format("{}{} {}", label.empty() ? "" : ", ", name, change.text);
  }
  return label.empty() ? "as in the scene" : label;
}

/// The scenes of the cases so far.
using KnownScenes = std::set<std::string>;

/// Makes a case of a valid scene, unless it is known.
Fault add_case(StudyFile& study, const std::vector<Change>& changes, KnownScenes& known) {
  auto scene = with_changes(study.scene, changes);
  if (!scene) return scene.error();
  if (!known.insert(scene::to_toml(scene->scene)).second) return std::nullopt;
  study::StudyCase made = study::case_of(label_of(changes), std::move(*scene));
  made.own_conditions = true;
  if (made.closing) made.scene.scene.surface.gaps = study.study.gaps;
  study.cases.add(std::move(made));
  return std::nullopt;
}

/// Every combination of the values of a block, the last key fastest.
Fault add_block(StudyFile& study, const std::vector<SettingsAxis>& axes, std::vector<Change> changes,
                KnownScenes& known) {
  if (changes.size() == axes.size()) return add_case(study, changes, known);
  const SettingsAxis& axis = axes[changes.size()];
  changes.emplace_back();
  for (const Change& change : axis) {
    changes.back() = change;
    if (Fault fault = add_block(study, axes, changes, known)) return fault;
  }
  return std::nullopt;
}

Fault check_setting_count(const StudyFile& study) {
  double count = 1.0;
  for (const auto& block : settings_of<AccuracySettings>(study.study).settings) {
    double product = 1.0;
    for (const SettingsAxis& axis : block) product *= static_cast<double>(axis.size());
    count += product;
  }
  if (count <= static_cast<double>(study.most_cases)) return std::nullopt;
  return fault_at(study, "settings", fmt::format("{:.0f} settings", count),
                  fmt::format("at most {}", study.most_cases));
}

Fault read_settings(const toml::table& root, StudyFile& study) {
  if (Fault fault = check_reference_meshes(study)) return fault;
  const toml::node* node = root.get("settings");
  if (!node || (node->is_array() && node->as_array()->empty())) return std::nullopt;
  if (!node->is_array_of_tables()) {
    return scene::error_at(scene::place_of(*node, study.file), "settings", scene::found_text(*node),
                           "tables, each written [[settings]], of scene keys with several values");
  }
  for (const toml::node& element : *node->as_array()) {
    const std::size_t block = settings_of<AccuracySettings>(study.study).settings.size();
    settings_of<AccuracySettings>(study.study).settings.emplace_back();
    for (const study::Leaf& leaf : study::leaves_as_written(*element.as_table())) {
      if (Fault fault = read_axis(leaf, block, study)) return fault;
    }
  }
  return check_setting_count(study);
}

Fault make_setting_cases(StudyFile& study) {
  const AccuracySettings settings = settings_of<AccuracySettings>(study.study);
  const KeyDescription description = *scene::find_key(scene::scene_keys(), cell_size_key);
  KnownScenes known;
  for (const double size : settings.reference_cell_sizes) {
    const Change change{cell_size_key, size, scene::format_value(description, size), "reference_cell_sizes",
                        place_of_key(study, "reference_cell_sizes")};
    if (Fault fault = add_case(study, {change}, known)) return fault;
  }
  if (Fault fault = check_reference_grids(study)) return fault;
  if (Fault fault = add_case(study, {}, known)) return fault;
  for (const std::vector<SettingsAxis>& block : settings.settings) {
    if (Fault fault = add_block(study, block, {}, known)) return fault;
  }
  return std::nullopt;
}

// --- variants ---

constexpr const char* variant_key = "variant";

/// Moves the values of a table into another one, into tables of the same name there; whatever else has the
/// name goes. Moved values still know their place in the file, copied ones do not.
void move_into(toml::table& to, toml::table& from) {
  for (auto&& [key, node] : from) {
    toml::table* inner = to.get_as<toml::table>(key.str());
    if (inner != nullptr && node.is_table())
      move_into(*inner, *node.as_table());
    else
      to.insert_or_assign(key.str(), std::move(node));
  }
}

/// The name of a variant, of which the name of a file is made.
scene::Expected<std::string> name_of_variant(const toml::table& table, const StudyFile& study) {
  constexpr const char* allowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.-";
  constexpr std::size_t longest = 64;
  const toml::node* node = table.get("name");
  const std::string name = node ? node->value_or(std::string{}) : std::string{};
  const Place place = scene::place_of(node ? *node : table, study.file);
  if (name.empty() || name.size() > longest || name.find_first_not_of(allowed) != std::string::npos) {
    return scene::error_at(place, "variant.name", node ? scene::found_text(*node) : "no name",
                           fmt::format("up to {} letters, digits, \"_\", \".\" and \"-\"", longest));
  }
  for (const AccuracyVariant& other : settings_of<AccuracySettings>(study.study).variants) {
    if (other.name == name)
      return scene::error_at(place, "variant.name", fmt::format("\"{}\" a second time", name),
                             "a name that no other variant has");
  }
  return name;
}

/// What the file says of all variants, with what the variant of that number says otherwise in its place.
Fault add_variant(const StudySource& source, std::size_t index, StudyFile& study) {
  auto root = scene::parse_toml(source.text, study.file);
  if (!root) return root.error();
  toml::table own = std::move(*root->get_as<toml::array>(variant_key)->get_as<toml::table>(index));
  root->erase(variant_key);
  const auto name = name_of_variant(own, study);
  if (!name) return name.error();
  own.erase("name");
  for (const char* common : {"kind", variant_key}) {
    if (const toml::node* node = own.get(common))
      return scene::error_at(scene::place_of(*node, study.file), fmt::format("variant.{}", common),
                             scene::found_text(*node), "keys of a study that variants may have otherwise");
  }
  move_into(*root, own);
  auto variant = read_study_table({*root, source.text, source.folder, source.tolerance}, study.file,
                                  study.most_cases - std::min(study.most_cases, study.cases.size()));
  if (!variant) return variant.error();
  for (study::StudyCase each : variant->cases) {
    each.label = *name + ": " + each.label;
    study.cases.add(std::move(each));
  }
  study.records.insert(study.records.end(), variant->records.begin(), variant->records.end());
  study.records.push_back(store::sha256(scene::to_toml(variant->scene.scene)));
  settings_of<AccuracySettings>(study.study).variants.push_back({*name, std::move(*variant)});
  return std::nullopt;
}

Fault make_accuracy_cases(const StudySource& source, StudyFile& study) {
  const toml::node* node = source.root.get(variant_key);
  if (node == nullptr) return make_setting_cases(study);
  for (std::size_t i = 0; i < node->as_array()->size(); ++i) {
    if (Fault fault = add_variant(source, i, study)) return fault;
  }
  // The first is the study's own.
  const StudyFile& first = settings_of<AccuracySettings>(study.study).variants.front().study;
  study.scene = first.scene;
  study.overrides = first.overrides;
  return std::nullopt;
}

const std::vector<scene::Key<AccuracySettings>> accuracy_keys{
    scene::list_key("reference_cell_sizes", scene::Dimension::length, scene::between(1e-5, 1),
                    scene::Standing::assumed,
                    "Cell sizes of at least three grids, each fitting the charge, that the reference is "
                    "extrapolated from.",
                    &AccuracySettings::reference_cell_sizes),
    scene::list_key("times", scene::Dimension::time, scene::between(0, 1), scene::Standing::assumed,
                    "Instants at which temperatures are compared too.", &AccuracySettings::times),
};

std::vector<Failure> accuracy_failures(const AccuracyResult& result) {
  std::vector<Failure> failures;
  std::size_t index = 0;
  for (const VariantAccuracy& variant : result.variants)
    for (const AccuracyRow& row : variant.rows)
      add_failure(failures, result.study.cases.label(index++), row.answer.outcome, row.answer.failure);
  return failures;
}

Fault read_accuracy(const StudySource& source, StudyFile& study) {
  const toml::node* node = source.root.get(variant_key);
  if (node == nullptr) return read_settings(source.root, study);
  if (node->is_array_of_tables()) return std::nullopt;
  return scene::error_at(scene::place_of(*node, study.file), variant_key, scene::found_text(*node),
                         "tables, each written [[variant]], with a name and what it has otherwise");
}

}  // namespace

Kind accuracy_kind() {
  return {
      .traits = {.name = "accuracy",
                 .gives_verdicts = false,
                 .bounds_critical_gaps = false,
                 .closing_gaps = study::ClosingGaps::compared},
      .keys = joined({gaps_keys(), judging_keys(), calibration_record_keys(), own_keys(accuracy_keys)}),
      .tables = {{"settings", {}}, {variant_key, {}}},
      .read = read_accuracy,
      .make_cases = make_accuracy_cases,
      .run = outcome_of<run_accuracy, accuracy_failures>,
      .files = {"accuracy.json", "accuracy_*.json", "error_against_time.svg"},
      .results = accuracy_results,
  };
}

}  // namespace launchsafe::kinds
