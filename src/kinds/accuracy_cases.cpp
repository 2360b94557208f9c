// A study of kind accuracy as a file: reference meshes, settings, and the cases that follow.
#include "launchsafe/kinds/accuracy.hpp"
#include "launchsafe/scene/plan.hpp"
#include "study_keys.hpp"

namespace launchsafe::kinds {
namespace {

constexpr std::size_t least_reference_meshes = 3;
constexpr const char *cell_size_key = "numerics.cell_size", *meshes_key = "reference_cell_sizes";

AccuracySettings& own(StudyFile& study) { return settings_of<AccuracySettings>(study.study); }

void read_axis(const Leaf& leaf, std::size_t block, StudyFile& study) {
  const Place place = scene::place_of(*leaf.node, study.file);
  const std::string key = fmt::format("settings.{}.{}", block, leaf.name);
  study.places[key] = place;
  if (leaf.name == "gap.thickness")
    refuse_at(study, key, leaf.name + " as a setting",
              "numerics keys, friction.closure, ...; the gaps are the study's");
  const KeyDescription description =
      scene::within("settings", [&] { return scene::describe_key(study.scene, leaf.name, place); });
  SettingsAxis& axis = own(study).settings[block].emplace_back();
  for (const Value& value :
       scene::within("settings", [&] { return scene::read_values(*leaf.node, description, study.file); }))
    axis.push_back({leaf.name, value, place, key});
}

void check_reference_meshes(StudyFile& study) {
  std::vector<double>& sizes = own(study).reference_cell_sizes;
  std::ranges::sort(sizes);
  check_twice(study, meshes_key, Dimension::length, sizes);
  if (sizes.size() < least_reference_meshes)
    refuse_at(study, meshes_key, fmt::format("{} cell sizes", sizes.size()),
              fmt::format("at least {}, from which the reference is extrapolated", least_reference_meshes));
}

/// Of one grid to the next. Between grids that are nearer to each other the values differ by less than their
/// ripple, which would pass for convergence; Celik et al. (2008) ask for 1.3 as a rule.
constexpr double least_refinement = 1.2;

/// Grids beside the charge's edge converge to something else, and two nominal sizes may be one grid.
void check_reference_grids(StudyFile& study) {
  const std::vector<double>& sizes = own(study).reference_cell_sizes;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const std::string size = format_quantity(sizes[i], Dimension::length);
    const Scene& scene = study.cases[i].scene.scene;
    if (const std::string edges = scene::charge_edges_off_grid(scene); !edges.empty())
      refuse_at(study, meshes_key,
                fmt::format("{}, whose grid does not run along the charge: {}", size, edges),
                "cells that divide the outer radius and the radius of the charge, rounded up a little");
    if (i == 0) continue;
    const scene::CellRange finer = scene::cells_of(study.cases[i - 1].scene.scene),
                           mesh = scene::cells_of(scene);
    if (!(mesh.shortest_r > finer.shortest_r && mesh.shortest_x > finer.shortest_x))
      refuse_at(study, meshes_key,
                fmt::format("{}, whose fitted grid is not coarser than the one before it", size),
                "cell sizes that make different grids");
    if (mesh.shortest_r < least_refinement * finer.shortest_r ||
        mesh.shortest_x < least_refinement * finer.shortest_x)
      refuse_at(study, meshes_key,
                fmt::format("{}, whose fitted grid is less than {} times as coarse as the one before it",
                            size, least_refinement),
                "grids far enough apart to show how T max moves with them");
  }
}

std::string label_of(const StudyFile& study, const std::vector<Change>& changes) {
  if (changes.empty()) return "as in the scene";
  const auto part = [&](const Change& change) {
    return change.name.substr(change.name.rfind('.') + 1) + " " + text_of(study.scene, change);
  };
  return fmt::format("{}", fmt::join(of_each(changes, part), ", "));
}

using KnownScenes = std::set<std::string>;

void add_case(StudyFile& study, const std::vector<Change>& changes, KnownScenes& known) {
  SceneFile scene = taken(with_changes(study.scene, changes));
  if (!known.insert(scene::to_toml(scene.scene)).second) return;
  StudyCase made = study::case_of(label_of(study, changes), std::move(scene));
  made.own_conditions = true;
  study.cases.add(std::move(made));
}

/// Every combination of the values of a block, the last key fastest.
void add_block(StudyFile& study, const std::vector<SettingsAxis>& axes, std::vector<Change> changes,
               KnownScenes& known) {
  if (changes.size() == axes.size()) return add_case(study, changes, known);
  const SettingsAxis& axis = axes[changes.size()];
  changes.emplace_back();
  for (const Change& change : axis) {
    changes.back() = change;
    add_block(study, axes, changes, known);
  }
}

void check_setting_count(StudyFile& study) {
  double count = 1.0;
  for (const auto& block : own(study).settings) {
    double product = 1.0;
    for (const SettingsAxis& axis : block) product *= static_cast<double>(axis.size());
    count += product;
  }
  check_count(study, "settings", count, "every combination of [[settings]]");
}

void read_settings(const toml::table& root, StudyFile& study) {
  check_reference_meshes(study);
  for (const toml::table* table :
       scene::tables_of(root, "settings", study.file,
                        "tables, each written [[settings]], of scene keys with several values")) {
    const std::size_t block = own(study).settings.size();
    own(study).settings.emplace_back();
    for (const Leaf& leaf : study::leaves_as_written(*table)) read_axis(leaf, block, study);
  }
  check_setting_count(study);
}

void make_accuracy_cases(const StudySource& source, StudyFile& study) {
  read_settings(source.root, study);
  const AccuracySettings settings = own(study);
  KnownScenes known;
  for (const double size : settings.reference_cell_sizes)
    add_case(study, {{cell_size_key, size, place_of_key(study, meshes_key), meshes_key}}, known);
  check_reference_grids(study);
  add_case(study, {}, known);
  for (const std::vector<SettingsAxis>& block : settings.settings) add_block(study, block, {}, known);
}

const std::vector<Key<AccuracySettings>> accuracy_keys{
    list_key("reference_cell_sizes", Dimension::length, between(1e-5, 1), Standing::assumed,
             "Cell sizes of at least three grids, each fitting the charge, that the reference is "
             "extrapolated from.",
             &AccuracySettings::reference_cell_sizes),
};

std::vector<Failure> accuracy_failures(const AccuracyResult& result) {
  std::vector<Failure> failures;
  for (std::size_t i = 0; i < result.rows.size(); ++i)
    add_failure(failures, result.study.cases.label(i), result.rows[i].result);
  return failures;
}

}  // namespace

Kind accuracy_kind() {
  return {
      .traits = {.name = "accuracy", .gives_verdicts = false},
      .keys = joined({gaps_keys(), search_keys(), own_keys(accuracy_keys)}),
      .tables = {{"settings", {}}},
      .make_cases = make_accuracy_cases,
      .run = outcome_of<run_accuracy, accuracy_failures>,
      .results = accuracy_results,
  };
}

}  // namespace launchsafe::kinds
