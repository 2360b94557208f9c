#include "safety_facts.hpp"

#include "launchsafe/report/number.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/study/changed_scene.hpp"
#include "launchsafe/study/verdict.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace launchsafe::report::safety {
namespace {

/// Verdict rows that page one holds.
constexpr std::size_t most_rows_on_page_one = 12;

// --- studies ---

/// The setting of an accuracy study whose uncertainty stands in the main study's input, or else the scene's
/// own where that study has no variants; nothing where the main study took the record of none.
Row setting_of(const StudyEvidence& main, const StudyEvidence& accuracy) {
  const std::string taken = quantity::recorded_uncertainty().key();
  for (const Row& row : accuracy.rows("settings"))
    for (const Row& each : main.rows("cases"))
      if (number_of(each, taken) == number_of(row, "temperature_bound_K")) return row;
  for (const Row& row : accuracy.rows("settings"))
    if (text_of(row, "is_scene") == "yes" && !row.contains("variant")) return row;
  return {};
}

/// Whether the main study took the record that a study wrote: by its digest, or by a bound that its cases
/// took from one.
std::string record_text(const StudyEvidence& main, const StudyEvidence& study) {
  if (study.tells != Tells::models && study.tells != Tells::accuracy) return {};
  const bool used = std::ranges::any_of(study.record.files, [&](const store::WrittenFile& file) {
    return main.record.manifest.input_text.find(file.sha256) != std::string::npos;
  });
  return used || !setting_of(main, study).is_null() ? "yes" : "no";
}

/// Of a study, without its tables.
Row about(const StudyEvidence& study, const StudyEvidence& main) {
  const store::Manifest& manifest = study.record.manifest;
  const auto runs_in = [&](store::CaseState state) {
    return std::ranges::count(study.runs, state, &store::RunRecord::state);
  };
  Row all = Row::array(), told = Row::array();  // what a scene writes out changes no number
  for (const study::Difference& each : study.differences) {
    all.push_back(each.key.name);
    if (each.key.name != "title" && !each.key.name.starts_with("output.")) told.push_back(each.key.name);
  }
  return {{"label", study.label},
          {"kind", study.kind},
          {"file", study.record.study},
          {"command", study.command()},
          {"scene_title", study.scene.scene.title},
          {"finished", study.finished()},
          {"lacks_pictures", study.finished() && !study.record.complete},
          {"done", runs_in(store::CaseState::done)},
          {"failed", runs_in(store::CaseState::failed) + runs_in(store::CaseState::timed_out)},
          {"made", manifest.start_time},
          {"commit", manifest.commit},
          {"compiler", manifest.compiler},
          {"compiler_flags", manifest.compiler_flags},
          {"input_sha256", manifest.input_sha256},
          {"version", manifest.model_version},
          {"program", manifest.program_version},
          {"record_used", record_text(main, study)},
          {"own_scenes", study.tells == Tells::stability},
          {"all_differences", all},
          {"differences", told},
          {"asked", study.asked}};
}

/// With its tables.
Row tables_of(const StudyEvidence& study, const StudyEvidence& main) {
  Row all = study.finished() ? study.study : Row::object();
  all.update(about(study, main));
  return all;
}

// --- what the answer rests on ---

/// The least that the critical gap can be at the hottest temperature of a sweep over it; of several cases at
/// that the smallest, and nothing where one has no bound.
Row hottest_of(const StudyEvidence& sweep) {
  double hottest = -HUGE_VAL, least = HUGE_VAL;
  for (const CaseEvidence& each : cases_of(sweep)) {
    const auto found = each.values.find("initial_temperature");
    if (found == each.values.end() || found->second < hottest) continue;
    if (found->second > hottest) least = HUGE_VAL;
    hottest = found->second;
    const bool ignites = text_of(*each.critical, "critical_gap_kind") == "all-ignite";
    const double bound = ignites ? 0.0 : number_of(*each.critical, "critical_gap_at_least_cm");
    // Written so that a bound that is not known stays.
    least = least < bound || std::isnan(least) ? least : bound;
  }
  if (!std::isfinite(hottest)) return {};
  return {{"temperature_K", hottest},
          {"at_least_cm", std::isfinite(least) && least > 0.0 ? Row(least) : Row()},
          {"none", least == 0.0}};
}

/// "300", or of a sweep over it "219 to 344": K, what the verdicts hold for.
std::string temperature_text(const StudyEvidence& study, const std::vector<CaseEvidence>& cases) {
  std::set<double> all;
  for (const CaseEvidence& each : cases)
    if (const auto found = each.values.find("initial_temperature"); found != each.values.end())
      all.insert(found->second);
  if (all.empty()) all.insert(study.scene.scene.initial_temperature);
  return fixed(*all.begin(), 0) + (all.size() > 1 ? " to " + fixed(*all.rbegin(), 0) : "");
}

/// Whether a study is of the main one's launch: numerics may differ, and what it varies itself.
bool is_of_same_launch(const StudyEvidence& study) {
  return std::ranges::all_of(study.differences, [&](const study::Difference& each) {
    const std::string& key = each.key.name;
    return key == "title" || key == "gap.thickness" || key.starts_with("numerics.") ||
           key.starts_with("output.") || std::ranges::any_of(study.rows("inputs"), [&](const Row& input) {
             return text_of(input, "scene_key") == key;
           });
  });
}

/// What the verdicts say beside themselves, and what the study does not say.
void add_limits(const StudyEvidence& main, const std::vector<CaseEvidence>& cases, Row& facts) {
  std::vector<const Row*> verdicts;
  std::set<std::string> models;  // under which ignition is not excluded
  bool warned = false;
  for (const CaseEvidence& each : cases)
    for (const Row* row : each.verdicts) {
      verdicts.push_back(row);
      warned = warned || !text_of(*row, "validity_warnings").empty() || !text_of(*row, "unaccepted").empty();
      if (text_of(*row, "verdict") != "UNSAFE") models.insert(text_of(*row, "model_form"));
    }
  models.erase("");
  if (!verdicts.empty()) facts["counts"] = counts_of(verdicts);
  facts["warned"] = warned;
  facts["other_models"] = models;
  const auto says = [&](const char* record, const char* by_hand) {
    return main.asked.contains(record) ||
           std::ranges::any_of(main.rows("stated_by_hand"),
                               [&](const Row& row) { return text_of(row, "key") == by_hand; });
  };
  const bool inputs = says("", "input_uncertainty"), computation = says("accuracy", "numerical_uncertainty"),
             form = says("model_form", "model_form_uncertainty");
  if (!inputs || !computation || !form)
    facts["assumed"] = {{"inputs", !inputs}, {"computation", !computation}, {"models", !form}};
}

/// A study's own drawing of that name.
Row drawing_of(const StudyEvidence* study, const std::string& file, PageFacts& all) {
  if (study == nullptr || !study->drawings.contains(file)) return {};
  all.drawings[file] = study->drawings.at(file);
  return {{"file", file}};
}

/// The pictures that a sweep drew: one for every place on the axes behind the first two, in the order of the
/// cases.
Row pictures_of(const StudyEvidence& sweep, PageFacts& all) {
  std::vector<std::pair<std::string, std::vector<CaseEvidence>>> places;
  for (CaseEvidence& each : cases_of(sweep)) {
    auto place = std::ranges::find(places, each.others, [](const auto& one) { return one.first; });
    if (place == places.end()) place = places.insert(place, {each.others, {}});
    place->second.push_back(std::move(each));
  }
  std::vector<std::string> axes;
  for (const Row& axis : sweep.rows("axes")) axes.push_back(text_of(axis, "name"));
  axes.resize(std::min<std::size_t>(axes.size(), 2));
  std::string names = fmt::format("{}", fmt::join(axes, " and "));
  std::ranges::replace(names, '_', ' ');
  Row pictures = Row::array();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::string file = fmt::format("critical_gap{}.svg", i > 0 ? fmt::format("_{}", i + 1) : "");
    Row picture = drawing_of(&sweep, file, all);
    if (picture.is_null()) continue;
    picture.update(summary_of(sweep, places[i].second));
    picture.update({{"axes", names}, {"others", places[i].first}});
    pictures.push_back(std::move(picture));
  }
  return pictures;
}

/// The case that the report is about in detail.
void add_own(const SafetyEvidence& evidence, const CaseEvidence& own, PageFacts& all) {
  const StudyEvidence& main = evidence.main();
  Row& facts = all.facts["own"];
  facts = told_case(main, own);
  facts["is_own"] = is_own(main, own);
  facts["completed"] = own.completed();
  facts["certain"] = own.completed() && !std::ranges::all_of(own.verdicts, is_uncertain);
  for (const Row& row : main.rows("gap_shares"))
    if (text_of(row, "case") == own.label) facts["gap_shares"].push_back(row);
  if (!own.completed()) return;
  for (const Row* row : own.verdicts) {
    facts["completed_verdicts"].push_back(*row);
    if (std::isfinite(number_of(*row, "uncertainty_K"))) facts["shares"].push_back(*row);
  }
  facts.update(fit_facts(main, own));
  if (const auto stored = evidence.mechanics.find(own.label); stored != evidence.mechanics.end())
    all.facts["pictures"] = picture_facts(main, own, stored->second, all);
}

}  // namespace

PageFacts facts_of(const SafetyEvidence& evidence, const std::optional<GapCriterion>& criterion) {
  const StudyEvidence& main = evidence.main();
  const bool of_launch = main.tells == Tells::launch, of_sweep = main.tells == Tells::sweep;
  const std::vector<CaseEvidence> cases =
      of_launch || of_sweep ? cases_of(main) : std::vector<CaseEvidence>{};
  PageFacts all;
  Row& facts = all.facts;
  facts["main"] = tables_of(main, main);
  for (const StudyEvidence& study : evidence.studies) facts["studies"].push_back(about(study, main));
  for (const auto& [name, tells] : {std::pair{"launch", Tells::launch},
                                    {"sweep", Tells::sweep},
                                    {"models", Tells::models},
                                    {"accuracy", Tells::accuracy},
                                    {"sensitivity", Tells::sensitivity},
                                    {"stability", Tells::stability}}) {
    const StudyEvidence* study = evidence.find(tells);
    facts[name] = study != nullptr ? tables_of(*study, main) : Row();
    if (study == nullptr) facts["missing"] = true;
  }
  facts["scene"] = scene_facts(main, all);
  facts["temperature"] = temperature_text(main, cases);
  facts["several"] = cases.size() > 1;
  facts["case_count"] = cases.size();
  facts["covered"] = !cases.empty();
  facts["answer"] = answer_of(main, of_launch ? cases : std::vector<CaseEvidence>{}, criterion);
  if (of_sweep || cases.size() > 1) facts["summary"] = summary_of(main, cases);
  add_limits(main, cases, facts);
  if (const CaseEvidence* own = of_launch ? own_case(main, cases) : nullptr) {
    add_own(evidence, *own, all);
    if (cases.size() == 1 || is_own(main, *own)) facts["told"] = facts["own"];
    facts["judged"] = true;
    facts["cases"] = facts["answer"]["cases"];
    Row verdicts = Row::array(), fits = Row::array();
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const Row fit = fit_facts(main, cases[i]);
      facts["cases"][i]["drawn"] = fit["fit"]["rows"] > 0;
      if (fit.contains("left_out")) fits.push_back(fit["left_out"]);
      for (std::size_t row = 0; row < cases[i].verdicts.size(); ++row)
        verdicts.push_back(told_verdict(cases[i], row));
    }
    if (cases.size() > 1) facts["left_out"] = fits;
    const bool fits_page = verdicts.size() <= most_rows_on_page_one;
    facts["page_one"] = {{"verdicts", fits_page ? verdicts : Row()},
                         {"cases", fits_page ? Row() : facts["cases"]}};
    if (!fits_page) facts["section_two"]["verdicts"] = verdicts;
    if (std::ranges::any_of(facts["cases"], [](const Row& each) { return each["drawn"] == true; }))
      facts["drawings"]["launch"] = drawing_of(&main, "temperature.svg", all);
  }
  if (const StudyEvidence* sweep = evidence.find(Tells::sweep)) {
    facts["hottest"] = hottest_of(*sweep);
    facts["envelopes"] = pictures_of(*sweep, all);
  }
  if (const StudyEvidence* accuracy = evidence.find(Tells::accuracy)) {
    facts["setting"] = setting_of(main, *accuracy);
    if (!facts["setting"].is_null()) facts["meshes"] = accuracy->rows("reference");
  }
  if (const StudyEvidence* sensitivity = evidence.find(Tells::sensitivity))
    facts["same_launch"] = is_of_same_launch(*sensitivity);
  facts["drawings"]["models"] = drawing_of(evidence.find(Tells::models), "model_form.svg", all);
  // How far those published rows are off that were not fitted.
  double worst = 0;
  for (const Row& row : main.rows("comparison"))
    if (const double misfit = std::abs(number_of(row, "temperature_max_computed_minus_published_K"));
        text_of(row, "used_for") != "fitted" && misfit > worst)
      worst = misfit;
  if (const std::size_t rows = main.rows("comparison").size(); rows > 0)
    facts["published"] = {{"rows", rows}, {"worst_K", worst}};
  return all;
}

}  // namespace launchsafe::report::safety

namespace launchsafe::report {

PageTemplates built_in_templates() {
  PageTemplates templates{safety::built_in_html, safety::built_in_markdown, {}};
  const auto built_in = texts_in(safety::built_in_texts, "texts");
  for (const PageText& each : *built_in) templates.texts[each.id] = each.words;
  return templates;
}

store::Result<RenderedReport> make_safety_report(const SafetyEvidence& evidence,
                                                 const std::optional<GapCriterion>& criterion,
                                                 const PageTemplates& templates,
                                                 const DrawingLimits& limits) {
  const PageFacts facts = safety::facts_of(evidence, criterion);
  return render_page(*texts_in(safety::built_in_texts, "texts"), facts, templates,
                     {{"format", "launchsafe safety report 2"},
                      {"title", evidence.main().title},
                      {"subject", evidence.main().scene.scene.title},
                      {"answer", facts.facts["answer"]}},
                     limits);
}

}  // namespace launchsafe::report
