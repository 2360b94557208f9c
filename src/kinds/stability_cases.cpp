// A study of kind stability as a file: its keys, and [[group]] with its cases.
#include "answer_tables.hpp"
#include "launchsafe/kinds/stability.hpp"
#include "study_keys.hpp"

#include <fmt/format.h>

#include <array>

namespace launchsafe::kinds {

using keys::words_key;
using study::Change, study::Fault, study::StudyFile;

namespace {

using scene::Dimension, scene::Expected, scene::InputError, scene::Key, scene::SceneFile, scene::Standing;

Sentences names_of_invariants() {
  Sentences names;
  for (const Invariant& each : all_invariants()) names.push_back(each.name);
  return names;
}

/// Of a [[group]], which its cases take over, and of a case.
const std::vector<Key<StressCase>> case_keys{
    scene::text_key("name", Standing::input, "Of the group, or of a case of it, unique in the group.", "load",
                    &StressCase::name) |
        scene::required(),
    scene::text_key("scene", Standing::input, "Path of a scene of its own, from the study file's folder.",
                    "stability/thin_shell.toml", &StressCase::scene),
    words_key("expect", Standing::input, "Outcomes that are expected; anything but WRONG if absent.",
              {"held", "degraded", "caught"}, &StressCase::expected),
    words_key("invariants", Standing::input, "What must hold; all if absent.", names_of_invariants(),
              &StressCase::invariants),
    scene::text_key(
        "refused", Standing::input,
        "What the reader must say of the scene: then the case is one of the reader, and nothing runs.",
        "at least 0", &StressCase::refused),
    scene::number_key("caught_within", Dimension::count, scene::between(0, 1e9), Standing::input,
                      "Steps within which a broken computation must be caught; 0: any number.",
                      &StressCase::caught_within),
    scene::number_key("numerical_uncertainty", Dimension::temperature_difference, scene::between(0, 1000),
                      Standing::input,
                      "Uncertainty of the maximum temperature with these numerics; the study's if absent.",
                      &StressCase::numerical_uncertainty),
};

/// One case while it is read.
struct CaseReader {
  StudyFile& study;
  const StudySource& source;
  const toml::table& group;
  const toml::table& table;
  StressCase launch;

  InputError fault(const std::string& key, std::string found, std::string allowed) const {
    const toml::node* at = table.get(key);
    return scene::error_at(scene::place_of(at ? *at : table, study.file), "group.cases." + key, found,
                           allowed);
  }
};

/// A scene with keys of its own, or why it cannot have them.
struct Changed {
  SceneFile scene;
  Fault refusal;
};

/// Changes a scene by tables of scene keys; a later one has the last word, also on keys that its own take
/// back. Unknown keys are faults in any case.
Expected<Changed> with_keys(const SceneFile& start, const std::vector<OverrideTable>& all,
                            const std::string& file) {
  std::vector<Change> changes;
  for (const auto& [name, node] : all) {
    if (!node) continue;
    std::vector<Change> earlier = std::exchange(changes, {});
    if (!node->is_table())
      return scene::error_at(scene::place_of(*node, file), name, scene::found_text(*node),
                             "a table of scene keys, written { key = value, ... }");
    for (const study::Leaf& leaf : study::leaves_as_written(*node->as_table())) {
      const scene::Place place = scene::place_of(*leaf.node, file);
      const auto key = scene::describe_key(start, leaf.name, place);
      if (!key) return scene::within(name, key.error());
      const auto value = scene::read_value(*leaf.node, *key, file);
      if (!value) return Changed{start, scene::within(name, value.error())};
      std::erase_if(earlier, [&](const Change& change) {
        return change.key == leaf.name || std::ranges::count(key->overrides, change.key) > 0;
      });
      changes.push_back(
          {leaf.name, *value, scene::format_value(*key, *value), name + "." + leaf.name, place});
    }
    changes.insert(changes.begin(), earlier.begin(), earlier.end());
  }
  auto scene = with_changes(start, changes, true);
  if (!scene) return Changed{start, scene.error()};
  return Changed{std::move(*scene), std::nullopt};
}

/// The scene that a case starts from: the study's, or its own under the study's overrides, whose refusal is a
/// fault of the study, never the refusal that a case expects.
Expected<SceneFile> starting_scene(const CaseReader& reader) {
  if (reader.launch.scene.empty()) return reader.study.scene;
  const toml::node* at = reader.table.get("scene");
  auto own = read_named_scene(reader.launch.scene, reader.source.folder, "group.cases.scene",
                              scene::place_of(at ? *at : reader.table, reader.study.file));
  if (!own) return own;
  auto changed = with_keys(*own, {{"set", reader.source.root.get("set")}}, reader.study.file);
  if (!changed) return changed.error();
  if (changed->refusal) return *changed->refusal;
  return std::move(changed->scene);
}

/// A mechanical run of a case. Its scene is checked for all that judging needs.
Fault add_run(const CaseReader& reader, const std::string& label, SceneFile scene,
              std::optional<std::size_t>& run) {
  if (!scene::has_charge(scene.scene))
    return reader.fault("scene", "a scene without a charge", "a scene with a charge");
  study::StudyCase made = study::case_of(label, std::move(scene));
  const double own = reader.launch.numerical_uncertainty;
  made.numerical_uncertainty = std::isfinite(own) ? own : reader.study.study.numerical_uncertainty;
  run = reader.study.cases.size();
  reader.study.cases.add(std::move(made));
  return std::nullopt;
}

/// A case of the reader has no run.
Fault read_refusal(CaseReader& reader, const Fault& refusal) {
  for (const char* key : {"against", "expect", "invariants", "caught_within"}) {
    if (reader.table.contains(key))
      return reader.fault(key, "a key of a case that runs", "refused alone: a case of the reader has no run");
  }
  reader.launch.expected = {Outcome::caught};
  if (refusal)
    reader.launch.refusal =
        fmt::format("{}: found {}; allowed: {}", refusal->key, refusal->found, refusal->allowed);
  return std::nullopt;
}

Fault read_runs(CaseReader& reader, const SceneFile& scene) {
  const StudyFile& study = reader.study;
  StressCase& launch = reader.launch;
  const bool own_bound = reader.table.contains("caught_within") || !reader.table.contains("expect");
  if (own_bound && launch.caught_within > 0 && std::ranges::count(launch.expected, Outcome::caught) == 0)
    return reader.fault("caught_within",
                        fmt::format("{} of a case that need not be caught", launch.caught_within),
                        "caught_within beside `expect` with \"caught\"");
  SceneFile own = scene;
  std::vector<double>& gaps = own.scene.surface.gaps;
  launch.gaps = gaps != study.scene.scene.surface.gaps ? gaps : study.study.gaps;
  const bool closes = own.scene.surface.model == scene::GapModel::closing;
  if (own.scene.coupling == scene::Coupling::two_way || closes) gaps = launch.gaps;
  if (Fault fault = add_run(reader, launch.label(), std::move(own), launch.run)) return fault;
  const bool of_case = reader.table.contains("against");
  const toml::node* against = (of_case ? reader.table : reader.group).get("against");
  if (!against || (against->is_table() && against->as_table()->empty())) {
    if (launch.invariants == places_of_all_invariants() || !launch.has("same-temperature"))
      return std::nullopt;
    return reader.fault("invariants", "same-temperature, without a safe computation to compare with",
                        "same-temperature beside keys of `against`");
  }
  auto safe = with_keys(scene, {{of_case ? "group.cases.against" : "group.against", against}}, study.file);
  if (!safe) return safe.error();
  if (safe->refusal) return safe->refusal;
  // A safe computation of the launch alone.
  safe->scene.scene.coupling = scene::Coupling::one_way;
  safe->scene.scene.surface.model = scene::GapModel::reservoir;
  return add_run(reader, launch.label() + ", against", std::move(safe->scene), launch.against);
}

Fault read_case(CaseReader reader) {
  StressCase& launch = reader.launch;
  launch.group = launch.name;
  const std::string& file = reader.study.file;
  const auto read = scene::read_table(reader.table, case_keys, {"set", "against"}, file, launch);
  if (!read) return scene::within("group.cases", read.error());
  const auto& others = settings_of<StabilitySettings>(reader.study.study).cases;
  if (std::ranges::count(others, launch.label(), &StressCase::label) > 0)
    return reader.fault("name", fmt::format("\"{}\" a second time in \"{}\"", launch.name, launch.group),
                        "a name that no other case of the group has");
  if (launch.invariants.empty())
    return reader.fault("invariants", "none, so that nothing could be WRONG", "at least one; all if absent");
  const auto start = starting_scene(reader);
  if (!start) return start.error();
  const auto changed = with_keys(
      *start, {{"group.set", reader.group.get("set")}, {"group.cases.set", reader.table.get("set")}}, file);
  if (!changed) return changed.error();
  const bool runs = launch.refused.empty();
  if (runs && changed->refusal) return changed->refusal;
  Fault fault = runs ? read_runs(reader, changed->scene) : read_refusal(reader, changed->refusal);
  if (!fault) settings_of<StabilitySettings>(reader.study.study).cases.push_back(std::move(launch));
  return fault;
}

Fault read_group(const toml::table& group, const StudySource& source, StudyFile& study) {
  StressCase defaults;
  const auto read = scene::read_table(group, case_keys, {"set", "against", "cases"}, study.file, defaults);
  if (!read) return scene::within("group", read.error());
  const toml::node* cases = group.get("cases");
  if (!cases || !cases->is_array_of_tables())
    return scene::error_at(scene::place_of(cases ? *cases : group, study.file), "group.cases",
                           cases ? scene::found_text(*cases) : "nothing; the key is missing",
                           "an array of tables, written [{ name = \"...\", set = { ... } }, ...]");
  for (const toml::node& element : *cases->as_array())
    if (Fault fault = read_case({study, source, group, *element.as_table(), defaults})) return fault;
  return std::nullopt;
}

Fault make_stability_cases(const StudySource& source, StudyFile& study) {
  if (!std::isfinite(study.study.numerical_uncertainty)) {
    return fault_at(study, "numerical_uncertainty", "nothing; the key is missing",
                    "the uncertainty that verdicts of the table are judged with: with a large one assumed "
                    "nothing could be WRONG");
  }
  const toml::node* node = source.root.get("group");
  const std::string allowed = "at least one table, written [[group]], with a case that has a run";
  if (node && !node->is_array_of_tables())
    return scene::error_at(scene::place_of(*node, study.file), "group", scene::found_text(*node), allowed);
  if (node) {
    for (const toml::node& element : *node->as_array())
      if (Fault fault = read_group(*element.as_table(), source, study)) return fault;
  }
  if (!study.cases.empty()) return std::nullopt;
  return scene::error_at(place_of_key(study, node ? "group" : "kind"), "group", "no case that runs", allowed);
}

/// A case that is WRONG is the worst outcome of a study. No case makes it indeterminate.
std::vector<Failure> stability_failures(const StabilityResult& result) {
  std::vector<Failure> failures;
  for (const StressCaseRow& row : result.rows) {
    if (row.is_as_expected()) continue;
    const std::string unexpected = fmt::format("{}, which is not what the study expects: {}",
                                               to_string(row.finding.outcome), row.finding.text);
    add_failure(failures, row.asked.label(), row.answer.outcome,
                row.computed() ? unexpected : row.answer.failure);
  }
  return failures;
}

}  // namespace

std::string to_string(Outcome outcome) {
  static constexpr std::array names{"held", "degraded", "caught", "WRONG"};
  return names[static_cast<std::size_t>(outcome)];
}

Kind stability_kind() {
  return {
      .traits = {.name = "stability",
                 .gives_verdicts = false,
                 .own_scenes = true,
                 .closing_gaps = study::ClosingGaps::launched,
                 .goes_through_ignition = true},
      .keys = joined({gaps_keys(), judging_keys()}),
      .tables = {study_table_of("group", case_keys)},
      .make_cases = make_stability_cases,
      .run = outcome_of<run_stability, stability_failures>,
      .files = {"outcomes.svg"},
      .results = stability_results,
  };
}

}  // namespace launchsafe::kinds
