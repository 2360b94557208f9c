// Whether the tables of a study follow from their own parts. The manifest says which cases and gaps were
// asked for; what a row says of them, and what follows from its other cells, is made anew by the functions of
// the study and held against what is written.
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/safety_report.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/study/case_answer.hpp"

namespace launchsafe::report {
namespace {

using scene::Dimension, scene::KeyKind;
using study::CriticalGap, study::CriticalGapKind, study::GapVerdict;

constexpr const char* results = "study.json";

// --- what a study asks for, and what its cells say ---

/// Gaps, axes and cases, as a study of kind critical-gap makes them.
study::StudyFile planned_study(const StudyEvidence& study) {
  study::StudyFile file;
  file.scene = scene::without_defaults(study.scene);
  // What its records say is not in the folder.
  file.study.kind = {.gives_verdicts = false, .closing_gaps = study::ClosingGaps::beside};
  const auto numbers = [&](const toml::table& table, const char* name, KeyKind kind, Dimension dimension) {
    const scene::KeyDescription key{.name = name, .kind = kind, .dimension = dimension};
    const toml::node* node = table.get(name);
    return node == nullptr
               ? std::vector<double>{}
               : std::get<std::vector<double>>(scene::read_value(*node, key, file.file).or_throw());
  };
  file.study.gaps = numbers(study.asked, "gaps", KeyKind::list, Dimension::length);
  for (const toml::table* entry : study::tables_of(study.asked, "vary", file)) {
    const std::string name = (*entry)["key"].value_or("");
    const Dimension dimension = study::varied_key(file, name, "vary", {}).dimension;
    std::vector<double> values = numbers(*entry, "values", KeyKind::list, dimension);
    if (const auto ends = numbers(*entry, "range", KeyKind::range, dimension); !ends.empty())
      values = study::spaced_values(ends.front(), ends.back(), (*entry)["count"].value_or(2));
    study::add_axis(file, name, "vary", std::move(values));
  }
  study::settle_gaps(file);
  study::make_factorial(file);
  return file;
}

/// m.
double gap_of(const Row& row, const std::string& key) { return number_of(row, key) / shown_gap(1.0); }

/// The critical gap of a case with its causes of uncertainty, and the bounds that follow from these.
CriticalGap critical_gap_of(const Row& row, const std::vector<const Row*>& causes) {
  using enum CriticalGapKind;
  CriticalGap gap;
  for (const CriticalGapKind kind : {value, all_safe, all_ignite, several_crossings})
    if (to_string(kind) == text_of(row, quantity::critical_gap_kind.key())) gap.kind = kind;
  gap.lower = gap_of(row, "critical_gap_lower_cm");
  gap.upper = gap_of(row, "critical_gap_upper_cm");
  if (gap.kind == value) gap.value = 0.5 * (gap.lower + gap.upper);
  std::vector<study::GapShare> shares(causes.size());
  for (std::size_t i = 0; i < causes.size(); ++i) {
    for (std::size_t kind = 0; kind < study::share_kinds; ++kind)
      if (study::traits_of(study::ShareKind(kind)).title == text_of(*causes[i], "cause"))
        shares[i].kind = study::ShareKind(kind);
    // How far it moves the gap is written with all digits.
    const double lowers = gap_of(*causes[i], "lowers_cm");
    shares[i].raised = lowers == 0.0 ? gap_or_bound_in(text_of(*causes[i], "raised")) : gap.lower - lowers;
    shares[i].lowered = gap_or_bound_in(text_of(*causes[i], "lowered"));
  }
  study::set_shares(gap, std::move(shares));
  // An earlier program took wide brackets, in which what causes of uncertainty change vanishes.
  constexpr double widest_bracket = 1.01e-6;  // m
  if (gap.kind == value && !(gap.lower <= gap.upper && gap.upper - gap.lower <= widest_bracket))
    gap.bounds = {};
  return gap;
}

/// What gaps that close say of a case; nothing where the study has no table of them.
std::vector<study::ClosingAnswer> closing_answers(const CaseEvidence& judged, const study::StudyCase& input) {
  std::vector<study::ClosingAnswer> answers;
  if (!input.closing || judged.study->rows("closing").empty()) return answers;
  const std::size_t wanted = study::closing_bounds(input).back().terms.size();
  for (const std::string name : {"conducting", "insulated", "corner"}) {
    answers.push_back({.name = name, .points = {}, .upper = math::infinity});
    for (const Row& row : judged.study->rows("closing")) {
      study::ClosingPoint point{.gap = gap_of(row, "gap_cm"),
                                .maximum_temperature = number_of(row, "temperature_max_" + name + "_K"),
                                .place = {}};
      point.ignited = point.maximum_temperature >= input.scene.scene.charge().kinetics.ignition_temperature;
      // An earlier program looked for the corner on fewer terms.
      if (text_of(row, "case") != judged.label ||
          (name == "corner" && !point.ignited &&
           !(number_of(row, "corner_launches") >= static_cast<double>(wanted))))
        continue;
      if (point.ignited) answers.back().upper = std::min(answers.back().upper, point.gap);
      point.at_most = point.maximum_temperature + number_of(row, name + "_numerical_K");
      answers.back().points.push_back(std::move(point));
    }
  }
  return answers;
}

/// What all verdicts of a case rest on, as far as the folder tells.
study::CaseEvidence evidence_of(const CaseEvidence& judged, const study::StudyCase& input) {
  study::CaseEvidence evidence;
  evidence.input = study::statements_of(judged.study->planned.study, input);
  evidence.validity_warnings = evidence.input.uncovered_load;
  if (judged.completed()) evidence.failure.clear();
  for (const Row* row : judged.verdicts)
    if (number_of(*row, "gap_cm") == 0.0)
      evidence.friction_rise =
          number_of(*row, quantity::temperature_max_inert.key()) - input.scene.scene.initial_temperature;
  return evidence;
}

/// The verdict row of a gap (m), not judged.
GapVerdict verdict_of(const Row& row, double gap, double ignition_temperature, study::CaseEvidence evidence) {
  GapVerdict made;
  made.gap = gap;
  made.maximum.temperature = number_of(row, quantity::temperature_max.key());
  made.margin = ignition_temperature - made.maximum.temperature;
  for (const auto& [part, member] : {std::pair{"computation", &study::Uncertainty::numerical},
                                     {"fit", &study::Uncertainty::fit},
                                     {"inputs", &study::Uncertainty::input},
                                     {"model_form", &study::Uncertainty::model_form}})
    if (const double kelvin = number_of(row, fmt::format("uncertainty_of_{}_K", part)); !(kelvin < 0.0))
      made.uncertainty.*member = kelvin;
  if (!text_of(row, "ignition_cause").empty()) made.ignition.emplace();
  if (const std::string warnings = text_of(row, "validity_warnings"); !warnings.empty())
    evidence.validity_warnings.push_back(warnings);
  if (const std::string unaccepted = text_of(row, "unaccepted"); !unaccepted.empty())
    evidence.input.implausible.push_back({.key = unaccepted});
  made.of_case = std::make_shared<const study::CaseEvidence>(std::move(evidence));
  return made;
}

/// By how much a verdict warns; the word of none least.
int severity(const std::string& verdict) {
  return verdict == "UNSAFE" ? 3 : verdict == "INDETERMINATE" ? 2 : verdict == "SAFE" ? 1 : 0;
}

// --- what is written is held against that ---

/// The rows of a study, and how their columns tell a case.
struct HeldRows {
  const StudyEvidence& study;
  Quantities<std::vector<double>> launch = launch_quantities(study.planned);
  std::vector<ShownKey> keys = shown_axes(study.planned.study);

  /// Refuses a cell that is not what was made, but for round-off or `tolerance` where rounded cells made it.
  void hold(const std::string& place, const Row& row, const Row& made, double tolerance = 1e-9) const {
    for (const auto& [key, value] : made.items()) {
      const double number = number_of(made, key), off = std::abs(number_of(row, key) - number);
      const Row cell = row.contains(key) ? row[key] : Row(),
                expected = value.is_number() && !std::isfinite(number) ? Row() : value;
      if (cell != expected && !(off <= tolerance * std::abs(number) + 1e-9))
        throw study.fault(results,
                          fmt::format("{}: {} is {}, and what it follows from makes it {}", place, key,
                                      cell.dump(), expected.dump()),
                          "tables as a study writes them");
    }
  }

  void hold_all() const {
    hold("axes", study.study, {{"axes", axes_json(study.planned.study)}});
    const std::size_t cases = study.planned.cases.size(), gaps = study.planned.study.gaps.size();
    if (study.rows("cases").size() != cases || study.rows("verdicts").size() != cases * gaps ||
        (study.study.contains("runs") && study.rows("runs").size() != cases))
      throw study.fault(
          results,
          fmt::format("found {} cases with {} verdicts, and its manifest asks for {} with {}",
                      study.rows("cases").size(), study.rows("verdicts").size(), cases, cases * gaps),
          "every gap in every case");
    for (const CaseEvidence& each : cases_of(study)) hold_case(each);
  }

  void hold_case(const CaseEvidence& judged) const {
    const study::StudyCase input = judged.input();
    const std::string place = fmt::format("cases, row {}", judged.place + 1);
    Row told = json_of(axis_quantities(study.planned.study), input.coordinates);
    told["case"] = judged.in_detail() ? input.label : place_text(keys, input.coordinates);
    hold(place, *judged.critical, told);
    if (judged.in_detail())
      hold(fmt::format("runs, row {}", judged.place + 1), *judged.run,
           {{"case", input.label},
            {"stored_case", judged.completed()
                                ? fmt::format("cases/{}.h5", study::mechanics_run(input.scene.scene, {}).hash)
                                : ""}});
    const CriticalGap critical = hold_gap(judged, place);
    const auto closing = closing_answers(judged, input);
    const study::CaseEvidence evidence = evidence_of(judged, input);
    const std::vector<double>& gaps = gaps_of(study.planned.study, input);
    std::vector<GapVerdict> rows;
    for (std::size_t i = 0; i < gaps.size(); ++i) {
      const Row& row = *judged.verdicts[i];
      const std::string verdict = text_of(row, "verdict");
      GapVerdict& made = rows.emplace_back(
          verdict_of(row, gaps[i], input.scene.scene.charge().kinetics.ignition_temperature, evidence));
      study::take_closing_evidence(closing, input.scene.scene, made);
      made.judgement = study::judge(made, critical);
      const std::string least = to_string(made.judgement.verdict);
      told = json_of(launch, input.coordinates);
      told.update({{"gap_cm", shown_gap(made.gap)},
                   {"margin_K", made.margin},
                   {"uncertainty_K", made.uncertainty.total()},
                   // What is not in the folder may have more to warn of.
                   {"verdict", severity(verdict) < severity(least) ? least : verdict}});
      hold(fmt::format("verdicts, row {}", judged.place * gaps.size() + i + 1), row, told);
      if (verdict != "SAFE") made.judgement.verdict = study::Verdict::indeterminate;
    }
    hold(place, *judged.critical, {{"largest_safe_gap_cm", shown_gap(study::largest_safe_gap(rows))}});
  }

  /// The critical gap of a case. Its bounds are those of its causes; where these are not listed, as in no
  /// study of many cases, none has made the lower bound larger or the upper one smaller.
  CriticalGap hold_gap(const CaseEvidence& judged, const std::string& place) const {
    const Row& row = *judged.critical;
    std::vector<const Row*> causes;
    for (const Row& each : study.rows("gap_shares"))
      if (text_of(each, "case") == judged.label) causes.push_back(&each);
    CriticalGap gap = critical_gap_of(row, causes);
    const Row shares = json_rows(gap_share_table({{judged.label, &gap}}));
    for (std::size_t i = 0; i < causes.size(); ++i)
      hold(fmt::format("gap_shares of {}, row {}", judged.label, i + 1), *causes[i], shares[i]);
    const double at_least = gap_of(row, "critical_gap_at_least_cm"),
                 at_most = gap.kind == CriticalGapKind::all_safe ? study::no_ignition
                                                                 : gap_of(row, "critical_gap_at_most_cm");
    const bool are_listed = !causes.empty() || std::isnan(gap.bounds.at_least);
    if (!are_listed && !(at_least > gap.bounds.at_least)) gap.bounds.at_least = at_least;
    if (!are_listed && !(at_most < gap.bounds.at_most)) gap.bounds.at_most = at_most;
    if (judged.in_detail() && !std::isnan(at_least)) hold_causes(judged, gap);
    // Critical gaps at the better end of a cause are written with four digits.
    hold(place, row, {{"critical_gap_at_most_cm", shown_gap(gap.bounds.at_most)}}, 1e-3);
    gap.bounds.at_most = at_most;
    Row told = json_of(bounded_gap_quantities(), gap);
    // What an indeterminate one might be is told beside it.
    for (const char* text : {"critical_gap_reads_as", "critical_gap_with_bounds"})
      if (gap.kind == CriticalGapKind::indeterminate && text_of(row, text).starts_with("indeterminate"))
        told.erase(text);
    hold(place, row, told);
    return gap;
  }

  /// What makes T max uncertain makes the critical gap uncertain too.
  void hold_causes(const CaseEvidence& judged, const CriticalGap& gap) const {
    using enum study::ShareKind;
    if (gap.kind == CriticalGapKind::all_ignite) return;
    std::vector<study::ShareKind> needed;
    if (!study.asked.contains("input_uncertainty"))
      needed = {peak_pressure, pulse_length, initial_temperature};
    for (const study::ShareKind kind : {load_curve, computation, fit, model_form})
      if (number_of(*judged.verdicts.front(),
                    fmt::format("uncertainty_of_{}_K", study::traits_of(kind).name)) != 0.0)
        needed.push_back(kind);
    for (const study::ShareKind kind : needed)
      if (std::ranges::count(gap.shares, kind, &study::GapShare::kind) == 0)
        throw study.fault(
            results,
            fmt::format("gap_shares of {} has no row of {}", judged.label, study::traits_of(kind).title),
            "every cause of uncertainty");
  }
};

}  // namespace

void check_rows(StudyEvidence& study) try {
  const auto has_code = [](const Row& row) { return row.contains(quantity::reason_code.key()); };
  if (!study.study.contains("extrapolated") || !std::ranges::all_of(study.rows("verdicts"), has_code))
    throw study.fault(results,
                      "an earlier program wrote these verdicts, without what they rest on as columns",
                      "a study that this program made");
  study.planned = planned_study(study);
  HeldRows{study}.hold_all();
} catch (const scene::InputError& error) {
  throw study.fault(store::manifest_name, "no cases follow from its study: " + error.message(),
                    "a manifest as a study writes it");
}

}  // namespace launchsafe::report
