// The tables of a critical-gap study.
#include "critical_gap_marks.hpp"
#include "launchsafe/kinds/critical_gap.hpp"
#include "launchsafe/report/case_tables.hpp"
#include "launchsafe/report/kinetics_text.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/report/verdict_text.hpp"
#include "launchsafe/scene/launch_end.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::kinds {

using namespace study;
using namespace report;
namespace {

/// What the published temperature at the early time was used for.
std::string early_used_for(const study::Reference& published) {
  using enum study::Use;
  if (!std::isfinite(published.early_temperature)) return {};
  return to_string(published.calibrated ? fitted : published.selection ? chosen_by : held_out);
}

/// Computed minus published (K) of a calibrated row above which the scene's constants are not those of its
/// calibration.
constexpr double calibration_slack = 0.5;

std::vector<Column> comparison_columns(double early_time) {
  using namespace quantity;
  const std::string early = early_text(early_time);
  return {gap(),
          used_for(),
          temperature_max(),
          number_column("published", "K", 1, "temperature_max_published_K"),
          computed_minus_published("temperature_max_computed_minus_published_K"),
          temperature_max_place(),
          named_text("published at", "temperature_max_published_place"),
          named_text("used for at " + early, "temperature_early_used_for"),
          temperature_early(early_time),
          number_column("published", "K", 1, "temperature_early_published_K"),
          computed_minus_published("temperature_early_computed_minus_published_K"),
          temperature_early_place(),
          named_text("published at", "temperature_early_published_place"),
          ignition_time(),
          number_column("published", "ms", 2, "ignition_time_published_ms")};
}

std::vector<Cell> comparison_cells(const GapVerdict& row, const study::Reference& published) {
  return {100.0 * row.gap,
          used_for(published),
          row.until_exit.temperature,
          optional_number(published.maximum_temperature),
          optional_number(row.misfit()),
          row.until_exit.point,
          published.point,
          early_used_for(published),
          row.early.temperature,
          optional_number(published.early_temperature),
          optional_number(row.early_misfit()),
          row.early.point,
          published.early_point,
          row.ignition ? optional_number(1e3 * row.ignition->time) : Cell(),
          optional_number(1e3 * published.ignition_time)};
}

}  // namespace

Table verdict_table(const CriticalGapResult& result) {
  Table table{"Verdicts",
              {quantity::gap(), quantity::peak_pressure(), quantity::crack_radius(), quantity::flaw_size()}};
  append(table.columns, verdict_columns(result.study.study));
  for (const CaseOutcome& outcome : result.cases) {
    for (const GapVerdict& row : outcome.verdicts) {
      std::vector<Cell> cells{100.0 * row.gap, 1e-6 * outcome.input.peak_pressure,
                              1e6 * outcome.input.crack_radius, 1e3 * outcome.input.flaw_size};
      add_verdict_cells(row, row.heated, cells);
      table.rows.push_back(std::move(cells));
    }
  }
  table.notes = mesh_notes(result.study);
  table.notes.push_back(station_note(result.study));
  return table;
}

Table comparison_table(const CriticalGapResult& result) {
  Table table;
  table.title = "Against the published results";
  table.columns = comparison_columns(result.study.study.early_time);
  bool ignited = false;
  double worst = 0;  // |computed - published| of a calibrated row, K
  for (const CaseOutcome& outcome : result.cases) {
    for (const GapVerdict& row : outcome.verdicts) {
      if (!row.reference) continue;
      ignited = ignited || row.reference->ignited() || row.ignition;
      if (row.reference->calibrated)
        worst = std::max(worst, std::isfinite(row.misfit()) ? std::abs(row.misfit()) : HUGE_VAL);
      table.rows.push_back(comparison_cells(row, *row.reference));
    }
  }
  table.notes.push_back(
      "Fitted: the load or constants were fitted to it. Chosen by: it was seen when a form of the model was "
      "picked, and is no prediction. Held out: a prediction.");
  if (!(worst <= calibration_slack)) {
    table.notes.push_back(fmt::format(
        "The scene's constants do not meet the calibrated rows ({}): they belong to other settings, and no "
        "row here counts as calibrated.",
        std::isfinite(worst) ? fmt::format("computed - published: {:.1f} K", worst)
                             : std::string("one of them ignites")));
  }
  if (ignited) {
    table.notes.push_back(
        "After ignition T max is that of the burning skin; it is not compared. Whether and when the largest "
        "published gap that is safe and the smallest that ignites do so is calibrated: the ignition "
        "temperature was set between them.");
  }
  return table;
}

namespace {

std::string ignition_word(bool ignites) { return ignites ? "ignites" : "does not ignite"; }

std::string outcome_word(const Confirmation& each) {
  return each.completed ? ignition_word(each.ignited) : "failed";
}

std::string confirmation_text(const CaseOutcome& outcome) {
  if (outcome.confirmations.empty()) return "not confirmed";
  std::string text;
  for (const study::Confirmation& each : outcome.confirmations)
    text += fmt::format("{}{} {}", text.empty() ? "" : "; ", centimetres(each.gap), outcome_word(each));
  return text;
}

}  // namespace

Table critical_gap_table(const CriticalGapResult& result) {
  Table table{"Critical gap", {quantity::case_name()}};
  append(table.columns, critical_gap_columns());
  append(table.columns, critical_gap_bounds_columns());
  append(table.columns,
         {for_programs(named_text("coupled runs", "coupled_runs")), named_text("remark", "reason")});
  for (const CaseOutcome& outcome : result.cases) {
    std::vector<Cell>& cells = table.rows.emplace_back();
    cells.emplace_back(outcome.input.label);
    add_critical_gap_cells(outcome.critical, cells);
    add_critical_gap_bounds_cells(outcome.critical, cells);
    cells.insert(cells.end(), {confirmation_text(outcome), outcome.critical.reason});
  }
  return table;
}

namespace {

/// What burnt in a coupled run; empty where nothing did.
std::vector<Cell> burning_cells(const std::optional<run::CombustionHistory>& combustion) {
  if (!combustion || combustion->burnt_mass.empty()) return std::vector<Cell>(5);
  const BurntState state = burnt_state_of(*combustion);
  return {optional_number(1e3 * combustion->complete_time), state.burnt_mass, state.released,
          state.highest_pressure, combustion->energy_residual};
}

}  // namespace

Table coupled_run_table(const CriticalGapResult& result) {
  Table table;
  table.title = "Coupled runs, on through combustion where they ignite";
  table.columns = {quantity::case_name(),
                   quantity::gap(),
                   named_text("expected", "expected"),
                   named_text("outcome", "outcome"),
                   quantity::temperature_max(),
                   scientific_column("coupled - traced", "K", 1, "coupled_minus_traced_K"),
                   quantity::skin_burnt_time(),
                   quantity::burnt_mass(),
                   quantity::heat_released(),
                   quantity::bottom_pressure_max(),
                   quantity::combustion_residual(),
                   quantity::reason()};
  for (const CaseOutcome& outcome : result.cases) {
    for (const Confirmation& each : outcome.confirmations) {
      std::vector<Cell>& cells = table.rows.emplace_back(std::vector<Cell>{
          outcome.input.label, 100.0 * each.gap, ignition_word(each.expected_ignition), outcome_word(each),
          optional_number(each.maximum_temperature), optional_number(each.difference)});
      const std::vector<Cell> burning = burning_cells(each.combustion);
      cells.insert(cells.end(), burning.begin(), burning.end());
      cells.emplace_back(each.failure);
      if (each.combustion && table.notes.empty())
        table.notes.push_back(flame_kinetics_note(outcome.input.scene.scene));
    }
  }
  return table;
}

Table air_energy_table(const CriticalGapResult& result) {
  std::vector<AuditedGap> gaps;
  for (const CaseOutcome& outcome : result.cases) {
    const std::string label = result.cases.size() > 1 ? outcome.input.label : std::string{};
    for (const GapVerdict& row : outcome.verdicts) gaps.push_back({label, row.gap, row.air});
  }
  return air_energy_table(result.study.scene.scene.surface.air_model, gaps);
}

Table air_model_table(const CriticalGapResult& result) {
  Table table{"Under both models of the air",
              {quantity::case_name(), quantity::gap(),
               number_column("T max, reservoir", "K", 1, "temperature_max_reservoir_K"),
               number_column("T max, film", "K", 1, "temperature_max_film_K")}};
  for (const CaseOutcome& outcome : result.cases) {
    if (!outcome.film) continue;
    for (std::size_t i = 0; i < outcome.verdicts.size(); ++i) {
      const GapVerdict& row = outcome.verdicts[i];
      table.rows.push_back({outcome.input.label, 100.0 * row.gap, optional_number(row.maximum.temperature),
                            optional_number(outcome.film->maximum_temperature.at(i))});
    }
    table.notes.push_back(fmt::format("Critical gap, {}: {} with the reservoir, {} with the film.",
                                      outcome.input.label, reads_as(outcome.critical),
                                      reads_as(outcome.film->critical)));
  }
  if (!table.rows.empty()) {
    table.notes.push_back(
        "The film conserves energy and conducts into charge and base: an optimistic bound, on which no "
        "verdict rests. Its temperature is that of the hottest depth of the charge: the base cools the "
        "surface.");
  }
  return table;
}

Table without_exit_table(const CriticalGapResult& result) {
  Table table{"In a barrel without end",
              {quantity::case_name(), quantity::gap(),
               number_column("T max, muzzle exit", "K", 1, "temperature_max_with_exit_K"),
               number_column("T max, without", "K", 1, "temperature_max_without_exit_K"),
               for_programs(named_text("critical gap, without", "critical_gap_without_exit"))}};
  for (const CaseOutcome& outcome : result.cases) {
    if (!outcome.longer_launch || scene::is_cut_short(outcome.input.scene.scene.load)) continue;
    for (std::size_t i = 0; i < outcome.verdicts.size(); ++i) {
      const GapVerdict& row = outcome.verdicts[i];
      table.rows.push_back({outcome.input.label, 100.0 * row.gap, optional_number(row.maximum.temperature),
                            optional_number(outcome.longer_launch->maximum_temperature.at(i)),
                            reads_as(outcome.longer_launch->critical)});
    }
    table.notes.push_back(fmt::format("Critical gap, {}: {} with the muzzle exit, {} without.",
                                      outcome.input.label, reads_as(outcome.critical),
                                      reads_as(outcome.longer_launch->critical)));
  }
  if (!table.rows.empty())
    table.notes.push_back(
        "Verdicts rest on the muzzle exit that the scene states. Without it the load goes on until it is "
        "below "
        "1 % of its peak: what the answer would be if the exit were wrong.");
  return table;
}

Table fit_table(const CaseOutcome& outcome) {
  Table table;
  if (!outcome.fit) return table;
  const study::GapFit& fit = *outcome.fit;
  const auto& ols = fit.least_squares;
  table.title = "T max = intercept + slope * gap over the rows that do not ignite, " + outcome.input.label;
  table.columns = {for_programs(quantity::case_name()), text_column("line"),
                   number_column("slope", "K/cm", 1, "slope_K_per_cm"),
                   number_column("intercept", "K", 3, "intercept_K"), number_column("RMS", "K", 2, "rms_K")};
  for (const double gap : fit.gaps) {
    table.columns.push_back(number_column(fmt::format("residual {:.6g}", 100.0 * gap), "K", 2,
                                          fmt::format("residual_{:.6g}_cm_K", 100.0 * gap)));
  }
  append(table.columns,
         {for_programs(number_column("slope error", "K/cm", 1, "slope_standard_error_K_per_cm")),
          for_programs(number_column("intercept error", "K", 2, "intercept_standard_error_K")),
          for_programs(number_column("R^2", "", 5, "r_squared")),
          for_programs(number_column("residual deviation", "K", 2, "residual_deviation_K"))});
  const auto add = [&](std::string name, const study::Line& line) {
    std::vector<Cell> cells{outcome.input.label, std::move(name), line.slope, line.intercept,
                            line.root_mean_square};
    for (const double residual : line.residuals) cells.emplace_back(residual);
    table.rows.push_back(std::move(cells));
  };
  add("least squares", fit.ordinary);
  table.rows.back().resize(table.columns.size() - 4);
  table.rows.back().insert(table.rows.back().end(), {ols.standard_errors[1], ols.standard_errors[0],
                                                     ols.r_squared, ols.residual_deviation});
  if (fit.mixed) add("its slope through the zero-gap row (the published form)", *fit.mixed);
  if (fit.published) add("as published", *fit.published);
  if (ols.degrees_of_freedom > 0) {
    table.notes.push_back(
        fmt::format("Least squares: slope {:.1f} +- {:.1f} K/cm, intercept {:.2f} +- {:.2f} K "
                    "(standard errors), R^2 {:.5f}, residual deviation {:.2f} K.",
                    ols.coefficients[1], ols.standard_errors[1], ols.coefficients[0], ols.standard_errors[0],
                    ols.r_squared, ols.residual_deviation));
  }
  return table;
}

Table run_table(const CriticalGapResult& result) {
  std::vector<NamedRun> runs;
  for (const CaseOutcome& outcome : result.cases)
    runs.push_back({outcome.input.label, outcome.failure, &outcome.result.mechanics,
                    outcome.completed() ? "cases/" + outcome.hash + ".h5" : std::string{}});
  return report::run_table(runs);
}

Table gap_share_table(const CriticalGapResult& result) {
  std::vector<std::pair<std::string, const CriticalGap*>> cases;
  for (const CaseOutcome& outcome : result.cases) cases.emplace_back(outcome.input.label, &outcome.critical);
  return report::gap_share_table(cases);
}

Table cited_limit_table(const CriticalGapResult& result) {
  return report::cited_limit_table(result.study, critical_gaps_of(result.cases));
}

}  // namespace launchsafe::kinds
