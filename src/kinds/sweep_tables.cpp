// The tables of a sweep.
#include "answer_tables.hpp"
#include "critical_gap_marks.hpp"
#include "launchsafe/kinds/sweep.hpp"
#include "launchsafe/report/case_tables.hpp"
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

using keys::fixed, keys::significant, keys::text;

/// Places of the smallest and largest gap among those judged; one of them where they are the same.
std::vector<std::size_t> outer_gaps(const std::vector<double>& gaps) {
  if (gaps.empty()) return {};
  const auto [least, most] = std::minmax_element(gaps.begin(), gaps.end());
  std::vector<std::size_t> places{static_cast<std::size_t>(least - gaps.begin())};
  if (*most > *least) places.push_back(static_cast<std::size_t>(most - gaps.begin()));
  return places;
}

/// T max at the smallest and the largest gap.
Quantities<AnsweredCase> outer_gap_quantities(const std::vector<double>& gaps) {
  Quantities<AnsweredCase> quantities;
  for (const std::size_t place : outer_gaps(gaps)) {
    const char* name = quantities.empty() ? "temperature_max_smallest_gap" : "temperature_max_largest_gap";
    quantities.emplace_back(
        Column{name, "T max at " + centimetres(gaps[place]), fixed(1, kelvin),
               "Highest temperature at that gap; of one that ignites the burning skin's."},
        [place](const AnsweredCase& row) {
          const auto& verdicts = row.answer->verdicts;
          return place < verdicts.size() ? verdicts[place].maximum.temperature : not_a_number;
        });
  }
  return quantities;
}

Quantities<AnsweredCase> swept_case_quantities(const study::Study& study) {
  return keys::joined<AnsweredCase>(
      {answered_axes(study),
       of_part<AnsweredCase>(bounded_gap_quantities(), &AnsweredCase::answer, &CaseAnswer::critical),
       {{{"assumed_shares", "assumed", text(), "What the bounds rest on and nothing says of the case."},
         [study](const AnsweredCase& row) {
           return assumed_shares(study, row.study->cases[row.index], row.answer->critical.value);
         }}},
       {{quantity::recorded_uncertainty(),
         [](const AnsweredCase& row) { return row.study->cases[row.index].recorded_uncertainty(); }}},
       outer_gap_quantities(study.gaps),
       {{quantity::status(), [](const AnsweredCase& row) { return status_of(*row.answer); }},
        {quantity::energy_drift(), &AnsweredCase::answer, &CaseAnswer::run, &RunSummary::energy_drift},
        {for_programs(quantity::steps()), &AnsweredCase::answer, &CaseAnswer::run, &RunSummary::steps},
        {for_programs(quantity::particles()), &AnsweredCase::answer, &CaseAnswer::run,
         &RunSummary::particles},
        {quantity::limiters(),
         [](const AnsweredCase& row) { return limiters_text(row.answer->run.limiters); }},
        {quantity::remark(), [](const AnsweredCase& row) {
           return row.answer->completed() ? to_string(row.answer->critical.reason) : row.answer->failure;
         }}}});
}

Quantities<VerdictRow> swept_verdict_quantities(const study::Study& study) {
  return keys::joined<VerdictRow>({of_part<VerdictRow>(axis_quantities(study), &VerdictRow::coordinates),
                                   {{quantity::gap(), &VerdictRow::width}},
                                   verdict_quantities(study)});
}

/// SAFE, UNSAFE or INDET. by gap.
Quantities<AnsweredCase> matrix_quantities(const study::Study& study) {
  Quantities<AnsweredCase> quantities = answered_axes(study);
  for (std::size_t i = 0; i < study.gaps.size(); ++i)
    quantities.emplace_back(Column{"gap_" + digits_of(study.gaps[i], quantity::gap().form) + "_cm",
                                   centimetres(study.gaps[i]), text(), "The verdict at that gap."},
                            [i](const AnsweredCase& row) -> std::string {
                              if (i >= row.answer->verdicts.size()) return {};
                              const Verdict verdict = row.answer->verdicts[i].judgement.verdict;
                              return verdict == Verdict::indeterminate ? "INDET." : study::to_string(verdict);
                            });
  return quantities;
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
  Table table = table_of("Critical gaps", swept_case_quantities(result.study.study),
                         answered(result.study, result.answers));
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
  std::vector<VerdictRow> rows;
  for (const AnsweredCase& each : answered(result.study, result.answers)) {
    const CaseAnswer* answer = each.answer;
    for (std::size_t i = 0; i < answer->verdicts.size(); ++i) {
      const bool known = i < answer->heated_temperature.size();
      rows.push_back({nullptr, &answer->verdicts[i], known ? answer->heated_temperature[i] : not_a_number,
                      &each.coordinates()});
    }
  }
  Table table = table_of("Verdicts", swept_verdict_quantities(result.study.study), rows);
  table.notes = mesh_notes(result.study);
  table.notes.push_back(station_note(result.study));
  return table;
}

Table verdict_matrix(const SweepResult& result) {
  Table table = table_of("Verdicts by gap", matrix_quantities(result.study.study),
                         answered(result.study, result.answers));
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

/// What an axis changes.
struct EffectRow {
  std::string axis;
  ShownKey key;
  Effect effect;
};

Quantities<EffectRow> effect_quantities() {
  return {{{"axis", "axis", text(), "The axis."}, &EffectRow::axis},
          {{"from", "from", text(), "Its lowest value."},
           [](const EffectRow& row) { return row.key.text(row.effect.lowest); }},
          {{"to", "to", text(), "Its highest value."},
           [](const EffectRow& row) { return row.key.text(row.effect.highest); }},
          {{"temperature_max_change", "T max by at most", significant(3, kelvin),
            "Largest change of T max over the axis, all else the same, where nothing ignites."},
           &EffectRow::effect,
           &Effect::temperature},
          {{"critical_gap_change", "critical gap by at most", significant(3, centimetre),
            "Largest change of the critical gap over the axis, all else the same."},
           &EffectRow::effect,
           &Effect::critical}};
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
      "Below the flaw size the crack radius is all but dead: T max moves by {} at most, critical gaps by {}. "
      "The strain that cracks add goes with the cube of crack radius over flaw size{}.",
      in_words(below.temperature, significant(2, kelvin)),
      in_words(below.critical, significant(2, centimetre)),
      rubs && !friction_varies
          ? ", and friction between closed crack faces keeps them from growing under the pressure of a launch"
          : "");
}

}  // namespace

Table axis_effect_table(const SweepResult& result) {
  std::vector<EffectRow> rows;
  std::vector<std::string> notes;
  const auto keys = shown_axes(result.study.study);
  const auto add = [&](const ShownKey& key, const char* which, const Effect& effect) {
    if (effect.lowest < effect.highest) rows.push_back({key.heading + which, key, effect});
  };
  for (std::size_t axis = 0; axis < keys.size(); ++axis) {
    add(keys[axis], "", effect_of(result, axis, [](const study::StudyCase&) { return true; }));
    if (keys[axis].scene_key != "charge.crack_radius") continue;
    const Effect below = effect_of(result, axis, below_flaw);
    add(keys[axis], ", below the flaw size", below);
    if (std::string note = crack_note(result, below); !note.empty()) notes.push_back(std::move(note));
  }
  Table table = table_of("What each axis changes", effect_quantities(), rows);
  table.notes = std::move(notes);
  if (!rows.empty()) {
    table.notes.push_back(
        "Changes over the whole axis with all other values the same: of T max at gaps where nothing ignites, "
        "and of critical gaps that are values.");
  }
  return table;
}

std::vector<ResultTable> sweep_results() {
  study::Study study;
  study.gaps = {0.0, 0.4e-3};
  return {{"cases", "critical_gaps.csv", keys::described(swept_case_quantities(study))},
          {"verdicts", "verdicts.csv", keys::described(swept_verdict_quantities(study))},
          {"cited_limits", "", cited_limit_columns()},
          {"axis_effects", "", keys::described(effect_quantities())}};
}

}  // namespace launchsafe::kinds
