// What a safety report rests on: the folders of studies, read and held against each other.
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/safety_report.hpp"
#include "launchsafe/run/run_case.hpp"
#include "launchsafe/scene/constants.hpp"

namespace launchsafe::report {
namespace {

using std::filesystem::path;
using store::Error;

/// Ends the reading.
[[noreturn]] void refuse(std::string message) { throw Error{Error::Kind::corrupt, std::move(message)}; }

// --- one study ---

/// The two parts of a study's input: its file, and the scene; what else follows begins with a remark of its
/// own.
std::pair<std::string, std::string> parts_of(const std::string& input) {
  constexpr std::string_view heading = "\n\n# scene\n";
  const std::size_t begin = input.rfind(heading);
  if (begin == std::string::npos) return {input, {}};
  const std::size_t scene = begin + heading.size();
  return {input.substr(0, begin), input.substr(scene, input.find("\n\n# ", scene) - scene)};
}

/// study.json; a picture stands in the row that tells what it shows.
void read_files(StudyEvidence& study) {
  if (study.record.files.empty()) return;
  const path results = study.folder / "study.json";
  study.study = Row::parse(store::read_file(results).or_throw(), nullptr, false);
  if (!study.finished()) refuse(results.string() + ": this is no JSON of a study");
  for (Row& picture : study.study["pictures"])
    if (auto svg = store::read_file(study.folder / text_of(picture, "file")))
      picture["svg"] = std::move(*svg);
}

std::string told_by(const StudyEvidence& study) {
  const auto first_has = [&](const char* table, const char* key) {
    const Row& rows = study.rows(table);
    return !rows.empty() && rows.front().contains(key);
  };
  // A study of a few launches tells how each of them ran.
  if (study.study.contains("verdicts")) return study.study.contains("runs") ? tells::launch : tells::sweep;
  if (first_has("settings", "temperature_bound_K")) return tells::accuracy;
  if (study.study.contains("indices")) return tells::sensitivity;
  if (study.kind == "stability") return tells::stability;
  return tells::nothing;
}

StudyEvidence read_study(const path& folder, std::size_t number) {
  StudyEvidence study;
  study.label = std::string(1, static_cast<char>('A' + number));
  study.folder = folder;
  auto record = store::read_study_record(folder);
  if (!record)
    refuse((record.error().kind == Error::Kind::missing
                ? folder.string() + ": found no study there (no manifest.json)"
                : record.error().message) +
           "; allowed: folders that launchsafe study STUDY.toml -o DIR wrote");
  study.record = std::move(*record);
  const store::Manifest& manifest = study.record.manifest;
  if (manifest.model_version != run::model_version)
    refuse(fmt::format("{}: its study is of model version {}, this program is of {} ({})",
                       (folder / store::manifest_name).string(), manifest.model_version, run::model_version,
                       study.command()));
  const auto [file, scene_text] = parts_of(manifest.input_text);
  if (auto asked = scene::parse_toml(file, folder / store::manifest_name)) study.asked = std::move(*asked);
  study.kind = study.asked["kind"].value_or("");
  auto scene = scene::parse_scene(scene_text, folder / store::manifest_name);
  if (!scene)
    refuse(fmt::format("{}: its input holds no scene that this program reads: {}",
                       (folder / store::manifest_name).string(), scene.error().message()));
  study.scene = std::move(*scene);
  study.title = study.asked["title"].value_or(study.scene.scene.title);
  read_files(study);
  study.tells = told_by(study);
  return study;
}

// --- all studies ---

/// Whether scenes that differ in a key, or in their bodies, are of different shells. Studies vary loads,
/// cracks, gaps, interfaces, numerics and the keys of constants files.
bool is_of_shell(const std::string& name) {
  if (name == "charge.crack_radius" || name == "charge.flaw_size") return false;
  if (scene::shipped_constants().front()->values.contains(name)) return false;
  return name == "body" || name.starts_with("steel.") || name.starts_with("charge.") ||
         name.starts_with("elastic.") || name.starts_with("material.");
}

/// One study of a kind, and all of one shell.
void compare_studies(SafetyEvidence& evidence) {
  const StudyEvidence& main = evidence.main();
  for (StudyEvidence& study : evidence.studies) {
    const auto first = std::ranges::find_if(evidence.studies, [&](const StudyEvidence& each) {
      return each.kind == study.kind && each.tells == study.tells;
    });
    if (&*first != &study)
      refuse(fmt::format("{} and {}: both are studies of kind {}; allowed: one of each kind",
                         first->folder.string(), study.folder.string(), study.kind));
    // A study of the program itself has scenes of its own.
    if (&study == &main || study.tells == tells::stability) continue;
    study.differences = study::differences(study.scene.scene, main.scene.scene);
    std::vector<std::string> of_shell;
    std::ranges::copy_if(study.differences, std::back_inserter(of_shell), is_of_shell);
    if (!of_shell.empty())
      refuse(
          fmt::format("the studies concern different shells: {} \"{}\", {} \"{}\", which differ in {}; "
                      "allowed: studies of one shell in a report",
                      main.folder.string(), main.scene.scene.title, study.folder.string(),
                      study.scene.scene.title, fmt::join(of_shell, ", ")));
  }
}

/// Of the main study's own launch, as far as it was kept. What ignites went on in a run of its own.
void read_stored_run(SafetyEvidence& evidence) {
  constexpr double same_temperature = 0.01;  // K
  const StudyEvidence& main = evidence.main();
  if (main.tells != tells::launch) return;
  const std::vector<CaseEvidence> cases = cases_of(main);
  const auto own = std::ranges::find_if(cases, &CaseEvidence::is_own);
  if (own == cases.end()) return;
  const path name(text_of(*own->run, "stored_case"));
  if (name.empty() || !std::filesystem::exists(main.folder / name)) return;
  run::CaseResult stored{store::read_case_file(main.folder / name).or_throw().result.mechanics, {}};
  if (stored.mechanics.trace.samples() < 2) return;
  for (const Row* row : own->verdicts) {
    const double gap = number_of(*row, "gap_cm") / shown_gap(1.0);
    run::GapResult found = run::evaluate_gap(main.scene.scene, stored.mechanics.trace, gap);
    if (std::abs(found.at_stations.temperature - number_of(*row, "temperature_max_K")) <= same_temperature)
      stored.gaps.push_back(std::move(found));
  }
  evidence.stored = std::move(stored);
}

/// What a cell of an axis is of 1 in SI.
double unit_of(const StudyEvidence& study, const Row& axis) {
  const auto key = scene::describe_key(study.scene, text_of(axis, "scene_key"), {}).or_throw();
  return shown_value(1.0, {.dimension = key.dimension, .unit = text_of(axis, "unit")});
}

}  // namespace

std::vector<CaseEvidence> cases_of(const StudyEvidence& study) {
  std::vector<CaseEvidence> cases;
  if (!study.study.contains("verdicts")) return cases;
  const Row &criticals = study.rows("cases"), &verdicts = study.rows("verdicts"), &runs = study.rows("runs");
  const bool in_detail = runs.size() == criticals.size();
  const std::size_t gaps = criticals.empty() ? 0 : verdicts.size() / criticals.size();
  for (std::size_t place = 0; place < criticals.size(); ++place) {
    const Row& critical = criticals[place];
    CaseEvidence each{&study, &critical, in_detail ? &runs[place] : &critical, text_of(critical, "case")};
    for (std::size_t i = 0; i < gaps; ++i) each.verdicts.push_back(&verdicts[place * gaps + i]);
    cases.push_back(std::move(each));
  }
  return cases;
}

double own_value(const StudyEvidence& study, const std::string& key) {
  return key == "load.peak" ? scene::PressureHistory(study.scene.scene.load).stated_peak()
                            : study::number_in(study.scene, key);
}

double CaseEvidence::value(const std::string& key) const {
  for (const Row& axis : study->rows("axes"))
    if (text_of(axis, "scene_key") == key)
      return number_of(*critical, text_of(axis, "key")) / unit_of(*study, axis);
  return own_value(*study, key);
}

bool CaseEvidence::is_own() const {
  return std::ranges::all_of(study->rows("axes"), [&](const Row& axis) {
    const std::string key = text_of(axis, "scene_key");
    return study::same_number(value(key), own_value(*study, key));
  });
}

std::string StudyEvidence::command() const {
  return fmt::format("launchsafe study {} -o {}", record.study.empty() ? "STUDY.toml" : record.study,
                     record.files.empty() ? folder.string() : "DIR");
}

const StudyEvidence* SafetyEvidence::find(const std::string& what) const {
  const auto found = std::ranges::find(studies, what, &StudyEvidence::tells);
  return found != studies.end() ? &*found : nullptr;
}

const StudyEvidence& SafetyEvidence::main() const {
  if (const StudyEvidence* launch = find(tells::launch)) return *launch;
  const auto found = std::ranges::find_if(
      studies, [](const StudyEvidence& study) { return !study.finished() || study.tells == tells::sweep; });
  return found != studies.end() ? *found : studies.front();
}

store::Result<SafetyEvidence> read_safety_evidence(const std::vector<std::filesystem::path>& folders) try {
  SafetyEvidence evidence;
  for (const std::filesystem::path& folder : folders)
    evidence.studies.push_back(read_study(folder, evidence.studies.size()));
  compare_studies(evidence);
  read_stored_run(evidence);
  return evidence;
} catch (const store::Error& error) {
  return error;
}

}  // namespace launchsafe::report
