#include "launchsafe/report/safety_evidence.hpp"

#include "launchsafe/report/number.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/run/model_version.hpp"
#include "launchsafe/run/run_case.hpp"
#include "launchsafe/scene/acceptance.hpp"
#include "launchsafe/store/atomic_file.hpp"
#include "launchsafe/store/case_file.hpp"
#include "launchsafe/store/sha256.hpp"
#include "launchsafe/study/changed_scene.hpp"
#include "launchsafe/study/study_axes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace launchsafe::report {
namespace {

using std::filesystem::path;
using store::Error;

Error refused(std::string message) { return {Error::Kind::corrupt, std::move(message)}; }
Error refused(const path& place, std::string_view found, std::string_view allowed) {
  return refused(fmt::format("{}: {}; allowed: {}", place.string(), found, allowed));
}

path study_json_of(const StudyEvidence& study) { return study.folder / "study.json"; }

// --- one study ---

/// The two parts of a study's input: its file, and the scene; what else follows begins with a remark of its
/// own.
std::pair<std::string, std::string> parts_of(const std::string& input) {
  constexpr std::string_view heading = "\n\n# scene\n";
  const std::size_t begin = input.rfind(heading);
  if (begin == std::string::npos) return {input, {}};
  const std::size_t first = begin + heading.size(), end = input.find("\n\n# ", first);
  return {input.substr(0, begin), input.substr(first, end == std::string::npos ? end : end - first)};
}

Row keys_asked(const std::string& study_file) {
  Row asked = Row::object();
  try {
    for (const auto& [key, node] : toml::parse(study_file)) {
      const auto text = node.value<std::string>();
      asked[std::string(key.str())] = text ? Row(*text) : Row(true);
    }
  } catch (const toml::parse_error&) {
    // A manifest that was edited: without a kind the study is refused.
  }
  return asked;
}

/// Files as they were written.
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
    if (file.name.ends_with(".svg")) study.drawings[file.name] = std::move(*bytes);
    if (file.name == "study.json") study.study = Row::parse(*bytes, nullptr, false);
  }
  if (study.study.is_null()) return {};
  if (!study.study.is_object() || text_of(study.study, "kind").empty())
    return refused(study_json_of(study), "found no results of a study", "study.json as a study writes it");
  if (text_of(study.study, "kind") != study.kind)
    return refused(study_json_of(study),
                   fmt::format("found results of kind {}, its manifest is of a study of kind {}",
                               text_of(study.study, "kind"), study.kind),
                   "study.json as a study writes it");
  study.title = text_of(study.study, "title");
  if (study.record.study.empty()) study.record.study = text_of(study.study, "study");
  return {};
}

bool has_several_values(const Row& axis) {
  const auto values = axis.find("values");
  return text_of(axis, "key") != quantity::gap().key() && values != axis.end() && values->size() > 1;
}

Tells told_by(const StudyEvidence& study) {
  if (!study.finished()) return Tells::nothing;
  const auto first_has = [&](const char* table, const char* key) {
    const Row& rows = study.rows(table);
    return !rows.empty() && rows.front().contains(key);
  };
  if (study.study.contains("verdicts"))
    // A study of a few launches names each of them; of many, what varies tells them apart.
    return first_has("cases", "case") ? Tells::launch : Tells::sweep;
  if (first_has("settings", "temperature_bound_K")) return Tells::accuracy;
  if (study.study.contains("indices")) return Tells::sensitivity;
  if (first_has("cases", "invariants")) return Tells::stability;
  return first_has("cases", "variant") ? Tells::models : Tells::nothing;
}

/// Whether a gap's own numbers, and the critical gap of its case, allow it to be called SAFE.
bool may_be_safe(const StudyEvidence& study, const Row& row, const Row& critical) {
  constexpr double slack = 1e-6;  // K
  const double margin = number_of(row, "margin_K"), gap = number_of(row, "gap_cm"),
               at_least = number_of(critical, "critical_gap_at_least_cm");
  if (!(margin > 0.0)) return false;
  for (const char* fault : {"ignition_cause", "validity_warnings", "unaccepted"})
    if (!text_of(row, fault).empty()) return false;
  // Another ignition temperature than the scene's may be what a sweep is over.
  const double ignition = study.scene.scene.charge().kinetics.ignition_temperature;
  if (study.tells == Tells::launch &&
      !(std::abs(ignition - number_of(row, "temperature_max_K") - margin) <= slack))
    return false;
  const std::string kind = text_of(critical, "critical_gap_kind");
  return (kind == "all-safe" && gap <= at_least && margin > number_of(row, "uncertainty_K")) ||
         (kind == "value" && gap < at_least);
}

/// Rows that are not all there, or whose own numbers contradict their SAFE.
store::MaybeError check_verdicts(const StudyEvidence& study) {
  if (study.tells != Tells::launch && study.tells != Tells::sweep) return {};
  const Row &cases = study.rows("cases"), &verdicts = study.rows("verdicts");
  if (cases.empty() || verdicts.empty() || verdicts.size() % cases.size() != 0)
    return refused(study_json_of(study),
                   fmt::format("found {} verdicts for {} cases", verdicts.size(), cases.size()),
                   "every gap in every case");
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    if (!verdicts[i].contains(quantity::reason_code().key()) || !study.study.contains("extrapolated"))
      return refused(study_json_of(study),
                     "an earlier program wrote these verdicts, without what they rest on as columns",
                     fmt::format("a study that this program made ({})", study.command()));
    if (text_of(verdicts[i], "verdict") != "SAFE" ||
        may_be_safe(study, verdicts[i], cases[i * cases.size() / verdicts.size()]))
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
  const auto [file, scene_text] = parts_of(manifest.input_text);
  study.asked = keys_asked(file);
  study.kind = text_of(study.asked, "kind");
  study.title = text_of(study.asked, "title");
  auto scene = scene::parse_scene(scene_text, folder / "manifest.json");
  if (!scene)
    return refused(fmt::format("{}: its input holds no scene that this program reads: {}",
                               (folder / "manifest.json").string(), scene.error().message()));
  study.scene = std::move(*scene);
  if (auto error = check_files(study)) return *error;
  study.tells = told_by(study);
  if (auto error = check_verdicts(study)) return *error;
  if (auto error = read_runs(study)) return *error;
  return study;
}

// --- all studies ---

/// Whether scenes that differ in a key are of different shells. Loads, cracks, gaps, constants of the
/// surface, interfaces and numerics are what studies vary.
bool is_of_shell(const study::Difference& difference) {
  const std::string& key = difference.key.name;
  if (key == "charge.crack_radius" || key == "charge.flaw_size" || key == "charge.crack_friction")
    return false;
  return key == scene::foreign_shell || key == "symmetry" || key.starts_with("steel.") ||
         key.starts_with("charge.") || key.starts_with("elastic.") || key.starts_with("material.");
}

store::MaybeError compare_scenes(SafetyEvidence& evidence) {
  const StudyEvidence& main = evidence.main();
  for (StudyEvidence& study : evidence.studies) {
    // One about the program, and not about a launch, has scenes of its own.
    if (&study == &main || study.tells == Tells::stability) continue;
    study.differences = study::differences(study.scene.scene, main.scene.scene);
    const auto accepted_by = [](const StudyEvidence& each) {
      std::vector<std::string> all;
      for (const scene::Acceptance& one : each.scene.scene.accepted) all.push_back(one.key + "=" + one.value);
      return all;
    };
    if (accepted_by(study) != accepted_by(main)) study.differences.push_back({{.name = "accept"}, {}, {}});
    std::string of_shell;
    for (const study::Difference& each : study.differences)
      if (is_of_shell(each)) of_shell += (of_shell.empty() ? "" : ", ") + each.key.name;
    if (of_shell.empty()) continue;
    return refused(
        fmt::format("the studies concern different shells: {} \"{}\", {} \"{}\", which differ in {}; "
                    "allowed: studies of one shell in a report",
                    main.folder.string(), main.scene.scene.title, study.folder.string(),
                    study.scene.scene.title, of_shell));
  }
  return {};
}

store::MaybeError check_kinds(const SafetyEvidence& evidence) {
  for (const StudyEvidence& study : evidence.studies)
    for (const StudyEvidence* first = evidence.studies.data(); first != &study; ++first)
      if (first->kind == study.kind && first->tells == study.tells)
        return refused(fmt::format("{} and {}: both are studies of kind {}; allowed: one of each kind",
                                   first->folder.string(), study.folder.string(), study.kind));
  return {};
}

/// Gaps of a case that are called SAFE, evaluated again on the case's stored run, must be as warm as their
/// verdicts say.
store::MaybeError check_against_run(const StudyEvidence& study, const CaseEvidence& judged,
                                    const run::MechanicsResult& stored) {
  if (stored.trace.samples() < 2) return {};
  const auto scene = scene_of(study, judged);
  if (!scene)
    return refused(study_json_of(study), "found a case that its scene cannot be: " + scene.error().message(),
                   "results as a study writes them");
  for (const Row* row : judged.verdicts) {
    if (text_of(*row, "verdict") != "SAFE") continue;
    const double gap = number_of(*row, "gap_cm"), said = number_of(*row, "temperature_max_K");
    const double found =
        run::evaluate_gap(scene->scene, stored.trace, gap / shown_gap(1.0)).at_stations.temperature;
    if (std::abs(found - said) <= same_temperature) continue;
    return refused(
        study_json_of(study),
        fmt::format("the gap of {} cm is called SAFE at {:.6g} K, and the stored run of {} gives {:.6g} K",
                    gap, said, judged.label, found),
        fmt::format("results and case files of one study ({})", study.command()));
  }
  return {};
}

/// The stored runs of the main study, as far as they were kept. A file under another case's name is damaged
/// too.
store::MaybeError read_stored_runs(SafetyEvidence& evidence) {
  const StudyEvidence& main = evidence.main();
  if (main.tells != Tells::launch) return {};
  const std::vector<CaseEvidence> cases = cases_of(main);
  for (const Row& row : main.rows("runs")) {
    const path name(text_of(row, "stored_case")), file = main.folder / name;
    if (name.is_absolute() || name.parent_path() != "cases" || !std::filesystem::exists(file)) continue;
    auto stored = store::read_case_file(file);
    if (!stored)
      return refused(fmt::format("{}; allowed: case files as they were written ({})", stored.error().message,
                                 main.command()));
    if (store::CaseIdentity(stored->manifest.input_text).hash() != name.stem())
      return refused(file, "this is the file of another case",
                     fmt::format("case files as they were written ({})", main.command()));
    for (const CaseEvidence& each : cases)
      if (each.label == text_of(row, "case"))
        if (auto error = check_against_run(main, each, stored->result.mechanics)) return *error;
    evidence.mechanics[text_of(row, "case")] = std::move(stored->result.mechanics);
  }
  return {};
}

}  // namespace

double own_value(const StudyEvidence& study, const std::string& key) {
  return key == "load.peak" ? scene::PressureHistory(study.scene.scene.load).stated_peak()
                            : study::number_in(study.scene, key);
}

/// Verdicts stand case after case, in the order of the cases, each with all gaps of the study.
std::vector<CaseEvidence> cases_of(const StudyEvidence& study) {
  struct Varied {
    std::string scene_key, column, words;
    Form form;
  };
  std::vector<Varied> all{
      {"load.peak", quantity::peak_pressure().key(), "", quantity::peak_pressure().form},
      {"charge.crack_radius", quantity::crack_radius().key(), "", quantity::crack_radius().form},
      {"charge.flaw_size", quantity::flaw_size().key(), "", quantity::flaw_size().form}};
  for (const Row& axis : study.rows("axes")) {
    const auto key = scene::describe_key(study.scene, text_of(axis, "scene_key"), {});
    if (!key || text_of(axis, "key") == quantity::gap().key()) continue;
    std::string words = has_several_values(axis) ? text_of(axis, "name") : "";
    std::ranges::replace(words, '_', ' ');
    all.push_back({key->name,
                   text_of(axis, "key"),
                   words,
                   {.dimension = key->dimension, .unit = text_of(axis, "unit")}});
  }
  std::map<std::string, const Row*> run_of;
  for (const Row& run : study.rows("runs")) run_of[text_of(run, "case")] = &run;
  const Row &criticals = study.rows("cases"), &verdicts = study.rows("verdicts");
  std::vector<CaseEvidence> cases;
  for (const Row& critical : criticals) {
    CaseEvidence& each = cases.emplace_back(CaseEvidence{text_of(critical, "case"), &critical});
    const std::size_t gaps = verdicts.size() / criticals.size(), first = (cases.size() - 1) * gaps;
    for (std::size_t i = first; i < first + gaps; ++i) each.verdicts.push_back(&verdicts[i]);
    int axis = 0;
    for (const Varied& varied : all) {
      double shown = number_of(critical, varied.column);
      if (std::isnan(shown) && gaps > 0) shown = number_of(*each.verdicts.front(), varied.column);
      if (std::isnan(shown)) continue;
      each.values[varied.scene_key] = shown / shown_value(1.0, varied.form);
      if (varied.words.empty()) continue;
      const std::string place = varied.words + " " + significant(shown, 6) +
                                (varied.form.unit.empty() ? "" : " " + varied.form.unit);
      if (!critical.contains("case")) each.label += (each.label.empty() ? "" : ", ") + place;
      if (++axis > 2) each.others += (each.others.empty() ? "" : ", ") + place;
    }
    const auto run = run_of.find(each.label);
    each.status = text_of(run != run_of.end() ? *run->second : critical, "status");
  }
  return cases;
}

scene::Expected<scene::SceneFile> scene_of(const StudyEvidence& study, const CaseEvidence& judged) {
  std::vector<study::Change> changes;
  for (const auto& [key, value] : judged.values)
    if (!study::same_number(value, own_value(study, key))) changes.push_back({key, value, {}, key, {}});
  return study::with_changes(study.scene, changes);
}

std::string StudyEvidence::command() const {
  return fmt::format("launchsafe study {} -o DIR", record.study.empty() ? "STUDY.toml" : record.study);
}

const Row& StudyEvidence::rows(const std::string& table) const {
  static const Row none = Row::array();
  const auto found = study.find(table);
  return found != study.end() && found->is_array() ? *found : none;
}

const StudyEvidence* SafetyEvidence::find(Tells what) const {
  const auto found = std::ranges::find(studies, what, &StudyEvidence::tells);
  return found != studies.end() ? &*found : nullptr;
}

const StudyEvidence& SafetyEvidence::main() const {
  if (const StudyEvidence* launch = find(Tells::launch)) return *launch;
  const auto found = std::ranges::find_if(
      studies, [](const StudyEvidence& study) { return !study.finished() || study.tells == Tells::sweep; });
  return found != studies.end() ? *found : studies.front();
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
  if (auto error = read_stored_runs(evidence)) return *error;
  return evidence;
}

}  // namespace launchsafe::report
