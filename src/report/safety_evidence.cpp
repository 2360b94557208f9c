#include "launchsafe/report/safety_evidence.hpp"

#include "launchsafe/run/model_version.hpp"
#include "launchsafe/store/atomic_file.hpp"
#include "launchsafe/store/case_file.hpp"
#include "launchsafe/store/sha256.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

namespace launchsafe::report {
namespace {

using std::filesystem::path;
using store::Error;

Error refused(std::string message) { return {Error::Kind::corrupt, std::move(message)}; }

// --- the text of a manifest ---

constexpr std::string_view scene_heading = "\n\n# scene\n";

/// The scene's part of a study's input; what else follows it begins with a remark of its own.
std::string scene_text_of(const std::string& input) {
  const std::size_t begin = input.rfind(scene_heading);
  if (begin == std::string::npos) return {};
  const std::size_t end = input.find("\n\n# ", begin + scene_heading.size());
  const std::size_t first = begin + scene_heading.size();
  return input.substr(first, end == std::string::npos ? end : end - first);
}

/// Values of the scene by key, "body" with all bodies as one.
std::map<std::string, std::string> values_by_key(const std::string& scene_text) {
  std::map<std::string, std::string> values;
  std::string key;
  std::size_t begin = 0;
  while (begin < scene_text.size()) {
    const std::size_t end = std::min(scene_text.find('\n', begin), scene_text.size());
    const std::string line = scene_text.substr(begin, end - begin);
    begin = end + 1;
    const std::size_t equals = line.find(" = ");
    if (!line.starts_with(' ') && equals != std::string::npos) {
      key = line.substr(0, equals);
      values[key] = line.substr(equals + 3);
    } else if (!key.empty()) {
      values[key] += line;
    }
  }
  return values;
}

std::vector<std::string> differing_keys(const StudyEvidence& one, const StudyEvidence& other) {
  const auto a = values_by_key(scene_text_of(one.record.manifest.input_text));
  const auto b = values_by_key(scene_text_of(other.record.manifest.input_text));
  std::set<std::string> keys;
  for (const auto& [from, to] : {std::pair{&a, &b}, std::pair{&b, &a}})
    for (const auto& [key, value] : *from)
      if (const auto found = to->find(key); found == to->end() || found->second != value) keys.insert(key);
  return {keys.begin(), keys.end()};
}

/// Whether two scenes that differ in a key are of different shells. Loads, cracks, gaps, constants of the
/// surface, interfaces and numerics are what studies vary.
bool is_of_shell(const std::string& key) {
  if (key == "charge.crack_radius" || key == "charge.flaw_size" || key == "charge.crack_friction")
    return false;
  return key == "body" || key == "symmetry" || key.starts_with("steel.") || key.starts_with("charge.") ||
         key.starts_with("elastic.");
}

// --- one study ---

std::string string_in(const nlohmann::json& object, const char* key) {
  return object.contains(key) && object[key].is_string() ? object[key].get<std::string>() : std::string{};
}

/// What the study file says of a key, from the manifest: for a study without study.json.
std::string said_in(const std::string& input, const std::string& key) {
  const std::size_t begin = ("\n" + input).find("\n" + key + " = ");
  if (begin == std::string::npos) return {};
  const std::size_t first = begin + key.size() + 3;
  std::string text = input.substr(first, input.find('\n', first) - first);
  if (text.size() >= 2 && (text.front() == '\'' || text.front() == '"'))
    text = text.substr(1, text.size() - 2);
  return text;
}

store::MaybeError check_files(const StudyEvidence& study) {
  for (const store::WrittenFile& file : study.record.files) {
    const auto bytes = store::read_file(study.folder / file.name);
    if (!bytes)
      return refused(
          fmt::format("{}: the manifest lists this file, and it cannot be read; allowed: a study's "
                      "report with all of its files ({})",
                      (study.folder / file.name).string(), study.command()));
    if (store::sha256(*bytes) != file.sha256)
      return refused(
          fmt::format("{}: this is not what the study wrote, its checksum differs from that of the "
                      "manifest; allowed: files as they were written ({})",
                      (study.folder / file.name).string(), study.command()));
  }
  return {};
}

store::MaybeError read_study_json(StudyEvidence& study) {
  const bool listed = std::any_of(study.record.files.begin(), study.record.files.end(),
                                  [](const store::WrittenFile& file) { return file.name == "study.json"; });
  if (!listed) return {};
  const auto text = store::read_file(study.folder / "study.json");
  if (!text) return text.error();
  study.study = nlohmann::json::parse(*text, nullptr, false);
  if (!study.study.is_object() || string_in(study.study, "kind").empty())
    return refused(fmt::format("{}: found no results of a study; allowed: study.json as a study writes it",
                               (study.folder / "study.json").string()));
  study.kind = string_in(study.study, "kind");
  study.title = string_in(study.study, "title");
  if (study.record.study.empty()) study.record.study = string_in(study.study, "study");
  return {};
}

/// Rows that are not all there, or whose own numbers contradict their SAFE.
store::MaybeError check_verdicts(const StudyEvidence& study) {
  const std::size_t cases = study.rows("cases").size(), verdicts = study.rows("verdicts").size();
  if (study.kind == "critical-gap" && study.finished() &&
      (cases == 0 || verdicts == 0 || verdicts % cases != 0))
    return refused(fmt::format("{}: found {} verdicts for {} cases; allowed: every gap in every case",
                               (study.folder / "study.json").string(), verdicts, cases));
  for (const nlohmann::json& row : study.rows("verdicts")) {
    if (string_in(row, "verdict") != "SAFE") continue;
    const auto number = [&](const char* key) {
      return row.contains(key) && row[key].is_number() ? row[key].get<double>() : std::nan("");
    };
    if (number("margin_K") > number("uncertainty_K") && string_in(row, "ignition_cause").empty()) continue;
    return refused(
        fmt::format("{}: a gap of {} cm is called SAFE with a margin that is not above its "
                    "uncertainty; allowed: verdicts as a study writes them",
                    (study.folder / "study.json").string(), number("gap_cm")));
  }
  return {};
}

/// An unfinished study has told of its runs in its journal alone.
store::MaybeError read_journal(StudyEvidence& study) {
  if (!std::filesystem::exists(study.folder / "cases")) return {};
  const auto opened = store::CaseStore::open_to_read(study.folder, study.record.manifest.model_version);
  if (!opened) return opened.error();
  study.runs = (*opened)->entries();
  return {};
}

store::Result<StudyEvidence> read_study(const path& folder, std::size_t number) {
  StudyEvidence study;
  study.label = fmt::format("S{}", number);
  study.folder = folder;
  auto record = store::read_study_record(folder);
  if (!record) {
    if (record.error().kind == Error::Kind::missing)
      return refused(
          fmt::format("{}: found no study there (no manifest.json); allowed: folders that launchsafe "
                      "study STUDY.toml -o DIR wrote",
                      folder.string()));
    return refused(record.error().message +
                   "; allowed: folders that launchsafe study STUDY.toml -o DIR wrote");
  }
  study.record = std::move(*record);
  const store::Manifest& manifest = study.record.manifest;
  if (manifest.model_version != run::model_version)
    return refused(
        fmt::format("{}: its study is of model version {}, this program is of {}; allowed: studies of "
                    "this version, computed again by {}",
                    folder.string(), manifest.model_version, run::model_version, study.command()));
  study.kind = said_in(manifest.input_text, "kind");
  study.title = said_in(manifest.input_text, "title");
  auto scene = scene::parse_scene(scene_text_of(manifest.input_text), folder / "manifest.json");
  if (!scene)
    return refused(fmt::format("{}: its input holds no scene that this program reads: {}",
                               (folder / "manifest.json").string(), scene.error().message()));
  study.scene = std::move(*scene);
  if (auto error = check_files(study)) return *error;
  if (auto error = read_study_json(study)) return *error;
  if (auto error = check_verdicts(study)) return *error;
  if (auto error = read_journal(study)) return *error;
  return study;
}

// --- all studies ---

/// A study about the program and not about a launch: its scenes are its own.
bool concerns_no_launch(const StudyEvidence& study) { return study.kind == "stability"; }

store::MaybeError compare_scenes(SafetyEvidence& evidence) {
  const StudyEvidence& main = evidence.main();
  for (StudyEvidence& study : evidence.studies) {
    if (&study == &main || concerns_no_launch(study)) continue;
    study.differences = differing_keys(main, study);
    std::vector<std::string> of_shell;
    std::copy_if(study.differences.begin(), study.differences.end(), std::back_inserter(of_shell),
                 is_of_shell);
    if (of_shell.empty()) continue;
    return refused(
        fmt::format("the studies concern different shells: {} \"{}\", {} \"{}\", which differ in {}; "
                    "allowed: studies of one "
                    "shell in a report",
                    main.folder.string(), main.scene.scene.title, study.folder.string(),
                    study.scene.scene.title, fmt::join(of_shell, ", ")));
  }
  return {};
}

store::MaybeError check_kinds(const SafetyEvidence& evidence) {
  std::map<std::string, path> folders;
  for (const StudyEvidence& study : evidence.studies) {
    const auto [first, is_new] = folders.emplace(study.kind, study.folder);
    if (!is_new)
      return refused(fmt::format("{} and {}: both are studies of kind {}; allowed: one of each kind",
                                 first->second.string(), study.folder.string(), study.kind));
  }
  return {};
}

/// The stored runs of the main study, as far as they were kept. A file under another case's name is damaged
/// too.
store::MaybeError read_cases(SafetyEvidence& evidence) {
  const StudyEvidence& main = evidence.main();
  if (main.kind != "critical-gap") return {};
  for (const nlohmann::json& row : main.rows("runs")) {
    CaseEvidence each{string_in(row, "case"), string_in(row, "stored_case"), false, {}};
    const path name(each.file), file = main.folder / name;
    if (!name.is_absolute() && name.parent_path() == "cases" && std::filesystem::exists(file)) {
      auto stored = store::read_case_file(file);
      if (!stored)
        return refused(fmt::format("{}; allowed: case files as they were written ({})",
                                   stored.error().message, main.command()));
      if (store::CaseIdentity(stored->manifest.input_text).hash() != name.stem())
        return refused(
            fmt::format("{}: this is the file of another case; allowed: case files as they were "
                        "written ({})",
                        file.string(), main.command()));
      each.mechanics = std::move(stored->result.mechanics);
      each.present = true;
    }
    evidence.cases.push_back(std::move(each));
  }
  return {};
}

}  // namespace

std::string StudyEvidence::command() const {
  return fmt::format("launchsafe study {} -o DIR", record.study.empty() ? "STUDY.toml" : record.study);
}

const nlohmann::json& StudyEvidence::rows(const std::string& member) const {
  static const nlohmann::json none = nlohmann::json::array();
  if (!study.is_object()) return none;
  const auto found = study.find(member);
  return found != study.end() && found->is_array() ? *found : none;
}

const StudyEvidence* SafetyEvidence::find(const std::string& kind) const {
  const auto found = std::find_if(studies.begin(), studies.end(),
                                  [&](const StudyEvidence& study) { return study.kind == kind; });
  return found != studies.end() ? &*found : nullptr;
}

const StudyEvidence& SafetyEvidence::main() const {
  for (const char* kind : {"critical-gap", "sweep", "comparison"})
    if (const StudyEvidence* study = find(kind)) return *study;
  return studies.front();
}

store::Result<SafetyEvidence> read_safety_evidence(const std::vector<path>& folders) {
  SafetyEvidence evidence;
  for (const path& folder : folders) {
    auto study = read_study(folder, evidence.studies.size() + 1);
    if (!study) return study.error();
    evidence.studies.push_back(std::move(*study));
  }
  if (auto error = check_kinds(evidence)) return *error;
  if (auto error = compare_scenes(evidence)) return *error;
  if (auto error = read_cases(evidence)) return *error;
  return evidence;
}

}  // namespace launchsafe::report
