// What each axis of a critical-gap study changes.
#include "critical_gap_tables.hpp"
#include "kind_texts.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/shown_key.hpp"
#include "launchsafe/report/verdict_text.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace launchsafe::kinds {

using keys::significant, keys::text;
using report::Row;
using study::StudyCase;

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
Effect effect_of(const CriticalGapResult& result, std::size_t axis, Counts counts) {
  std::map<std::vector<double>, Line> lines;
  Range extent;
  for (std::size_t i = 0; i < result.answers.size(); ++i) {
    const StudyCase& input = result.study.cases[i];
    const study::CaseAnswer& answer = result.answers[i];
    if (input.coordinates.size() <= axis || !answer.completed() || !counts(input)) continue;
    std::vector<double> others = input.coordinates;
    extent.add(others[axis]);
    others[axis] = 0.0;
    Line& line = lines[others];
    line.critical.add(report::value_of(answer.critical));
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

/// What an axis changes.
struct EffectRow {
  std::string axis;
  report::ShownKey key;
  Effect effect;
};

report::Quantities<EffectRow> effect_quantities() {
  return {{{"axis", "axis", text(), "The axis."}, &EffectRow::axis},
          {{"from", "from", text(), "Its lowest value."},
           [](const EffectRow& row) { return row.key.text(row.effect.lowest); }},
          {{"to", "to", text(), "Its highest value."},
           [](const EffectRow& row) { return row.key.text(row.effect.highest); }},
          {{"temperature_max_change", "T max by at most", significant(3, keys::kelvin),
            "Largest change of T max over the axis, all else the same, where nothing ignites."},
           &EffectRow::effect,
           &Effect::temperature},
          {{"critical_gap_change", "critical gap by at most", significant(3, keys::centimetre),
            "Largest change of the critical gap over the axis, all else the same."},
           &EffectRow::effect,
           &Effect::critical}};
}

bool below_flaw(const StudyCase& input) { return input.crack_radius < input.flaw_size; }

/// What there is to say of a crack radius that changes little below the flaw size; nothing where it changes
/// much.
Row crack_facts(const CriticalGapResult& result, const Effect& below) {
  constexpr double little = 5.0;  // K
  if (!(below.temperature <= little)) return {};
  const bool friction_varies = std::ranges::any_of(result.study.study.axes, [](const study::Axis& axis) {
    return axis.key.name == "charge.face_friction" || axis.key.name == "charge.crack_friction";
  });
  return {{"temperature", report::in_words(below.temperature, significant(2, keys::kelvin))},
          {"critical_gap", report::in_words(below.critical, significant(2, keys::centimetre))},
          {"held", result.study.scene.scene.charge().strength.face_friction > 0.0 && !friction_varies}};
}

}  // namespace

std::vector<report::Column> axis_effect_columns() { return keys::described(effect_quantities()); }

report::Table axis_effect_table(const CriticalGapResult& result) {
  std::vector<EffectRow> rows;
  Row facts = Row::object();
  const auto keys = report::shown_axes(result.study.study);
  const auto add = [&](const report::ShownKey& key, const char* which, const Effect& effect) {
    if (effect.lowest < effect.highest) rows.push_back({key.heading + which, key, effect});
  };
  for (std::size_t axis = 0; axis < keys.size(); ++axis) {
    add(keys[axis], "", effect_of(result, axis, [](const StudyCase&) { return true; }));
    if (keys[axis].scene_key != "charge.crack_radius") continue;
    const Effect below = effect_of(result, axis, below_flaw);
    add(keys[axis], ", below the flaw size", below);
    facts["cracks"] = crack_facts(result, below);
  }
  report::Table table = report::table_of("What each axis changes", effect_quantities(), rows);
  table.notes = said("critical_gap.note.axis_effects", facts);
  return table;
}

}  // namespace launchsafe::kinds
