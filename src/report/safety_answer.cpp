// Page one: the answer, and all that a reader of this page alone must know.
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/scene/launch_end.hpp"
#include "safety_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace launchsafe::report::safety {
namespace {

Parts gap_part(double gap, int decimals) { return part(allowed_text(gap, decimals) + " cm", gap, "cm"); }

/// A bracket in digits that tell its ends apart, the lower end rounded down and the upper one up.
Parts bracket_parts(const Subject& subject, const Row& critical) {
  const double lower = number_of(critical, "critical_gap_lower_cm");
  const double upper = number_of(critical, "critical_gap_upper_cm");
  const int decimals = std::max(decimals_for(upper - lower), 3);
  Parts parts{{"case", text_of(critical, "case")}};
  parts["lower"] = gap_part(lower, decimals);
  parts["upper"] = part(fixed(rounded_up(upper, decimals), decimals) + " cm", upper, "cm");
  parts["confirmed"] = is_confirmed(subject, text_of(critical, "case"));
  return parts;
}

void say_critical_gap(const Subject& subject, const JudgedCase& each, SafetySection& section) {
  const Row& critical = *each.critical;
  const Origin origin = subject.origin("cases", each.label);
  const std::string kind = text_of(critical, "critical_gap_kind");
  if (const auto gap = measured_gap(critical)) {
    Parts parts = bracket_parts(subject, critical);
    parts["gap"] = part(gap->text("cm"), number_of(critical, "critical_gap_cm"), "cm");
    parts["from"] = part(fixed(std::max(0.0, gap->lower()), gap->decimals), gap->lower(), "cm");
    parts["to"] = part(fixed(gap->upper(), gap->decimals) + " cm", gap->upper(), "cm");
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
  Parts parts{{"several", subject.cases.size() > 1}, {"temperature", launch_temperature_text(subject)}};
  if (safe) parts["gap"] = part(exact(*safe) + " cm", *safe, "cm");
  if (!subject.criterion)
    return section.say(safe ? "recommended.not_stated" : "recommended.not_stated_none_safe", parts, origin,
                       Look::lead);
  parts["criterion"] = subject.criterion->text;
  parts["source"] = subject.criterion->source;
  const auto allowed = allowed_in_all(subject.cases, *subject.criterion);
  if (allowed) parts["gap"] = part(exact(*allowed) + " cm", *allowed, "cm");
  section.say(allowed ? "recommended.gap" : "recommended.none", parts, origin, Look::lead);
}

// --- many cases ---

Table case_table(const Subject& subject) {
  Table table{.columns = {quantity::case_name(), Column{"critical_gap", "critical gap"},
                          Column{"largest_safe_gap", "largest SAFE gap"},
                          Column{"initial_temperature", "before launch", keys::fixed(0, kelvin)},
                          Column{"safe", "SAFE", count()}, Column{"indeterminate", "INDETERMINATE", count()},
                          Column{"unsafe", "UNSAFE", count()}}};
  for (const JudgedCase& each : subject.cases) {
    const std::size_t safe = largest_safe(each);
    table.rows.push_back({each.label, gap_text(*each.critical),
                          safe == each.gaps.size() ? "none" : exact(each.gaps[safe].gap) + " cm",
                          subject.scene().initial_temperature,
                          static_cast<std::int64_t>(count_of(each.verdicts, "SAFE")),
                          static_cast<std::int64_t>(count_of(each.verdicts, "INDETERMINATE")),
                          static_cast<std::int64_t>(count_of(each.verdicts, "UNSAFE"))});
  }
  return table;
}

/// What is smallest, and how many have none; of a sweep, or of several cases.
void say_cases(const Subject& subject, const std::string& text, SafetySection& section) {
  const Row* smallest = nullptr;
  std::map<std::string, std::size_t> kinds;
  const Row& cases = subject.study.rows("cases");
  for (const Row& row : cases) {
    ++kinds[text_of(row, "critical_gap_kind")];
    if (is_value(row) &&
        (smallest == nullptr || number_of(row, "critical_gap_cm") < number_of(*smallest, "critical_gap_cm")))
      smallest = &row;
  }
  Parts parts{
      {"cases", cases.size()},
      {"none_safe", count_part(kinds["all-ignite"])},
      {"unknown", count_part(cases.size() - kinds["value"] - kinds["all-safe"] - kinds["all-ignite"])}};
  if (smallest != nullptr) {
    parts["smallest"] = part(gap_text(*smallest), number_of(*smallest, "critical_gap_cm"), "cm");
    parts["case"] = name_of_case(subject.study, *smallest);
  }
  section.say(text, parts, subject.origin("cases"), Look::lead);
}

void answer_critical_gap(const Subject& subject, SafetySection& section) {
  if (const JudgedCase* own = subject.own_case(); subject.cases.size() == 1 || subject.is_own(*own))
    say_critical_gap(subject, *own, section);
  if (subject.cases.size() > 1) say_cases(subject, "answer.cases", section);
  say_recommended(subject, section);
  if (all_verdicts(subject).size() <= most_rows_on_page_one)
    section.show("verdicts", verdict_table(subject), subject.origin("verdicts"));
  else
    section.show("cases", case_table(subject), subject.origin("cases"));
  section.say("answer.read_verdicts");
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
    const auto gap = measured_gap(*each.critical);
    answer["cases"].push_back({{"case", each.label},
                               {"critical_gap_kind", text_of(*each.critical, "critical_gap_kind")},
                               {"critical_gap", gap_text(*each.critical)},
                               {"lower_cm", gap ? Parts(gap->lower()) : Parts()},
                               {"upper_cm", gap ? Parts(gap->upper()) : Parts()}});
  }
  return answer;
}

SafetySection answer_section(const Subject& subject) {
  SafetySection section{"answer"};
  const StudyEvidence& study = subject.study;
  section.say("answer.launch", {{"launch", scene::launch_sentence(subject.scene())}},
              subject.origin("the scene, in its manifest"), Look::lead);
  if (!study.finished())
    section.say("answer.unfinished", {{"kind", study.kind}, {"command", study.command()}},
                subject.origin("manifest"), Look::lead);
  else if (!subject.cases.empty())
    answer_critical_gap(subject, section);
  else if (study.kind == "sweep")
    say_cases(subject, "answer.sweep", section);
  else
    section.say("answer.no_verdicts", {{"kind", study.kind}}, subject.origin("study.json"), Look::lead);
  if (subject.criterion && subject.cases.empty())
    section.say("recommended.not_applied",
                {{"criterion", subject.criterion->text}, {"source", subject.criterion->source}}, {},
                Look::lead);
  say_limits(subject, section);
  return section;
}

}  // namespace launchsafe::report::safety
