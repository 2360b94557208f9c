// A study of kind stability as a file: its keys, and [[case]].
#include "launchsafe/kinds/stability.hpp"
#include "launchsafe/study/study_axes.hpp"
#include "launchsafe/study/study_cases.hpp"
#include "study_keys.hpp"
#include "study_outcome.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

namespace launchsafe::kinds {

using namespace study;
namespace {

using scene::Dimension, scene::InputError, scene::Key, scene::Place, scene::SceneFile, scene::Standing;

/// What may be expected: nobody expects a WRONG.
constexpr std::array expectable{Outcome::held, Outcome::degraded, Outcome::caught};

/// One [[case]] as read, without its tables of scene keys.
struct StressCaseText {
  std::string group, name, must_hold, scene, refused;
  double numerical_uncertainty = not_a_number;  ///< K
  double caught_within = 0;                     ///< steps
};

const std::vector<Key<StressCaseText>>& stress_case_keys() {
  static const std::vector<Key<StressCaseText>> keys{
      scene::required(scene::text_key<StressCaseText>("group", Standing::input, "What cases it belongs to.",
                                                      "load", &StressCaseText::group)),
      scene::required(scene::text_key<StressCaseText>("name", Standing::input,
                                                      "What the case is, unique in its group.", "peak 10 MPa",
                                                      &StressCaseText::name)),
      scene::required(
          scene::text_key<StressCaseText>("must_hold", Standing::input, "What must hold, a sentence.",
                                          "T max as with half the time step", &StressCaseText::must_hold)),
      scene::text_key<StressCaseText>("scene", Standing::input,
                                      "Path of a scene of its own, from the study file's folder.",
                                      "stability/thin_shell.toml", &StressCaseText::scene),
      scene::text_key<StressCaseText>(
          "refused", Standing::input,
          "What the reader must say of the scene: then the case is one of the reader, and nothing runs.",
          "at least 0", &StressCaseText::refused),
      scene::number_key<StressCaseText>(
          "caught_within", Dimension::count, scene::between(0, 1e9), Standing::input,
          "Steps within which a broken computation must be caught; 0: any number.",
          &StressCaseText::caught_within),
      scene::number_key<StressCaseText>(
          "numerical_uncertainty", Dimension::temperature_difference, scene::between(0, 1000),
          Standing::input,
          "Uncertainty of the maximum temperature with these numerics; the study's if absent.",
          &StressCaseText::numerical_uncertainty),
  };
  return keys;
}

/// One [[case]] while it is read.
struct CaseReader {
  StudyFile& study;
  const toml::table& table;
  StressCaseText text;
  std::map<std::string, Place> places;

  Place place_of(const std::string& key) const {
    const auto found = places.find(key);
    return found == places.end() ? scene::place_of(table, study.file) : found->second;
  }
  InputError fault(const std::string& key, std::string found, std::string allowed,
                   std::string suggestion = {}) const {
    return scene::error_at(place_of(key), "case." + key, std::move(found), std::move(allowed),
                           std::move(suggestion));
  }
};

/// A scene with keys of its own, or why it cannot have them.
struct Changed {
  SceneFile scene;
  std::optional<InputError> refusal;
};

/// Changes a scene by a table of scene keys, `name` in the case. Unknown keys are faults in any case.
scene::Expected<Changed> with_keys(const CaseReader& reader, const std::string& name,
                                   const SceneFile& start) {
  const toml::node* node = reader.table.get(name);
  if (!node) return Changed{start, std::nullopt};
  const toml::table* table = node->as_table();
  if (!table) {
    return scene::error_at(scene::place_of(*node, reader.study.file), "case." + name,
                           scene::found_text(*node), "a table of scene keys, written { key = value, ... }");
  }
  ChangedScene scene(start);
  for (const Leaf& leaf : leaves_as_written(*table)) {
    const Place place = scene::place_of(*leaf.node, reader.study.file);
    const auto key = scene::describe_key(start, leaf.name, place);
    if (!key) return in_table(key.error(), "case." + name);
    const auto value = scene::read_value(*leaf.node, *key, reader.study.file);
    if (!value) return Changed{start, in_table(value.error(), "case." + name)};
    scene.apply(
        {leaf.name, *value, scene::format_value(*key, *value), "case." + name + "." + leaf.name, place});
  }
  if (!scene.complete()) return Changed{start, scene.error()};
  return Changed{scene.take(), std::nullopt};
}

/// The scene that a case starts from: the study's, or its own with the study's overrides.
scene::Expected<SceneFile> starting_scene(const CaseReader& reader, const toml::table& root,
                                          const std::filesystem::path& folder) {
  if (reader.text.scene.empty()) return reader.study.scene;
  const std::filesystem::path path = folder / reader.text.scene;
  std::error_code status;
  if (!std::filesystem::exists(path, status)) {
    return reader.fault("scene", fmt::format("\"{}\", which does not exist", reader.text.scene),
                        "a scene file, by its path from the study file's folder");
  }
  auto read = scene::read_scene(path);
  if (!read || !root.contains("set")) return read;
  const CaseReader whole{reader.study, root, {}, {}};
  auto changed = with_keys(whole, "set", *read);
  if (!changed) return changed.error();
  if (changed->refusal) return *changed->refusal;
  return std::move(changed->scene);
}

scene::Expected<std::vector<Outcome>> read_expected(const CaseReader& reader) {
  const toml::node* node = reader.table.get("expect");
  std::vector<Outcome> expected;
  if (!node) return expected;
  const auto wrong = [&](const toml::node& at) {
    return scene::error_at(scene::place_of(at, reader.study.file), "case.expect", scene::found_text(at),
                           "\"held\", \"degraded\" or \"caught\", or an array of them");
  };
  const auto read_one = [&](const toml::node& word) {
    const auto text = word.value_exact<std::string>();
    const auto found = std::find_if(expectable.begin(), expectable.end(),
                                    [&](Outcome each) { return text && to_string(each) == *text; });
    if (found == expectable.end()) return false;
    expected.push_back(*found);
    return true;
  };
  const toml::array* array = node->as_array();
  if (!array) return read_one(*node) ? scene::Expected<std::vector<Outcome>>(expected) : wrong(*node);
  for (const toml::node& word : *array) {
    if (!read_one(word)) return wrong(word);
  }
  return expected;
}

/// A mechanical run of a case. Its scene is checked for all that judging needs.
scene::Expected<std::size_t> add_run(CaseReader& reader, const std::string& label, SceneFile scene) {
  if (!scene::has_charge(scene.scene)) {
    return reader.fault("scene", "a scene without a charge", "a scene with a charge");
  }
  StudyCase made = case_of(label, std::move(scene));
  made.numerical_uncertainty = std::isfinite(reader.text.numerical_uncertainty)
                                   ? reader.text.numerical_uncertainty
                                   : reader.study.study.numerical_uncertainty;
  reader.study.cases.push_back(std::move(made));
  return reader.study.cases.size() - 1;
}

/// A case of the reader has no run.
Fault read_refusal(const CaseReader& reader, const Changed& changed, StressCase& launch) {
  for (const char* key : {"against", "expect", "caught_within"}) {
    if (!reader.table.contains(key)) continue;
    return scene::error_at(scene::place_of(*reader.table.get(key), reader.study.file),
                           std::string("case.") + key, "a key of a case that runs",
                           "refused alone: a case of the reader has no run");
  }
  launch.must_refuse = reader.text.refused;
  launch.expected = {Outcome::caught};
  if (changed.refusal) {
    const InputError& error = *changed.refusal;
    launch.refusal = fmt::format("{}: found {}; allowed: {}", error.key, error.found, error.allowed);
  }
  return std::nullopt;
}

Fault read_runs(CaseReader& reader, Changed changed, StressCase& launch) {
  if (changed.refusal) return changed.refusal;
  const bool own_gaps = changed.scene.scene.surface.gaps != reader.study.scene.scene.surface.gaps;
  launch.gaps = own_gaps ? changed.scene.scene.surface.gaps : reader.study.study.gaps;
  const std::string label = launch.group + ": " + launch.name;
  const SceneFile scene = changed.scene;
  launch.burns = changed.scene.scene.coupling == scene::Coupling::two_way;
  if (launch.burns) changed.scene.scene.surface.gaps = launch.gaps;
  const auto run = add_run(reader, label, std::move(changed.scene));
  if (!run) return run.error();
  launch.run = *run;
  if (!reader.table.contains("against")) return std::nullopt;
  auto other = with_keys(reader, "against", scene);
  if (!other) return other.error();
  if (other->refusal) return other->refusal;
  other->scene.scene.coupling = scene::Coupling::one_way;  // a safe computation of the launch alone
  const auto against = add_run(reader, label + ", against", std::move(other->scene));
  if (!against) return against.error();
  launch.against = *against;
  return std::nullopt;
}

Fault read_case(CaseReader& reader, const toml::table& root, const std::filesystem::path& folder) {
  auto read = scene::read_table(reader.table, stress_case_keys(), {"set", "against", "expect"},
                                reader.study.file, reader.text);
  if (!read) return in_table(read.error(), "case");
  reader.places = std::move(*read);
  StressCase launch;
  launch.group = reader.text.group;
  launch.name = reader.text.name;
  launch.must_hold = reader.text.must_hold;
  launch.caught_within = static_cast<std::uint64_t>(reader.text.caught_within);
  for (const StressCase& other : settings_of<StabilitySettings>(reader.study.study).cases) {
    if (other.group != launch.group || other.name != launch.name) continue;
    return reader.fault("name", fmt::format("\"{}\" a second time in \"{}\"", launch.name, launch.group),
                        "a name that no other case of the group has");
  }
  auto expected = read_expected(reader);
  if (!expected) return expected.error();
  launch.expected = std::move(*expected);
  const auto start = starting_scene(reader, root, folder);
  if (!start) return start.error();
  auto changed = with_keys(reader, "set", *start);
  if (!changed) return changed.error();
  const bool refused = !reader.text.refused.empty();
  if (Fault fault =
          refused ? read_refusal(reader, *changed, launch) : read_runs(reader, std::move(*changed), launch))
    return fault;
  settings_of<StabilitySettings>(reader.study.study).cases.push_back(std::move(launch));
  return std::nullopt;
}

Fault make_stability_cases(const StudySource& source, StudyFile& study) {
  const toml::table& root = source.root;
  if (!std::isfinite(study.study.numerical_uncertainty)) {
    return fault_at(study, "numerical_uncertainty", "nothing; the key is missing",
                    "the uncertainty that verdicts of the matrix are judged with: with a large one assumed "
                    "nothing could be WRONG");
  }
  study.uncertainty_source = "as the study states";
  const toml::node* node = root.get("case");
  const std::string allowed = "at least one table, written [[case]], that has a run";
  if (node && !node->is_array_of_tables())
    return scene::error_at(scene::place_of(*node, study.file), "case", scene::found_text(*node), allowed);
  if (node) {
    for (const toml::node& element : *node->as_array()) {
      CaseReader reader{study, *element.as_table(), {}, {}};
      if (Fault fault = read_case(reader, root, source.folder)) return fault;
    }
  }
  if (study.cases.empty())
    return scene::error_at(place_of_key(study, node ? "case" : "kind"), "case", "no case that runs", allowed);
  return std::nullopt;
}

/// It varies nothing but what its cases say.
Fault read_stability(const StudySource&, StudyFile&) { return std::nullopt; }

/// A case that is WRONG is the worst outcome of a study. No case makes it indeterminate.
std::vector<Failure> stability_failures(const StabilityResult& result) {
  std::vector<Failure> failures;
  for (const StressCaseRow& row : result.rows) {
    const std::string label = row.group + ": " + row.name;
    if (!row.computed()) add_failure(failures, label, row.outcome, row.failure);
    if (row.is_wrong()) add_failure(failures, label, row.outcome, "WRONG: " + row.finding.text);
    if (row.computed() && !row.is_wrong() && !row.is_as_expected())
      add_failure(failures, label, row.outcome,
                  fmt::format("{}, which is not what the study expects: {}", to_string(row.finding.outcome),
                              row.finding.text));
  }
  return failures;
}

}  // namespace

std::string to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::held:
      return "held";
    case Outcome::degraded:
      return "degraded";
    case Outcome::caught:
      return "caught";
    case Outcome::wrong:
      break;
  }
  return "WRONG";
}

Kind stability_kind() {
  return {
      .traits = {.name = "stability",
                 .gaps_key = "gaps",
                 .gives_verdicts = false,
                 .own_scenes = true,
                 .goes_through_ignition = true},
      .keys = joined({gaps_keys(), judging_keys()}),
      .tables = {table_of("case", stress_case_keys())},
      .read = read_stability,
      .make_cases = make_stability_cases,
      .run = outcome_of<run_stability, stability_failures>,
      .files = {{"stability.csv"}, {"launches.csv"}},
  };
}

}  // namespace launchsafe::kinds
