// Page one: the answer, and all that a reader of this page alone must know.
#include "launchsafe/report/number.hpp"
#include "safety_sections.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

namespace launchsafe::report::safety {
namespace {

/// Rows of a verdict table that page one holds.
constexpr std::size_t most_rows = 12;

Parts gap_part(double gap, int decimals) { return part(allowed_text(gap, decimals) + " cm", gap, "cm"); }

/// A bracket in digits that tell its ends apart, the lower end rounded down and the upper one up.
Parts bracket_parts(const Row& critical) {
  const double lower = number_of(critical, "critical_gap_lower_cm");
  const double upper = number_of(critical, "critical_gap_upper_cm");
  const int decimals = std::max(decimals_for(upper - lower), 3);
  Parts parts{{"case", text_of(critical, "case")}};
  parts["lower"] = gap_part(lower, decimals);
  parts["upper"] = part(fixed(rounded_up(upper, decimals), decimals) + " cm", upper, "cm");
  const std::string coupled = text_of(critical, "coupled_runs");
  parts["confirmed"] = !coupled.empty();
  return parts;
}

void say_critical_gap(const Subject& subject, const JudgedCase& each, SafetySection& section) {
  const Row& critical = *each.critical;
  const Origin origin = subject.origin("cases", each.label);
  const std::string kind = text_of(critical, "critical_gap_kind");
  if (const auto gap = measured_gap(critical)) {
    Parts parts = bracket_parts(critical);
    parts["gap"] = part(gap->text("cm"), number_of(critical, "critical_gap_cm"), "cm");
    parts["from"] = part(fixed(std::max(0.0, gap->lower()), gap->decimals), gap->lower(), "cm");
    parts["to"] = part(fixed(gap->upper(), gap->decimals) + " cm", gap->upper(), "cm");
    parts["uncertainty"] = part(uncertain_text(number_of(critical, "critical_gap_uncertainty_cm"), 1) + " cm",
                                number_of(critical, "critical_gap_uncertainty_cm"), "cm");
    section.say("answer.value", parts, origin, Look::lead);
    return;
  }
  Parts parts{{"case", each.label},
              {"reason", text_of(critical, "reason")},
              {"reads_as", text_of(critical, "critical_gap_reads_as")}};
  section.say("answer." + (kind.empty() ? "indeterminate" : kind), parts, origin, Look::lead);
}

/// The largest computed gap whose verdict is SAFE together with all smaller ones; none: rows.size().
std::size_t largest_safe(const JudgedCase& each) { return largest_gap_under(GapCriterion{}, each.gaps); }

/// What a rule recommends over all cases: the smallest of what it allows in each. Nothing where one allows
/// none.
std::optional<double> allowed_in_all(const std::vector<JudgedCase>& cases, const GapCriterion& criterion) {
  std::optional<double> smallest;
  for (const JudgedCase& each : cases) {
    const std::size_t row = largest_gap_under(criterion, each.gaps);
    if (row == each.gaps.size()) return std::nullopt;
    smallest = std::min(smallest.value_or(each.gaps[row].gap), each.gaps[row].gap);
  }
  return smallest;
}

void say_recommended(const Subject& subject, SafetySection& section) {
  const Origin origin = subject.origin("verdicts");
  const auto safe = allowed_in_all(subject.cases, GapCriterion{});
  Parts parts{{"several", subject.cases.size() > 1}};
  if (safe) parts["gap"] = part(exact(*safe) + " cm", *safe, "cm");
  if (!subject.criterion) {
    section.say(safe ? "recommended.not_stated" : "recommended.not_stated_none_safe", parts, origin,
                Look::lead);
    return;
  }
  parts["criterion"] = subject.criterion->text;
  parts["source"] = subject.criterion->source;
  const auto allowed = allowed_in_all(subject.cases, *subject.criterion);
  if (allowed) parts["gap"] = part(exact(*allowed) + " cm", *allowed, "cm");
  section.say(allowed ? "recommended.gap" : "recommended.none", parts, origin, Look::lead);
}

// --- what was not covered ---

std::vector<const Row*> all_verdicts(const Subject& subject) {
  std::vector<const Row*> rows;
  for (const JudgedCase& each : subject.cases)
    rows.insert(rows.end(), each.verdicts.begin(), each.verdicts.end());
  return rows;
}

std::size_t count_of(const std::vector<const Row*>& rows, const std::string& verdict) {
  return static_cast<std::size_t>(std::count_if(
      rows.begin(), rows.end(), [&](const Row* row) { return text_of(*row, "verdict") == verdict; }));
}

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
                    {"all", open == rows.size()}};
  section.item(open > 0 ? "limits.indeterminate" : "limits.all_decided", parts, subject.origin("verdicts"));
}

/// The basis of the air's heat.
void say_air(const Subject& subject, SafetySection& section) {
  const Origin origin = subject.origin("verdicts");
  const scene::AirModel air = subject.scene().surface.air_model;
  if (air != scene::AirModel::reservoir) {
    section.item(air == scene::AirModel::film ? "limits.air_film" : "limits.air_balance", {}, origin);
    return;
  }
  const Row* most = nullptr;
  for (const Row* row : all_verdicts(subject))
    if (number_of(*row, "taken_over_supplied") > (most ? number_of(*most, "taken_over_supplied") : 0.0))
      most = row;
  if (most == nullptr) {
    section.item("limits.air_unknown", {}, origin);
    return;
  }
  const double ratio = number_of(*most, "taken_over_supplied");
  Parts parts{
      {"ratio", part(significant(ratio, 2), ratio, "")},
      {"gap", part(significant(number_of(*most, "gap_cm"), 6) + " cm", number_of(*most, "gap_cm"), "cm")},
      {"took", part(significant(number_of(*most, "skin_took_kJ_per_m2"), 2) + " kJ/m²",
                    number_of(*most, "skin_took_kJ_per_m2"), "kJ/m2")},
      {"supplied", part(significant(number_of(*most, "compression_supplies_kJ_per_m2"), 2) + " kJ/m²",
                        number_of(*most, "compression_supplies_kJ_per_m2"), "kJ/m2")}};
  section.item(ratio > 1.0 ? "limits.air_reservoir" : "limits.air_reservoir_within", parts, origin);
}

bool says(const StudyEvidence& study, const char* key) {
  return study.record.manifest.input_text.find(fmt::format("\n{} = ", key)) != std::string::npos;
}

/// What is extrapolated, as study/case_uncertainty.cpp words it: items between commas, which may say in
/// parentheses why they are accepted.
struct Extrapolated {
  std::string items, accepted;
};

Extrapolated extrapolated_in(const std::vector<const Row*>& rows) {
  constexpr std::string_view word = "extrapolated: ", accepted_because = " (accepted because ";
  std::vector<std::string> items, accepted;
  const auto keep = [](std::vector<std::string>& all, const std::string& each) {
    if (std::find(all.begin(), all.end(), each) == all.end()) all.push_back(each);
  };
  for (const Row* row : rows) {
    const std::string reason = "; " + text_of(*row, "reason");
    const std::size_t at = reason.find("; " + std::string(word));
    if (at == std::string::npos) continue;
    std::string item;
    int depth = 0;
    for (const char letter : reason.substr(at + 2 + word.size()) + ",") {
      depth += letter == '(' ? 1 : letter == ')' ? -1 : 0;
      const bool ends = depth == 0 && (letter == ',' || letter == ';');
      if (!ends) {
        if (!item.empty() || letter != ' ') item += letter;
        continue;
      }
      const std::size_t because = item.find(accepted_because);
      if (because != std::string::npos) {
        keep(accepted, item.substr(because + accepted_because.size(),
                                   item.size() - because - accepted_because.size() - 1));
        item.resize(because);
      }
      keep(items, item);
      item.clear();
      if (letter == ';') break;
    }
  }
  return {fmt::format("{}", fmt::join(items, ", ")), fmt::format("{}", fmt::join(accepted, "; "))};
}

void say_calibration(const Subject& subject, SafetySection& section) {
  const auto rows = all_verdicts(subject);
  const Origin origin = subject.origin("verdicts");
  const Extrapolated extrapolated = extrapolated_in(rows);
  if (!extrapolated.items.empty())
    section.item("limits.extrapolated", {{"what", extrapolated.items}, {"accepted", extrapolated.accepted}},
                 origin);
  if (const std::string foreign = said_after(rows, "the constants were calibrated on another launch (");
      !foreign.empty())
    section.item("limits.foreign", {{"what", foreign.substr(0, foreign.find(')'))}}, origin);
  section.item("limits.calibrated", {{"record", says(subject.study, "calibration")}}, origin);
}

void say_shares(const Subject& subject, SafetySection& section) {
  const JudgedCase* own = subject.own_case();
  if (own == nullptr) return;
  // The row at which the question is decided: the largest gap that does not ignite.
  const Row* row = nullptr;
  for (const Row* each : own->verdicts)
    if (text_of(*each, "verdict") != "UNSAFE" && std::isfinite(number_of(*each, "uncertainty_K"))) row = each;
  if (row == nullptr) return;
  const Share largest = largest_of(shares_of(*row));
  if (!(largest.size > 0.0)) return;
  Parts parts = truths_of(largest);
  parts["size"] = part(uncertain_text(largest.size) + " K", largest.size, "K");
  parts["total"] =
      part(uncertain_text(number_of(*row, "uncertainty_K")) + " K", number_of(*row, "uncertainty_K"), "K");
  parts["gap"] = significant(number_of(*row, "gap_cm"), 6) + " cm";
  section.item("limits.largest_share", parts, subject.origin("verdicts", own->label));
}

void say_assumptions(const Subject& subject, SafetySection& section) {
  const StudyEvidence& study = subject.study;
  const Origin origin = subject.origin("the study file, in its manifest");
  const bool inputs = !says(study, "input_uncertainty");
  const bool computation = !says(study, "accuracy") && !says(study, "numerical_uncertainty");
  const bool models = !says(study, "model_form") && !says(study, "model_form_uncertainty");
  const std::string others = said_after(all_verdicts(subject), "ignition not excluded under ");
  if (inputs || computation || models)
    section.item("limits.assumed", {{"inputs", inputs}, {"computation", computation}, {"models", models}},
                 origin);
  if (!others.empty()) section.item("limits.other_models", {{"models", others}}, subject.origin("verdicts"));
}

void say_launch(const Subject& subject, SafetySection& section) {
  const scene::Scene& scene = subject.scene();
  const auto kelvin = fixed(scene.initial_temperature, 0) + " K";
  Parts parts{{"peak", significant(1e-6 * scene::PressureHistory(scene.load).stated_peak(), 4) + " MPa"},
              {"duration", significant(1e3 * scene.load.duration, 3) + " ms"},
              {"crack", significant(1e6 * scene.charge().strength.initial_crack_radius, 4) + " µm"},
              {"flaw", significant(1e3 * scene.charge().strength.flaw_size, 3) + " mm"},
              {"temperature", kelvin},
              {"several", subject.cases.size() > 1},
              {"sweep", subject.evidence.find("sweep") != nullptr}};
  section.item("limits.launch", parts, subject.origin("the scene, in its manifest"));
  std::string missing;
  for (const char* kind : {"critical-gap", "sweep", "accuracy", "sensitivity", "comparison", "stability"})
    if (subject.evidence.find(kind) == nullptr) missing += (missing.empty() ? "" : ", ") + std::string(kind);
  if (!missing.empty()) section.item("limits.missing", {{"kinds", missing}});
}

void say_unfinished(const Subject& subject, SafetySection& section) {
  for (const StudyEvidence& study : subject.evidence.studies) {
    if (study.finished()) {
      if (!study.record.complete)
        section.item("limits.no_pictures", {{"study", study.label}}, origin_of(study, "manifest"));
      continue;
    }
    std::map<store::CaseState, std::size_t> states;
    for (const store::JournalEntry& entry : study.runs) ++states[entry.state];
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
  for (const JudgedCase& each : subject.cases) {
    const Row& critical = *each.critical;
    const std::string coupled = text_of(critical, "coupled_runs");
    if (is_value(critical) && coupled.empty())
      section.item("limits.not_confirmed", {{"case", each.label}}, subject.origin("cases", each.label));
  }
  for (const Row& run : subject.study.rows("runs"))
    if (text_of(run, "status") != "completed")
      section.item("limits.failed", {{"case", text_of(run, "case")}, {"status", text_of(run, "status")}},
                   subject.origin("runs", text_of(run, "case")));
}

// --- tables of many cases ---

Table case_table(const Subject& subject) {
  Table table;
  table.columns = {text_column("case"),
                   text_column("critical gap"),
                   text_column("largest SAFE gap"),
                   {"SAFE", "", Alignment::right, 0, Notation::fixed, "safe"},
                   {"INDETERMINATE", "", Alignment::right, 0, Notation::fixed, "indeterminate"},
                   {"UNSAFE", "", Alignment::right, 0, Notation::fixed, "unsafe"}};
  for (const JudgedCase& each : subject.cases) {
    const auto gap = measured_gap(*each.critical);
    const std::size_t safe = largest_safe(each);
    table.rows.push_back({each.label,
                          gap ? gap->text("cm") : text_of(*each.critical, "critical_gap_reads_as"),
                          safe == each.gaps.size() ? "none" : exact(each.gaps[safe].gap) + " cm",
                          static_cast<std::int64_t>(count_of(each.verdicts, "SAFE")),
                          static_cast<std::int64_t>(count_of(each.verdicts, "INDETERMINATE")),
                          static_cast<std::int64_t>(count_of(each.verdicts, "UNSAFE"))});
  }
  return table;
}

void answer_critical_gap(const Subject& subject, SafetySection& section) {
  for (const JudgedCase& each : subject.cases)
    if (subject.cases.size() == 1 || &each == subject.own_case()) say_critical_gap(subject, each, section);
  say_recommended(subject, section);
  std::vector<const JudgedCase*> cases;
  for (const JudgedCase& each : subject.cases) cases.push_back(&each);
  if (all_verdicts(subject).size() <= most_rows)
    section.blocks.push_back(SaidTable{"verdicts", verdict_table(cases), subject.origin("verdicts")});
  else
    section.blocks.push_back(SaidTable{"cases", case_table(subject), subject.origin("cases")});
  section.say("answer.read_verdicts");
}

/// What a sweep says, where no study asks for the critical gap of one launch.
void answer_sweep(const Subject& subject, SafetySection& section) {
  const Row* smallest = nullptr;
  std::size_t none = 0;
  const Row& cases = subject.study.rows("cases");
  for (const Row& row : cases) {
    if (text_of(row, "critical_gap_kind") == "all-ignite") ++none;
    if (is_value(row) &&
        (smallest == nullptr || number_of(row, "critical_gap_cm") < number_of(*smallest, "critical_gap_cm")))
      smallest = &row;
  }
  Parts parts{{"cases", cases.size()}, {"none_safe", none}};
  if (smallest != nullptr)
    if (const auto gap = measured_gap(*smallest))
      parts["smallest"] = part(gap->text("cm"), number_of(*smallest, "critical_gap_cm"), "cm");
  section.say("answer.sweep", parts, subject.origin("cases"), Look::lead);
}

}  // namespace

Parts answer_parts(const Subject& subject) {
  const auto number = [](std::optional<double> value) { return value ? Parts(*value) : Parts(); };
  Parts answer{{"study", subject.study.label},
               {"finished", subject.study.finished()},
               {"criterion", nullptr},
               {"criterion_source", nullptr},
               {"recommended_gap_cm", nullptr},
               {"largest_safe_gap_cm",
                number(subject.cases.empty() ? std::nullopt : allowed_in_all(subject.cases, GapCriterion{}))},
               {"cases", Parts::array()}};
  if (subject.criterion) {
    answer["criterion"] = subject.criterion->text;
    answer["criterion_source"] = subject.criterion->source;
    if (!subject.cases.empty())
      answer["recommended_gap_cm"] = number(allowed_in_all(subject.cases, *subject.criterion));
  }
  for (const JudgedCase& each : subject.cases) {
    Parts row{{"case", each.label}, {"critical_gap_kind", text_of(*each.critical, "critical_gap_kind")}};
    const auto gap = measured_gap(*each.critical);
    row["critical_gap"] =
        gap ? Parts(gap->text("cm")) : Parts(text_of(*each.critical, "critical_gap_reads_as"));
    row["lower_cm"] = number(gap ? std::optional(gap->lower()) : std::nullopt);
    row["upper_cm"] = number(gap ? std::optional(gap->upper()) : std::nullopt);
    answer["cases"].push_back(std::move(row));
  }
  return answer;
}

SafetySection answer_section(const Subject& subject) {
  SafetySection section{"answer"};
  const StudyEvidence& study = subject.study;
  if (!study.finished())
    section.say("answer.unfinished", {{"kind", study.kind}, {"command", study.command()}},
                subject.origin("manifest"), Look::lead);
  else if (!subject.cases.empty())
    answer_critical_gap(subject, section);
  else if (study.kind == "sweep")
    answer_sweep(subject, section);
  else
    section.say("answer.no_verdicts", {{"kind", study.kind}}, subject.origin("study.json"), Look::lead);
  section.say("limits.begin");
  say_unfinished(subject, section);
  say_failed(subject, section);
  say_verdict_counts(subject, section);
  say_calibration(subject, section);
  say_air(subject, section);
  say_shares(subject, section);
  say_assumptions(subject, section);
  say_launch(subject, section);
  return section;
}

}  // namespace launchsafe::report::safety
