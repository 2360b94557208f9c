#include "launchsafe/report/statement_table.hpp"

#include "launchsafe/report/number.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/study_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::report {
namespace {

using study::PublishedStatement, study::StatementCheck;
using Agreement = StatementCheck::Agreement;

/// A unit in which values of a dimension are shown.
struct ShownUnit {
  const char* name;
  double factor;  ///< from SI
  int decimals;
};

ShownUnit unit_of(const PublishedStatement& statement) {
  using scene::Dimension;
  if (statement.quantity == study::StatementQuantity::slope) return {"K/cm", 1.0, 1};
  switch (study::traits_of(statement.quantity).dimension.value_or(Dimension::number)) {
    case Dimension::temperature:
    case Dimension::temperature_difference:
      return {"K", 1.0, 1};
    case Dimension::time:
      return {"ms", 1e3, 2};
    case Dimension::pressure:
      return {"MPa", 1e-6, 1};
    case Dimension::length:
      return {"cm", 100.0, 4};
    default:
      return {"", 1.0, 1};
  }
}

std::string with_unit(std::string text, const ShownUnit& unit) {
  return *unit.name == '\0' ? text : text + " " + unit.name;
}

std::string computed_text(const StatementCheck& check) {
  if (!check.place.empty() || !check.reason.empty()) return check.place.empty() ? check.reason : check.place;
  if (!std::isfinite(check.low)) return {};
  const ShownUnit unit = unit_of(check.statement);
  const auto number = [&](double value) { return fixed(unit.factor * value, unit.decimals); };
  return with_unit(
      check.low == check.high ? number(check.low) : number(check.low) + " to " + number(check.high), unit);
}

/// "+0.22 ms".
std::string difference_text(const StatementCheck& check) {
  const ShownUnit unit = unit_of(check.statement);
  const double shown = unit.factor * check.difference;
  return with_unit((shown > 0 ? "+" : "") + fixed(shown, unit.decimals), unit);
}

std::string outcome_text(const StatementCheck& check) {
  switch (check.agreement) {
    case Agreement::agrees:
      return "agrees";
    case Agreement::differs:
      return std::isfinite(check.difference) ? "differs by " + difference_text(check) : "differs";
    case Agreement::not_computed:
      break;
  }
  return "not computed";
}

/// "17.7 ms", "G13 at 10 ms", "800 K", "pressure ratio 1.5"; empty where nothing narrows the statement.
std::string circumstances(const PublishedStatement& said) {
  std::string text = said.point;
  const auto add = [&text](const std::string& more) { text += (text.empty() ? "" : ", ") + more; };
  if (std::isfinite(said.time)) add(scene::time_text(said.time));
  if (std::isfinite(said.level)) add(significant(said.level, 6) + " K");
  if (std::isfinite(said.ratio)) add("pressure ratio " + significant(said.ratio, 6));
  return text;
}

Cell cell_in(double value, const ShownUnit& unit) { return optional_number(unit.factor * value); }

/// What the statements of one quantity come to.
struct Tally {
  std::int64_t checked = 0, agree = 0, held_out = 0, held_out_agree = 0;
  const StatementCheck* worst = nullptr;

  void add(const StatementCheck& check) {
    const bool agrees = check.agreement == Agreement::agrees;
    const bool is_held_out = check.statement.use == study::Use::held_out;
    ++checked;
    agree += agrees;
    held_out += is_held_out;
    held_out_agree += agrees && is_held_out;
    if (agrees) return;
    const auto size = [](const StatementCheck& each) {
      return std::isfinite(each.difference) ? std::abs(each.difference) : HUGE_VAL;
    };
    if (worst == nullptr || size(check) > size(*worst)) worst = &check;
  }
};

/// "-12.8 K at 0.04 cm, 10 ms".
std::string worst_text(const StatementCheck* worst) {
  if (worst == nullptr) return {};
  std::string text = std::isfinite(worst->difference)
                         ? difference_text(*worst)
                         : fmt::format("{} instead of {}", computed_text(*worst), worst->statement.value);
  if (std::isfinite(worst->gap)) text += " at " + centimetres(worst->gap);
  const std::string more = circumstances(worst->statement);
  return more.empty() ? text : text + ", " + more;
}

}  // namespace

Table statement_table(const std::vector<StatementCheck>& checks) {
  Table table;
  table.title = "Statements of the publication";
  table.columns = {named_text("source", "source"),
                   quantity::gap(),
                   named_text("quantity", "quantity"),
                   named_text("at", "circumstances"),
                   named_text("published", "published"),
                   named_text("computed", "computed"),
                   named_text("outcome", "outcome"),
                   quantity::used_for(),
                   named_text("remark", "remark"),
                   for_programs(named_text("unit", "unit")),
                   for_programs(number_column("published low", "", 6, "published_low")),
                   for_programs(number_column("published high", "", 6, "published_high")),
                   for_programs(number_column("tolerance", "", 6, "tolerance")),
                   for_programs(number_column("computed low", "", 6, "computed_low")),
                   for_programs(number_column("computed high", "", 6, "computed_high")),
                   for_programs(number_column("difference", "", 6, "computed_minus_published"))};
  for (const StatementCheck& check : checks) {
    const PublishedStatement& said = check.statement;
    const bool counts = said.quantity != study::StatementQuantity::not_computed;
    const ShownUnit unit = unit_of(said);
    const bool number = std::isfinite(said.low);
    table.rows.push_back({said.source, optional_number(100.0 * check.gap),
                          study::traits_of(said.quantity).word, circumstances(said), said.value,
                          computed_text(check), outcome_text(check),
                          counts ? study::to_string(said.use) : std::string{}, said.remark,
                          std::string(unit.name), cell_in(said.low, unit), cell_in(said.high, unit),
                          number ? Cell(unit.factor * said.tolerance) : Cell(), cell_in(check.low, unit),
                          cell_in(check.high, unit), cell_in(check.difference, unit)});
  }
  return table;
}

Table statement_summary(const std::vector<StatementCheck>& checks) {
  Table table;
  table.title = "Against the text of the publication";
  table.columns = {named_text("quantity", "quantity"),
                   count_column("statements", "statements"),
                   count_column("agree", "agree"),
                   count_column("held out", "held_out"),
                   count_column("of these agree", "held_out_agree"),
                   named_text("largest difference", "largest_difference")};
  for (const study::StatementTraits& traits : study::statement_traits()) {
    Tally tally;
    for (const StatementCheck& check : checks)
      if (check.statement.quantity == traits.quantity && check.agreement != Agreement::not_computed)
        tally.add(check);
    if (tally.checked == 0) continue;
    table.rows.push_back({traits.word, tally.checked, tally.agree, tally.held_out, tally.held_out_agree,
                          worst_text(tally.worst)});
  }
  return table;
}

std::string statement_definitions(const std::vector<StatementCheck>& checks) {
  std::string text;
  for (const study::StatementTraits& traits : study::statement_traits()) {
    const bool named = std::any_of(checks.begin(), checks.end(), [&](const StatementCheck& check) {
      return check.statement.quantity == traits.quantity;
    });
    if (named) text += fmt::format("- {}: {}\n", traits.word, traits.definition);
  }
  return text;
}

}  // namespace launchsafe::report
