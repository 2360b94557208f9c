// What stress cases come to: held, degraded, caught or WRONG, by which rules; and how that is told.
#include "launchsafe/kinds/stability.hpp"

#include "study_keys.hpp"

namespace launchsafe::kinds {
namespace {

/// What a run says by itself: all that judging needs, and no histories.
struct StressRun {
  CaseRow result;
  double end_time = not_a_number;  ///< s, reached
  Sentences violations;            ///< of invariants
  Sentences reserves;              ///< what the result says against itself
  std::vector<Finding> findings;   ///< of a launch that was stopped, or of the gaps' own launches
};

std::string joined_text(const Sentences& parts) { return fmt::format("{}", fmt::join(parts, "; ")); }

bool was_computed(const CaseRow& result) {
  return result.outcome == RunOutcome::ran || result.outcome == RunOutcome::reused;
}

/// Of a gap: "ignites", "does not ignite", or "no number".
std::string state_of(const GapRow& gap) {
  if (!std::isfinite(gap.maximum.temperature)) return "no number";
  return gap.ignition ? "ignites" : "does not ignite";
}

// --- of a run by itself ---

Finding judge_reader(const StressCase& asked) {
  if (asked.refusal.empty())
    return {Outcome::wrong, "the reader took the scene, without \"" + asked.refused + "\""};
  if (asked.refusal.find(asked.refused) == std::string::npos)
    return {Outcome::wrong, fmt::format("refused, but not for \"{}\": {}", asked.refused, asked.refusal)};
  return {Outcome::caught, fmt::format("refused: \"{}\"; {}", asked.refused, asked.refusal)};
}

Finding judge_stopped(const StressCase& asked, const MechanicsResult& mechanics) {
  const std::string text =
      fmt::format("{} after {} steps{}", run::to_string(mechanics.status), mechanics.steps,
                  mechanics.reason.empty() ? "" : ", " + mechanics.reason);
  if (asked.caught_within == 0 || mechanics.steps <= asked.caught_within) return {Outcome::caught, text};
  return {Outcome::degraded,
          fmt::format("caught late, {} steps were allowed: {}", asked.caught_within, text)};
}

std::string numbers_of(const run::CombustionHistory& c) {
  const double pressure = *std::ranges::max_element(c.pressure);
  return fmt::format("burnt {:.3g} g, gas at {:.0f} K, up to {:.3g} MPa, energy residual {:.1e}",
                     1e3 * c.burnt_mass.back(), c.gas_temperature.back(), 1e-6 * pressure, c.energy_residual);
}

/// Of a run through the ignition of one gap.
Finding judge_burn(const Scene& scene, double gap, const run::CaseResult& result) {
  const auto& combustion = result.gaps.front().combustion;
  if (!combustion) return {Outcome::degraded, "nothing ignited"};
  const Sentences violations = violations_of({scene, result.mechanics, {gap}, &*combustion});
  if (!violations.empty()) return {Outcome::wrong, joined_text(violations)};
  Sentences all = run::combustion_validity_warnings(scene, *combustion);
  const Outcome outcome = all.empty() ? Outcome::held : Outcome::degraded;
  all.push_back(numbers_of(*combustion));
  return {outcome, joined_text(all)};
}

/// Of the launch of one gap alone.
Finding judge_gap(const StudyCase& input, double gap, const run::CaseResult& result) {
  const MechanicsResult& mechanics = result.mechanics;
  Finding finding{Outcome::caught, run::to_string(mechanics.status) + ", " + mechanics.reason};
  if (mechanics.status == run::RunStatus::completed)
    finding = judge_burn(input.scene.scene, gap, result);
  else if (mechanics.reason.empty())
    finding = {Outcome::wrong, "broke off without a reason"};
  finding.text = fmt::format("through ignition at {:.6g} cm: {}", 100.0 * gap, finding.text);
  return finding;
}

Sentences reserves_of(const CaseRow& result) {
  Sentences reserves = of_each(result.warnings, &study::Remark::text);
  if (const std::string limited = run::to_string(result.run.limiters); !limited.empty())
    reserves.push_back("limiters acted: " + limited);
  for (const GapRow& gap : result.gaps)
    if (!std::isfinite(gap.maximum.temperature)) reserves.emplace_back("a temperature is not a number");
  return reserves;
}

/// `runs`: the launch, then those through the ignition of gaps. How far one came that
/// was cut off depends on the machine, and says nothing of the computation: that leaves the case without a
/// finding.
StressRun run_from(const StudyFile& study, std::size_t index, std::vector<FinishedRun>& runs) {
  StressRun run;
  // After a launch that was stopped no other is begun.
  const std::size_t begun = runs.front().failure.empty() ? runs.size() : 1;
  for (std::size_t i = 0; i < begun; ++i) {
    if (runs[i].has_result() && !was_cut_off(runs[i])) continue;
    run.result.failure = (i == 0 ? "" : "in the launch of a gap: ") + runs[i].failure;
    run.result.outcome = runs[i].outcome;
    return run;
  }
  // The case that asked for the run, by itself or as its safe computation.
  const StressCase& asked = *std::ranges::find_if(
      settings_of<StabilitySettings>(study.study).cases,
      [index](const StressCase& each) { return each.run == index || each.against == index; });
  const Scene& scene = study.cases[index].scene.scene;
  const MechanicsResult& mechanics = runs.front().result.mechanics;
  Study judged = study.study;
  judged.gaps = asked.gaps;
  run.result = study::draw_row(judged, study.cases[index], mechanics);
  run.result.outcome = runs.front().outcome;
  run.end_time = mechanics.end_time;
  if (!run.result.completed()) {
    run.findings = {judge_stopped(asked, mechanics)};
    runs.front().expected = asked.run == index && asked.expects(run.findings.front().outcome);
    return run;
  }
  run.violations = violations_of({scene, mechanics, asked.gaps});
  run.reserves = reserves_of(run.result);
  for (std::size_t i = 1; i < begun; ++i)
    run.findings.push_back(judge_gap(study.cases[index], scene.surface.gaps[i - 1], runs[i].result));
  return run;
}

// --- of a case ---

/// Of a launch that completed. `compared`: there is nothing to compare with, or it completed.
Finding judge_launch(const StressCaseRow& row, const StressRun& run, bool compared) {
  Sentences faults = run.violations, remarks = run.reserves, numbers;
  for (std::size_t i = 0; i < row.result.gaps.size(); ++i) {
    const GapRow& gap = row.result.gaps[i];
    numbers.push_back(fmt::format("{:.6g} cm: T max {:.1f} K, {}", 100.0 * gap.gap, gap.maximum.temperature,
                                  state_of(gap)));
    if (!compared || row.deviations.empty()) continue;
    const double deviation = row.deviations[i], tolerance = row.asked.tolerance;
    if (std::isnan(deviation)) remarks.emplace_back("a temperature to compare with is not a number");
    if (std::abs(deviation) > tolerance)
      faults.push_back(fmt::format("off the safe computation by {:.3g} K, more than {:.3g} K",
                                   std::abs(deviation), tolerance));
    if (std::isfinite(deviation))
      numbers.back() += fmt::format(", {:+.2g} K against the safe computation", deviation);
  }
  if (!compared) remarks.emplace_back("the safe computation is not there to compare with");
  const bool silent = !faults.empty() && run.reserves.empty();
  faults.insert(faults.end(), remarks.begin(), remarks.end());
  const Outcome outcome = silent ? Outcome::wrong : faults.empty() ? Outcome::held : Outcome::degraded;
  faults.insert(faults.end(), numbers.begin(), numbers.end());
  return {outcome, joined_text(faults)};
}

/// The worst first: the enumeration is in that order.
Finding worst_of(std::vector<Finding> findings) {
  std::ranges::stable_sort(findings, std::ranges::greater{}, &Finding::outcome);
  return {findings.front().outcome, joined_text(of_each(findings, &Finding::text))};
}

/// `against`: the safe computation; nullptr without one. Both ignite at `ignition_temperature`, K.
StressCaseRow judge(const StressCase& asked, const StressRun& run, const StressRun* against,
                    double ignition_temperature) {
  StressCaseRow row{asked, run.result, run.end_time, {}, {}, {}};
  if (against != nullptr && row.computed() && !was_computed(against->result)) row.result = against->result;
  if (!row.computed()) return row;
  for (std::size_t i = 0; against != nullptr && i < against->result.gaps.size(); ++i) {
    row.heated_against.push_back(against->result.gaps[i].heated);
    row.deviations.push_back(std::min(run.result.gaps[i].heated, ignition_temperature) -
                             std::min(row.heated_against[i], ignition_temperature));
  }
  std::vector<Finding> findings = run.findings;
  if (run.result.completed())
    findings.insert(findings.begin(),
                    judge_launch(row, run, against == nullptr || against->result.completed()));
  row.finding = worst_of(std::move(findings));
  return row;
}

// --- tables and page ---

/// "held", "degraded", "caught", "WRONG", or "not computed".
std::string outcome_text(const StressCaseRow& row) {
  return row.computed() ? to_string(row.finding.outcome) : "not computed";
}

std::string finding_text(const StressCaseRow& row) {
  return row.computed() ? row.finding.text : row.result.failure;
}

std::string expected_text(const StressCase& asked) {
  const auto text = [](Outcome outcome) { return to_string(outcome); };
  return asked.expected.empty() ? "not WRONG"
                                : fmt::format("{}", fmt::join(of_each(asked.expected, text), " or "));
}

/// A case, and one of its gaps where there is one.
struct GapOfCase {
  const StressCaseRow* of;
  std::optional<std::size_t> gap;

  const GapRow* row() const { return gap ? &of->result.gaps[*gap] : nullptr; }
  const study::RunRow* run() const { return gap ? &of->result.run : nullptr; }
};

const Quantities<StressCaseRow> stress_case_quantities{
    {"group", "group", text(), "Group of the case.", &StressCaseRow::asked, &StressCase::group},
    {quantity::case_name, &StressCaseRow::asked, &StressCase::name},
    {"outcome", "outcome", text(), "held, degraded, caught, WRONG, or not computed.", outcome_text},
    {"expected", "expected", text(), "What the study expects.", &StressCaseRow::asked, expected_text},
    {"as_expected", "as expected", text(), "Whether it came out so.", &StressCaseRow::is_as_expected},
    {"finding", "finding", text(), "Why it came out so, and the numbers behind it.", finding_text}};

/// What there is to say of a case and of one of its gaps, which may have none of the numbers.
Quantities<GapOfCase> stability_quantities() {
  const auto of_list = [](std::vector<double> StressCaseRow::*list) {
    return [list](const GapOfCase& row) {
      const std::vector<double>& values = row.of->*list;
      return row.gap && *row.gap < values.size() ? values[*row.gap] : not_a_number;
    };
  };
  return joined<GapOfCase>(
      {of_part<GapOfCase>(stress_case_quantities, &GapOfCase::of),
       {{quantity::status, &GapOfCase::run, &study::RunRow::status},
        {"end_time", "until", fixed(4, millisecond), "Instant that the run reached.",
         [](const GapOfCase& row) { return row.gap ? row.of->end_time : not_a_number; }},
        {quantity::steps, &GapOfCase::run, &study::RunRow::steps},
        {quantity::particles, &GapOfCase::run, &study::RunRow::particles},
        {quantity::energy_drift, &GapOfCase::run, &study::RunRow::energy_drift},
        {quantity::gap, &GapOfCase::row, &GapRow::gap},
        {quantity::temperature_max, &GapOfCase::row,
         [](const GapRow& gap) { return report::known(gap.maximum.temperature); }},
        {quantity::temperature_max_inert, &GapOfCase::row, &GapRow::heated},
        {"safe_computation", "safe computation", fixed(1, kelvin), "T max of the safe computation.",
         of_list(&StressCaseRow::heated_against)},
        {"deviation", "against", fixed(1, kelvin), "How far the case is off it.",
         of_list(&StressCaseRow::deviations)},
        {"tolerance", "tolerance", significant(2, kelvin), "By how much it may be off it.",
         [](const GapOfCase& row) { return row.gap ? row.of->asked.tolerance : not_a_number; }},
        {"state", "state", text(), "ignites, does not ignite, or no number.", &GapOfCase::row, state_of},
        {quantity::limiters, &GapOfCase::run,
         [](const study::RunRow& run) { return run::to_string(run.limiters); }}}});
}

/// A row for every gap of every case: what must hold, what became of it, why, and the numbers behind it.
Table stability_table(const StabilityResult& result) {
  std::vector<GapOfCase> rows;
  for (const StressCaseRow& row : result.rows) {
    const std::size_t gaps = row.computed() ? row.result.gaps.size() : 0;
    for (std::size_t i = 0; i < gaps; ++i) rows.push_back({&row, i});
    if (gaps == 0) rows.push_back({&row, std::nullopt});
  }
  return table_of("Stress cases", stability_quantities(), rows);
}

std::size_t count_missing(const StabilityResult& result) {
  return static_cast<std::size_t>(std::ranges::count(result.rows, false, &StressCaseRow::computed));
}

constexpr Outcome all_outcomes[] = {Outcome::held, Outcome::degraded, Outcome::caught, Outcome::wrong};

std::string legend(const Study& study) {
  const double tolerance = settings_of<StabilitySettings>(study).temperature_tolerance;
  std::string text = fmt::format(
      "- **held**: what must hold held.\n"
      "- **degraded**: it did not, a limiter acted or a validity warning holds, and the result says so.\n"
      "- **caught**: the run was stopped, or the scene refused.\n"
      "- **WRONG**: an invariant is violated, and no warning, limiter or stop says so.\n\n"
      "Invariants, with a tolerance of T max of {} unless the case states its own:\n\n",
      in_words(tolerance, significant(3, kelvin)));
  for (const Invariant& each : all_invariants()) text += fmt::format("- `{}`: {}.\n", each.name, each.words);
  return text;
}

Row counts_json(const StabilityResult& result) {
  Row counts;
  counts["cases"] = result.rows.size();
  for (const Outcome outcome : all_outcomes) counts[to_string(outcome)] = result.count(outcome);
  counts["not_as_expected"] = std::ranges::count_if(result.rows, [](const StressCaseRow& row) {
    return row.computed() && !row.is(Outcome::wrong) && !row.is_as_expected();
  });
  counts["not_computed"] = count_missing(result);
  return counts;
}

/// A row for every case that is not held, with the reason in a few words.
Table not_held_table(const StabilityResult& result) {
  std::vector<StressCaseRow> rows;
  std::ranges::copy_if(result.rows, std::back_inserter(rows),
                       [](const StressCaseRow& row) { return !row.is(Outcome::held); });
  return table_of<StressCaseRow>(
      "Not held",
      {{quantity::case_name, [](const StressCaseRow& row) { return row.asked.label(); }},
       {"outcome", "outcome", text(), "What became of it.", outcome_text},
       {"why", "why", text(), "Why.",
        [](const StressCaseRow& row) {  // without the numbers behind it
          const std::string text = finding_text(row);
          return text.substr(0, std::min(text.find(", "), text.find("; ")));
        }}},
      rows);
}

}  // namespace

bool StressCase::expects(Outcome outcome) const {
  if (outcome == Outcome::wrong) return false;
  return expected.empty() || std::ranges::count(expected, outcome) > 0;
}

bool StressCaseRow::computed() const { return was_computed(result); }

bool StressCaseRow::is_as_expected() const { return computed() && asked.expects(finding.outcome); }

std::size_t StabilityResult::count(Outcome outcome) const {
  return static_cast<std::size_t>(
      std::ranges::count_if(rows, [outcome](const StressCaseRow& row) { return row.is(outcome); }));
}

StabilityResult run_stability(const StudyFile& study, const StudyOptions& options) {
  const auto compute = [&](StabilityResult& result) {
    std::vector<StressRun> runs(study.cases.size());
    run_every_case(study, options, result.timing, [&](std::size_t i, std::vector<FinishedRun>& finished) {
      runs[i] = run_from(study, i, finished);
    });
    for (const StressCase& asked : settings_of<StabilitySettings>(study.study).cases) {
      if (asked.run)
        result.rows.push_back(
            judge(asked, runs[*asked.run], asked.against ? &runs[*asked.against] : nullptr,
                  study.cases[*asked.run].scene.scene.charge().kinetics.ignition_temperature));
      else
        result.rows.push_back({asked, {}, not_a_number, {}, {}, judge_reader(asked)});
    }
  };
  return run_timed<StabilityResult>(study, options, compute);
}

std::string answer(const StabilityResult& result) {
  std::string text = fmt::format("{}: {} held, {} degraded with a reason, {} caught, {} WRONG.",
                                 report::counted(std::ssize(result.rows), "stress case"),
                                 result.count(Outcome::held), result.count(Outcome::degraded),
                                 result.count(Outcome::caught), result.count(Outcome::wrong));
  if (result.count(Outcome::wrong) + count_missing(result) == 0)
    text += "\nNo broken computation passes for a sound one.";
  const char* heading = "\nNot as the study expects:";
  for (const StressCaseRow& row : result.rows)
    if (!row.is_as_expected()) {
      text +=
          fmt::format("{}\n- {}: {}: {}", heading, row.asked.label(), outcome_text(row), finding_text(row));
      heading = "";
    }
  if (result.interrupted) text += "\nThe study was interrupted: some cases were not computed.";
  return text;
}

Report report_of(const StabilityResult& result) {
  Report report{result.study.study.title, answer(result), report::remaking_command(result.study)};
  report.items = {
      ReportTable{not_held_table(result)},
      std::string{"All cases with their numbers: `stability.csv`.\n"},
      ReportTable{stability_table(result), "stability.csv", "cases", Shown::file},
      "## What the outcomes mean\n\n" + legend(result.study.study),
  };
  report.json = study_json(result.study, report, {{"counts", counts_json(result)}});
  return report;
}

std::vector<ReportTable> stability_results() {
  return {{table_of({}, stability_quantities(), {}), "stability.csv", "cases"}};
}

}  // namespace launchsafe::kinds
