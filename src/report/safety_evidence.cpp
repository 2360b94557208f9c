// What a safety report rests on: the folders of studies, read and held against what they say of themselves,
// and against each other.
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/safety_report.hpp"
#include "launchsafe/study/case_answer.hpp"

namespace launchsafe::report {
namespace {

using std::filesystem::path;
using store::Error;

constexpr const char* results = "study.json";

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

/// Files as they were written; a picture stands in the row that tells what it shows.
void read_files(StudyEvidence& study) {
  auto files = store::read_as_written(study.folder, study.record.files);
  if (!files)
    refuse(
        fmt::format("{}; allowed: files as they were written ({})", files.error().message, study.command()));
  for (const store::TextFile& file : *files)
    if (file.name == results) study.study = Row::parse(file.text, nullptr, false);
  if (study.study.is_null()) return;
  for (const auto& [key, asked] :
       {std::pair{"kind", study.kind}, {"title", study.title}, {"study", study.record.study}})
    if (const std::string found = text_of(study.study, key); found != asked)
      throw study.fault(
          results, fmt::format("found results of {} \"{}\", its manifest is of \"{}\"", key, found, asked),
          "results as a study writes them");
  for (Row& picture : study.study["pictures"])
    for (store::TextFile& file : *files)
      if (file.name == text_of(picture, "file")) picture["svg"] = std::move(file.text);
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
  if (first_has("cases", "invariants")) return tells::stability;
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
    throw study.fault(store::manifest_name,
                      fmt::format("its study is of model version {}, this program is of {}",
                                  manifest.model_version, run::model_version),
                      "studies of this version");
  const auto [file, scene_text] = parts_of(manifest.input_text);
  // Of a manifest that was edited nothing is asked, and it is refused for its kind.
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
  if (study.study.contains("verdicts")) check_rows(study);
  return study;
}

// --- all studies ---

/// Whether scenes that differ in a key are of different shells. Loads, cracks, gaps, constants of the
/// surface, interfaces and numerics are what studies vary.
bool is_of_shell(const std::string& key) {
  if (key == "charge.crack_radius" || key == "charge.flaw_size" || key == "charge.crack_friction")
    return false;
  return key == scene::foreign_shell || key == "symmetry" || key.starts_with("steel.") ||
         key.starts_with("charge.") || key.starts_with("elastic.") || key.starts_with("material.");
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
    // One about the program, and not about a launch, has scenes of its own.
    if (&study == &main || study.tells == tells::stability) continue;
    study.differences = study::differences(study.scene.scene, main.scene.scene);
    const auto said_by = [](const scene::Acceptance& one) { return one.key + "=" + one.value; };
    if (!std::ranges::equal(study.scene.scene.accepted, main.scene.scene.accepted, {}, said_by, said_by))
      study.differences.push_back({{.name = "accept"}, {}, {}});
    std::vector<std::string> of_shell;
    for (const study::Difference& each : study.differences)
      if (is_of_shell(each.key.name)) of_shell.push_back(each.key.name);
    if (!of_shell.empty())
      refuse(
          fmt::format("the studies concern different shells: {} \"{}\", {} \"{}\", which differ in {}; "
                      "allowed: studies of one shell in a report",
                      main.folder.string(), main.scene.scene.title, study.folder.string(),
                      study.scene.scene.title, fmt::join(of_shell, ", ")));
  }
}

// --- one launch, whichever study judges it ---

double bound_of(const CaseEvidence& judged) {
  return number_of(*judged.critical, "critical_gap_at_least_cm");
}

/// But for round-off and the widths of their brackets, which what ignites without a gap has not.
bool have_one_bound(const CaseEvidence& a, const CaseEvidence& b) {
  constexpr double round_off = 1e-6;  // cm
  const auto width = [](const Row& row) {
    const double cm = number_of(row, "critical_gap_upper_cm") - number_of(row, "critical_gap_lower_cm");
    return std::isfinite(cm) ? cm : 0.0;
  };
  const double first = bound_of(a), second = bound_of(b);
  return std::abs(first - second) <= round_off + width(*a.critical) + width(*b.critical) ||
         (std::isnan(first) && std::isnan(second));
}

/// Whether two cases are of one launch, computed with the same numerics.
bool is_same_launch(const CaseEvidence& a, const CaseEvidence& b) {
  // Of many cases most are told apart by their peaks.
  if (!study::same_number(a.value("load.peak"), b.value("load.peak"))) return false;
  return std::ranges::none_of(study::differences(a.input().scene.scene, b.input().scene.scene), is_of_launch);
}

/// Refuses studies that judge the same launch, with the same numerics, by different lower bounds of its
/// critical gap: they do not rest on the same records or statements. Where numerics or any other key of the
/// scene differs the bounds may. Not compared are critical gaps beyond the end of a search.
void check_agreement(const SafetyEvidence& evidence) {
  const auto text = [](const CaseEvidence& each) {
    const double bound = bound_of(each);
    return fmt::format("{} (case {}) {}", each.study->folder.string(), each.label,
                       std::isfinite(bound) ? significant(bound, 6) + " cm" : "a bound that is not known");
  };
  std::vector<CaseEvidence> earlier;
  for (const StudyEvidence& study : evidence.studies)
    for (CaseEvidence& each : cases_of(study)) {
      const std::string kind = text_of(*each.critical, "critical_gap_kind");
      if (kind != "value" && kind != "all-ignite") continue;
      for (const CaseEvidence& other : earlier) {
        if (other.study != &study && !have_one_bound(other, each) && is_same_launch(other, each))
          refuse(fmt::format(
              "two studies give one launch different lower bounds of its critical gap: {}, {}; allowed: "
              "studies of a launch with one uncertainty, which name the same calibration, accuracy and "
              "model_form and state the same",
              text(other), text(each)));
      }
      earlier.push_back(std::move(each));
    }
}

// --- the stored runs of the main study ---

/// Why the rows of a case cannot be those of its stored run, on which gaps are evaluated again; empty where
/// they can. What ignites went on in a run of its own.
std::string contradiction_of(const CaseEvidence& judged, StoredLaunch& stored) {
  constexpr double same_temperature = 0.01;  // K
  const trace::BottomTrace& trace = stored.result.mechanics.trace;
  for (const Row* row : judged.verdicts) {
    const double gap = number_of(*row, "gap_cm"), said = number_of(*row, "temperature_max_K");
    run::GapResult found = run::evaluate_gap(stored.scene, trace, gap / shown_gap(1.0));
    const double temperature = found.at_stations.temperature;
    if (std::abs(temperature - said) <= same_temperature)
      stored.result.gaps.push_back(std::move(found));
    else if (text_of(*row, "verdict") != "UNSAFE")
      return fmt::format("the gap of {} cm is called {} at {:.6g} K, and the stored run of {} gives {:.6g} K",
                         gap, text_of(*row, "verdict"), said, judged.label, temperature);
  }
  const surface::IgnitionOfGaps ignites(surface::skin_model(stored.scene), trace);
  const bool is_bound = text_of(*judged.critical, "critical_gap_kind") != "indeterminate";
  for (const auto& [key, expected] :
       {std::pair{"critical_gap_lower_cm", false}, {"critical_gap_upper_cm", true}})
    if (const double gap = number_of(*judged.critical, key);
        is_bound && std::isfinite(gap) && ignites(gap / shown_gap(1.0)) != expected)
      return fmt::format("{} of {} is {} cm, which the stored run contradicts", key, judged.label, gap);
  return {};
}

/// As far as they were kept. A file under another case's name is damaged too.
void read_stored_runs(SafetyEvidence& evidence) {
  const StudyEvidence& main = evidence.main();
  if (main.tells != tells::launch) return;
  for (const CaseEvidence& each : cases_of(main)) {
    const path name(text_of(*each.run, "stored_case"));
    if (name.empty() || !std::filesystem::exists(main.folder / name)) continue;
    auto read = store::read_case_file(main.folder / name);
    if (!read)
      refuse(fmt::format("{}; allowed: case files as they were written ({})", read.error().message,
                         main.command()));
    if (store::CaseIdentity(read->manifest.input_text).hash() != name.stem())
      throw main.fault(name, "this is the file of another case", "case files as they were written");
    if (read->result.mechanics.trace.samples() < 2) continue;
    StoredLaunch stored{each.input().scene.scene, {std::move(read->result.mechanics), {}}};
    if (const std::string contradiction = contradiction_of(each, stored); !contradiction.empty())
      throw main.fault(results, contradiction, "results and case files of one study");
    evidence.stored.emplace(each.label, std::move(stored));
  }
}

}  // namespace

bool is_of_launch(const study::Difference& difference) {
  const std::string& key = difference.key.name;
  return key != "title" && key != "gap.thickness" && !key.starts_with("output.");
}

std::vector<CaseEvidence> cases_of(const StudyEvidence& study) {
  const Row &criticals = study.rows("cases"), &verdicts = study.rows("verdicts"), &runs = study.rows("runs");
  const std::size_t gaps = study.planned.study.gaps.size();
  std::vector<CaseEvidence> cases;
  for (std::size_t place = 0; place < study.planned.cases.size(); ++place) {
    const Row& critical = criticals[place];
    CaseEvidence each{&study, place, &critical, runs.empty() ? &critical : &runs[place],
                      text_of(critical, "case")};
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
  const std::vector<study::Axis>& axes = study->planned.study.axes;
  for (std::size_t i = 0; i < axes.size(); ++i)
    if (axes[i].key.name == key) return study->planned.cases.coordinates(place)[i];
  return own_value(*study, key);
}

bool CaseEvidence::is_own() const {
  return std::ranges::all_of(study->planned.study.axes, [&](const study::Axis& axis) {
    return study::same_number(value(axis.key.name), own_value(*study, axis.key.name));
  });
}

std::string StudyEvidence::command() const {
  return fmt::format("launchsafe study {} -o {}", record.study.empty() ? "STUDY.toml" : record.study,
                     record.files.empty() ? folder.string() : "DIR");
}

Error StudyEvidence::fault(const path& file, std::string_view found, std::string_view allowed) const {
  return {Error::Kind::corrupt,
          fmt::format("{}: {}; allowed: {} ({})", (folder / file).string(), found, allowed, command())};
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
  check_agreement(evidence);
  read_stored_runs(evidence);
  return evidence;
} catch (const store::Error& error) {
  return error;
}

}  // namespace launchsafe::report
