// What each axis of a sweep changes.
#include "launchsafe/kinds/sweep_report.hpp"
#include "launchsafe/report/columns.hpp"
#include "launchsafe/report/number.hpp"
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
