#include "launchsafe/report/safety_document.hpp"

#include "launchsafe/report/number.hpp"
#include "launchsafe/report/quantities.hpp"
#include "safety_sections.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace launchsafe::report {

Parts part(std::string text, double value, std::string unit) {
  Parts number{{"text", std::move(text)}, {"value", nullptr}, {"unit", std::move(unit)}};
  if (std::isfinite(value)) number["value"] = value;
  return number;
}

std::string to_string(Look look) {
  constexpr const char* words[] = {"lead", "plain", "item", "code"};  // in the order of Look
  return words[static_cast<std::size_t>(look)];
}

namespace safety {

std::string text_of(const Row& row, const std::string& key) {
  const auto found = row.find(key);
  return found != row.end() && found->is_string() ? found->get<std::string>() : std::string{};
}

double number_of(const Row& row, const std::string& key) {
  const auto found = row.find(key);
  return found != row.end() && found->is_number() ? found->get<double>() : std::nan("");
}

bool has_validity_warning(const Row& verdict) {
  return text_of(verdict, "reason").starts_with("validity warning: ");
}

InertRows inert_rows(const JudgedCase& each) {
  InertRows rows;
  if (!each.completed) return rows;
  for (const Row* row : each.verdicts) {
    const double temperature = number_of(*row, "temperature_max_K");
    if (!text_of(*row, "ignition_cause").empty() || !std::isfinite(temperature)) continue;
    rows.gaps.push_back(number_of(*row, "gap_cm"));
    rows.temperatures.push_back(temperature);
  }
  return rows;
}

std::vector<const Row*> pointers_to(const Row& rows) {
  std::vector<const Row*> pointers;
  for (const Row& row : rows) pointers.push_back(&row);
  return pointers;
}

Table table_of(const std::vector<const Row*>& rows, std::vector<Column> columns) {
  Table table{"", std::move(columns), {}};
  for (const Row* row : rows) {
    std::vector<Cell>& cells = table.rows.emplace_back();
    for (const Column& column : table.columns) {
      const auto found = row->find(column.key());
      if (found != row->end() && found->is_string())
        cells.emplace_back(found->get<std::string>());
      else if (found != row->end() && found->is_number_integer())
        cells.emplace_back(found->get<std::int64_t>());
      else
        cells.push_back(optional_number(number_of(*row, column.key())));
    }
  }
  return table;
}

Origin origin_of(const StudyEvidence& study, std::string of, std::string setting) {
  return {study.label, std::move(of), std::move(setting)};
}

const Row* setting_taken_by(const StudyEvidence& main, const StudyEvidence& accuracy) {
  const std::string taken = quantity::recorded_uncertainty().key();
  for (const Row& row : accuracy.rows("settings"))
    for (const Row& each : main.rows("cases"))
      if (number_of(each, taken) == number_of(row, "temperature_bound_K")) return &row;
  return nullptr;
}

Origin Subject::origin(std::string of, std::string setting) const {
  return origin_of(study, std::move(of), std::move(setting));
}

namespace {

JudgedGap judged(const Row& row, const Row& critical) {
  JudgedGap gap{.gap = number_of(row, "gap_cm"),
                .safe = text_of(row, "verdict") == "SAFE",
                .margin = number_of(row, "margin_K"),
                .uncertainty = number_of(row, "uncertainty_K")};
  if (is_value(critical)) {
    gap.distance = number_of(critical, "critical_gap_lower_cm") - gap.gap;
    gap.distance_uncertainty =
        number_of(critical, "critical_gap_lower_cm") - number_of(critical, "critical_gap_at_least_cm");
  }
  return gap;
}

/// Verdicts stand case after case, in the order of the cases, each with all gaps of the study.
std::vector<JudgedCase> judged_cases(const StudyEvidence& study) {
  std::vector<JudgedCase> cases;
  const Row &criticals = study.rows("cases"), &verdicts = study.rows("verdicts");
  for (const Row& critical : criticals) {
    JudgedCase& each = cases.emplace_back(JudgedCase{text_of(critical, "case"), &critical, {}, {}, false});
    for (const Row& run : study.rows("runs"))
      if (text_of(run, "case") == each.label) each.completed = text_of(run, "status") == "completed";
    const std::size_t gaps = verdicts.size() / criticals.size(), first = (cases.size() - 1) * gaps;
    for (std::size_t i = first; i < first + gaps; ++i) {
      each.verdicts.push_back(&verdicts[i]);
      each.gaps.push_back(judged(verdicts[i], critical));
    }
  }
  return cases;
}

}  // namespace

Subject subject_of(const SafetyEvidence& evidence, const std::optional<GapCriterion>& criterion) {
  const StudyEvidence& study = evidence.main();
  return {evidence, study, study.kind == "critical-gap" ? judged_cases(study) : std::vector<JudgedCase>{},
          criterion};
}

bool Subject::is_own(const JudgedCase& each) const {
  const Row& row = *each.verdicts.front();
  const auto same = [](double a, double b) { return std::abs(a - b) <= 1e-9 * std::abs(b); };
  return same(number_of(row, "peak_pressure_MPa"),
              1e-6 * scene::PressureHistory(scene().load).stated_peak()) &&
         same(number_of(row, "crack_radius_um"), 1e6 * scene().charge().strength.initial_crack_radius) &&
         same(number_of(row, "flaw_size_mm"), 1e3 * scene().charge().strength.flaw_size);
}

const JudgedCase* Subject::own_case() const {
  if (cases.empty()) return nullptr;
  const auto own =
      std::find_if(cases.begin(), cases.end(), [&](const JudgedCase& each) { return is_own(each); });
  if (own != cases.end()) return &*own;
  const auto gap = [](const JudgedCase& each) {
    return is_value(*each.critical) ? number_of(*each.critical, "critical_gap_cm") : HUGE_VAL;
  };
  return &*std::min_element(cases.begin(), cases.end(),
                            [&](const JudgedCase& a, const JudgedCase& b) { return gap(a) < gap(b); });
}

Parts count_part(std::size_t count) { return count > 0 ? Parts(count) : Parts(); }

bool is_value(const Row& critical) { return text_of(critical, "critical_gap_kind") == "value"; }

std::optional<Measured> measured_gap(const Row& critical) {
  if (!is_value(critical)) return std::nullopt;
  return report::measured_gap(number_of(critical, "critical_gap_cm"),
                              number_of(critical, "critical_gap_at_least_cm"),
                              number_of(critical, "critical_gap_at_most_cm"));
}

std::string gap_text(const Row& critical) {
  const auto gap = measured_gap(critical);
  return gap ? gap->text("cm") : text_of(critical, "critical_gap_reads_as");
}

std::vector<Share> shares_of(const Row& verdict) {
  std::vector<Share> shares;
  for (const char* name : share_names) {
    const double size = number_of(verdict, fmt::format("uncertainty_of_{}_K", name));
    shares.push_back({name, std::isfinite(size) ? size : 0.0});
  }
  return shares;
}

namespace {

/// A reason without what other columns of its row and page one say of all rows: margin and extrapolation.
std::string short_reason(const std::string& verdict, const std::string& reason) {
  std::string text;
  std::size_t begin = 0;
  while (begin < reason.size()) {
    const std::size_t end = std::min(reason.find("; ", begin), reason.size());
    std::string clause = reason.substr(begin, end - begin);
    begin = end + 2;
    if (verdict == "SAFE" && (clause.starts_with("margin ") || clause.starts_with("below "))) continue;
    if (clause.starts_with("extrapolated: ")) clause = "extrapolated";
    if (clause.starts_with("margin ")) clause = "margin within the uncertainty";
    text += (text.empty() ? "" : "; ") + clause;
  }
  return text;
}

}  // namespace

Table verdict_table(const Subject& subject) {
  const bool several = subject.cases.size() > 1;
  Table table{.columns = {quantity::gap(), quantity::verdict(),
                          Column{"initial_temperature", "before launch", keys::fixed(0, kelvin)},
                          Column{"temperature_max", "T max", keys::fixed(0, kelvin)},
                          Column{"margin", "margin", keys::significant(6, kelvin)},
                          Column{"uncertainty", "uncertainty", keys::significant(6, kelvin)},
                          Column{"margin_over_uncertainty", "margin over uncertainty", keys::fixed(1)},
                          Column{"distance", "distance", keys::fixed(3, centimetre)},
                          for_people(Column{"why", "why"}), for_programs(quantity::reason())}};
  if (several) table.columns.insert(table.columns.begin(), quantity::case_name());
  for (const JudgedCase& each : subject.cases) {
    for (std::size_t i = 0; i < each.verdicts.size(); ++i) {
      const Row& row = *each.verdicts[i];
      const JudgedGap& gap = each.gaps[i];
      std::vector<Cell>& cells = table.rows.emplace_back();
      if (several) cells.emplace_back(each.label);
      const int decimals = decimals_for(gap.uncertainty);
      const auto down = [&each](double value, int places) {
        return each.completed && std::isfinite(value) ? Cell(rounded_down(value, places)) : Cell();
      };
      // After ignition T max is that of the burning skin, and a margin says nothing.
      const bool ignited = !text_of(row, "ignition_cause").empty();
      const bool known = each.completed && std::isfinite(gap.uncertainty) && !has_validity_warning(row);
      cells.insert(cells.end(),
                   {gap.gap, text_of(row, "verdict"), subject.scene().initial_temperature,
                    each.completed ? optional_number(number_of(row, "temperature_max_K")) : Cell(),
                    ignited ? Cell() : down(gap.margin, decimals),
                    known ? Cell(rounded_up(gap.uncertainty, decimals)) : Cell(),
                    known && gap.uncertainty > 0 && !ignited ? down(gap.margin / gap.uncertainty, 1) : Cell(),
                    down(gap.distance, 3), short_reason(text_of(row, "verdict"), text_of(row, "reason")),
                    text_of(row, "reason")});
    }
  }
  return table;
}

}  // namespace safety

SafetyDocument make_safety_document(const SafetyEvidence& evidence,
                                    const std::optional<GapCriterion>& criterion) {
  using namespace safety;
  const Subject subject = subject_of(evidence, criterion);
  return {.title = subject.study.title,
          .subject = subject.scene().title,
          .answer = answer_parts(subject),
          .sections = {answer_section(subject), gap_section(subject), scene_section(subject),
                       place_section(subject), fit_section(subject), budget_section(subject),
                       published_section(subject), validity_section(subject)}};
}

}  // namespace launchsafe::report
