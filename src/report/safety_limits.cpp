// What the answer rests on, and what it does not cover: the rest of page one.
#include "launchsafe/report/number.hpp"
#include "safety_sections.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

namespace launchsafe::report::safety {

bool is_confirmed(const Subject& subject, const std::string& label) {
  bool below = false, above = false;
  for (const Row& run : subject.study.rows("coupled_runs")) {
    if (text_of(run, "case") != label) continue;
    if (text_of(run, "outcome") != text_of(run, "expected")) return false;
    (text_of(run, "expected") == "ignites" ? above : below) = true;
  }
  return below && above;
}

std::vector<double> swept_temperatures(const StudyEvidence& study) {
  std::vector<double> temperatures;
  for (const Row& axis : study.rows("axes"))
    if (text_of(axis, "scene_key") == "initial_temperature" && axis.contains("values"))
      for (const Row& value : axis["values"])
        if (value.is_number()) temperatures.push_back(value.get<double>());
  return temperatures;
}

std::string launch_temperature_text(const Subject& subject) {
  const auto swept = swept_temperatures(subject.study);
  if (swept.empty()) return fixed(subject.scene().initial_temperature, 0) + " K";
  const auto [coldest, hottest] = std::minmax_element(swept.begin(), swept.end());
  return fmt::format("{} to {} K", fixed(*coldest, 0), fixed(*hottest, 0));
}

std::vector<const Row*> all_verdicts(const Subject& subject) {
  const bool judges = subject.study.kind == "critical-gap" || subject.study.kind == "sweep";
  return judges ? pointers_to(subject.study.rows("verdicts")) : std::vector<const Row*>{};
}

std::size_t count_of(const std::vector<const Row*>& rows, const std::string& verdict) {
  return static_cast<std::size_t>(std::count_if(
      rows.begin(), rows.end(), [&](const Row* row) { return text_of(*row, "verdict") == verdict; }));
}

namespace {

/// What stands behind a word in the reasons of verdicts, each once: "extrapolated: peak pressure".
std::string said_after(const std::vector<const Row*>& rows, const std::string& word) {
  std::set<std::string> found;
  std::string text;
  for (const Row* row : rows) {
    const std::string reason = text_of(*row, "reason");
    const std::size_t at = reason.find(word);
    if (at == std::string::npos) continue;
    const std::size_t begin = at + word.size();
    const std::string said = reason.substr(begin, reason.find("; ", begin) - begin);
    if (found.insert(said).second) text += (text.empty() ? "" : "; ") + said;
  }
  return text;
}

void say_verdict_counts(const Subject& subject, SafetySection& section) {
  const auto rows = all_verdicts(subject);
  const std::size_t open = count_of(rows, "INDETERMINATE");
  if (rows.empty()) return;
  const Parts parts{{"of", rows.size()},
                    {"safe", count_of(rows, "SAFE")},
                    {"unsafe", count_of(rows, "UNSAFE")},
                    {"indeterminate", open},
                    {"temperature", launch_temperature_text(subject)},
                    {"all", open == rows.size()}};
  section.item(open > 0 ? "limits.indeterminate" : "limits.all_decided", parts, subject.origin("verdicts"));
}

/// The least that the critical gap can be at the hottest temperature of a sweep over it; of several cases at
/// that the smallest, and nothing where one has no bound.
void say_hottest(const Subject& subject, SafetySection& section) {
  for (const StudyEvidence& study : subject.evidence.studies) {
    const auto temperatures = swept_temperatures(study);
    if (study.kind != "sweep" || temperatures.empty()) continue;
    const double hottest = *std::max_element(temperatures.begin(), temperatures.end());
    double least = std::numeric_limits<double>::infinity();
    for (const Row& row : study.rows("cases")) {
      if (number_of(row, "initial_temperature_K") != hottest) continue;
      const bool ignites = text_of(row, "critical_gap_kind") == "all-ignite";
      const double bound = ignites ? 0.0 : number_of(row, "critical_gap_at_least_cm");
      // Written so that a bound that is not known stays.
      least = least < bound || std::isnan(least) ? least : bound;
    }
    Parts parts{{"temperature", part(fixed(hottest, 0) + " K", hottest, "K")}, {"study", study.label}};
    if (std::isfinite(least) && least > 0.0)
      parts["at_least"] = part(allowed_text(least, 4) + " cm", least, "cm");
    parts["none"] = least == 0.0;
    section.item("limits.hottest", parts, origin_of(study, "cases"));
  }
}

/// Two digits, or all before the point.
std::string two_digits(double value) { return value < 10.0 ? significant(value, 2) : fixed(value, 0); }

/// The basis of the air's heat.
void say_air(const Subject& subject, SafetySection& section) {
  const Origin origin = subject.origin("verdicts");
  if (subject.scene().surface.air_model == scene::AirModel::film)
    return section.item("limits.air_film", {}, origin);
  const Row* most = nullptr;
  for (const Row* row : all_verdicts(subject))
    if (number_of(*row, "taken_over_supplied") > (most ? number_of(*most, "taken_over_supplied") : 0.0))
      most = row;
  if (most == nullptr) return section.item("limits.air_unknown", {}, origin);
  const double ratio = number_of(*most, "taken_over_supplied");
  Parts parts{
      {"ratio", part(two_digits(ratio), ratio, "")},
      {"gap", part(significant(number_of(*most, "gap_cm"), 6) + " cm", number_of(*most, "gap_cm"), "cm")},
      {"took", part(two_digits(number_of(*most, "skin_took_kJ_per_m2")) + " kJ/m²",
                    number_of(*most, "skin_took_kJ_per_m2"), "kJ/m2")},
      {"supplied", part(two_digits(number_of(*most, "compression_supplies_kJ_per_m2")) + " kJ/m²",
                        number_of(*most, "compression_supplies_kJ_per_m2"), "kJ/m2")}};
  section.item(ratio > 1.0 ? "limits.air_reservoir" : "limits.air_reservoir_within", parts, origin);
}

bool says(const StudyEvidence& study, const char* key) {
  return study.record.manifest.input_text.find(fmt::format("\n{} = ", key)) != std::string::npos;
}

/// "key = value" of rows of the study's acceptances, the first of many.
std::string values_in(const Row& rows) {
  constexpr std::size_t most_named = 12;
  std::vector<std::string> values;
  for (std::size_t i = 0; i < std::min(rows.size(), most_named); ++i)
    values.push_back(text_of(rows[i], "key") + " = " + text_of(rows[i], "value"));
  if (rows.size() > most_named) values.push_back(fmt::format("and {} more", rows.size() - most_named));
  return fmt::format("{}", fmt::join(values, "; "));
}

/// T max with an accepted constant as calibrated: at the thickest gap that is SAFE, or else does not ignite.
const Row* as_calibrated(const Subject& subject, const std::string& key) {
  const Row* found = nullptr;
  bool safe = false;
  for (const Row& row : subject.study.rows("as_calibrated")) {
    const bool is_safe = text_of(row, "verdict") == "SAFE";
    if (text_of(row, "key") != key || text_of(row, "verdict") == "UNSAFE" || (safe && !is_safe)) continue;
    found = &row;
    safe = is_safe;
  }
  return found;
}

/// Every acceptance, with what it could do.
void say_accepted(const Subject& subject, SafetySection& section) {
  const Row& accepted = subject.study.rows("accepted");
  const Origin origin = subject.origin("accepted");
  if (!accepted.empty()) section.item("limits.accepted", {{"count", accepted.size()}}, origin);
  for (const Row& row : accepted) {
    Parts parts{
        {"key", text_of(row, "key")}, {"value", text_of(row, "value")}, {"because", text_of(row, "because")}};
    if (const Row* other = as_calibrated(subject, text_of(row, "key"))) {
      const auto kelvin = [other](const char* name) {
        const double value = number_of(*other, name);
        return part(fixed(value, 0) + " K", value, "K");
      };
      const double gap = number_of(*other, "gap_cm");
      parts["gap"] = part(significant(gap, 6) + " cm", gap, "cm");
      parts["own"] = kelvin("temperature_max_K");
      parts["calibrated"] = kelvin("temperature_max_as_calibrated_K");
      parts["ignites"] = text_of(*other, "ignites") == "yes";
    }
    section.item("limits.acceptance", parts, origin);
  }
}

void say_calibration(const Subject& subject, SafetySection& section) {
  const Origin origin = subject.origin("extrapolated");
  // A study that an earlier program wrote has no such list.
  if (!all_verdicts(subject).empty() && !subject.study.study.contains("extrapolated"))
    section.item("limits.not_listed", {}, subject.origin("verdicts"));
  std::vector<std::string> extrapolated;
  for (const Row& each : subject.study.rows("extrapolated")) extrapolated.push_back(each.get<std::string>());
  if (!extrapolated.empty())
    section.item("limits.extrapolated", {{"what", fmt::format("{}", fmt::join(extrapolated, ", "))}}, origin);
  if (const Row& missing = subject.study.rows("not_accepted"); !missing.empty())
    section.item("limits.not_accepted", {{"what", values_in(missing)}}, subject.origin("not_accepted"));
  say_accepted(subject, section);
  section.item("limits.calibrated", {{"record", says(subject.study, "calibration")}},
               subject.origin("verdicts"));
}

/// The cause that lowers the bound of the critical gap most.
void say_shares(const Subject& subject, SafetySection& section) {
  const JudgedCase* own = subject.own_case();
  if (own == nullptr || !own->completed) return;
  if (std::all_of(own->verdicts.begin(), own->verdicts.end(),
                  [](const Row* row) { return has_validity_warning(*row); }))
    return;  // nothing says how wrong it is
  const Row* largest = nullptr;
  double most = 0.0;
  for (const Row& row : subject.study.rows("gap_shares")) {
    const double lowers = number_of(row, "lowers_cm");
    if (text_of(row, "case") != own->label || !(lowers > most)) continue;
    largest = &row;
    most = lowers;
  }
  if (largest == nullptr) return;
  const double at_least = number_of(*own->critical, "critical_gap_at_least_cm");
  const Parts parts{{"cause", text_of(*largest, "cause")},
                    {"at_least", part(allowed_text(at_least, 4) + " cm", at_least, "cm")},
                    {"size", part(uncertain_text(most) + " cm", most, "cm")}};
  section.item("limits.largest_share", parts, subject.origin("gap_shares", own->label));
}

void say_assumptions(const Subject& subject, SafetySection& section) {
  const StudyEvidence& study = subject.study;
  const Origin origin = subject.origin("the study file, in its manifest");
  const auto states = [&](const char* key) {
    const Row& stated = study.rows("stated_by_hand");
    return std::any_of(stated.begin(), stated.end(),
                       [&](const Row& row) { return text_of(row, "key") == key; });
  };
  const bool inputs = !states("input_uncertainty");
  const bool computation = !says(study, "accuracy") && !states("numerical_uncertainty");
  const bool models = !says(study, "model_form") && !states("model_form_uncertainty");
  const std::string others = said_after(all_verdicts(subject), "ignition not excluded under ");
  if (inputs || computation || models)
    section.item("limits.assumed", {{"inputs", inputs}, {"computation", computation}, {"models", models}},
                 origin);
  for (const Row& row : study.rows("stated_by_hand")) {
    std::string name = text_of(row, "key");
    std::replace(name.begin(), name.end(), '_', ' ');
    const double value = number_of(row, "K");
    section.item("limits.stated",
                 {{"what", name},
                  {"value", part(significant(value, 3) + " K", value, "K")},
                  {"because", text_of(row, "because")}},
                 origin);
  }
  if (!others.empty()) section.item("limits.other_models", {{"models", others}}, subject.origin("verdicts"));
}

/// What the answer would be if the shot never left.
void say_without_exit(const Subject& subject, SafetySection& section) {
  const auto& rows = subject.study.rows("without_exit");
  if (rows.empty() || subject.cases.size() != 1) return;
  section.item("limits.without_exit", {{"critical", text_of(rows.front(), "critical_gap_without_exit")}},
               subject.origin("without_exit"));
}

void say_launch(const Subject& subject, SafetySection& section) {
  const scene::Scene& scene = subject.scene();
  const JudgedCase* own = subject.own_case();
  Parts parts{{"own", own != nullptr && subject.is_own(*own)},
              {"cases", subject.study.rows("cases").size()},
              {"peak", significant(1e-6 * scene::PressureHistory(scene.load).stated_peak(), 4) + " MPa"},
              {"end", scene::end_text(scene)},
              {"crack", significant(1e6 * scene.charge().strength.initial_crack_radius, 4) + " µm"},
              {"flaw", significant(1e3 * scene.charge().strength.flaw_size, 3) + " mm"},
              {"temperature", launch_temperature_text(subject)},
              {"several", subject.cases.size() > 1},
              {"others", subject.study.kind != "sweep" && subject.evidence.find("sweep") != nullptr}};
  // Nothing is covered by what was not computed.
  if (!subject.study.rows("cases").empty())
    section.item("limits.launch", parts, subject.origin("the scene, in its manifest"));
  std::string missing;
  for (const char* kind : {"critical-gap", "sweep", "accuracy", "sensitivity", "comparison", "stability"})
    if (subject.evidence.find(kind) == nullptr) missing += (missing.empty() ? "" : ", ") + std::string(kind);
  if (!missing.empty()) section.item("limits.missing", {{"kinds", missing}});
}

/// Studies of other values than the main one's; what a scene writes out changes no number.
void say_differences(const Subject& subject, SafetySection& section) {
  constexpr std::size_t most_keys = 4;
  for (const StudyEvidence& study : subject.evidence.studies) {
    std::vector<std::string> keys;
    for (const std::string& key : study.differences)
      if (!key.starts_with("output.") && key != "title") keys.push_back(key);
    if (keys.empty()) continue;
    const std::size_t shown = std::min(keys.size(), most_keys);
    section.item("limits.differs",
                 {{"study", study.label},
                  {"kind", study.kind},
                  {"keys", fmt::format("{}", fmt::join(keys.begin(), keys.begin() + shown, ", "))},
                  {"more", count_part(keys.size() - shown)}},
                 origin_of(study, "the scene, in its manifest"));
  }
}

void say_unfinished(const Subject& subject, SafetySection& section) {
  for (const StudyEvidence& study : subject.evidence.studies) {
    if (study.finished()) {
      if (!study.record.complete)
        section.item("limits.no_pictures", {{"study", study.label}}, origin_of(study, "manifest"));
      continue;
    }
    std::map<store::CaseState, std::size_t> states;
    for (const store::RunRecord& entry : study.runs) ++states[entry.state];
    section.item("limits.unfinished",
                 {{"study", study.label},
                  {"kind", study.kind},
                  {"done", states[store::CaseState::done]},
                  {"failed", states[store::CaseState::failed] + states[store::CaseState::timed_out]},
                  {"command", study.command()}},
                 origin_of(study, "journal"));
  }
}

/// Cases that failed, by their reasons.
void say_failed(const Subject& subject, SafetySection& section) {
  std::vector<std::string> not_confirmed;
  for (const JudgedCase& each : subject.cases)
    if (is_value(*each.critical) && !is_confirmed(subject, each.label)) not_confirmed.push_back(each.label);
  if (!not_confirmed.empty())
    section.item("limits.not_confirmed",
                 {{"case", not_confirmed.front()}, {"others", count_part(not_confirmed.size() - 1)}},
                 subject.origin("coupled_runs", not_confirmed.front()));
  std::map<std::string, std::vector<std::string>> failed;  // by status
  for (const char* table : {"runs", "cases"})              // a sweep has one row a case
    for (const Row& run : subject.study.rows(table))
      if (const std::string status = text_of(run, "status"); !status.empty() && status != "completed")
        failed[status].push_back(name_of_case(subject.study, run));
  for (const auto& [status, names] : failed)
    section.item("limits.failed",
                 {{"case", names.front()}, {"status", status}, {"others", count_part(names.size() - 1)}},
                 subject.origin("runs", names.front()));
}

}  // namespace

void say_limits(const Subject& subject, SafetySection& section) {
  section.say("limits.begin");
  say_unfinished(subject, section);
  say_failed(subject, section);
  say_differences(subject, section);
  say_verdict_counts(subject, section);
  say_hottest(subject, section);
  say_calibration(subject, section);
  say_air(subject, section);
  say_shares(subject, section);
  say_assumptions(subject, section);
  say_launch(subject, section);
  say_without_exit(subject, section);
  say_probability(subject, section);
}

}  // namespace launchsafe::report::safety
