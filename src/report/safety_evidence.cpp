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
/// For a file of a study, which its command would make anew.
[[noreturn]] void refuse(const StudyEvidence& study, const path& file, std::string_view found,
                         std::string_view allowed) {
  refuse(fmt::format("{}: {}; allowed: {} ({})", (study.folder / file).string(), found, allowed,
                     study.command()));
}

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
  const std::string kind = text_of(study.study, "kind");
  if (kind.empty() || kind != study.kind)
    refuse(
        study, results,
        fmt::format("found results of kind \"{}\", its manifest is of a study of kind {}", kind, study.kind),
        "results as a study writes them");
  study.title = text_of(study.study, "title");
  for (Row& picture : study.study["pictures"])
    for (store::TextFile& file : *files)
      if (file.name == text_of(picture, "file")) picture["svg"] = std::move(file.text);
}

bool closes(const StudyEvidence& study) {
  return study.scene.scene.surface.model == scene::GapModel::closing;
}

/// The accuracy of launches whose gap closes, or what they depend on, says nothing of the reservoir.
std::string told_by(const StudyEvidence& study) {
  const auto first_has = [&](const char* table, const char* key) {
    const Row& rows = study.rows(table);
    return !rows.empty() && rows.front().contains(key);
  };
  // A study of a few launches tells how each of them ran.
  if (study.study.contains("verdicts"))
    return !study.study.contains("runs") ? tells::sweep : closes(study) ? tells::closing : tells::launch;
  if (first_has("settings", "temperature_bound_K")) return closes(study) ? tells::nothing : tells::accuracy;
  if (study.study.contains("indices")) return closes(study) ? tells::nothing : tells::sensitivity;
  if (first_has("cases", "invariants")) return tells::stability;
  return first_has("cases", "variant") ? tells::models : tells::nothing;
}

/// Whether all launches that this program takes looked for the worst corner of a gap (cm) that closes.
bool corner_is_whole(const CaseEvidence& judged, double gap) {
  const auto scene = judged.scene();
  if (!scene) return false;
  study::StudyCase input;
  input.scene = *scene;
  input.closing = scene->scene.surface;
  const std::size_t wanted = study::closing_bounds(input).back().terms.size();
  return std::ranges::any_of(judged.study->rows("closing"), [&](const Row& row) {
    return text_of(row, "case") == judged.label && number_of(row, "gap_cm") == gap &&
           number_of(row, "corner_launches") >= static_cast<double>(wanted);
  });
}

/// What contradicts a verdict SAFE among the gap's own numbers and those of its case; empty for none.
std::string contradiction_of(const CaseEvidence& judged, const Row& row) {
  constexpr double slack = 1e-6;  // K
  const StudyEvidence& study = *judged.study;
  const double margin = number_of(row, "margin_K"), gap = number_of(row, "gap_cm"),
               at_least = number_of(*judged.critical, "critical_gap_at_least_cm");
  if (!(margin > 0.0)) return "its margin";
  // Of many cases whose gaps close the worst corner was not computed.
  if (closes(study) && (study.tells == tells::sweep || !corner_is_whole(judged, gap)))
    return "its worst corner, for which fewer launches looked than this program takes";
  // An earlier program looked less closely at measured curves.
  if (!study.scene.scene.load.curve_time.empty()) {
    const auto scene = judged.scene();
    const auto uncovered = scene ? run::uncovered_load(scene->scene.load) : std::vector<std::string>{"none"};
    if (!uncovered.empty()) return "its load: " + uncovered.front();
  }
  for (const char* fault : {"ignition_cause", "validity_warnings", "unaccepted"})
    if (!text_of(row, fault).empty()) return std::string("its ") + fault;
  // Another ignition temperature than the scene's may be what a sweep is over.
  const double ignition = study.scene.scene.charge().kinetics.ignition_temperature;
  if (study.tells != tells::sweep &&
      !(std::abs(ignition - number_of(row, "temperature_max_K") - margin) <= slack))
    return "its temperature";
  const std::string kind = text_of(*judged.critical, "critical_gap_kind");
  // An earlier program took a bound up to the end of the search for known.
  const double known = study::known_part_of_search * number_of(*judged.critical, "critical_gap_lower_cm");
  // An earlier program took wide brackets, in which what causes of uncertainty change vanishes.
  constexpr double widest_bracket = 1.01e-4;  // cm
  if (kind == "value" && !closes(study) &&
      !(number_of(*judged.critical, "critical_gap_upper_cm") -
            number_of(*judged.critical, "critical_gap_lower_cm") <=
        widest_bracket))
    return "a bracket of its critical gap that is too wide for its bounds";
  const bool is_below =
      (kind == "all-safe" && gap <= at_least && gap <= known && margin > number_of(row, "uncertainty_K")) ||
      (kind == "value" && gap < at_least);
  return is_below ? "" : "the uncertainty or the critical gap";
}

/// Rows that are not all there, or whose own numbers contradict their SAFE.
void check_verdicts(const StudyEvidence& study) {
  if (!study.study.contains("verdicts")) return;
  const Row &cases = study.rows("cases"), &verdicts = study.rows("verdicts");
  if (cases.empty() || verdicts.empty() || verdicts.size() % cases.size() != 0)
    refuse(study, results, fmt::format("found {} verdicts for {} cases", verdicts.size(), cases.size()),
           "every gap in every case");
  const auto has_code = [](const Row& row) { return row.contains(quantity::reason_code.key()); };
  if (!study.study.contains("extrapolated") || !std::ranges::all_of(verdicts, has_code))
    refuse(study, results, "an earlier program wrote these verdicts, without what they rest on as columns",
           "a study that this program made");
  const auto is_no_verdict = [](const Row& row) {
    const std::string word = text_of(row, "verdict");
    return word != "SAFE" && word != "UNSAFE" && word != "INDETERMINATE";
  };
  if (std::ranges::any_of(verdicts, is_no_verdict))
    refuse(study, results, "found a word that is no verdict", "SAFE, UNSAFE or INDETERMINATE");
  for (const CaseEvidence& judged : cases_of(study))
    for (const Row* verdict : judged.verdicts)
      if (text_of(*verdict, "verdict") == "SAFE")
        if (const std::string contradiction = contradiction_of(judged, *verdict); !contradiction.empty())
          refuse(study, results,
                 fmt::format("a gap of {} cm is called SAFE against {}", number_of(*verdict, "gap_cm"),
                             contradiction),
                 "verdicts as a study of this program writes them");
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
    refuse(study, store::manifest_name,
           fmt::format("its study is of model version {}, this program is of {}", manifest.model_version,
                       run::model_version),
           "studies of this version");
  const auto [file, scene_text] = parts_of(manifest.input_text);
  // Of a manifest that was edited nothing is asked, and it is refused for its kind.
  if (auto asked = scene::parse_toml(file, folder / store::manifest_name)) study.asked = std::move(*asked);
  study.kind = study.asked["kind"].value_or("");
  study.title = study.asked["title"].value_or("");
  auto scene = scene::parse_scene(scene_text, folder / store::manifest_name);
  if (!scene)
    refuse(fmt::format("{}: its input holds no scene that this program reads: {}",
                       (folder / store::manifest_name).string(), scene.error().message()));
  study.scene = std::move(*scene);
  read_files(study);
  study.tells = told_by(study);
  check_verdicts(study);
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

/// Whether two cases are of one launch, computed with the same numerics, or may be: that of a scene which
/// cannot be made is not known.
bool is_same_launch(const CaseEvidence& a, const CaseEvidence& b) {
  // Of many cases most are told apart by their peaks.
  if (!study::same_number(a.value("load.peak"), b.value("load.peak"))) return false;
  const auto first = a.scene(), second = b.scene();
  return !first || !second ||
         std::ranges::none_of(study::differences(first->scene, second->scene), is_of_launch);
}

/// Refuses studies that judge the same launch, with the same numerics, by different lower bounds of its
/// critical gap: they do not rest on the same records or statements. Where numerics or any other key of the
/// scene differs the bounds may. Not compared are critical gaps beyond the end of a search, and a comparison
/// whose result is the record of other models, which it cannot use itself.
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

/// What is SAFE under air that is a reservoir stays so only where a study of the same gaps closing calls them
/// and all thinner ones SAFE too.
void hold_against_closing_gaps(SafetyEvidence& evidence) {
  const StudyEvidence* closing = held_against(evidence);
  if (closing == nullptr) return;
  const Row& judged = closing->rows("verdicts");
  const double largest = largest_gap_under({}, {judged.begin(), judged.end()}).value_or(-1.0);
  Row& study = std::ranges::find(evidence.studies, tells::launch, &StudyEvidence::tells)->study;
  for (Row& row : study["verdicts"]) {
    for (const Row& both : closing->rows("closing"))
      if (found_in(both, "gap_cm") == row["gap_cm"])
        row["temperature_max_corner_K"] = found_in(both, "temperature_max_corner_K");
    if (text_of(row, "verdict") != "SAFE" || number_of(row, "gap_cm") <= largest) continue;
    row["verdict"] = "INDETERMINATE";
    row[quantity::reason_code.key()] = to_string(study::ReasonCode::closing_corner);
    row["reason"] = row["cause"] = "not SAFE where the gap closes: " + closing->label;
  }
  for (Row& row : study["cases"])
    if (number_of(row, "largest_safe_gap_cm") > largest)
      row["largest_safe_gap_cm"] = largest < 0.0 ? Row() : Row(largest);
}

// --- the stored runs of the main study ---

/// Gaps of a case, evaluated again on its stored run: one that is called SAFE must be as warm as its verdict
/// says. Others that are not went on from ignition in a run of their own.
void check_against_run(const CaseEvidence& judged, StoredLaunch& stored) {
  constexpr double same_temperature = 0.01;  // K
  const run::MechanicsResult& mechanics = stored.result.mechanics;
  for (const Row* row : judged.verdicts) {
    const double gap = number_of(*row, "gap_cm"), said = number_of(*row, "temperature_max_K");
    run::GapResult found = run::evaluate_gap(stored.scene, mechanics.trace, gap / shown_gap(1.0));
    const double temperature = found.at_stations.temperature;
    if (std::abs(temperature - said) <= same_temperature)
      stored.result.gaps.push_back(std::move(found));
    else if (text_of(*row, "verdict") == "SAFE")
      refuse(
          *judged.study, results,
          fmt::format("the gap of {} cm is called SAFE at {:.6g} K, and the stored run of {} gives {:.6g} K",
                      gap, said, judged.label, temperature),
          "results and case files of one study");
  }
}

/// As far as they were kept. A file under another case's name is damaged too.
void read_stored_runs(SafetyEvidence& evidence) {
  const StudyEvidence& main = evidence.main();
  if (main.tells != tells::launch) return;
  for (const CaseEvidence& each : cases_of(main)) {
    const path name(text_of(*each.run, "stored_case"));
    if (name.is_absolute() || name.parent_path() != "cases" || !std::filesystem::exists(main.folder / name))
      continue;
    const auto scene = each.scene();
    if (!scene)
      refuse(main, results, "found a case that its scene cannot be: " + scene.error().message(),
             "results as a study writes them");
    auto read = store::read_case_file(main.folder / name);
    if (!read)
      refuse(fmt::format("{}; allowed: case files as they were written ({})", read.error().message,
                         main.command()));
    if (store::CaseIdentity(read->manifest.input_text).hash() != name.stem())
      refuse(main, name, "this is the file of another case", "case files as they were written");
    if (read->manifest.commit != main.record.manifest.commit)
      evidence.other_commits.insert(read->manifest.commit);
    StoredLaunch stored{scene->scene, {std::move(read->result.mechanics), {}}};
    if (stored.result.mechanics.trace.samples() < 2) continue;
    check_against_run(each, stored);
    evidence.stored.emplace(each.label, std::move(stored));
  }
}

}  // namespace

bool is_of_launch(const study::Difference& difference) {
  const std::string& key = difference.key.name;
  return key != "title" && key != "gap.thickness" && !key.starts_with("output.");
}

std::vector<CaseEvidence> cases_of(const StudyEvidence& study) {
  if (study.tells != tells::launch && study.tells != tells::sweep && study.tells != tells::closing) return {};
  // Peak pressure and defect stand in every table of cases or verdicts.
  Row axes = study.rows("axes");
  for (const auto& [key, column] : {std::pair{"load.peak", quantity::peak_pressure},
                                    {"charge.crack_radius", quantity::crack_radius},
                                    {"charge.flaw_size", quantity::flaw_size}})
    axes.push_back({{"scene_key", key}, {"key", column.key()}, {"unit", column.form.unit}});
  const Row &criticals = study.rows("cases"), &verdicts = study.rows("verdicts");
  const std::size_t gaps = verdicts.size() / criticals.size();
  std::vector<CaseEvidence> cases;
  for (const Row& critical : criticals) {
    CaseEvidence each{&study, &critical, &critical, text_of(critical, "case")};
    for (std::size_t i = 0; i < gaps; ++i) each.verdicts.push_back(&verdicts[cases.size() * gaps + i]);
    for (const Row& axis : axes) {
      const std::string name = text_of(axis, "scene_key"), column = text_of(axis, "key");
      const auto key = scene::describe_key(study.scene, name, {});
      double shown = number_of(critical, column);
      if (std::isnan(shown)) shown = number_of(*each.verdicts.front(), column);
      if (!key || std::isnan(shown) || column == quantity::gap.key()) continue;
      const double value =
          shown / shown_value(1.0, {.dimension = key->dimension, .unit = text_of(axis, "unit")});
      if (!study::same_number(value, own_value(study, name))) each.changes.push_back({name, value, {}, name});
    }
    for (const Row& run : study.rows("runs"))
      if (text_of(run, "case") == each.label) each.run = &run;
    cases.push_back(std::move(each));
  }
  return cases;
}

const StudyEvidence* held_against(const SafetyEvidence& evidence) {
  const StudyEvidence* launch = evidence.find(tells::launch);
  if (launch == nullptr || closes(*launch)) return nullptr;
  if (const StudyEvidence* closing = evidence.find(tells::closing)) return closing;
  for (const StudyEvidence& study : evidence.studies)
    if (study.tells == tells::sweep && closes(study)) return &study;
  return nullptr;
}

double own_value(const StudyEvidence& study, const std::string& key) {
  return key == "load.peak" ? scene::PressureHistory(study.scene.scene.load).stated_peak()
                            : study::number_in(study.scene, key);
}

double CaseEvidence::value(const std::string& key) const {
  const auto found = std::ranges::find(changes, key, &study::Change::name);
  return found != changes.end() ? std::get<double>(found->value) : own_value(*study, key);
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
  // A launch whose gap closes stands beside one whose air is a reservoir, where there is one.
  if (evidence.find(tells::launch) == nullptr)
    for (StudyEvidence& study : evidence.studies)
      if (study.tells == tells::closing) study.tells = tells::launch;
  compare_studies(evidence);
  check_agreement(evidence);
  read_stored_runs(evidence);
  hold_against_closing_gaps(evidence);
  return evidence;
} catch (const store::Error& error) {
  return error;
}

}  // namespace launchsafe::report
