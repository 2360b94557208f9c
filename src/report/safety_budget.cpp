// What the uncertainty is made of, and what holds the results against what others published.
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/quantities.hpp"
#include "safety_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace launchsafe::report::safety {
namespace {

// --- shares ---

/// A size in digits that mean something: of next to nothing, below what it is.
std::string share_text(double size, double least) {
  return size > 0.0 && size < least ? "< " + significant(least, 1) : uncertain_text(size);
}
constexpr double least_temperature_share = 0.1;  // K

Table share_table(const JudgedCase& each) {
  // Cells are texts: of next to nothing, what it is below.
  const auto kelvins = [](const char* heading, const char* name) {
    return Column{name, heading, keys::fixed(1, kelvin)};
  };
  Table table{.columns = {quantity::gap(), kelvins("computation", "computation"), kelvins("fit", "fit"),
                          kelvins("inputs", "inputs"), kelvins("model form", "model_form"),
                          kelvins("total", "uncertainty"), quantity::verdict()}};
  for (const Row* row : each.verdicts) {
    if (!each.completed || !std::isfinite(number_of(*row, "uncertainty_K"))) continue;
    std::vector<Cell>& cells = table.rows.emplace_back();
    cells.emplace_back(number_of(*row, "gap_cm"));
    for (const Share& share : shares_of(*row))
      cells.emplace_back(share_text(share.size, least_temperature_share));
    cells.emplace_back(uncertain_text(number_of(*row, "uncertainty_K")));
    cells.emplace_back(text_of(*row, "verdict"));
  }
  return table;
}

/// The causes of a case that lower the bound of its critical gap.
std::vector<const Row*> causes_of(const Subject& subject, const JudgedCase& each) {
  std::vector<const Row*> causes = pointers_to(subject.study.rows("gap_shares"));
  std::erase_if(causes, [&](const Row* row) { return text_of(*row, "case") != each.label; });
  return causes;
}

void say_gap_shares(const Subject& subject, const JudgedCase& each, SafetySection& section) {
  const std::vector<const Row*> causes = causes_of(subject, each);
  if (causes.empty()) return;
  const Origin origin = subject.origin("gap_shares", each.label);
  section.say("budget.gap_shares", {{"case", each.label}}, origin);
  section.show("gap_shares",
               table_of(causes, {Column{"cause", "cause"}, Column{"class", "class"},
                                 Column{"raised", "critical gap towards ignition"},
                                 Column{"lowered", "at the other end"},
                                 Column{"lowers", "lowers the bound by", keys::significant(2, centimetre)}}),
               origin);
}

// --- numerics ---

/// The rows of one variant of an accuracy study.
std::vector<const Row*> rows_of_variant(const StudyEvidence& accuracy, const std::string& table,
                                        const std::string& variant) {
  std::vector<const Row*> rows = pointers_to(accuracy.rows(table));
  std::erase_if(rows, [&](const Row* row) { return text_of(*row, "variant") != variant; });
  return rows;
}

/// Of several variants the one speaks whose record the main study took, or none.
void say_accuracy(const StudyEvidence& main, const StudyEvidence* accuracy, SafetySection& section) {
  if (accuracy == nullptr || !accuracy->finished()) return section.say("budget.no_accuracy");
  const Row* taken = setting_taken_by(main, *accuracy);
  const Row& settings = accuracy->rows("settings");
  if (taken == nullptr && !settings.empty() && !text_of(settings.front(), "variant").empty())
    return section.say("budget.no_variant", {}, origin_of(*accuracy, "settings"));
  const std::string variant = taken != nullptr ? text_of(*taken, "variant") : "";
  for (const Row* row : rows_of_variant(*accuracy, "settings", variant)) {
    if (text_of(*row, "remark").find("the scene as it is") == std::string::npos) continue;
    const double bound = number_of(*row, "temperature_bound_K"),
                 gap = number_of(*row, "critical_gap_bound_cm");
    const std::string setting = (variant.empty() ? "" : variant + ": ") + text_of(*row, "setting");
    section.say("budget.accuracy",
                {{"setting", setting},
                 {"bound", part(uncertain_text(bound) + " K", bound, "K")},
                 {"gap", part(uncertain_text(gap) + " cm", gap, "cm")}},
                origin_of(*accuracy, "settings", setting));
  }
  const std::vector<const Row*> rows = rows_of_variant(*accuracy, "reference", variant);
  if (rows.empty()) return;
  std::vector<std::string> meshes;
  for (const auto& [key, value] : rows.front()->items())
    if (key.starts_with("cells_") && !value.is_null()) meshes.push_back(key);
  std::sort(meshes.begin(), meshes.end(), [](const std::string& a, const std::string& b) {
    return std::strtod(a.c_str() + 6, nullptr) < std::strtod(b.c_str() + 6, nullptr);
  });
  std::vector<Column> columns{quantity::subject(), quantity::unit()};
  for (const std::string& mesh : meshes) {
    std::string name = mesh.substr(6);
    std::replace(name.begin(), name.end(), '_', ' ');
    columns.push_back({mesh, name, keys::significant(5)});
  }
  columns.push_back({"uncertainty", "uncertainty of the limit", keys::significant(2)});
  columns.push_back({"method", "method"});
  section.show("meshes", table_of(rows, std::move(columns)), origin_of(*accuracy, "reference"));
}

// --- inputs ---

/// Whether a study is of the main one's launch: these keys may differ, and those that it varies.
bool is_of_same_launch(const StudyEvidence& study) {
  const std::vector<std::string>& differences = study.differences;
  const auto is_input = [&study](const std::string& key) {
    const Row& inputs = study.rows("inputs");
    return std::any_of(inputs.begin(), inputs.end(),
                       [&key](const Row& input) { return text_of(input, "scene_key") == key; });
  };
  return std::all_of(differences.begin(), differences.end(), [&](const std::string& key) {
    return key == "title" || key == "gap.thickness" || key.starts_with("numerics.") ||
           key.starts_with("output.") || is_input(key);
  });
}

std::string percent_of(const Row& row, const char* key) {
  return significant(100.0 * number_of(row, key), 3) + " %";
}

/// The quantiles over the draws, beside the bounds of the same launch.
void say_quantiles(const StudyEvidence& sensitivity, const JudgedCase* own, SafetySection& section) {
  const Row& rows = sensitivity.rows("quantiles");
  const auto ignition = sensitivity.study.find("ignition");
  if (rows.empty() || ignition == sensitivity.study.end()) return;
  const auto at = [&](double percent) -> std::string {
    for (const Row& row : rows)
      if (number_of(row, "share_percent") == percent) return text_of(row, "critical_gap_reads_as");
    return "n/a";
  };
  const auto bounds =
      own != nullptr && is_of_same_launch(sensitivity) ? measured_gap(*own->critical) : std::nullopt;
  section.say("budget.quantiles",
              {{"lowest", at(2.5)},
               {"low", at(5)},
               {"middle", at(50)},
               {"highest", at(97.5)},
               {"bounds", bounds ? bounds->text("cm") : ""},
               {"gap", significant(number_of(sensitivity.study, "gap_cm"), 6) + " cm"},
               {"from", percent_of(*ignition, "probability_from")},
               {"to", percent_of(*ignition, "probability_to")}},
              origin_of(sensitivity, "quantiles"));
}

void say_sensitivity(const StudyEvidence* sensitivity, const JudgedCase* own, SafetySection& section) {
  if (sensitivity == nullptr || !sensitivity->finished()) return section.say("budget.no_sensitivity");
  say_quantiles(*sensitivity, own, section);
  Table table{.columns = {Column{"input", "input"}, quantity::distribution(),
                          Column{"first_order", "first order", keys::significant(2)},
                          Column{"first_order_interval", "interval"},
                          Column{"total_order", "total order", keys::significant(2)},
                          Column{"total_order_interval", "interval"}}};
  const Row* largest = nullptr;
  bool below_first = false;
  const auto interval = [](const Row& row, const std::string& order) {
    return fmt::format("{} to {}", significant(number_of(row, order + "_lower"), 2),
                       significant(number_of(row, order + "_upper"), 2));
  };
  for (const Row& row : sensitivity->rows("indices")) {
    if (text_of(row, "output") != "critical_gap" || !std::isfinite(number_of(row, "total_order"))) continue;
    table.rows.push_back({text_of(row, "input"), text_of(row, "distribution"), number_of(row, "first_order"),
                          interval(row, "first_order"), number_of(row, "total_order"),
                          interval(row, "total_order")});
    below_first = below_first || number_of(row, "total_order") < number_of(row, "first_order");
    if (largest == nullptr || number_of(row, "total_order") > number_of(*largest, "total_order"))
      largest = &row;
  }
  const Origin origin = origin_of(*sensitivity, "indices");
  if (largest == nullptr) return section.say("budget.no_indices", {}, origin);
  section.say("budget.sensitivity",
              {{"input", text_of(*largest, "input")},
               {"share", significant(100 * number_of(*largest, "total_order"), 2) + " %"}},
              origin);
  section.show("indices", std::move(table), origin);
  if (below_first) section.say("budget.total_below_first", {}, origin);
}

// --- model form ---

/// MPa, the pressure of a comparison that is nearest to the load's peak.
double nearest_pressure(const StudyEvidence& comparison, double peak) {
  double nearest = std::nan("");
  for (const Row& row : comparison.rows("cases")) {
    const double pressure = number_of(row, "peak_pressure_MPa");
    if (!(std::abs(pressure - peak) >= std::abs(nearest - peak))) nearest = pressure;
  }
  return nearest;
}

/// The cases of a comparison at one pressure (MPa); all where none is known.
std::vector<const Row*> rows_at(const StudyEvidence& comparison, double pressure) {
  std::vector<const Row*> rows = pointers_to(comparison.rows("cases"));
  std::erase_if(rows, [&](const Row* row) {
    return std::isfinite(pressure) && number_of(*row, "peak_pressure_MPa") != pressure;
  });
  return rows;
}

/// What the record of other models holds, over the pressures; without it the critical gaps at one pressure.
Table model_table(const StudyEvidence& comparison, const std::vector<const Row*>& cases) {
  const Row& models = comparison.rows("models");
  if (models.empty())
    return table_of(cases, {Column{"variant", "model"}, Column{"critical_gap_reads_as", "critical gap"},
                            quantity::reason()});
  std::vector<Column> columns{Column{"model", "model"}, Column{"what_it_is", "what it is"}};
  constexpr std::string_view prefix = "critical_gap_at_", unit = "_MPa";
  for (const auto& [key, value] : models.front().items()) {
    if (!key.starts_with(prefix) || !key.ends_with(unit)) continue;
    const std::string pressure = key.substr(prefix.size(), key.size() - prefix.size() - unit.size());
    columns.push_back({key, fmt::format("gap at {} MPa [cm]", pressure)});
  }
  columns.push_back(Column{"counts_as", "counts as"});
  return table_of(pointers_to(models), std::move(columns));
}

/// Critical gaps under each model, a point each.
Plot model_plot(const std::vector<const Row*>& rows, const std::string& pressure) {
  Plot plot;
  plot.title = "Critical gap under each model";
  plot.subtitle = pressure;
  plot.x = {.label = "critical gap [cm]", .minimum = 0.0};
  plot.height = 150 + 34 * static_cast<int>(rows.size());
  Series series{.style = Style::points, .colour = 0};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double place = static_cast<double>(rows.size() - i);
    const std::string name = text_of(*rows[i], "variant");
    plot.y.tics.push_back(
        {place, is_value(*rows[i]) ? name : name + ", " + text_of(*rows[i], "critical_gap_reads_as")});
    if (is_value(*rows[i])) series.add(number_of(*rows[i], "critical_gap_cm"), place);
  }
  plot.y.minimum = 0.4;
  plot.y.maximum = static_cast<double>(rows.size()) + 0.6;
  plot.series = {std::move(series)};
  return plot;
}

void say_models(const Subject& subject, SafetySection& section) {
  const StudyEvidence* comparison = subject.evidence.find("comparison");
  if (comparison == nullptr || !comparison->finished()) return section.say("budget.no_comparison");
  const double pressure =
      nearest_pressure(*comparison, 1e-6 * scene::PressureHistory(subject.scene().load).stated_peak());
  const auto text = [](double at) { return std::isfinite(at) ? significant(at, 4) + " MPa" : ""; };
  const std::vector<const Row*> rows = rows_at(*comparison, pressure);
  const std::string place = text(pressure);
  const Origin origin = origin_of(*comparison, "cases", place);
  const Row* lowest = nullptr;
  for (const Row& row : comparison->rows("cases"))
    if (number_of(row, "critical_gap_difference_cm") <
        (lowest ? number_of(*lowest, "critical_gap_difference_cm") : 0.0))
      lowest = &row;
  Parts parts{{"place", place}, {"count", rows.size()}};
  if (lowest != nullptr)
    parts["lowest"] = {{"model", text_of(*lowest, "variant")},
                       {"by", uncertain_text(-number_of(*lowest, "critical_gap_difference_cm")) + " cm"},
                       {"at", significant(number_of(*lowest, "peak_pressure_MPa"), 4) + " MPa"}};
  section.say("budget.models", parts, origin);
  // Where they were calibrated all agree: the picture is that of the pressure at which they differ most.
  const double drawn = lowest != nullptr ? number_of(*lowest, "peak_pressure_MPa") : pressure;
  const std::vector<const Row*> bars = rows_at(*comparison, drawn);
  if (std::any_of(bars.begin(), bars.end(), [](const Row* row) { return is_value(*row); })) {
    const std::string where = text(drawn);
    parts["place"] = where;
    section.draw("models", "models.svg", model_plot(bars, where), parts,
                 origin_of(*comparison, "cases", where));
  }
  section.show("models", model_table(*comparison, rows), origin_of(*comparison, "models"));
}

// --- published results ---

Table published_table(const Subject& subject) {
  return table_of(
      pointers_to(subject.study.rows("comparison")),
      {quantity::gap(), quantity::used_for(), Column{"temperature_max", "computed", keys::fixed(1, kelvin)},
       Column{"temperature_max_published", "published", keys::fixed(1, kelvin)},
       Column{"temperature_max_computed_minus_published", "difference", keys::fixed(1, kelvin)},
       Column{"temperature_early_used_for", "used for, early"},
       Column{"temperature_early", "computed, early", keys::fixed(1, kelvin)},
       Column{"temperature_early_published", "published, early", keys::fixed(1, kelvin)},
       quantity::ignition_time(),
       Column{"ignition_time_published", "published", keys::fixed(2, millisecond)}});
}

Table limit_table(const Subject& subject) {
  return table_of(
      pointers_to(subject.study.rows("cited_limits")),
      {Column{"limit", "cited limit", keys::significant(4, centimetre)},
       Column{"limit_peak_pressure", "at", keys::significant(4, megapascal)}, Column{"source", "source"},
       Column{"case", "nearest case"}, Column{"critical_gap_reads_as", "computed"},
       Column{"difference", "computed less cited", keys::significant(2, centimetre)}});
}

}  // namespace

SafetySection budget_section(const Subject& subject) {
  SafetySection section{"budget"};
  if (const JudgedCase* own = subject.own_case()) {
    say_gap_shares(subject, *own, section);
    Table table = share_table(*own);
    if (!table.rows.empty()) {
      section.say("budget.shares", {{"case", own->label}});
      section.show("shares", std::move(table), subject.origin("verdicts", own->label));
    }
  } else {
    section.say("budget.none");
  }
  say_accuracy(subject.study, subject.evidence.find("accuracy"), section);
  say_sensitivity(subject.evidence.find("sensitivity"), subject.own_case(), section);
  say_models(subject, section);
  return section;
}

void say_probability(const Subject& subject, SafetySection& section) {
  const StudyEvidence* sensitivity = subject.evidence.find("sensitivity");
  if (sensitivity == nullptr || !sensitivity->finished() || !is_of_same_launch(*sensitivity)) return;
  const auto ignition = sensitivity->study.find("ignition");
  if (ignition == sensitivity->study.end()) return;
  section.item("limits.probability",
               {{"gap", significant(number_of(sensitivity->study, "gap_cm"), 6) + " cm"},
                {"igniting", static_cast<int>(number_of(*ignition, "igniting"))},
                {"draws", static_cast<int>(number_of(*ignition, "completed"))},
                {"from", percent_of(*ignition, "probability_from")},
                {"to", percent_of(*ignition, "probability_to")}},
               origin_of(*sensitivity, "ignition"));
}

SafetySection published_section(const Subject& subject) {
  SafetySection section{"published"};
  Table published = published_table(subject);
  Parts parts{{"rows", published.rows.size()}, {"fitted", 0}, {"chosen_by", 0}, {"held_out", 0}};
  double worst = 0;
  for (const Row& row : subject.study.rows("comparison")) {
    const std::string used = text_of(row, "used_for");
    const char* use = used == "fitted" ? "fitted" : used == "chosen by" ? "chosen_by" : "held_out";
    parts[use] = parts[use].get<int>() + 1;
    if (used == "fitted") continue;
    const double misfit = std::abs(number_of(row, "temperature_max_computed_minus_published_K"));
    if (misfit > worst) worst = misfit;
  }
  parts["worst"] = part(uncertain_text(worst) + " K", worst, "K");
  if (published.rows.empty()) {
    section.say("published.none", {}, subject.origin("comparison"));
  } else {
    section.show("published", std::move(published), subject.origin("comparison"));
    section.say("published.conclusion", parts, subject.origin("comparison"));
  }
  if (Table limits = limit_table(subject); !limits.rows.empty()) {
    section.say("published.limits", {}, subject.origin("cited_limits"));
    section.show("limits", std::move(limits), subject.origin("cited_limits"));
  }
  return section;
}

}  // namespace launchsafe::report::safety
