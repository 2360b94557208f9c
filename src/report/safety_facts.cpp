// What a safety report tells: rows of studies, what was selected from them, and what was computed besides.
#include "launchsafe/report/case_tables.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/safety_report.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/scene/plan.hpp"

namespace launchsafe::report {
namespace {

/// Verdict rows that page one holds.
constexpr std::size_t most_rows_on_page_one = 12;

// --- what was simulated, and pictures of where and when it becomes hot ---

/// A value in the unit of its key: "peak_MPa".
double in(keys::Unit unit, double value) { return shown_value(value, keys::significant(6, unit)); }

/// A long list by its beginning; the manifest holds all of it.
std::string short_value(const std::string& value) {
  constexpr std::size_t longest = 120, beginning = 40;
  if (value.size() <= longest) return value;
  return fmt::format("{} ... ({} values)", value.substr(0, value.rfind(',', beginning)),
                     std::ranges::count(value, ',') + 1);
}

/// All inputs, but those of a law of which no body is made.
Row inputs_of(const scene::SceneFile& file) {
  Row inputs = Row::array();
  for (const scene::ListedKey& each : scene::list_keys(file)) {
    const std::string law = each.name.substr(0, each.name.find('.'));
    const bool is_unused =
        (law == "steel" || law == "elastic") &&
        std::ranges::find(file.scene.bodies, law, &scene::Body::material) == file.scene.bodies.end();
    if (is_unused) continue;
    inputs.push_back({{"key", each.name}, {"value", short_value(each.value)}, {"meaning", each.sentence}});
  }
  return inputs;
}

/// Gaps whose histories are shown: the largest that is SAFE, and the smallest that is not, one that ignites
/// before others; or the first.
std::vector<const Row*> shown_gaps(const Row& own) {
  const auto rows = [&](const char* which) { return selected({"", "", which}, own); };
  std::vector<const Row*> shown = rows("verdicts where verdict SAFE largest gap_cm");
  auto next = rows("verdicts where verdict UNSAFE smallest gap_cm");
  if (next.empty() && !shown.empty()) next = rows("verdicts where verdict INDETERMINATE smallest gap_cm");
  shown.insert(shown.end(), next.begin(), next.end());
  return shown.empty() ? rows("verdicts first 1") : shown;
}

/// "nose: sliding", ...: how bodies hold the charge.
Row interfaces_of(const scene::Scene& scene) {
  return study::of_each(scene::describe_interfaces(scene),
                        [](const scene::InterfaceText& each) { return each.body + ": " + each.condition; });
}

/// The scene and its inputs, and what of the physics was left out.
Row scene_facts(const StudyEvidence& study) {
  const scene::Scene& scene = study.scene.scene;
  const auto& strength = scene.charge().strength;
  Row facts{{"title", scene.title},
            {"end", scene::end_text(scene)},
            {"exit", scene::exit_text(scene)},
            {"peak_MPa", in(megapascal, own_value(study, "load.peak"))},
            {"crack_um", in(micrometre, strength.initial_crack_radius)},
            {"flaw_mm", in(millimetre, strength.flaw_size)},
            {"temperature_K", scene.initial_temperature},
            {"ignition_K", scene.charge().kinetics.ignition_temperature},
            {"stations", scene::stations_of(scene).size()},
            {"station_width_mm", in(millimetre, scene.surface.station_width)},
            {"station_depth_mm", in(millimetre, scene.surface.station_depth)},
            {"curve_points", scene.load.curve_time.size()},
            {"curve_file", scene.load.curve_file},
            {"smoothing_ms", in(millisecond, scene.load.smoothing)},
            {"inputs", inputs_of(study.scene)}};
  // The manifest's scene has every number written out; where they come from the study says.
  facts["kinetics"] = study.study.contains("kinetics") ? study.study["kinetics"] : kinetics_json(study.scene);
  facts["held"] = interfaces_of(scene);
  for (const scene::Body& body : scene.bodies)
    facts["bodies"].push_back({{"body", body.name},
                               {"material", scene::material_text(scene, body)},
                               {"x_begin_cm", in(centimetre, body.x_begin)},
                               {"x_end_cm", in(centimetre, body.x_end)},
                               {"r_begin_cm", in(centimetre, body.r_begin)},
                               {"r_end_cm", in(centimetre, body.r_end)}});
  const scene::Plan plan = scene::make_plan(scene);
  for (const scene::NamedTerm& term : scene::plan_terms)
    if (!(plan.*term.term).in)
      facts["left_out"].push_back({{"term", term.title}, {"why", (plan.*term.term).reason}});
  return facts;
}

/// The load, histories, profiles and fields of a case that was stored, with its verdicts.
Row picture_facts(const StudyEvidence& study, const Row& own, const run::CaseResult& stored, PageFacts& all) {
  Row facts = Row::object();
  run::CaseResult shown_result{stored.mechanics, {}};
  for (const Row* row : shown_gaps(own)) {
    const double gap = number_of(*row, "gap_cm") / shown_gap(1.0);
    const auto found = std::ranges::find(stored.gaps, gap, &run::GapResult::gap);
    if (found != stored.gaps.end())
      shown_result.gaps.push_back(*found);
    else  // ignition under two-way coupling goes on in a run of its own
      facts["other_histories"].push_back(*row);
  }
  DrawnCase drawn{study.scene.scene, shown_result};
  for (const PictureKind& kind : picture_kinds()) {
    const std::string word = kind.word;
    if (word == "combustion") continue;
    if (const std::string why = kind.lacks(drawn); !why.empty()) {
      facts["lacks"].push_back({{"word", word}, {"why", why}});
      continue;
    }
    for (CasePicture& each : kind.pictures(drawn)) {
      facts[word].push_back({{"file", each.file},
                             {"gap_cm", each.gap ? Row(shown_gap(*each.gap)) : Row()},
                             {"time_ms", each.time ? Row(in(millisecond, *each.time)) : Row()}});
      all.drawings[each.file] = std::move(each.plot);
    }
  }
  return facts;
}

// --- studies ---

/// "peak pressure 250 to 700 MPa", ...: what a study varies.
Row covered_by(const StudyEvidence& study) {
  Row covered = Row::array();
  for (const Row& axis : study.rows("axes")) {
    const auto [least, most] = std::ranges::minmax_element(axis["values"]);
    const Row ends{{"from", *least}, {"to", *most}};
    covered.push_back(filled("{{name|words}} {{from|sig 4}} to {{to|sig 4}} {{unit}}", {&axis, &ends}));
  }
  return covered;
}

/// Of a study, without its tables: its manifest, but for its input, and how it differs from the main study.
Row about(const StudyEvidence& study) {
  Row facts = store::to_json(study.record);
  facts.erase("input");
  facts.update({{"label", study.label},
                {"kind", study.kind},
                {"tells", study.tells},
                {"command", study.command()},
                {"other_programs", study.record.other_programs()},
                {"scene_title", study.scene.scene.title},
                {"covers", covered_by(study)},
                {"finished", study.finished()},
                {"own_scenes", study.tells == tells::stability},
                {"all_differences", study.differences},
                {"differences", Row::array()}});  // those that change numbers
  for (const std::string& name : study.differences)
    if (name != "title" && !name.starts_with("output.")) facts["differences"].push_back(name);
  return facts;
}

// --- cases ---

/// Whether complete coupled runs on both sides of a case's critical gap do what is expected of them.
bool is_confirmed(const CaseEvidence& judged) {
  std::set<std::string> expected;
  for (const Row& run : judged.study->rows("coupled_runs")) {
    if (text_of(run, "case") != judged.label) continue;
    if (text_of(run, "outcome") != text_of(run, "expected")) return false;
    expected.insert(text_of(run, "expected"));
  }
  return expected.size() == 2;
}

/// cm: the largest gap that is SAFE in every case. Nothing where a case has none.
Row largest_safe_in_all(const std::vector<CaseEvidence>& cases) {
  double smallest = math::infinity;
  for (const CaseEvidence& each : cases) {
    const double largest = number_of(*each.critical, "largest_safe_gap_cm");
    smallest = std::isnan(largest) ? largest : std::min(largest, smallest);
    if (std::isnan(largest)) break;
  }
  return std::isfinite(smallest) ? Row(smallest) : Row();
}

/// The row of a case, and how its verdicts came out.
Row told_case(const CaseEvidence& judged) {
  Row row = *judged.critical;
  row["confirmed"] = is_confirmed(judged);
  for (const char* word : {"SAFE", "INDETERMINATE", "UNSAFE"})
    row[word] = std::ranges::count(judged.verdicts, word,
                                   [](const Row* verdict) { return text_of(*verdict, "verdict"); });
  return row;
}

/// A verdict row as its table shows it, rounded to the safe side. A run that was cut off has no numbers of
/// the launch; after ignition T max is that of the burning skin.
Row told_verdict(const CaseEvidence& judged, const Row& verdict) {
  Row row = verdict;
  const bool ignited = !text_of(row, "ignition_cause").empty();
  const double uncertainty = ignited ? study::not_a_number : number_of(row, "uncertainty_K"),
               margin = ignited ? study::not_a_number : number_of(row, "margin_K");
  const int decimals = decimals_for(number_of(row, "uncertainty_K"));
  const auto told = [&](double value) {
    return judged.completed() && std::isfinite(value) ? Row(value) : Row();
  };
  row["case"] = judged.label;
  row["accepted"] = text_of(*judged.critical, "accepted");
  row["temperature_max_K"] = told(number_of(row, "temperature_max_K"));
  row["margin_K"] = told(rounded_down(margin, decimals));
  row["uncertainty_K"] = told(rounded_up(uncertainty, decimals));
  row["distance_cm"] =
      told(rounded_down(number_of(*judged.critical, "critical_gap_cm") - number_of(row, "gap_cm"), 3));
  return row;
}

/// The case of the scene's own launch, or else the one with the smallest critical gap, or the first.
const CaseEvidence& own_case(const std::vector<CaseEvidence>& cases) {
  return *std::ranges::min_element(cases, {}, [](const CaseEvidence& each) {
    const double gap = number_of(*each.critical, "critical_gap_cm");
    return each.is_own() ? -HUGE_VAL : std::isnan(gap) ? HUGE_VAL : gap;
  });
}

// --- what the report says ---

/// What the study answers over all cases.
Row answer_of(const StudyEvidence& study, const std::vector<CaseEvidence>& cases) {
  return {{"study", study.label},
          {"finished", study.finished()},
          {"largest_safe_gap_cm", largest_safe_in_all(cases)},
          {"cases", study::of_each(cases, told_case)}};
}

/// "300", or of a sweep over it "219 to 344": K, what the verdicts hold for.
std::string temperature_text(const StudyEvidence& main, const std::vector<CaseEvidence>& cases) {
  std::set<double> all;
  for (const CaseEvidence& each : cases) all.insert(each.value("initial_temperature"));
  if (all.empty()) all = {main.scene.scene.initial_temperature};
  return report::fixed(*all.begin(), 0) + (all.size() > 1 ? " to " + report::fixed(*all.rbegin(), 0) : "");
}

/// Of the cases of a launch, one of them in detail. Few verdicts stand on page one, and of many the cases.
void add_launch(const SafetyEvidence& evidence, const std::vector<CaseEvidence>& cases, PageFacts& all) {
  const CaseEvidence& own = own_case(cases);
  Row facts = told_case(own), verdicts = Row::array();
  facts["is_own"] = own.is_own();
  facts["told"] = cases.size() == 1 || own.is_own();
  facts["completed"] = own.completed();
  for (const Row* picture :
       selected({"", "", "launch.pictures begins file temperature with svg first 1"}, all.facts))
    all.facts["verdict_picture"] = *picture;
  if (own.completed()) {
    if (cases.size() == 1) {
      all.facts["verdict_picture"] = {{"file", "temperature.svg"}};
      all.drawings["temperature.svg"] = verdict_plot(all.facts["main"], own.study->scene.scene);
    }
    for (const Row* row : own.verdicts) facts["verdicts"].push_back(*row);
    if (evidence.stored) all.facts["pictures"] = picture_facts(*own.study, facts, *evidence.stored, all);
  }
  for (const CaseEvidence& each : cases)
    for (const Row* row : each.verdicts) verdicts.push_back(told_verdict(each, *row));
  all.facts["own"] = facts;
  all.facts[verdicts.size() <= most_rows_on_page_one ? "few" : "many"] = {
      {"verdicts", verdicts}, {"cases", all.facts["answer"]["cases"]}};
}

PageFacts facts_of(const SafetyEvidence& evidence) {
  const StudyEvidence& main = evidence.main();
  const std::vector<CaseEvidence> cases = cases_of(main);
  const bool of_launch = main.tells == tells::launch;
  PageFacts all;
  Row& facts = all.facts;
  for (const StudyEvidence& study : evidence.studies) {
    const Row told = about(study);
    facts["studies"].push_back(told);
    // With its tables.
    Row tables = study.finished() ? study.study : Row::object();
    tables.update(told);
    if (&study == evidence.find(study.tells)) facts[study.tells] = tables;
    if (&study == &main) facts["main"] = std::move(tables);
  }
  facts["scene"] = scene_facts(main);
  for (const std::string& name :
       {tells::launch, tells::sweep, tells::accuracy, tells::sensitivity, tells::stability})
    if (!facts.contains(name)) facts["missing"] = true;
  facts["temperature"] = temperature_text(main, cases);
  facts["several"] = cases.size() > 1;
  facts["answer"] = answer_of(main, of_launch ? cases : std::vector<CaseEvidence>{});
  if (of_launch) add_launch(evidence, cases, all);
  const auto rows = [&](const char* of) { return selected({"", "", of}, facts); };
  double worst = 0;
  for (const Row* row : rows("main.comparison except used_for fitted"))
    worst = std::max(worst, std::abs(number_of(*row, "temperature_max_computed_minus_published_K")));
  if (!main.rows("comparison").empty()) facts["published"]["worst_K"] = worst;
  return all;
}

}  // namespace

RenderedReport make_safety_report(const SafetyEvidence& evidence, const DrawingLimits& limits) {
  const PageFacts facts = facts_of(evidence);
  return render_page(texts_in(built_in_texts, "texts"), facts,
                     {{"format", "launchsafe safety report 4"},
                      {"title", evidence.main().title},
                      {"subject", evidence.main().scene.scene.title},
                      {"answer", facts.facts["answer"]}},
                     limits);
}

}  // namespace launchsafe::report
