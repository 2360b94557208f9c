// The tables of a sweep.
#include "launchsafe/kinds/sweep.hpp"
#include "launchsafe/report/air_energy_table.hpp"
#include "launchsafe/report/columns.hpp"
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/report/verdict_text.hpp"
#include "sweep_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace launchsafe::kinds {

using namespace study;
using namespace report;

namespace {

/// The columns of the axes, and room for others behind them.
std::vector<Column> axis_columns(const std::vector<ShownKey>& keys) {
  std::vector<Column> columns;
  for (const ShownKey& key : keys) columns.push_back(key.column());
  return columns;
}

std::vector<Cell> axis_cells(const std::vector<ShownKey>& keys, const study::StudyCase& input) {
  std::vector<Cell> cells(keys.size());
  for (std::size_t i = 0; i < std::min(keys.size(), input.coordinates.size()); ++i)
    cells[i] = keys[i].value(input.coordinates[i]);
  return cells;
}

/// Calls with every case and its answer.
template <class Function>
void for_each_case(const SweepResult& result, Function function) {
  const std::size_t cases = std::min(result.study.cases.size(), result.answers.size());
  for (std::size_t i = 0; i < cases; ++i) function(result.study.cases[i], result.answers[i]);
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

std::string verdict_mark(study::Verdict verdict) {
  return verdict == study::Verdict::indeterminate ? "INDET." : study::to_string(verdict);
}

/// What the audit of the air says of the gap where most was taken; there may be millions of others.
std::string air_energy_note(const SweepResult& result, const std::vector<ShownKey>& keys) {
  std::vector<AuditedGap> worst;
  for_each_case(result, [&](const study::StudyCase& input, const CaseAnswer& answer) {
    for (const study::GapVerdict& row : answer.verdicts) {
      if (!std::isfinite(row.air.ratio())) continue;
      if (worst.empty() || row.air.ratio() > worst.front().air.ratio())
        worst = {{name_of(keys, input), row.gap, row.air}};
    }
  });
  return air_energy_statement(result.study.scene.scene.surface.air_model, worst);
}

/// A table whose rows begin with the values of the axes.
Table table_by_axes(std::string title, const std::vector<ShownKey>& keys) {
  Table table;
  table.title = std::move(title);
  table.columns = axis_columns(keys);
  return table;
}

}  // namespace

Table critical_gap_table(const SweepResult& result) {
  const auto keys = shown_axes(result.study.study);
  const std::vector<double>& gaps = result.study.study.gaps;
  Table table = table_by_axes("Critical gaps", keys);
  append(table.columns, critical_gap_columns());
  append(table.columns, outer_gap_columns(gaps));
  append(table.columns,
         {quantity::status(), quantity::energy_drift(), for_programs(quantity::steps()),
          for_programs(quantity::particles()), quantity::limiters(), named_text("remark", "reason")});
  for_each_case(result, [&](const study::StudyCase& input, const CaseAnswer& answer) {
    std::vector<Cell> cells = axis_cells(keys, input);
    add_critical_gap_cells(answer.critical, cells);
    for (const std::size_t place : outer_gaps(gaps))
      cells.push_back(place < answer.verdicts.size()
                          ? optional_number(answer.verdicts[place].maximum.temperature)
                          : Cell());
    add_run_cells(answer, cells);
    table.rows.push_back(std::move(cells));
  });
  table.notes.emplace_back(
      "Only a critical gap of kind value is a number. T max of a gap that ignites is that of the burning "
      "skin.");
  table.notes.push_back(air_energy_note(result, keys));
  return table;
}

Table verdict_table(const SweepResult& result) {
  const auto keys = shown_axes(result.study.study);
  Table table;
  table.title = "Verdicts";
  table.columns = axis_columns(keys);
  append(table.columns, {quantity::gap()});
  append(table.columns, verdict_columns(result.study.study));
  for_each_case(result, [&](const study::StudyCase& input, const CaseAnswer& answer) {
    const std::vector<Cell> place = axis_cells(keys, input);
    for (std::size_t i = 0; i < answer.verdicts.size(); ++i) {
      std::vector<Cell>& cells = table.rows.emplace_back();
      cells.reserve(table.columns.size());
      cells.insert(cells.end(), place.begin(), place.end());
      cells.emplace_back(in_centimetres(answer.verdicts[i].gap));
      const bool known = i < answer.heated_temperature.size();
      add_verdict_cells(answer.verdicts[i], known ? answer.heated_temperature[i] : study::not_a_number,
                        cells);
    }
  });
  table.notes = mesh_notes(result.study);
  table.notes.push_back(station_note(result.study));
  return table;
}

Table verdict_matrix(const SweepResult& result) {
  const auto keys = shown_axes(result.study.study);
  const std::vector<double>& gaps = result.study.study.gaps;
  Table table = table_by_axes("Verdicts by gap", keys);
  for (const double gap : gaps) {
    table.columns.push_back(named_text(centimetres(gap), fmt::format("gap_{:.6g}_cm", in_centimetres(gap))));
  }
  for_each_case(result, [&](const study::StudyCase& input, const CaseAnswer& answer) {
    std::vector<Cell> cells = axis_cells(keys, input);
    for (std::size_t i = 0; i < std::min(gaps.size(), answer.verdicts.size()); ++i)
      cells.emplace_back(verdict_mark(answer.verdicts[i].judgement.verdict));
    table.rows.push_back(std::move(cells));
  });
  if (counts_of(result.answers).verdicts.at(Verdict::indeterminate) > 0)
    table.notes.emplace_back("INDET.: indeterminate; verdicts.csv has the reasons.");
  return table;
}

Table cited_limit_table(const SweepResult& result) {
  std::vector<const CriticalGap*> critical;
  for (const CaseAnswer& answer : result.answers) critical.push_back(&answer.critical);
  return report::cited_limit_table(result.study, critical);
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
  for (std::size_t i = 0; i < std::min(result.study.cases.size(), result.answers.size()); ++i) {
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
      "{} cm. "
      "The strain that cracks add goes with the cube of crack radius over flaw size{}.",
      significant(below.temperature, 2), significant(100.0 * below.critical, 2),
      rubs && !friction_varies
          ? ", and friction between closed crack faces keeps them from growing under the pressure of a launch"
          : "");
}

}  // namespace

Table axis_effect_table(const SweepResult& result) {
  Table table;
  table.title = "What each axis changes";
  table.columns = {text_column("axis"), text_column("from"), text_column("to"),
                   significant_column("T max by at most", "K", 3, "temperature_max_change_K"),
                   significant_column("critical gap by at most", "cm", 3, "critical_gap_change_cm")};
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
        "and "
        "of critical gaps that are values.");
  }
  return table;
}

}  // namespace launchsafe::kinds
