// The tables of a sweep.
#include "answer_tables.hpp"
#include "critical_gap_marks.hpp"
#include "launchsafe/kinds/sweep.hpp"
#include "launchsafe/report/case_tables.hpp"
#include "launchsafe/report/columns.hpp"
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/report/verdict_text.hpp"
#include "launchsafe/study/case_uncertainty.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace launchsafe::kinds {

using namespace study;
using namespace report;

namespace {

PlacedAnswers answers_of(const SweepResult& result) {
  const auto keys = shown_axes(result.study.study);
  PlacedAnswers placed;
  for (const ShownKey& key : keys) placed.columns.push_back(key.column());
  for (std::size_t i = 0; i < result.answers.size(); ++i)
    placed.rows.push_back({axis_cells(keys, result.study.cases[i]), &result.answers[i]});
  return placed;
}

/// Places of the smallest and largest gap among those judged; one of them where they are the same.
std::vector<std::size_t> outer_gaps(const std::vector<double>& gaps) {
  if (gaps.empty()) return {};
  const auto [least, most] = std::minmax_element(gaps.begin(), gaps.end());
  std::vector<std::size_t> places{static_cast<std::size_t>(least - gaps.begin())};
  if (*most > *least) places.push_back(static_cast<std::size_t>(most - gaps.begin()));
  return places;
}

std::vector<Column> outer_gap_columns(const std::vector<double>& gaps) {
  std::vector<Column> columns;
  for (const std::size_t place : outer_gaps(gaps)) {
    const char* key = columns.empty() ? "temperature_max_smallest_gap_K" : "temperature_max_largest_gap_K";
    columns.push_back(number_column("T max at " + centimetres(gaps[place]), "K", 1, key));
  }
  return columns;
}

void add_run_cells(const CaseAnswer& answer, std::vector<Cell>& cells) {
  cells.emplace_back(status_of(answer));
  cells.push_back(optional_number(answer.run.energy_drift));
  cells.emplace_back(static_cast<std::int64_t>(answer.run.steps));
  cells.emplace_back(static_cast<std::int64_t>(answer.run.particles));
  cells.emplace_back(limiters_text(answer.run.limiters));
  cells.emplace_back(answer.completed() ? answer.critical.reason : answer.failure);
}

/// What the audit of the air says of the gap where most was taken; there may be millions of others.
std::string air_energy_note(const SweepResult& result, const std::vector<ShownKey>& keys) {
  std::vector<AuditedGap> worst;
  for (std::size_t i = 0; i < result.answers.size(); ++i) {
    for (const study::GapVerdict& row : result.answers[i].verdicts) {
      if (!std::isfinite(row.air.ratio())) continue;
      if (worst.empty() || row.air.ratio() > worst.front().air.ratio())
        worst = {{name_of(keys, result.study.cases[i]), row.gap, row.air}};
    }
  }
  return air_energy_statement(result.study.scene.scene.surface.air_model, worst);
}

}  // namespace

Table critical_gap_table(const SweepResult& result) {
  const auto keys = shown_axes(result.study.study);
  const std::vector<double>& gaps = result.study.study.gaps;
  const PlacedAnswers answers = answers_of(result);
  Table table = answers.table("Critical gaps");
  append(table.columns, critical_gap_columns());
  append(table.columns, critical_gap_bounds_columns());
  append(table.columns, {named_text("assumed", "assumed_shares")});
  append(table.columns, outer_gap_columns(gaps));
  append(table.columns,
         {quantity::status(), quantity::energy_drift(), for_programs(quantity::steps()),
          for_programs(quantity::particles()), quantity::limiters(), named_text("remark", "reason")});
  for (std::size_t i = 0; i < answers.rows.size(); ++i) {
    const auto& [place, answer] = answers.rows[i];
    std::vector<Cell>& cells = table.rows.emplace_back(place);
    add_critical_gap_cells(answer->critical, cells);
    add_critical_gap_bounds_cells(answer->critical, cells);
    cells.emplace_back(assumed_shares(result.study.study, result.study.cases[i], answer->critical.value));
    for (const std::size_t gap : outer_gaps(gaps))
      cells.push_back(gap < answer->verdicts.size()
                          ? optional_number(answer->verdicts[gap].maximum.temperature)
                          : Cell());
    add_run_cells(*answer, cells);
  }
  table.notes.emplace_back(
      "Only a critical gap of kind value is a number. T max of a gap that ignites is that of the burning "
      "skin.");
  table.notes.emplace_back(
      "Assumed: what the bounds rest on and neither the study nor its records say of the case. What is said "
      "of "
      "the uncertainty names why, the commonest reason first.");
  table.notes.push_back(air_energy_note(result, keys));
  return table;
}

Table verdict_table(const SweepResult& result) {
  Table table = verdict_table(result.study.study, answers_of(result));
  table.notes = mesh_notes(result.study);
  table.notes.push_back(station_note(result.study));
  return table;
}

Table verdict_matrix(const SweepResult& result) {
  Table table = verdict_matrix(result.study.study, answers_of(result));
  if (counts_of(result.answers).verdicts.at(Verdict::indeterminate) > 0)
    table.notes.emplace_back(indeterminate_note);
  return table;
}

Table cited_limit_table(const SweepResult& result) {
  return report::cited_limit_table(result.study, critical_gaps_of(result.answers));
}

namespace {

/// Least and greatest of what was seen; nothing before the first.
struct Range {
  double least = study::not_a_number, most = study::not_a_number;
  void add(double value) {
    if (!std::isfinite(value)) return;
    least = std::isnan(least) ? value : std::min(least, value);
    most = std::isnan(most) ? value : std::max(most, value);
  }
  double width() const { return most - least; }  ///< NaN before the first
};

/// The cases that differ along one axis alone: their T max by gap, where no one ignites, and critical gaps.
struct Line {
  std::map<double, Range> temperature;  ///< K, by gap in m
  std::map<double, bool> ignited;
  Range critical;  ///< m
};

struct Effect {
  double temperature = study::not_a_number;                            ///< K
  double critical = study::not_a_number;                               ///< m
  double lowest = study::not_a_number, highest = study::not_a_number;  ///< of the axis, SI
};

void raise(double& most, double value) {
  if (std::isfinite(value) && !(value <= most)) most = value;
}

template <class Counts>
Effect effect_of(const SweepResult& result, std::size_t axis, Counts counts) {
  std::map<std::vector<double>, Line> lines;
  Range extent;
  for (std::size_t i = 0; i < result.answers.size(); ++i) {
    const study::StudyCase& input = result.study.cases[i];
    const study::CaseAnswer& answer = result.answers[i];
    if (input.coordinates.size() <= axis || !answer.completed() || !counts(input)) continue;
    std::vector<double> others = input.coordinates;
    extent.add(others[axis]);
    others[axis] = 0.0;
    Line& line = lines[others];
    line.critical.add(value_of(answer.critical));
    for (const study::GapVerdict& row : answer.verdicts) {
      if (row.ignition) line.ignited[row.gap] = true;
      line.temperature[row.gap].add(row.maximum.temperature);
    }
  }
  Effect effect{study::not_a_number, study::not_a_number, extent.least, extent.most};
  for (const auto& [others, line] : lines) {
    raise(effect.critical, line.critical.width());
    for (const auto& [gap, range] : line.temperature) {
      if (!line.ignited.contains(gap)) raise(effect.temperature, range.width());
    }
  }
  return effect;
}

void add_row(Table& table, const ShownKey& key, const std::string& which, const Effect& effect) {
  if (!(effect.lowest < effect.highest)) return;
  table.rows.push_back({which, key.text(effect.lowest), key.text(effect.highest),
                        optional_number(effect.temperature), optional_number(100.0 * effect.critical)});
}

bool below_flaw(const study::StudyCase& input) { return input.crack_radius < input.flaw_size; }

/// What stands behind a crack radius that changes little below the flaw size; empty where it changes much.
std::string crack_note(const SweepResult& result, const Effect& below) {
  constexpr double little = 5.0;  // K
  if (!(below.temperature <= little)) return {};
  const auto& axes = result.study.study.axes;
  const bool friction_varies = std::any_of(axes.begin(), axes.end(), [](const study::Axis& axis) {
    return axis.key.name == "charge.face_friction" || axis.key.name == "charge.crack_friction";
  });
  const bool rubs = result.study.scene.scene.charge().strength.face_friction > 0.0;
  return fmt::format(
      "Below the flaw size the crack radius is all but dead: T max moves by {} K at most, critical gaps by "
      "{} cm. The strain that cracks add goes with the cube of crack radius over flaw size{}.",
      significant(below.temperature, 2), significant(100.0 * below.critical, 2),
      rubs && !friction_varies
          ? ", and friction between closed crack faces keeps them from growing under the pressure of a launch"
          : "");
}

}  // namespace

Table axis_effect_table(const SweepResult& result) {
  Table table{"What each axis changes",
              {text_column("axis"), text_column("from"), text_column("to"),
               significant_column("T max by at most", "K", 3, "temperature_max_change_K"),
               significant_column("critical gap by at most", "cm", 3, "critical_gap_change_cm")}};
  const auto keys = shown_axes(result.study.study);
  for (std::size_t axis = 0; axis < keys.size(); ++axis) {
    add_row(table, keys[axis], keys[axis].name,
            effect_of(result, axis, [](const study::StudyCase&) { return true; }));
    if (keys[axis].scene_key != "charge.crack_radius") continue;
    const Effect below = effect_of(result, axis, below_flaw);
    add_row(table, keys[axis], keys[axis].name + ", below the flaw size", below);
    if (std::string note = crack_note(result, below); !note.empty()) table.notes.push_back(std::move(note));
  }
  if (!table.rows.empty()) {
    table.notes.push_back(
        "Changes over the whole axis with all other values the same: of T max at gaps where nothing ignites, "
        "and of critical gaps that are values.");
  }
  return table;
}

}  // namespace launchsafe::kinds
