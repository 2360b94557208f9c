#include "launchsafe/report/number.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/study/changed_scene.hpp"
#include "launchsafe/study/verdict.hpp"
#include "safety_facts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace launchsafe::report::safety {
namespace {

bool is_value(const Row& critical) { return text_of(critical, "critical_gap_kind") == "value"; }

/// Whether complete coupled runs on both sides of a case's critical gap do what is expected of them.
bool is_confirmed(const StudyEvidence& study, const std::string& label) {
  std::set<std::string> expected;
  for (const Row& run : study.rows("coupled_runs")) {
    if (text_of(run, "case") != label) continue;
    if (text_of(run, "outcome") != text_of(run, "expected")) return false;
    expected.insert(text_of(run, "expected"));
  }
  return expected.size() == 2;
}

std::vector<JudgedGap> gaps_of(const CaseEvidence& judged) {
  std::vector<JudgedGap> gaps;
  const double lower = number_of(*judged.critical, "critical_gap_lower_cm");
  for (const Row* row : judged.verdicts) {
    gaps.push_back({.gap = number_of(*row, "gap_cm"),
                    .safe = text_of(*row, "verdict") == "SAFE",
                    .margin = number_of(*row, "margin_K"),
                    .uncertainty = number_of(*row, "uncertainty_K")});
    if (!is_value(*judged.critical)) continue;
    gaps.back().distance = lower - gaps.back().gap;
    gaps.back().distance_uncertainty = lower - number_of(*judged.critical, "critical_gap_at_least_cm");
  }
  return gaps;
}

/// cm: what a rule recommends over all cases, the smallest of what it allows in each. Nothing where one
/// allows none.
Row allowed_in_all(const std::vector<CaseEvidence>& cases, const GapCriterion& criterion) {
  Row smallest;
  for (const CaseEvidence& each : cases) {
    const std::vector<JudgedGap> gaps = gaps_of(each);
    const std::size_t row = largest_gap_under(criterion, gaps);
    if (row == gaps.size()) return {};
    if (smallest.is_null() || gaps[row].gap < smallest.get<double>()) smallest = gaps[row].gap;
  }
  return smallest;
}

/// The case with the smallest critical gap; nullptr where none is a value.
const CaseEvidence* smallest_of(const std::vector<CaseEvidence>& cases) {
  const CaseEvidence* smallest = nullptr;
  for (const CaseEvidence& each : cases)
    if (is_value(*each.critical) &&
        (smallest == nullptr ||
         number_of(*each.critical, "critical_gap_cm") < number_of(*smallest->critical, "critical_gap_cm")))
      smallest = &each;
  return smallest;
}

}  // namespace

bool is_uncertain(const Row* verdict) {
  const std::string code = text_of(*verdict, quantity::reason_code().key());
  return code == to_string(study::ReasonCode::validity_warning) ||
         code == to_string(study::ReasonCode::unaccepted);
}

Row counts_of(const std::vector<const Row*>& verdicts) {
  Row counts{{"of", verdicts.size()}};
  for (const char* word : {"SAFE", "INDETERMINATE", "UNSAFE"})
    counts[word] =
        std::ranges::count_if(verdicts, [&](const Row* row) { return text_of(*row, "verdict") == word; });
  counts["undecided"] = counts["INDETERMINATE"] != 0;
  counts["all_undecided"] = counts["INDETERMINATE"] == verdicts.size();
  return counts;
}

Row told_case(const StudyEvidence& study, const CaseEvidence& judged) {
  Row row = *judged.critical;
  const auto number = [&](const char* key) { return number_of(row, key); };
  row["case"] = judged.label;
  row["confirmed"] = is_confirmed(study, judged.label);
  row["critical_gap"] = row["critical_gap_reads_as"];
  // Digits that tell the ends of the bracket apart.
  row["bracket_decimals"] =
      std::max(decimals_for(number("critical_gap_upper_cm") - number("critical_gap_lower_cm")), 3);
  const auto gap = is_value(row) ? measured_gap(number("critical_gap_cm"), number("critical_gap_at_least_cm"),
                                                number("critical_gap_at_most_cm"))
                                 : std::nullopt;
  if (gap) {
    row["critical_gap"] = gap->text("cm");
    row["lower_cm"] = gap->lower();
    row["upper_cm"] = gap->upper();
    row["from"] = fixed(std::max(0.0, gap->lower()), gap->decimals);
    row["to"] = fixed(gap->upper(), gap->decimals);
  }
  row["largest_safe_gap_cm"] = allowed_in_all({judged}, GapCriterion{});
  row.update(counts_of(judged.verdicts));
  return row;
}

Row told_verdict(const CaseEvidence& judged, std::size_t place) {
  Row row = *judged.verdicts[place];
  const JudgedGap gap = gaps_of(judged)[place];
  const bool ignited = !text_of(row, "ignition_cause").empty();
  const bool is_known = judged.completed() && std::isfinite(gap.uncertainty) && !is_uncertain(&row);
  const int decimals = decimals_for(gap.uncertainty);
  const auto down = [&](bool told, double value, int places) {
    return told && judged.completed() && std::isfinite(value) ? Row(rounded_down(value, places)) : Row();
  };
  row["case"] = judged.label;
  row["safe"] = gap.safe;
  row["margin_K"] = down(!ignited, gap.margin, decimals);
  row["uncertainty_K"] = is_known ? Row(rounded_up(gap.uncertainty, decimals)) : Row();
  row["margin_over_uncertainty"] =
      down(is_known && gap.uncertainty > 0 && !ignited, gap.margin / gap.uncertainty, 1);
  row["distance_cm"] = down(true, gap.distance, 3);
  if (!judged.completed()) row["temperature_max_K"] = nullptr;
  // What else the reason says, but for what page one says of all rows.
  std::vector<std::string> beside;
  for (const char* clause : {"limited", "noise", "ring", "model_form", "accepted"})
    if (std::string text = text_of(row, clause); !text.empty()) beside.push_back(std::move(text));
  if (!text_of(row, "extrapolated").empty()) beside.emplace_back("extrapolated");
  row["beside"] = fmt::format("{}", fmt::join(beside, "; "));
  return row;
}

Row summary_of(const StudyEvidence& study, const std::vector<CaseEvidence>& cases) {
  std::size_t none_safe = 0, unknown = 0;
  const CaseEvidence* smallest = smallest_of(cases);
  for (const CaseEvidence& each : cases) {
    const std::string kind = text_of(*each.critical, "critical_gap_kind");
    none_safe += kind == "all-ignite";
    unknown += kind != "all-ignite" && kind != "all-safe" && kind != "value";
  }
  return {{"cases", cases.size()},
          {"sweeps", study.tells == Tells::sweep},
          {"none_safe", none_safe > 0 ? Row(none_safe) : Row()},
          {"unknown", unknown > 0 ? Row(unknown) : Row()},
          {"smallest", smallest != nullptr ? told_case(study, *smallest) : Row()}};
}

bool is_own(const StudyEvidence& study, const CaseEvidence& judged) {
  return std::ranges::all_of(judged.values, [&](const auto& each) {
    return study::same_number(each.second, own_value(study, each.first));
  });
}

const CaseEvidence* own_case(const StudyEvidence& study, const std::vector<CaseEvidence>& cases) {
  const auto own = std::ranges::find_if(cases, [&](const CaseEvidence& each) { return is_own(study, each); });
  if (own != cases.end()) return &*own;
  const CaseEvidence* smallest = smallest_of(cases);
  return smallest != nullptr || cases.empty() ? smallest : &cases.front();
}

Row answer_of(const StudyEvidence& study, const std::vector<CaseEvidence>& cases,
              const std::optional<GapCriterion>& criterion) {
  Row answer{{"study", study.label},
             {"finished", study.finished()},
             {"criterion", criterion ? Row(criterion->text) : Row()},
             {"criterion_source", criterion ? Row(criterion->source) : Row()},
             {"recommended_gap_cm", criterion ? allowed_in_all(cases, *criterion) : Row()},
             {"largest_safe_gap_cm", allowed_in_all(cases, GapCriterion{})},
             {"cases", Row::array()}};
  for (const CaseEvidence& each : cases) answer["cases"].push_back(told_case(study, each));
  return answer;
}

}  // namespace launchsafe::report::safety
