// A study of kind stability as a file: its keys, and [[group]] with its cases.
#include "launchsafe/kinds/stability.hpp"
#include "study_keys.hpp"

namespace launchsafe::kinds {

using keys::words_key;

namespace {

/// Of a [[group]], which its cases take over, and of a case.
const std::vector<Key<StressCase>> case_keys{
    text_key("name", Standing::input, "Of the group, or of a case of it, unique in the group.", "load",
             &StressCase::name) |
        required(),
    text_key("scene", Standing::input, "Path of a scene of its own, from the study file's folder.",
             "stability/thin_shell.toml", &StressCase::scene),
    words_key("expect", Standing::input, "Outcomes that are expected; anything but WRONG if absent.",
              {"held", "degraded", "caught"}, &StressCase::expected),
    text_key("refused", Standing::input,
             "What the reader must say of the scene: then the case is one of the reader, and nothing runs.",
             "at least 0", &StressCase::refused),
    number_key("caught_within", Dimension::count, between(0, 1e9), Standing::input,
               "Steps within which a broken computation must be caught; 0: any number.",
               &StressCase::caught_within),
    number_key("tolerance", Dimension::temperature_difference, above_to(0, 1000), Standing::input,
               "By how much the maximum temperature may be off that of the safe computation; "
               "temperature_tolerance of the study if absent.",
               &StressCase::tolerance),
};

const std::vector<Key<StabilitySettings>> stability_keys{
    number_key("temperature_tolerance", Dimension::temperature_difference, above_to(0, 1000),
               Standing::assumed, "Tolerance of cases that state none.",
               &StabilitySettings::temperature_tolerance),
};

/// One case while it is read.
struct CaseReader {
  StudyFile& study;
  const StudySource& source;
  const toml::table& group;
  const toml::table& table;
  StressCase launch;

  [[noreturn]] void refuse(const std::string& key, std::string found, std::string allowed) const {
    const toml::node* at = table.get(key);
    throw error_at(scene::place_of(at ? *at : table, study.file), "group.cases." + key, found, allowed);
  }
};

/// A scene with keys of its own, or why it cannot have them.
using Changed = Expected<SceneFile>;

/// Changes a scene by tables of scene keys; a later one has the last word, also on keys that its own take
/// back. Unknown keys are refused in any case.
Changed with_keys(SceneFile start, const std::vector<OverrideTable>& all, const std::string& file) {
  std::vector<Change> changes;
  for (const OverrideTable& table : all) {
    const auto later = changes_in(table, file, "a table of scene keys, written { key = value, ... }", start);
    if (!later) return later.error();
    for (const Change& each : *later) {
      const auto overrides = scene::describe_key(start, each.name, each.place).overrides;
      std::erase_if(changes, [&](const Change& change) {
        return change.name == each.name || std::ranges::count(overrides, change.name) > 0;
      });
    }
    changes.insert(changes.end(), later->begin(), later->end());
  }
  return with_changes(start, changes);
}

/// The scene that a case starts from: the study's, or its own under the study's overrides, whose refusal is
/// one of the study, never that which a case expects.
SceneFile starting_scene(const CaseReader& reader) {
  if (reader.launch.scene.empty()) return reader.study.scene;
  const toml::node* at = reader.table.get("scene");
  const Place place = scene::place_of(at ? *at : reader.table, reader.study.file);
  const SceneFile own = scene::read_scene(scene::named_file(reader.source.folder, reader.launch.scene, place,
                                                            "group.cases.scene", "a scene file"));
  return taken(with_keys(own, {{"set", reader.source.root.get("set")}}, reader.study.file));
}

/// A mechanical run of a case, by its place. Its scene is checked for all that judging needs.
std::size_t add_run(const CaseReader& reader, const std::string& label, SceneFile scene) {
  if (!scene::has_charge(scene.scene))
    reader.refuse("scene", "a scene without a charge", "a scene with a charge");
  reader.study.cases.add(study::case_of(label, std::move(scene)));
  return reader.study.cases.size() - 1;
}

/// A case of the reader has no run.
void read_refusal(CaseReader& reader, const Changed& changed) {
  for (const char* key : {"against", "expect", "caught_within"})
    if (reader.table.contains(key))
      reader.refuse(key, "a key of a case that runs", "refused alone: a case of the reader has no run");
  reader.launch.expected = {Outcome::caught};
  if (!changed)
    reader.launch.refusal = fmt::format("{}: found {}; allowed: {}", changed.error().key,
                                        changed.error().found, changed.error().allowed);
}

void read_runs(CaseReader& reader, const SceneFile& scene) {
  const StudyFile& study = reader.study;
  StressCase& launch = reader.launch;
  const bool own_bound = reader.table.contains("caught_within") || !reader.table.contains("expect");
  if (own_bound && launch.caught_within > 0 && std::ranges::count(launch.expected, Outcome::caught) == 0)
    reader.refuse("caught_within", fmt::format("{} of a case that need not be caught", launch.caught_within),
                  "caught_within beside `expect` with \"caught\"");
  SceneFile own = scene;
  std::vector<double>& gaps = own.scene.surface.gaps;
  launch.gaps = gaps != study.scene.scene.surface.gaps ? gaps : study.study.gaps;
  if (own.scene.coupling == scene::Coupling::two_way) gaps = launch.gaps;
  launch.run = add_run(reader, launch.label(), std::move(own));
  const bool of_case = reader.table.contains("against");
  const toml::node* against = (of_case ? reader.table : reader.group).get("against");
  if (!against || (against->is_table() && against->as_table()->empty())) return;
  SceneFile safe =
      taken(with_keys(scene, {{of_case ? "group.cases.against" : "group.against", against}}, study.file));
  // A safe computation of the launch alone.
  safe.scene.coupling = scene::Coupling::one_way;
  launch.against = add_run(reader, launch.label() + ", against", std::move(safe));
}

void read_case(CaseReader reader) {
  StressCase& launch = reader.launch;
  launch.group = launch.name;
  const std::string& file = reader.study.file;
  scene::within("group.cases", [&] {
    return scene::read_table(reader.table, case_keys, {"set", "against"}, file, launch);
  });
  const auto& settings = settings_of<StabilitySettings>(reader.study);
  if (std::isnan(launch.tolerance)) launch.tolerance = settings.temperature_tolerance;
  if (std::ranges::count(settings.cases, launch.label(), &StressCase::label) > 0)
    reader.refuse("name", fmt::format("\"{}\" a second time in \"{}\"", launch.name, launch.group),
                  "a name that no other case of the group has");
  const Changed changed =
      with_keys(starting_scene(reader),
                {{"group.set", reader.group.get("set")}, {"group.cases.set", reader.table.get("set")}}, file);
  launch.refused.empty() ? read_runs(reader, taken(changed)) : read_refusal(reader, changed);
  settings_of<StabilitySettings>(reader.study.study).cases.push_back(std::move(launch));
}

void read_group(const toml::table& group, const StudySource& source, StudyFile& study) {
  StressCase defaults;
  scene::within("group", [&] {
    return scene::read_table(group, case_keys, {"set", "against", "cases"}, study.file, defaults);
  });
  const toml::node* cases = group.get("cases");
  if (!cases || !cases->is_array_of_tables())
    throw error_at(scene::place_of(cases ? *cases : group, study.file), "group.cases",
                   cases ? found_text(*cases) : "nothing; the key is missing",
                   "an array of tables, written [{ name = \"...\", set = { ... } }, ...]");
  for (const toml::node& element : *cases->as_array())
    read_case({study, source, group, *element.as_table(), defaults});
}

void make_stability_cases(const StudySource& source, StudyFile& study) {
  const std::string allowed = "at least one table, written [[group]], with a case that has a run";
  for (const toml::table* group : scene::tables_of(source.root, "group", study.file, allowed))
    read_group(*group, source, study);
  if (study.cases.empty())
    throw error_at(place_of_key(study, source.root.contains("group") ? "group" : "kind"), "group",
                   "no case that runs", allowed);
}

/// A case that is WRONG or not as expected fails the study.
std::vector<Failure> stability_failures(const StabilityResult& result) {
  std::vector<Failure> failures;
  for (const StressCaseRow& row : result.rows) {
    if (row.is_as_expected()) continue;
    CaseRow result = row.result;
    if (row.computed())
      result.failure = fmt::format("{}, which is not what the study expects: {}",
                                   to_string(row.finding.outcome), row.finding.text);
    add_failure(failures, row.asked.label(), result);
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
                 .goes_through_ignition = true},
      .keys = joined({gaps_keys(), search_keys(), own_keys(stability_keys)}),
      .tables = {study_table_of("group", case_keys)},
      .make_cases = make_stability_cases,
      .run = outcome_of<run_stability, stability_failures>,
      .results = stability_results,
  };
}

}  // namespace launchsafe::kinds
