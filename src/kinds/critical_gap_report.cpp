// The answer, the page, the picture of T max and the files of a critical-gap study.
#include "critical_gap_tables.hpp"
#include "launchsafe/report/safety_report.hpp"

namespace launchsafe::kinds {

namespace {

/// From the least to the largest of the values that it includes.
struct Extent {
  double lowest = math::infinity, highest = -math::infinity;
  void include(double value) {
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
  }
};

struct Effect {
  double temperature = not_a_number;  ///< K
  double critical = not_a_number;     ///< m
  Extent values;                      ///< of the axis, SI
};

void raise(double& most, double value) {
  if (std::isfinite(value) && !(value <= most)) most = value;
}

/// Of all cases, or of those with a crack below its flaw; without changes where one of them failed.
Effect effect_of(const CriticalGapResult& result, std::size_t axis, bool below_flaw) {
  // Of the cases that differ along the axis alone: K, infinite where one ignites, by gap too; and m.
  std::map<std::pair<std::vector<double>, double>, Extent> temperatures;
  std::map<std::vector<double>, Extent> critical_gaps;
  Effect effect;
  bool all_completed = true;
  for (std::size_t i = 0; i < result.answers.size(); ++i) {
    const StudyCase& input = result.study.cases[i];
    const CaseAnswer& answer = result.answers[i];
    if (input.coordinates.size() <= axis) continue;
    if (below_flaw && input.strength().initial_crack_radius >= input.strength().flaw_size) continue;
    std::vector<double> others = input.coordinates;
    effect.values.include(others[axis]);
    all_completed = all_completed && answer.completed();
    others[axis] = 0.0;
    critical_gaps[others].include(report::value_of(answer.critical));
    for (const GapVerdict& row : answer.verdicts)
      temperatures[{others, row.gap}].include(row.ignition ? math::infinity : row.maximum.temperature);
  }
  if (!all_completed) return effect;
  for (const auto& [others, range] : critical_gaps) raise(effect.critical, range.highest - range.lowest);
  for (const auto& [others, range] : temperatures) raise(effect.temperature, range.highest - range.lowest);
  return effect;
}

struct EffectRow {
  std::string axis;
  ShownKey key;
  Effect effect;
};

const Quantities<EffectRow> effect_quantities{
    {"axis", "axis", text(), "The axis.", &EffectRow::axis},
    {"from", "from", text(), "Its lowest value.",
     [](const EffectRow& row) { return row.key.text(row.effect.values.lowest); }},
    {"to", "to", text(), "Its highest value.",
     [](const EffectRow& row) { return row.key.text(row.effect.values.highest); }},
    {"temperature_max_change", "T max by at most", significant(3, kelvin),
     "Largest change of T max over the axis, all else the same, where nothing ignites.", &EffectRow::effect,
     &Effect::temperature},
    {"critical_gap_change", "critical gap by at most", significant(3, centimetre),
     "Largest change of the critical gap over the axis, all else the same.", &EffectRow::effect,
     &Effect::critical}};

/// Of a crack radius that changes little below the flaw size; nothing where it changes much.
Row crack_facts(const CriticalGapResult& result, const Effect& below) {
  constexpr double little = 5.0;  // K
  if (!(below.temperature <= little)) return {};
  const bool friction_varies = std::ranges::any_of(result.study.study.axes, [](const Axis& axis) {
    return axis.key.name == "charge.face_friction" || axis.key.name == "charge.crack_friction";
  });
  return {{"temperature", in_words(below.temperature, significant(2, kelvin))},
          {"critical_gap", in_words(below.critical, significant(2, centimetre))},
          {"held", result.study.scene.scene.charge().strength.face_friction > 0.0 && !friction_varies}};
}

/// Of a table on the page; the files have all.
constexpr std::size_t most_rows = 200;

Row counts_json(const CriticalGapResult& result) {
  std::map<CriticalGapKind, std::size_t> kinds;
  std::map<Verdict, std::size_t> verdicts;
  std::size_t limited = 0;
  for (const CaseAnswer& answer : result.answers) {
    limited += answer.run.limiters.acted() ? 1 : 0;
    ++kinds[answer.critical.kind];
    for (const GapVerdict& row : answer.verdicts) ++verdicts[row.judgement.verdict];
  }
  Row counts{{"cases", result.answers.size()},
             {"failed", count_failed(result.answers)},
             {"limiters_acted", limited}};
  for (const auto kind : {CriticalGapKind::value, CriticalGapKind::all_safe, CriticalGapKind::all_ignite,
                          CriticalGapKind::indeterminate, CriticalGapKind::several_crossings})
    counts["critical_gaps"][study::to_string(kind)] = kinds[kind];
  for (const auto verdict : {Verdict::safe, Verdict::unsafe, Verdict::indeterminate})
    counts["verdicts"][study::to_string(verdict)] = verdicts[verdict];
  return counts;
}

Row facts_of(const CriticalGapResult& result) {
  const Study& study = result.study.study;
  const auto keys = report::shown_axes(study);
  Row facts = counts_json(result);
  for (std::size_t i = 0; i < keys.size(); ++i)
    facts["axes"].push_back(
        fmt::format("{} ({})", keys[i].heading, values_text(keys[i], study.axes[i].values)));
  facts["gaps"] = study.gaps.size();
  if (!study.gaps.empty()) {
    const auto [least, most] = std::ranges::minmax(study.gaps);
    facts.update({{"least_cm", shown_gap(least)}, {"most_cm", shown_gap(most)}});
  }
  // The case with the smallest critical gap that is a value, and those that ignite at every gap: their
  // critical gap is below every value. `end`: the largest gap that the searches which met no ignition came
  // to.
  double best = not_a_number, end = not_a_number;
  std::size_t without_safe = 0;
  for (std::size_t i = 0; i < result.answers.size(); ++i) {
    const CriticalGap& gap = result.answers[i].critical;
    if (std::isfinite(report::value_of(gap)) && !(gap.value >= best)) {
      best = gap.value;
      facts["smallest"] = report::measured_text(gap) + ", at " + name_of(keys, result.study.cases[i]);
    }
    if (gap.kind == CriticalGapKind::all_safe && !(gap.lower >= end)) end = gap.lower;
    if (gap.kind == CriticalGapKind::all_ignite && without_safe++ == 0)
      facts["without_safe"] = name_of(keys, result.study.cases[i]);
  }
  facts["end_of_search_cm"] = report::number(shown_gap(end));
  facts["other_without_safe"] = without_safe > 0 ? without_safe - 1 : 0;
  facts["failures"] = failures_list(keys, result.study, result.answers);
  return facts;
}

std::string answer_in_detail(const CriticalGapResult& result) {
  std::vector<std::string> lines;
  for (const CaseOutcome& outcome : result.details) {
    Row row = json_of(report::bounded_gap_quantities(), outcome.critical);
    row.update({{"why", text_of(outcome.critical.reason)},
                {"accepted", outcome.evidence && !study::accepted_text(outcome.evidence->input).empty()},
                {"confirmed", !outcome.confirmations.empty()},
                {"largest_safe_cm", report::number(shown_gap(study::largest_safe_gap(outcome.verdicts)))}});
    lines.push_back(said("critical_gap.sentence", {{"row", row}}).front());
    if (result.details.size() > 1)
      lines.back() = outcome.input.label + ": " + lines.back();
    else
      lines.back().front() = static_cast<char>(std::toupper(lines.back().front()));
  }
  return fmt::format("{}", fmt::join(lines, "\n"));
}

Row json_of_study(const CriticalGapResult& result, const Table& gaps) {
  Row members{{"axes", report::axes_json(result.study.study)},
              // Of the only case; where there are several, each has its own.
              {"critical_gap", result.answers.size() == 1 ? json_rows(gaps).front() : nullptr},
              {"early_time_ms", shown_value(result.study.study.early_time, report::quantity::time(2).form)},
              {"counts", counts_json(result)},
              {"notes", report::mesh_notes(result.study)}};
  if (!result.details.empty()) members["timing"] = report::timing_json(result.timing);
  return members;
}

}  // namespace

Plot temperature_plot(const CriticalGapResult& result) {
  const Row verdicts = json_rows(verdict_table(result)), cases = json_rows(critical_gap_table(result));
  Plot plot;
  plot.columns = 1;
  std::size_t ignite = 0;
  auto row = verdicts.begin();
  for (std::size_t i = 0; i < result.details.size(); ++i) {
    const std::vector<GapVerdict>& gaps = result.answers[i].verdicts;
    const auto end = row + static_cast<std::ptrdiff_t>(gaps.size());
    // Temperatures of a part of the launch say nothing of it.
    Row tables{{"verdicts", result.details[i].completed() ? Row(Row::array_t(row, end)) : Row::array()},
               {"cases", Row::array({cases[i]})}};
    row = end;
    ignite += std::ranges::any_of(gaps, [](const GapVerdict& gap) { return gap.ignition.has_value(); });
    const StudyCase& input = result.details[i].input;
    if (input.own_conditions) tables["comparison"] = json_rows(comparison_table(result));
    if (result.study.study.demonstration) tables["demonstration"] = true;
    Plot panel = report::verdict_plot(tables, input.scene.scene);
    panel.height = 500;  // there is more room than on page one of a safety report
    if (result.details.size() == 1) return panel;
    panel.title = input.label + ": " + panel.title;
    if (!panel.series.empty()) plot.panels.push_back(std::move(panel));
  }
  plot.title = fmt::format("{} of {} cases ignite at a computed gap", ignite, result.details.size());
  return plot;
}

Table axis_effect_table(const CriticalGapResult& result) {
  std::vector<EffectRow> rows;
  Row facts = Row::object();
  const auto keys = report::shown_axes(result.study.study);
  const auto add = [&](const ShownKey& key, const char* which, const Effect& effect) {
    if (effect.values.lowest < effect.values.highest) rows.push_back({key.heading + which, key, effect});
  };
  for (std::size_t axis = 0; axis < keys.size(); ++axis) {
    add(keys[axis], "", effect_of(result, axis, false));
    if (keys[axis].scene_key != "charge.crack_radius") continue;
    const Effect below = effect_of(result, axis, true);
    add(keys[axis], ", below the flaw size", below);
    facts["cracks"] = crack_facts(result, below);
  }
  return table_of("What each axis changes", effect_quantities, rows,
                  said("critical_gap.note.axis_effects", facts));
}

std::string answer(const CriticalGapResult& result) {
  if (!result.details.empty()) return answer_in_detail(result);
  std::vector<std::string> lines = said("critical_gap.answer", facts_of(result));
  lines.push_back(limited_text(result.answers, "case"));
  return answer_of(std::move(lines), result.study);
}

Report report_of(const CriticalGapResult& result) {
  const bool in_detail = !result.details.empty();
  Report report{result.study.study.title, answer(result), report::remaking_command(result.study)};
  report.launch = scene::launch_sentence(result.study.scene.scene);
  const Table gaps = critical_gap_table(result);
  report.add({verdict_table(result), "verdicts.csv", "verdicts",
              in_detail ? Shown::page_and_terminal : Shown::file});
  if (in_detail) report.draw({"temperature.svg", temperature_plot(result), "T max against gap"});
  report.add({comparison_table(result), "", "comparison"});
  report.add({gaps, "critical_gaps.csv", "cases", Shown::page_and_terminal, most_rows});
  report.add({coupled_run_table(result), "", "coupled_runs"});
  report.add({cited_limit_table(result), "", "cited_limits"});
  GapPictures drawn = gap_pictures(result);
  for (Picture& each : drawn.pictures) report.items.push_back(std::move(each));
  report.remarks = std::move(drawn.remarks);
  report.add({axis_effect_table(result), "", "axis_effects", Shown::page});
  if (in_detail) add_details(result, report);
  report.say("## What it rests on\n\n" + report::friction_remark(result.study));
  report.say(report::uncertainty_remark(result.study) +
             (in_detail ? "\n" : " " + said_below("critical_gap.traces")));
  if (!in_detail) report.say(report::station_note(result.study) + "\n");
  report.say(limiter_remark(result));
  report.say("## Setup\n\n" + report::setup_text(result.study));
  if (in_detail) add_runs(result, report);
  report.json = study_json(result.study, report, json_of_study(result, gaps));
  return report;
}

}  // namespace launchsafe::kinds
