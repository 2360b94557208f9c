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

/// study.json and its pictures.
void read_files(StudyEvidence& study) {
  if (study.record.files.empty()) return;
  const path results = study.folder / "study.json";
  study.study = Row::parse(store::read_file(results), nullptr, false);
  if (!study.finished()) refuse(results.string() + ": this is no JSON of a study");
  for (const Row& picture : study.rows("pictures")) {
    const std::string name = text_of(picture, "file");
    if (std::filesystem::exists(study.folder / name))
      study.pictures[name] = store::read_file(study.folder / name);
  }
}

StudyEvidence read_study(const path& folder, std::size_t number) {
  StudyEvidence study;
  study.label = std::string(1, static_cast<char>('A' + number));
  study.folder = folder;
  try {
    study.record = store::read_study_record(folder);
  } catch (const Error& error) {
    refuse((error.kind == Error::Kind::missing ? folder.string() + ": found no study there (no manifest.json)"
                                               : error.message) +
           "; allowed: folders that launchsafe study STUDY.toml -o DIR wrote");
  }
  const store::Manifest& manifest = study.record.manifest;
  if (manifest.model_version != run::model_version)
    refuse(fmt::format("{}: its study is of model version {}, this program is of {} ({})",
                       (folder / store::manifest_name).string(), manifest.model_version, run::model_version,
                       study.command()));
  const auto [file, scene_text] = parts_of(manifest.input_text);
  const toml::table asked = scene::parse_toml(file, folder / store::manifest_name);
  study.kind = asked["kind"].value_or("");
  auto scene = scene::caught(
      [&, &text = scene_text] { return scene::parse_scene(text, folder / store::manifest_name); });
  if (!scene)
    refuse(fmt::format("{}: its input holds no scene that this program reads: {}",
                       (folder / store::manifest_name).string(), scene.error().message()));
  study.scene = std::move(*scene);
  study.title = asked["title"].value_or(study.scene.scene.title);
  read_files(study);
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

/// One study of a launch, and all of one shell.
void compare_studies(SafetyEvidence& evidence) {
  const StudyEvidence& main = evidence.main();
  for (StudyEvidence& study : evidence.studies) {
    // A study of the program itself has scenes of its own.
    if (&study == &main || study.kind == "stability") continue;
    if (main.is_of_launch() && study.is_of_launch())
      refuse(fmt::format("{} and {}: both are studies of launches; allowed: one in a report",
                         main.folder.string(), study.folder.string()));
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

/// The launch of a main study without axes, as far as it was kept. What ignites went on in a run of its
/// own.
void read_stored_run(SafetyEvidence& evidence) {
  constexpr double same_temperature = 0.01;  // K
  const StudyEvidence& main = evidence.main();
  if (!main.is_of_launch() || !main.rows("axes").empty()) return;
  const path name(text_of(main.rows("runs").front(), "stored_case"));
  if (name.empty() || !std::filesystem::exists(main.folder / name)) return;
  run::CaseResult stored{store::read_case_file(main.folder / name).result.mechanics, {}};
  if (stored.mechanics.trace.samples() < 2) return;
  for (const Row& row : main.verdicts_of(0)) {
    const double gap = number_of(row, "gap_cm") / shown_gap(1.0);
    run::GapResult found = run::evaluate_gap(main.scene.scene, stored.mechanics.trace, gap);
    if (std::abs(found.at_stations.temperature - number_of(row, "temperature_max_K")) <= same_temperature)
      stored.gaps.push_back(std::move(found));
  }
  evidence.stored = std::move(stored);
}

}  // namespace

Row StudyEvidence::verdicts_of(std::size_t place) const {
  const Row& all = rows("verdicts");
  const std::size_t gaps = all.size() / rows("cases").size();
  const auto begin = all.begin() + static_cast<std::ptrdiff_t>(place * gaps);
  return Row::array_t(begin, begin + static_cast<std::ptrdiff_t>(gaps));
}

std::string StudyEvidence::command() const {
  return fmt::format("launchsafe study {} -o {}", record.study.empty() ? "STUDY.toml" : record.study,
                     record.files.empty() ? folder.string() : "DIR");
}

const StudyEvidence& SafetyEvidence::main() const {
  if (const auto launch = std::ranges::find_if(studies, &StudyEvidence::is_of_launch);
      launch != studies.end())
    return *launch;
  const auto found = std::ranges::find_if(
      studies, [](const StudyEvidence& study) { return !study.finished() || study.has_verdicts(); });
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
