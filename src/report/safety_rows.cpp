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
using study::CriticalGap, study::CriticalGapKind, study::GapVerdict, study::ShareKind;

/// Refuses a cell that is not what was made of others; `tolerance` where these were rounded.
void hold(const StudyEvidence& study, const std::string& place, const Row& row, const Row& made,
          double tolerance = 1e-9) {
  for (const auto& [key, value] : made.items()) {
    const double number = number_of(made, key), off = std::abs(number_of(row, key) - number);
    const Row cell = row.contains(key) ? row[key] : Row(),
              wanted = value.is_number() && !std::isfinite(number) ? Row() : value;
    if (cell != wanted && !(off <= tolerance * std::abs(number) + 1e-9))
      throw study.fault("study.json",
                        fmt::format("{}: {} is {}, and what it follows from makes it {}", place, key,
                                    cell.dump(), wanted.dump()),
                        "tables as a study writes them");
  }
}

// --- what is made: cases by the manifest, and values of the study by cells ---

/// Gaps, axes and cases, as a study of kind critical-gap makes them.
study::StudyFile planned_study(const StudyEvidence& study) {
  study::StudyFile file;
  file.scene = study.scene;
  // The manifest writes every value: what follows from others is to follow them in cases too.
  for (const auto& given : study.scene.given) {
    scene::SceneFile fewer = file.scene;
    fewer.given.erase(given.first);
    if (auto same = scene::with_keys(fewer, {}, true);
        same && scene::to_toml(same->scene) == scene::to_toml(study.scene.scene))
      file.scene = std::move(*same);
  }
  // What its records say is not in the folder.
  file.study.kind = {.gives_verdicts = false};
  const auto numbers = [&](const toml::table& table, const char* name, KeyKind kind, Dimension dimension) {
    scene::Value read = std::vector<double>();
    if (const toml::node* node = table.get(name))
      read = scene::read_value(*node, {.name = name, .kind = kind, .dimension = dimension}, "").or_throw();
    return std::get<std::vector<double>>(read);
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
double gap_in(const Row& row, const std::string& key) { return number_of(row, key) / shown_gap(1.0); }

/// The verdict row of a gap (m), not judged; `evidence`: what all rows of its case rest on.
GapVerdict verdict_in(const Row& row, double gap, double ignition_temperature, study::CaseEvidence evidence) {
  GapVerdict made;
  made.gap = gap;
  made.maximum.temperature = number_of(row, "temperature_max_K");
  made.margin = ignition_temperature - made.maximum.temperature;
  for (const auto& [part, member] : {std::pair{"computation", &study::Uncertainty::numerical},
                                     {"fit", &study::Uncertainty::fit},
                                     {"inputs", &study::Uncertainty::input},
                                     {"model_form", &study::Uncertainty::model_form}})
    made.uncertainty.*member = std::abs(number_of(row, fmt::format("uncertainty_of_{}_K", part)));
  if (!text_of(row, "ignition_cause").empty()) made.ignition.emplace();
  if (const std::string warnings = text_of(row, "validity_warnings"); !warnings.empty())
    evidence.validity_warnings.push_back(warnings);
  if (const std::string unaccepted = text_of(row, "unaccepted"); !unaccepted.empty())
    evidence.input.implausible.push_back({.key = unaccepted});
  made.of_case = std::make_shared<const study::CaseEvidence>(std::move(evidence));
  return made;
}

// --- what is written is held against that ---

/// The causes that a table lists of a critical gap up to `safe` (m). One is not known that has no row, and
/// that is assumed of every launch or makes T max uncertain.
std::vector<study::GapShare> held_causes(const CaseEvidence& judged, double safe) {
  const StudyEvidence& study = *judged.study;
  std::vector<study::GapShare> shares;
  for (std::size_t i = 0; i < study::share_kinds; ++i) {
    study::GapShare share{ShareKind(i)};
    const auto& [name, title, of_class, remedy] = study::traits_of(share.kind);
    const double kelvin = number_of(*judged.verdicts.front(), "uncertainty_of_" + name + "_K");
    bool counts = share.kind <= ShareKind::initial_temperature
                      ? !study.asked.contains("input_uncertainty")
                      : share.kind != ShareKind::sliding && kelvin > 0.0;
    for (const Row& row : study.rows("gap_shares")) {
      if (text_of(row, "case") != judged.label || text_of(row, "cause") != title) continue;
      counts = true;
      // How far it moves the gap is written with all digits.
      const double lowers = gap_in(row, "lowers_cm");
      share.raised = lowers == 0.0 ? gap_or_bound_in(text_of(row, "raised")) : safe - lowers;
      share.lowered = gap_or_bound_in(text_of(row, "lowered"));
      const CriticalGap alone{.lower = safe, .shares = {share}};
      hold(study, "gap_shares, " + judged.label, row,
           json_rows(gap_share_table({{judged.label, &alone}}))[0]);
    }
    if (counts) shares.push_back(share);
  }
  return shares;
}

/// The critical gap of a case. Its bounds are those of its causes; where these are not listed, as in no study
/// of many cases, none has made the lower bound larger or the upper one smaller.
CriticalGap held_gap(const CaseEvidence& judged) {
  using enum CriticalGapKind;
  const Row& row = *judged.critical;
  CriticalGap gap;
  for (const CriticalGapKind kind : {value, all_safe, all_ignite, several_crossings})
    if (to_string(kind) == text_of(row, "critical_gap_kind")) gap.kind = kind;
  gap.lower = gap_in(row, "critical_gap_lower_cm");
  gap.upper = gap_in(row, "critical_gap_upper_cm");
  if (gap.kind == value) gap.value = 0.5 * (gap.lower + gap.upper);
  const bool has_causes = judged.in_detail() && gap.kind != all_ignite;
  study::set_shares(gap, has_causes ? held_causes(judged, gap.lower) : std::vector<study::GapShare>{});
  const double at_least = gap_in(row, "critical_gap_at_least_cm"),
               at_most = gap_in(row, "critical_gap_at_most_cm");
  if (!judged.in_detail() && (at_least <= gap.bounds.at_least || std::isnan(at_least)))
    gap.bounds.at_least = at_least;
  if (!judged.in_detail() && (at_most >= gap.bounds.at_most || std::isnan(at_most)))
    gap.bounds.at_most = at_most;
  // Critical gaps at the better ends of causes have four digits.
  const std::string place = "cases, " + judged.label;
  hold(*judged.study, place, row, {{"critical_gap_at_most_cm", shown_gap(gap.bounds.at_most)}}, 1e-3);
  if (std::isfinite(at_most)) gap.bounds.at_most = at_most;
  Row told = json_of(bounded_gap_quantities(), gap);
  // What one might be that is indeterminate is not known here.
  for (const char* text : {"critical_gap_reads_as", "critical_gap_with_bounds"})
    if (gap.kind == indeterminate) told.erase(text);
  hold(*judged.study, place, row, told);
  // An earlier program took wide brackets, in which what causes of uncertainty change vanishes.
  constexpr double widest_bracket = 1.01e-6;  // m
  if (!(gap.lower <= gap.upper && gap.upper - gap.lower <= widest_bracket) && gap.kind == value)
    gap.bounds = {};
  return gap;
}

/// The name of the stored run of a case follows from its launch.
void hold_run(const CaseEvidence& judged, const study::StudyCase& input) {
  const std::string hash = study::mechanics_run(input.scene.scene, {}).hash;
  hold(*judged.study, "runs, " + judged.label, *judged.run,
       {{"case", judged.label}, {"stored_case", judged.completed() ? "cases/" + hash + ".h5" : ""}});
}

/// The rows of a case, of whose launch their columns say so much. No verdict warns less than its own parts
/// do; what is not in the folder may have more to warn of.
void hold_case(const CaseEvidence& judged, const Row& launch) {
  const StudyEvidence& study = *judged.study;
  const study::StudyCase input = judged.input();
  const scene::Scene& scene = input.scene.scene;
  if (judged.in_detail()) hold_run(judged, input);
  const CriticalGap critical = held_gap(judged);
  study::CaseEvidence evidence;
  if (judged.completed()) evidence.failure.clear();
  evidence.input = study::statements_of(study.planned.study, input);
  evidence.validity_warnings = evidence.input.uncovered_load;
  std::vector<GapVerdict> rows;
  for (const double gap : study.planned.study.gaps) {
    const Row& row = *judged.verdicts[rows.size()];
    GapVerdict& made =
        rows.emplace_back(verdict_in(row, gap, scene.charge().kinetics.ignition_temperature, evidence));
    made.judgement = study::judge(made, critical);
    const std::string verdict = text_of(row, "verdict"), least = to_string(made.judgement.verdict);
    const bool warns_more = verdict == "UNSAFE" || (verdict == "INDETERMINATE" && least == "SAFE");
    Row told = launch;
    told.update({{"gap_cm", shown_gap(gap)},
                 {"margin_K", made.margin},
                 {"uncertainty_K", made.uncertainty.total()},
                 {"verdict", warns_more ? verdict : least}});
    hold(study, fmt::format("verdicts, {}, row {}", judged.label, rows.size()), row, told);
    if (verdict != "SAFE") made.judgement.verdict = study::Verdict::indeterminate;
  }
  hold(study, "cases, " + judged.label, *judged.critical,
       {{"largest_safe_gap_cm", shown_gap(study::largest_safe_gap(rows))}});
}

}  // namespace

std::optional<double> largest_safe_gap(std::vector<Row> verdicts) {
  const auto gap = [](const Row& verdict) { return number_of(verdict, "gap_cm"); };
  std::ranges::stable_sort(verdicts, {}, gap);
  std::optional<double> largest;
  for (const Row& each : verdicts) {
    if (text_of(each, "verdict") != "SAFE") break;
    largest = gap(each);
  }
  return largest;
}

void check_rows(StudyEvidence& study) try {
  const auto has_code = [](const Row& row) { return row.contains("reason_code"); };
  if (!study.study.contains("extrapolated") || !std::ranges::all_of(study.rows("verdicts"), has_code))
    throw study.fault("study.json",
                      "an earlier program wrote these verdicts, without what they rest on as columns",
                      "a study that this program made");
  const study::StudyFile& planned = study.planned = planned_study(study);
  const std::size_t cases = planned.cases.size();
  const auto count = [&](const char* table) {
    return study.rows(table).is_array() ? study.rows(table).size() : 0;
  };
  hold(study, "rows", {{"cases", count("cases")}, {"verdicts", count("verdicts")}, {"runs", count("runs")}},
       {{"cases", cases},
        {"verdicts", cases * planned.study.gaps.size()},
        {"runs", study.tells == tells::sweep ? 0 : cases}});
  hold(study, "axes", study.study, {{"axes", axes_json(planned.study)}});
  const auto launch = launch_quantities(planned), axes = axis_quantities(planned.study);
  const std::vector<ShownKey> keys = shown_axes(planned.study);
  for (const CaseEvidence& each : cases_of(study)) {
    const std::vector<double>& at = planned.cases.coordinates(each.place);
    const std::string label = each.in_detail() ? planned.cases.label(each.place) : place_text(keys, at);
    Row told = json_of(axes, at);
    // Of several with one label all but the first are numbered.
    told["case"] = each.label.starts_with(label + " (") ? each.label : label;
    hold(study, fmt::format("cases, row {}", each.place + 1), *each.critical, told);
    hold_case(each, json_of(launch, at));
  }
} catch (const scene::InputError& error) {
  throw study.fault(store::manifest_name, "no cases follow from its study: " + error.message(),
                    "a manifest as a study writes it");
}

}  // namespace launchsafe::report
