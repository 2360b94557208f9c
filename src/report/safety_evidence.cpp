#include "launchsafe/report/safety_evidence.hpp"

#include "launchsafe/run/model_version.hpp"
#include "launchsafe/run/run_case.hpp"
#include "launchsafe/store/atomic_file.hpp"
#include "launchsafe/store/case_file.hpp"
#include "launchsafe/store/sha256.hpp"
#include "safety_agreement.hpp"
#include "safety_sections.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string_view>

namespace launchsafe::report {
namespace {

using safety::number_of;
using safety::text_of;
using std::filesystem::path;
using store::Error;

Error refused(std::string message) { return {Error::Kind::corrupt, std::move(message)}; }
Error refused(const path& place, std::string_view found, std::string_view allowed) {
  return refused(fmt::format("{}: {}; allowed: {}", place.string(), found, allowed));
}

path study_json_of(const StudyEvidence& study) { return study.folder / "study.json"; }

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
         key.starts_with("elastic.") || key.starts_with("material.");
}

// --- one study ---

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

/// Files as they were written; the maps over what varies are kept.
store::MaybeError check_files(StudyEvidence& study) {
  for (const store::WrittenFile& file : study.record.files) {
    const path place = study.folder / file.name;
    auto bytes = store::read_file(place);
    if (!bytes)
      return refused(place, "the manifest lists this file, and it cannot be read",
                     fmt::format("a study's report with all of its files ({})", study.command()));
    if (store::sha256(*bytes) != file.sha256)
      return refused(place,
                     "this is not what the study wrote, its checksum differs from that of the manifest",
                     fmt::format("files as they were written ({})", study.command()));
    if (file.name.starts_with("critical_gap") || file.name.starts_with("safe_gap"))
      if (file.name.ends_with(".svg")) study.drawings[file.name] = std::move(*bytes);
  }
  return {};
}

store::MaybeError read_study_json(StudyEvidence& study) {
  const bool listed = std::any_of(study.record.files.begin(), study.record.files.end(),
                                  [](const store::WrittenFile& file) { return file.name == "study.json"; });
  if (!listed) return {};
  const auto text = store::read_file(study_json_of(study));
  if (!text) return text.error();
  study.study = nlohmann::json::parse(*text, nullptr, false);
  if (!study.study.is_object() || text_of(study.study, "kind").empty())
    return refused(study_json_of(study), "found no results of a study", "study.json as a study writes it");
  if (text_of(study.study, "kind") != study.kind)
    return refused(study_json_of(study),
                   fmt::format("found results of kind {}, its manifest is of a study of kind {}",
                               text_of(study.study, "kind"), study.kind),
                   "study.json as a study writes it");
  // A critical-gap study of many cases has no names for them: here it is a sweep.
  if (const nlohmann::json& cases = study.rows("cases");
      study.kind == "critical-gap" && !cases.empty() && !cases.front().contains("case"))
    study.kind = "sweep";
  study.title = text_of(study.study, "title");
  if (study.record.study.empty()) study.record.study = text_of(study.study, "study");
  return {};
}

/// Whether a gap's own numbers, and the critical gap of its case, allow it to be called SAFE.
bool may_be_safe(const StudyEvidence& study, const nlohmann::json& row, const nlohmann::json* critical) {
  const double margin = number_of(row, "margin_K");
  if (!(margin > 0.0) || !text_of(row, "ignition_cause").empty()) return false;
  if (critical == nullptr) return true;
  constexpr double slack = 1e-6;  // K
  const double ignition = study.scene.scene.charge().kinetics.ignition_temperature;
  if (!(std::abs(ignition - number_of(row, "temperature_max_K") - margin) <= slack)) return false;
  const std::string kind = text_of(*critical, "critical_gap_kind");
  const double distance = number_of(*critical, "critical_gap_at_least_cm") - number_of(row, "gap_cm");
  return (kind == "all-safe" && distance >= 0.0 && margin > number_of(row, "uncertainty_K")) ||
         (kind == "value" && distance > 0.0);
}

/// Rows that are not all there, or whose own numbers contradict their SAFE.
store::MaybeError check_verdicts(const StudyEvidence& study) {
  const bool by_case = study.kind == "critical-gap";
  const nlohmann::json &cases = study.rows("cases"), &verdicts = study.rows("verdicts");
  if (by_case && study.finished() &&
      (cases.empty() || verdicts.empty() || verdicts.size() % cases.size() != 0))
    return refused(study_json_of(study),
                   fmt::format("found {} verdicts for {} cases", verdicts.size(), cases.size()),
                   "every gap in every case");
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    if (text_of(verdicts[i], "verdict") != "SAFE") continue;
    if (may_be_safe(study, verdicts[i], by_case ? &cases[i * cases.size() / verdicts.size()] : nullptr))
      continue;
    return refused(study_json_of(study),
                   fmt::format("a gap of {} cm is called SAFE, which its temperature, its margin, the "
                               "uncertainty or the critical gap contradicts",
                               number_of(verdicts[i], "gap_cm")),
                   "verdicts as a study writes them");
  }
  return {};
}

/// An unfinished study has told of its runs in its results file alone.
store::MaybeError read_runs(StudyEvidence& study) {
  if (!std::filesystem::exists(study.folder / "cases")) return {};
  const auto opened = store::CaseStore::open_to_read(study.folder, study.record.manifest.model_version);
  if (!opened) return opened.error();
  study.runs = (*opened)->records();
  return {};
}

store::Result<StudyEvidence> read_study(const path& folder, std::size_t number) {
  StudyEvidence study;
  study.label = fmt::format("S{}", number);
  study.folder = folder;
  auto record = store::read_study_record(folder);
  if (!record)
    return refused((record.error().kind == Error::Kind::missing
                        ? folder.string() + ": found no study there (no manifest.json)"
                        : record.error().message) +
                   "; allowed: folders that launchsafe study STUDY.toml -o DIR wrote");
  study.record = std::move(*record);
  const store::Manifest& manifest = study.record.manifest;
  if (manifest.model_version != run::model_version)
    return refused(folder,
                   fmt::format("its study is of model version {}, this program is of {}",
                               manifest.model_version, run::model_version),
                   "studies of this version, computed again by " + study.command());
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
  if (auto error = read_runs(study)) return *error;
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
                    "allowed: studies of one shell in a report",
                    main.folder.string(), main.scene.scene.title, study.folder.string(),
                    study.scene.scene.title, fmt::join(of_shell, ", ")));
  }
  return {};
}

store::MaybeError check_kinds(const SafetyEvidence& evidence) {
  for (const StudyEvidence& study : evidence.studies)
    if (const StudyEvidence* first = evidence.find(study.kind); first != &study)
      return refused(fmt::format("{} and {}: both are studies of kind {}; allowed: one of each kind",
                                 first->folder.string(), study.folder.string(), study.kind));
  return {};
}

/// Gaps of a case that are called SAFE, evaluated again on the case's stored run, must be as warm as their
/// verdicts say.
store::MaybeError check_against_run(const StudyEvidence& study, const CaseEvidence& stored) {
  const nlohmann::json &cases = study.rows("cases"), &verdicts = study.rows("verdicts");
  if (stored.mechanics.trace.samples() < 2) return {};
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    const nlohmann::json& row = verdicts[i];
    const bool of_case = text_of(cases[i * cases.size() / verdicts.size()], "case") == stored.label;
    const auto scene = scene_of(study, row);
    if (!of_case || text_of(row, "verdict") != "SAFE" || !scene) continue;
    const double gap = number_of(row, "gap_cm"), said = number_of(row, "temperature_max_K");
    const double found =
        run::evaluate_gap(*scene, stored.mechanics.trace, 1e-2 * gap).at_stations.temperature;
    if (std::abs(found - said) <= same_temperature) continue;
    return refused(
        study_json_of(study),
        fmt::format("the gap of {} cm is called SAFE at {:.6g} K, and the stored run of {} gives {:.6g} K",
                    gap, said, stored.label, found),
        fmt::format("results and case files of one study ({})", study.command()));
  }
  return {};
}

/// The stored runs of the main study, as far as they were kept. A file under another case's name is damaged
/// too.
store::MaybeError read_cases(SafetyEvidence& evidence) {
  const StudyEvidence& main = evidence.main();
  if (main.kind != "critical-gap") return {};
  for (const nlohmann::json& row : main.rows("runs")) {
    CaseEvidence each{text_of(row, "case"), text_of(row, "stored_case"), false, {}};
    const path name(each.file), file = main.folder / name;
    if (!name.is_absolute() && name.parent_path() == "cases" && std::filesystem::exists(file)) {
      auto stored = store::read_case_file(file);
      if (!stored)
        return refused(fmt::format("{}; allowed: case files as they were written ({})",
                                   stored.error().message, main.command()));
      if (store::CaseIdentity(stored->manifest.input_text).hash() != name.stem())
        return refused(file, "this is the file of another case",
                       fmt::format("case files as they were written ({})", main.command()));
      each.mechanics = std::move(stored->result.mechanics);
      each.present = true;
      if (auto error = check_against_run(main, each)) return *error;
    }
    evidence.cases.push_back(std::move(each));
  }
  return {};
}

}  // namespace

std::optional<scene::Scene> scene_of(const StudyEvidence& study, const nlohmann::json& verdict) {
  scene::Scene scene = study.scene.scene;
  scene.load.peak = 1e6 * number_of(verdict, "peak_pressure_MPa");
  scene.charge().strength.initial_crack_radius = 1e-6 * number_of(verdict, "crack_radius_um");
  scene.charge().strength.flaw_size = 1e-3 * number_of(verdict, "flaw_size_mm");
  return std::isfinite(scene.load.peak) ? std::optional(scene) : std::nullopt;
}

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
  for (const char* kind : {"critical-gap", "sweep"})
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
  if (auto error = check_agreement(evidence)) return *error;
  if (auto error = read_cases(evidence)) return *error;
  return evidence;
}

}  // namespace launchsafe::report
