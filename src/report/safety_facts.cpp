// The facts, tables and figures of a safety report: rows of studies, and what follows from them.
#include "launchsafe/report/case_tables.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/scene/plan.hpp"
#include "safety_page.hpp"

#include <set>

namespace launchsafe::report {
namespace {

using keys::fixed, keys::significant, keys::text;

// --- rows of JSON ---

Cell cell_in(const Row& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_integer()) return value.get<std::int64_t>();
  return value.is_number() ? Cell(value.get<double>()) : Cell();
}

/// The cells of rows that have the keys of these columns.
Table table_in(std::string title, std::vector<Column> columns, const Row& rows) {
  Table table{std::move(title), std::move(columns)};
  for (const Row& row : rows) {
    auto& cells = table.rows.emplace_back();
    for (const Column& column : table.columns) cells.push_back(cell_in(found_in(row, column.key())));
  }
  return table;
}

Row rows_where(const Row& rows, const char* key, const std::string& value) {
  Row found = Row::array();
  for (const Row& row : rows)
    if (text_of(row, key) == value) found.push_back(row);
  return found;
}

/// The row with the smallest number, or the largest by a `sign` of -1; null where none has one.
const Row& smallest_in(const Row& rows, const std::string& key, double sign = 1.0) {
  static const Row nothing;
  const Row* best = &nothing;
  for (const Row& row : rows)
    if (const double number = sign * number_of(row, key);
        !std::isnan(number) && !(number >= sign * number_of(*best, key)))
      best = &row;
  return *best;
}
const Row& largest_in(const Row& rows, const std::string& key) { return smallest_in(rows, key, -1.0); }

/// "0.0176 cm", of a member in the unit of a column; empty where it is no number.
std::string told(const Row& row, const Column& column) {
  const double number = number_of(row, column.key());
  return std::isnan(number) ? "" : shown_digits(number, column.form) + " " + column.form.unit;
}

// --- the scene ---

/// All inputs; a long list by its beginning.
Row inputs_of(const scene::SceneFile& file) {
  constexpr std::size_t longest = 120, beginning = 40;
  Row inputs = Row::array();
  for (const scene::ListedKey& each : scene::list_keys(file)) {
    std::string value = each.value;
    if (value.size() > longest)
      value = fmt::format("{} ... ({} values)", value.substr(0, value.rfind(',', beginning)),
                          std::ranges::count(value, ',') + 1);
    inputs.push_back({{"key", each.name}, {"value", value}, {"meaning", each.sentence}});
  }
  return inputs;
}

Table body_table(const scene::Scene& scene) {
  using scene::Body;
  const auto edge = [](const char* name, const char* heading, double Body::*member) {
    return Quantity<Body>{name, heading, significant(6, centimetre), "Edge of the body.", member};
  };
  return table_of("Bodies",
                  Quantities<Body>{{"body", "body", text(), "Name of the body.", &Body::name},
                                   {"material", "material", text(), "Its material.",
                                    [&](const Body& body) { return scene::material_text(scene, body); }},
                                   edge("x_begin", "x from", &Body::x_begin),
                                   edge("x_end", "to", &Body::x_end),
                                   edge("r_begin", "r from", &Body::r_begin),
                                   edge("r_end", "to", &Body::r_end)},
                  scene.bodies);
}

void add_scene(const StudyEvidence& study, SafetyPage& page) {
  const scene::Scene& scene = study.scene.scene;
  page.facts["scene"] = {
      {"launch", scene::launch_sentence(scene)},
      {"peak", in_words(scene::PressureHistory(scene.load).stated_peak(), significant(4, megapascal))},
      {"crack", in_words(scene.charge().strength.initial_crack_radius, significant(4, micrometre))},
      {"flaw", in_words(scene.charge().strength.flaw_size, significant(3, millimetre))},
      {"temperature", in_words(scene.initial_temperature, fixed(0, kelvin))},
      {"ignition", in_words(scene.charge().kinetics.ignition_temperature, fixed(1, kelvin))},
      {"measured", scene::smoothing_text(scene.load)},
      {"held", study::of_each(scene::describe_interfaces(scene), [](const scene::InterfaceText& each) {
         return each.body + ": " + each.condition;
       })}};
  // The manifest's scene has every number written out; where they come from the study says.
  page.facts["kinetics"] =
      study.study.contains("kinetics") ? study.study["kinetics"] : kinetics_json(study.scene);
  page.tables["bodies"] = body_table(scene);
  Row left_out = Row::array();
  for (const scene::Term& term : scene::make_plan(scene).terms)
    if (!term.in) left_out.push_back({{"term", term.title}, {"why", term.reason}});
  page.tables["left_out"] =
      table_in("Physics left out, and why", {{"term", "term"}, {"why", "why"}}, left_out);
  page.tables["inputs"] = table_in("Inputs", {{"key", "key"}, {"value", "value"}, {"meaning", "meaning"}},
                                   inputs_of(study.scene));
}

// --- studies ---

/// Its manifest, but for its input, and how it differs from the main study.
Row about(const StudyEvidence& study) {
  Row facts = store::to_json(study.record);
  facts.erase("input");
  facts.update({{"label", study.label},
                {"kind", study.kind},
                {"title", study.title},
                {"state", study.finished() ? "finished" : "unfinished"},
                {"command", study.command()},
                {"other_programs", study.record.other_programs()},
                {"differs_in", fmt::format("{}", fmt::join(study.differences, ", "))}});
  return facts;
}

/// All studies, and what those beside the main one answer.
void add_studies(const SafetyEvidence& evidence, SafetyPage& page) {
  Row& facts = page.facts;
  std::set<std::string> kinds;
  for (const StudyEvidence& study : evidence.studies) {
    const Row told = facts["studies"].emplace_back(about(study));
    if (!study.finished()) facts["unfinished_studies"].push_back(told);
    if (!told["other_programs"].empty()) facts["other_programs"].push_back(told);
    if (!study.finished() || &study == &evidence.main()) continue;
    kinds.insert(study.kind);
    facts["others"].push_back(
        {{"label", study.label}, {"title", study.title}, {"answer", text_of(study.study, "answer")}});
    for (const auto& [file, svg] : study.pictures)
      page.figures["others"].push_back(
          {.file = file, .alternative = fmt::format("Study {}: {}", study.label, study.title), .svg = svg});
  }
  facts["missing"] = Row::array();
  for (const char* kind : {"accuracy", "sensitivity", "stability"})
    if (!kinds.contains(kind)) facts["missing"].push_back(kind);
  page.tables["studies"] = table_in("Studies",
                                    {{"label", "study"},
                                     {"kind", "kind"},
                                     {"study", "file"},
                                     {"state", "state"},
                                     {"start_time", "made"},
                                     {"commit", "commit"},
                                     {"input_sha256", "SHA-256 of the input"},
                                     {"differs_in", "values of the scene that differ from the main study"}},
                                    facts["studies"]);
}

// --- cases ---

/// Whether complete coupled runs on both sides of a case's critical gap do what is expected of them.
bool is_confirmed(const StudyEvidence& study, const std::string& name) {
  std::set<std::string> expected;
  for (const Row& run : rows_where(study.rows("coupled_runs"), "case", name)) {
    if (text_of(run, "outcome") != text_of(run, "expected")) return false;
    expected.insert(text_of(run, "expected"));
  }
  return expected.size() == 2;
}

/// The rows of cases, and how the verdicts of each came out.
Row told_cases(const StudyEvidence& study) {
  Row cases = study.rows("cases");
  for (std::size_t i = 0; i < cases.size(); ++i) {
    cases[i]["confirmed"] = is_confirmed(study, text_of(cases[i], "case"));
    for (const char* word : {"SAFE", "INDETERMINATE", "UNSAFE"})
      cases[i][word] = rows_where(study.verdicts_of(i), "verdict", word).size();
  }
  return cases;
}

/// The verdicts of all cases without what says nothing of the launch: numbers of a run that was cut off. What
/// somebody accepts stands beside the case.
Row told_verdicts(const StudyEvidence& study) {
  Row told = Row::array();
  for (std::size_t i = 0; i < study.rows("cases").size(); ++i) {
    const Row& of_case = study.rows("cases")[i];
    for (Row row : study.verdicts_of(i)) {
      row["case"] = of_case["case"];
      for (const auto& column : verdict_columns())
        if (column.form.notation != Notation::text && column.name != "gap" && !study.completed(i))
          row[column.key()] = nullptr;
      row["verdict_shown"] = text_of(row, "verdict");
      if (row["verdict"] == "SAFE" && !text_of(of_case, "accepted").empty())
        row["verdict_shown"] = "SAFE, accepted";
      row["reason"] = rule_in(text_of(row, "reason"));
      told.push_back(row);
    }
  }
  return told;
}

Table verdict_table(const Row& rows, bool several) {
  std::vector<Column> columns = verdict_columns();
  const auto place = std::ranges::find(columns, quantity::verdict.name, &Column::name);
  *place = for_programs(*place);
  columns.insert(place, for_people(Column{"verdict_shown", "verdict"}));
  columns.insert(columns.begin(), several ? quantity::case_name : for_programs(quantity::case_name));
  return table_in("Verdicts", columns, rows);
}

/// cm: the largest gap that is SAFE in every case. Null where a case has none.
Row largest_safe_in_all(const Row& cases) {
  const std::string key = "largest_safe_gap_cm";
  const bool all = std::ranges::all_of(cases, [&](const Row& each) { return each[key].is_number(); });
  const Row& smallest = smallest_in(cases, key);
  return all && !smallest.is_null() ? smallest[key] : Row();
}

/// "496 MPa, 30 µm, 1 mm, 336 K permits none"
std::string cases_without_safe(const Row& cases) {
  std::vector<std::string> names;
  for (const Row& each : cases)
    if (each["largest_safe_gap_cm"].is_null()) names.push_back(text_of(each, "case"));
  return fmt::format("{} {} none", fmt::join(names, "; "), names.size() == 1 ? "permits" : "permit");
}

/// The critical gap of one case, and what makes it uncertain.
void add_shown_case(const StudyEvidence& main, const Row& row, SafetyPage& page) {
  const std::string name = text_of(row, "case");
  Row shown{{"case", name},
            {"critical_gap", text_of(row, "critical_gap_with_bounds")},
            {"at_least", told(row, quantity::lower_bound)},
            {"at_most", told(row, quantity::upper_bound)},
            {"confirmed", row["confirmed"]}};
  const Row causes = rows_where(main.rows("causes"), "case", name);
  if (const Row& largest = largest_in(causes, "shorter_cm"); number_of(largest, "shorter_cm") > 0)
    shown["largest_cause"] = {{"cause", largest["cause"]},
                              {"shorter", told(largest, quantity::shorter)},
                              {"remedy", largest["remedy"]}};
  page.facts["shown"] = shown;
  page.tables["causes"] =
      table_in("Causes of the bounds of the critical gap",
               {{"cause", "cause"}, {"class", "class"}, quantity::shorter, quantity::longer}, causes);
}

/// Gaps whose histories are shown: the largest that is SAFE, and the smallest that is not, one that ignites
/// before others; or the first.
std::vector<double> shown_gaps(const Row& verdicts) {
  const auto of = [&](const char* word) { return rows_where(verdicts, "verdict", word); };
  const Row safe = largest_in(of("SAFE"), "gap_cm");
  Row next = smallest_in(of("UNSAFE"), "gap_cm");
  if (next.is_null()) next = smallest_in(safe.is_null() ? verdicts : of("INDETERMINATE"), "gap_cm");
  std::vector<double> gaps;
  for (const Row& row : {safe, next})
    if (!row.is_null()) gaps.push_back(number_of(row, "gap_cm") / shown_gap(1.0));
  return gaps;
}

/// The load, histories, profiles and the last temperature field of the run that was stored. Ignition under
/// two-way coupling goes on in a run of its own, which has no trace here.
void add_stored_run(const StudyEvidence& main, const run::CaseResult& stored, SafetyPage& page) {
  run::CaseResult shown{stored.mechanics, {}};
  for (const double gap : shown_gaps(main.verdicts_of(0)))
    for (const run::GapResult& each : stored.gaps)
      if (each.gap == gap) shown.gaps.push_back(each);
  const std::map<std::string, std::string> captions{
      {"pressure", "Pressure of the chamber, and at the charge's bottom, against time, as computed."},
      {"histories", "Skin temperature of the stations and pressures against time."},
      {"profile", "Skin temperature along the charge's bottom, at the end or just before ignition."},
      {"fields", "Temperature of the skin under the gap, stretched along x."}};
  const DrawnCase drawn{main.scene.scene, shown};
  for (const PictureKind& kind : picture_kinds()) {
    const std::string name = kind.word;
    if (!captions.contains(name) || !kind.lacks(drawn).empty()) continue;
    std::vector<Picture>& figures = page.figures[name];
    for (Picture& each : kind.pictures(drawn)) {
      if (name == "fields" && !each.file.starts_with("field_temperature")) continue;
      if (name == "fields") figures.clear();  // the last alone
      each.alternative = captions.at(name) + (each.gap ? " Gap " + centimetres(*each.gap) + "." : "");
      figures.push_back(std::move(each));
    }
  }
}

/// The picture of verdicts: that of one launch, or of several as their study has it.
void add_verdict_picture(const StudyEvidence& main, SafetyPage& page) {
  Picture picture{.file = "temperature.svg",
                  .alternative = "T max against gap, with the critical gap within its bounds."};
  if (main.rows("cases").size() == 1)
    picture.drawing = verdict_plot(main.study, main.scene.scene);
  else if (const auto drawn = main.pictures.find(picture.file); drawn != main.pictures.end())
    picture.svg = drawn->second;
  else
    return;
  page.figures["temperature"] = {std::move(picture)};
}

/// A launch, or a few; the case with the smallest critical gap is the one to see.
void add_launch(const SafetyEvidence& evidence, SafetyPage& page) {
  const StudyEvidence& main = evidence.main();
  const Row cases = told_cases(main), verdicts = told_verdicts(main), safe = largest_safe_in_all(cases);
  const bool several = cases.size() > 1;
  page.tables["verdicts"] = verdict_table(verdicts, several);
  std::vector<Column> columns = keys::described(case_quantities());
  columns.insert(columns.begin(), quantity::case_name);
  columns.emplace_back("largest_safe_gap", "largest SAFE gap", significant(6, centimetre));
  page.tables["cases"] = table_in("Cases", columns, cases);
  Row& facts = page.facts;
  facts["answer"].update({{"largest_safe_gap_cm", safe}, {"cases", cases}});
  facts["several"] = several;
  const bool is_accepted =
      std::ranges::any_of(cases, [](const Row& each) { return !text_of(each, "accepted").empty(); });
  if (safe.is_null())
    facts["not_safe"] = {{"reason", several            ? cases_without_safe(cases)
                                    : verdicts.empty() ? ""
                                                       : text_of(verdicts.front(), "reason")}};
  else
    facts["safe"] = {{"gap", safe}, {"accepted", is_accepted}};
  const Row& smallest = smallest_in(cases, "critical_gap_cm");
  add_shown_case(main, smallest.is_null() ? cases.front() : smallest, page);
  if (!main.completed(0)) return;
  add_verdict_picture(main, page);
  if (evidence.stored) add_stored_run(main, *evidence.stored, page);
}

/// What stands beside the verdicts of the main study.
void add_basis(const StudyEvidence& main, SafetyPage& page) {
  Row& facts = page.facts;
  facts["notes"] = main.rows("notes");
  facts["models"] = main.rows("models");
  if (const Row& row = largest_in(main.rows("verdicts"), "taken_over_supplied"); !row.is_null())
    facts["air_ratio"] = shown_digits(number_of(row, "taken_over_supplied"), up(significant(2)));
  page.tables["runs"] = table_in("Runs", run_table({}).columns, main.rows("runs"));
}

void add_comparison(const StudyEvidence& main, SafetyPage& page) {
  const Row& rows = main.rows("comparison");
  page.facts["fitted_rows"] = rows_where(rows, "used_for", "fitted").size();
  page.facts["published_rows"] = rows.size();
  const auto temperature = [](const char* name, const char* heading) {
    return Column{name, heading, fixed(1, kelvin)};
  };
  page.tables["published"] = table_in("Against published results",
                                      {quantity::gap,
                                       quantity::used_for,
                                       quantity::temperature_max,
                                       headed("at", quantity::temperature_max_place),
                                       temperature("temperature_max_published", "published"),
                                       {"temperature_max_published_place", "at"},
                                       temperature("temperature_max_computed_minus_published", "difference"),
                                       temperature("temperature_early", "early"),
                                       temperature("temperature_early_published", "published"),
                                       quantity::ignition_time,
                                       {"ignition_time_published", "published", fixed(2, millisecond)}},
                                      rows);
}

}  // namespace

SafetyPage safety_page(const SafetyEvidence& evidence) {
  const StudyEvidence& main = evidence.main();
  SafetyPage page;
  Row& facts = page.facts;
  facts = {{"format", "launchsafe safety report 5"},
           {"title", main.title},
           {"subject", main.scene.scene.title},
           {"answer",
            {{"study", main.label},
             {"finished", main.finished()},
             {"largest_safe_gap_cm", nullptr},
             {"cases", Row::array()}}},
           {"main", about(main)}};
  add_studies(evidence, page);
  add_scene(main, page);
  facts["unfinished"] = !main.finished();
  facts["no_verdicts"] = main.finished() && !main.has_verdicts();
  if (main.has_verdicts() && !main.is_of_launch()) facts["combinations"] = main.rows("cases").size();
  if (main.is_of_launch()) add_launch(evidence, page);
  if (main.has_verdicts()) {
    add_basis(main, page);
    add_comparison(main, page);
  }
  return page;
}

}  // namespace launchsafe::report
