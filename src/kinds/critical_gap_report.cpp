// The answer, the page and the files of a critical-gap study.
#include "critical_gap_tables.hpp"
#include "launchsafe/kinds/shown_surrogate.hpp"
#include "launchsafe/scene/launch_end.hpp"
#include "launchsafe/surface/ignition_boundary.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cctype>
#include <set>

namespace launchsafe::kinds {

using keys::significant, keys::text;
using report::Picture, report::ReportTable, report::Row, report::Shown, report::shown_gap, report::Statement,
    report::Table;
using study::StudyCase, surface::Extent;

namespace {

/// The cases that differ along one axis alone: their T max by gap, where no one ignites, and critical gaps.
struct Line {
  std::map<double, Extent> temperature;  ///< K, by gap in m
  std::set<double> ignited;
  Extent critical;  ///< m
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
  Extent extent;
  for (std::size_t i = 0; i < result.answers.size(); ++i) {
    const StudyCase& input = result.study.cases[i];
    const study::CaseAnswer& answer = result.answers[i];
    if (input.coordinates.size() <= axis || !answer.completed() || !counts(input)) continue;
    std::vector<double> others = input.coordinates;
    extent.include(others[axis]);
    others[axis] = 0.0;
    Line& line = lines[others];
    line.critical.include(report::value_of(answer.critical));
    for (const study::GapVerdict& row : answer.verdicts) {
      if (row.ignition) line.ignited.insert(row.gap);
      line.temperature[row.gap].include(row.maximum.temperature);
    }
  }
  Effect effect{study::not_a_number, study::not_a_number, extent.lowest, extent.highest};
  for (const auto& [others, line] : lines) {
    raise(effect.critical, line.critical.highest - line.critical.lowest);
    for (const auto& [gap, range] : line.temperature) {
      if (!line.ignited.contains(gap)) raise(effect.temperature, range.highest - range.lowest);
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

const report::Quantities<EffectRow> effect_quantities{
    {"axis", "axis", text(), "The axis.", &EffectRow::axis},
    {"from", "from", text(), "Its lowest value.",
     [](const EffectRow& row) { return row.key.text(row.effect.lowest); }},
    {"to", "to", text(), "Its highest value.",
     [](const EffectRow& row) { return row.key.text(row.effect.highest); }},
    {"temperature_max_change", "T max by at most", significant(3, keys::kelvin),
     "Largest change of T max over the axis, all else the same, where nothing ignites.", &EffectRow::effect,
     &Effect::temperature},
    {"critical_gap_change", "critical gap by at most", significant(3, keys::centimetre),
     "Largest change of the critical gap over the axis, all else the same.", &EffectRow::effect,
     &Effect::critical}};

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

/// Of a table on the page; the files have all.
constexpr std::size_t most_rows = 200;

nlohmann::ordered_json counts_json(const SweepCounts& counts) {
  nlohmann::ordered_json gaps, verdicts;
  for (const auto& [kind, count] : counts.critical_gaps) gaps[study::to_string(kind)] = count;
  for (const auto& [verdict, count] : counts.verdicts) verdicts[study::to_string(verdict)] = count;
  return {{"cases", counts.cases},
          {"failed", counts.failed},
          {"limiters_acted", counts.limited},
          {"critical_gaps", std::move(gaps)},
          {"verdicts", std::move(verdicts)}};
}

/// What the answer about many cases is filled with.
Row facts_of(const CriticalGapResult& result, const SweepCounts& counts) {
  const study::Study& study = result.study.study;
  const auto keys = report::shown_axes(study);
  Row facts = counts_json(counts);
  for (std::size_t i = 0; i < keys.size(); ++i)
    facts["axes"].push_back(
        fmt::format("{} ({})", keys[i].heading, values_text(keys[i], study.axes[i].values)));
  facts["gaps"] = study.gaps.size();
  facts["by_cooling"] = study.gaps_by_cooling;
  if (!study.gaps.empty()) {
    const auto [least, most] = std::ranges::minmax(study.gaps);
    facts.update({{"least_cm", shown_gap(least)}, {"most_cm", shown_gap(most)}});
  }
  // The case with the smallest critical gap that is a value, and those that ignite at every gap: their
  // critical gap is below every value. `end`: the largest gap that the searches which met no ignition came
  // to.
  double best = study::not_a_number, end = study::not_a_number;
  std::size_t without_safe = 0;
  for (std::size_t i = 0; i < result.answers.size(); ++i) {
    const study::CriticalGap& gap = result.answers[i].critical;
    if (std::isfinite(report::value_of(gap)) && !(gap.value >= best)) {
      best = gap.value;
      facts["smallest"] = report::measured_text(gap) + ", at " + name_of(keys, result.study.cases[i]);
    }
    if (gap.kind == study::CriticalGapKind::all_safe && !(gap.lower >= end)) end = gap.lower;
    if (gap.kind == study::CriticalGapKind::all_ignite && without_safe++ == 0)
      facts["without_safe"] = name_of(keys, result.study.cases[i]);
  }
  facts["end_of_search_cm"] = report::number(shown_gap(end));
  facts["other_without_safe"] = without_safe > 0 ? without_safe - 1 : 0;
  facts["failures"] = failures_list(keys, result.study, result.answers);
  return facts;
}

/// Of few cases, one after the other.
std::string answer_in_detail(const CriticalGapResult& result) {
  std::vector<std::string> lines;
  for (const study::CaseOutcome& outcome : result.details) {
    Row row = report::json_of(report::bounded_gap_quantities(), outcome.critical);
    row.update({{"why", outcome.critical.reason},
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

nlohmann::ordered_json json_of_study(const CriticalGapResult& result, const Table& gaps) {
  nlohmann::ordered_json members{
      {"axes", report::axes_json(result.study.study)},
      // Of the only case; where there are several, each has its own.
      {"critical_gap", result.answers.size() == 1 ? json_of_row(gaps, 0) : nullptr},
      {"early_time_ms", report::shown_value(result.study.study.early_time, report::quantity::time(2).form)},
      {"counts", counts_json(counts_of(result.answers))},
      {"notes", report::mesh_notes(result.study)}};
  if (!result.details.empty()) members["timing"] = report::timing_json(result.timing);
  return members;
}

}  // namespace

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
    const Effect below =
        effect_of(result, axis, [](const StudyCase& input) { return input.crack_radius < input.flaw_size; });
    add(keys[axis], ", below the flaw size", below);
    facts["cracks"] = crack_facts(result, below);
  }
  return report::table_of("What each axis changes", effect_quantities, rows,
                          said("critical_gap.note.axis_effects", facts));
}

std::string answer(const CriticalGapResult& result) {
  if (!result.details.empty()) return answer_in_detail(result);
  const SweepCounts counts = counts_of(result.answers);
  std::vector<std::string> lines = said("critical_gap.answer", facts_of(result, counts));
  for (std::string& line : closing_answer(result)) lines.push_back(std::move(line));
  lines.push_back(limited_text(counts, "case"));
  return answer_of(std::move(lines), result.study);
}

report::Report report_of(const CriticalGapResult& result) {
  const bool in_detail = !result.details.empty();
  report::Report report{result.study.study.title, answer(result), report::remaking_command(result.study)};
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
  if (settings_of<CriticalGapSettings>(result.study.study).surrogate) {
    const study::SurrogateRecord record = sweep_surrogate(result);
    report.add({surrogate_table(record), "", "surrogate"});
    for (report::TextFile& file : surrogate_files(record, result.study))
      report.files.push_back(std::move(file));
  }
  report.add({axis_effect_table(result), "", "axis_effects", Shown::page});
  if (Table bounds = closing_bound_table(result); !bounds.rows.empty())
    report.add({std::move(bounds), "closing_bounds.csv", "closing_bounds",
                in_detail ? Shown::page_and_terminal : Shown::file});
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
