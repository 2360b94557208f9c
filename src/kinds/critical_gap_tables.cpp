// The tables of a critical-gap study.
#include "launchsafe/kinds/calibration.hpp"
#include "launchsafe/kinds/critical_gap_report.hpp"
#include "launchsafe/report/air_energy_table.hpp"
#include "launchsafe/report/columns.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/report/verdict_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::kinds {

using namespace study;
using namespace report;
namespace {

/// What the published temperature at the early time was used for.
std::string early_used_for(const study::Reference& paper) {
  using enum study::Use;
  if (!std::isfinite(paper.early_temperature)) return {};
  return to_string(paper.early_calibrated ? calibration : paper.selection ? selection : held_out);
}

/// Computed minus published (K) of a calibrated row above which the scene's constants are not those of its
/// calibration.
constexpr double calibration_slack = 0.5;

}  // namespace

Table verdict_table(const CriticalGapResult& result) {
  Table table;
  table.title = "Verdicts";
  table.columns = {significant_column("gap", "cm", 6, "gap_cm"),
                   significant_column("p max", "MPa", 6, "peak_pressure_MPa"),
                   significant_column("c(0)", "um", 6, "crack_radius_um"),
                   significant_column("a", "mm", 6, "flaw_size_mm")};
  for (Column& column : verdict_columns(result.study.study)) table.columns.push_back(std::move(column));
  for (const CaseOutcome& outcome : result.cases) {
    for (const GapVerdict& row : outcome.verdicts) {
      std::vector<Cell> cells{100.0 * row.gap, 1e-6 * outcome.input.peak_pressure,
                              1e6 * outcome.input.crack_radius, 1e3 * outcome.input.flaw_size};
      add_verdict_cells(row, cells);
      table.rows.push_back(std::move(cells));
    }
  }
  table.notes = mesh_notes(result.study);
  table.notes.push_back(station_note(result.study));
  return table;
}

Table comparison_table(const CriticalGapResult& result) {
  Table table;
  const std::string early = fmt::format("{:.6g} ms", 1e3 * result.study.study.early_time);
  table.title = "Against the published results";
  table.columns = {significant_column("gap", "cm", 6, "gap_cm"),
                   named_text("used for", "used_for"),
                   number_column("T max", "K", 1, "T_max_K"),
                   number_column("paper", "K", 1, "paper_K"),
                   number_column("computed - published", "K", 1, "computed_minus_published_K"),
                   named_text("at", "at"),
                   named_text("paper at", "paper_at"),
                   named_text("used for at " + early, "used_for_10ms"),
                   number_column("T at " + early, "K", 1, "T_max_10ms_K"),
                   number_column("paper", "K", 1, "paper_10ms_K"),
                   number_column("computed - published", "K", 1, "computed_minus_published_10ms_K"),
                   named_text("at", "at_10ms"),
                   named_text("paper at", "paper_at_10ms"),
                   number_column("ignition", "ms", 2, "ignition_ms"),
                   number_column("paper", "ms", 2, "paper_ignition_ms")};
  bool ignited = false;
  double worst = 0;  // |computed - published| of a calibrated row, K
  for (const CaseOutcome& outcome : result.cases) {
    for (const GapVerdict& row : outcome.verdicts) {
      if (!row.reference) continue;
      const study::Reference& paper = *row.reference;
      ignited = ignited || paper.ignited() || row.ignition;
      if (paper.calibrated)
        worst = std::max(worst, std::isfinite(row.misfit()) ? std::abs(row.misfit()) : HUGE_VAL);
      table.rows.push_back({100.0 * row.gap, used_for(paper), row.maximum.temperature,
                            optional_number(paper.maximum_temperature), optional_number(row.misfit()),
                            row.maximum.point, paper.point, early_used_for(paper), row.early.temperature,
                            optional_number(paper.early_temperature), optional_number(row.early_misfit()),
                            row.early.point, paper.early_point,
                            row.ignition ? optional_number(1e3 * row.ignition->time) : Cell(),
                            optional_number(1e3 * paper.ignition_time)});
    }
  }
  table.notes.push_back(
      "Calibration: constants or the load were fitted to it. Selection: it chose among models, and is no "
      "prediction. Held out: a prediction.");
  if (!(worst <= calibration_slack)) {
    table.notes.push_back(fmt::format(
        "The scene's constants do not meet the calibrated rows ({}): they belong to other settings, and no "
        "row here "
        "counts as calibrated.",
        std::isfinite(worst) ? fmt::format("computed - published: {:.1f} K", worst)
                             : std::string("one of them ignites")));
  }
  if (ignited) {
    table.notes.push_back(
        "After ignition T max is that of the burning skin; it is not compared. Whether and when the largest "
        "published gap that is safe and the smallest that ignites do so is calibrated: the ignition "
        "temperature "
        "was set between them.");
  }
  return table;
}

namespace {

std::string confirmation_text(const CaseOutcome& outcome) {
  if (outcome.confirmations.empty()) return "not confirmed";
  std::string text;
  for (const study::Confirmation& each : outcome.confirmations) {
    const std::string said = !each.completed ? "failed" : each.ignited ? "ignites" : "does not ignite";
    text += fmt::format("{}{} {}", text.empty() ? "" : "; ", centimetres(each.gap), said);
  }
  return text;
}

}  // namespace

Table critical_gap_table(const CriticalGapResult& result) {
  Table table;
  table.title = "Critical gap";
  table.columns = {text_column("case"),
                   named_text("kind", "kind"),
                   significant_column("value", "cm", 6, "value_cm"),
                   significant_column("no ignition", "cm", 6, "lower_cm"),
                   significant_column("ignites", "cm", 6, "upper_cm"),
                   significant_column("uncertainty", "cm", 2, "uncertainty_cm"),
                   named_text("coupled runs", "coupled_runs"),
                   named_text("remark", "reason")};
  for (const CaseOutcome& outcome : result.cases) {
    const study::CriticalGap& gap = outcome.critical;
    table.rows.push_back({outcome.input.label, study::to_string(gap.kind), optional_number(100.0 * gap.value),
                          optional_number(100.0 * gap.lower), optional_number(100.0 * gap.upper),
                          optional_number(100.0 * gap.uncertainty), confirmation_text(outcome), gap.reason});
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
  Table table;
  table.title = "Under both models of the air";
  table.columns = {text_column("case"), significant_column("gap", "cm", 6, "gap_cm"),
                   number_column("T max, reservoir", "K", 1, "T_max_reservoir_K"),
                   number_column("T max, film", "K", 1, "T_max_film_K")};
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
        "verdict "
        "rests. Its temperature is that of the charge's surface, which the base cools.");
  }
  return table;
}

Table fit_table(const CaseOutcome& outcome) {
  Table table;
  if (!outcome.fit) return table;
  const study::GapFit& fit = *outcome.fit;
  const auto& ols = fit.least_squares;
  table.title = "T max = intercept + slope * gap over the rows that do not ignite, " + outcome.input.label;
  table.columns = {text_column("line"), number_column("slope", "K/cm", 1, "slope_K_per_cm"),
                   number_column("intercept", "K", 3, "intercept_K"), number_column("RMS", "K", 2, "rms_K")};
  for (const double gap : fit.gaps) {
    table.columns.push_back(number_column(fmt::format("residual {:.6g}", 100.0 * gap), "K", 2,
                                          fmt::format("residual_{:.6g}_cm_K", 100.0 * gap)));
  }
  const auto add = [&table](std::string name, const study::Line& line) {
    std::vector<Cell> cells{std::move(name), line.slope, line.intercept, line.root_mean_square};
    for (const double residual : line.residuals) cells.emplace_back(residual);
    table.rows.push_back(std::move(cells));
  };
  add("least squares", fit.ordinary);
  if (fit.mixed) add("its slope through the zero-gap row (the paper's form)", *fit.mixed);
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
  Table table;
  table.title = "Runs";
  table.columns = {text_column("case"),
                   named_text("status", "status"),
                   scientific_column("energy drift", "", 1, "energy_drift"),
                   count_column("steps", "steps"),
                   count_column("particles", "particles"),
                   scientific_column("updates", "1/s", 2, "updates_per_second"),
                   named_text("limiters that acted (particle steps)", "limiters")};
  for (const CaseOutcome& outcome : result.cases) {
    const run::MechanicsResult& run = outcome.result.mechanics;
    table.rows.push_back({outcome.input.label, outcome.completed() ? "completed" : outcome.failure,
                          optional_number(run::largest_energy_drift(run)),
                          static_cast<std::int64_t>(run.steps), static_cast<std::int64_t>(run.particles),
                          optional_number(run.update_rate()), limiters_text(run.limiters)});
  }
  return table;
}

Table cited_limit_table(const CriticalGapResult& result) {
  std::vector<const CriticalGap*> critical;
  for (const CaseOutcome& outcome : result.cases) critical.push_back(&outcome.critical);
  return report::cited_limit_table(result.study, critical);
}

}  // namespace launchsafe::kinds
