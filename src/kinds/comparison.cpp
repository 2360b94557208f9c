// The study of kind comparison: its cases, answer, tables and page.
#include "launchsafe/kinds/comparison.hpp"

#include "study_keys.hpp"

namespace launchsafe::kinds {

using study::StationTemperature;

namespace {

const std::vector<Key<ComparisonSettings>> comparison_keys{
    text_key("name", Standing::input, "What the scene without changes is called.", "as in the scene",
             &ComparisonSettings::name),
    text_key("description", Standing::input, "What that is, a phrase.", "frictionless wall",
             &ComparisonSettings::description),
};

/// The record of a calibration. On one that failed the study rests too: that no constants were found.
CalibrationRecord read_calibration_record(StudyFile& study, const StudySource& source,
                                          const std::string& name, const std::string& key) {
  const std::string text =
      read_named_file(study, source.folder, key, name, "the calibration.json of a calibration");
  CalibrationRecord record = taken(study::parse_calibration_record(text, (source.folder / name).string()));
  if (!record.failure.empty()) study.records.push_back(store::sha256(text));
  return record;
}

/// Makes the cases of one variant after another.
struct VariantMaker {
  const StudySource& source;
  StudyFile& study;
  StudyKeys keys = joined({common_keys(), comparison_kind().keys});

  std::vector<Variant>& variants() { return settings_of<ComparisonSettings>(study.study).variants; }

  void add_variant(const toml::table& table, const std::string& key) {
    Variant variant;
    for (const auto& [name, place] :
         taken(scene::read_table(table, variant_keys(), {"set", "accept"}, study.file, variant),
               "vary.variants"))
      study.places[key + "." + name] = place;
    if (keys::find_named(variants(), variant.name) != nullptr)
      refuse_at(study, key + ".name", fmt::format("\"{}\" a second time", variant.name),
                "a name that no other variant has");
    check_gaps(table);
    if (!variant.record.empty())
      variant.calibration = read_calibration_record(study, source, variant.record, key + ".calibration");
    add(std::move(variant), &table);
  }

  /// Gaps of a variant would silently do nothing.
  void check_gaps(const toml::table& table) const {
    const toml::node* set = table.get("set");
    if (!set || !set->is_table()) return;
    for (const Leaf& leaf : study::leaves_as_written(*set->as_table()))
      if (leaf.name == "gap.thickness")
        throw error_at(scene::place_of(*leaf.node, study.file), "vary.variants.set." + leaf.name,
                       "gaps of a variant", "the study's gaps, which all variants share");
  }

  /// `table`: with the scene keys of the variant, and what it accepts; nullptr for the scene as it is.
  void add(Variant variant, const toml::table* table) {
    StudyFile own = start(variant);
    settle_scene(source,
                 {{"set", source.root.get("set")},
                  {"vary.variants.set", table == nullptr ? nullptr : table->get("set")}},
                 own);
    check_load_axes(own);
    for (const Axis& axis : own.study.axes)
      if (own.overrides.contains(axis.key.name))
        refuse_at(study, axis.study_key, axis.key.name + ", which a table of scene keys fixes",
                  axis.key.name + " either here or there");
    settle_acceptances(source.root, keys, own);
    if (table != nullptr)
      for (scene::Acceptance& each :
           taken(scene::read_acceptances(*table, scene::acceptable_keys(own.scene.scene), study.file),
                 "vary.variants"))
        scene::accept(own.scene.scene.accepted, std::move(each));
    if (own.study.early_time > scene::end_time(own.scene.scene.load))
      refuse_at(study, "early_time",
                fmt::format("an instant after the launch of variant \"{}\"", variant.name),
                "a time within the load's duration of every variant");
    make_factorial(own);
    take(std::move(variant), own);
  }

  /// The study before its scene was read; with the constants of the variant, where it has its own.
  StudyFile start(const Variant& variant) const {
    StudyFile own = study;
    own.cases = {};
    own.overrides.clear();
    own.records.clear();
    own.study.settings.reset();
    own.study.implausible.clear();
    own.study.calibration = study::shipped_calibration();
    own.study.fit_uncertainty = not_a_number;  // of its own calibration
    if (variant.calibration && variant.calibration->failure.empty())
      own.study.calibration_record = variant.record;
    return own;
  }

  void take(Variant variant, StudyFile& own) {
    const bool is_first = variants().empty();
    check_count(study, "vary", static_cast<double>(study.cases.size() + own.cases.size()), "of all variants");
    if (is_first && !own.study.calibration_record.empty())
      variant.calibration =
          read_calibration_record(study, source, own.study.calibration_record, "calibration");
    for (const auto& [key, value] : own.overrides) {
      const auto common = study.overrides.find(key);
      if (common == study.overrides.end() || common->second != value)
        variant.changes.push_back(key + " = " + value);
    }
    if (!is_first && variant.changes.empty())
      refuse_at(study, "vary", fmt::format("\"{}\", which is the scene as it is", variant.name),
                "a variant with set or calibration");
    variant.scene = own.scene.scene;
    for (StudyCase each : own.cases) {
      each.label = variant.name + ": " + each.label;
      each.own_conditions = each.own_conditions && is_first;
      study.cases.add(std::move(each));
    }
    variant.judged = std::move(own.study);
    study.records.insert(study.records.end(), own.records.begin(), own.records.end());
    variants().push_back(std::move(variant));
  }
};

void make_comparison_cases(const StudySource& source, StudyFile& study) {
  const std::vector<const toml::table*> tables = variants_in(source, study);
  VariantMaker maker{source, study};
  Variant own;
  own.name = settings_of<ComparisonSettings>(study).name;
  own.description = settings_of<ComparisonSettings>(study).description;
  maker.add(std::move(own), nullptr);
  for (std::size_t index = 0; const toml::table* table : tables)
    maker.add_variant(*table, fmt::format("vary.{}.variants", index++));
}

void judge(const Variant& variant, const StudyCase& input, std::vector<FinishedRun>& runs, ComparedCase& of) {
  static_cast<CaseAnswer&>(of) = answer_from(variant.judged, input, runs);
  if (run_without_result(runs) != nullptr || was_cut_off(runs.front())) return;
  const MechanicsResult& mechanics = runs.front().result.mechanics;
  of.processor_time = mechanics.work_time();
  if (!of.completed()) return;
  const SkinModel model = study::without_reaction(surface::skin_model(input.scene.scene));
  for (const double gap : variant.judged.gaps)
    of.stations.push_back(
        study::station_temperatures(surface::integrate_skin(model, mechanics.trace, gap), mechanics.trace));
}

// --- tables and page ---

struct CaseRow {
  const ComparisonResult* result;
  std::size_t index;

  const ComparedCase& compared() const { return result->answers[index]; }
  const std::vector<double>& coordinates() const { return result->study.cases.coordinates(index); }
  const std::string& variant() const { return result->variants()[compared().variant].name; }
  const ComparedCase& counterpart() const { return result->answers[result->counterpart(index)]; }
  /// Nothing for one of the scene as it is.
  const CaseRow* if_changed() const { return compared().variant == 0 ? nullptr : this; }
};

/// Variant, and peak pressure where there are several.
Quantities<CaseRow> place_quantities(const Study& study) {
  return joined<CaseRow>({{{quantity::variant, &CaseRow::variant}},
                          of_part<CaseRow>(report::axis_quantities(study), &CaseRow::coordinates)});
}

double hottest(const ComparedCase& each) {
  double highest = not_a_number;
  for (const GapVerdict& row : each.verdicts)
    if (!(row.heated <= highest)) highest = row.heated;
  return highest;
}

/// m by which the critical gap of a variant is above that of the scene as it is; NaN where one has none.
double shift_of(const CaseRow& row) {
  return report::value_of(row.compared().critical) - report::value_of(row.counterpart().critical);
}

Quantities<CaseRow> compared_case_quantities(const Study& study) {
  return joined<CaseRow>(
      {place_quantities(study),
       of_part<CaseRow>(report::critical_gap_quantities(), &CaseRow::compared, &CaseAnswer::critical),
       {{"critical_gap_difference", "less that of the scene", significant(3, centimetre),
         "Critical gap minus that of the scene as it is.", &CaseRow::if_changed, shift_of},
        {quantity::temperature_max_inert, &CaseRow::compared, hottest},
        {"temperature_max_inert_difference", "less that of the scene", fixed(1, kelvin),
         "The same minus that of the scene as it is.", &CaseRow::if_changed,
         [](const CaseRow& row) { return hottest(row.compared()) - hottest(row.counterpart()); }},
        {for_programs(quantity::processor_time), &CaseRow::compared, &ComparedCase::processor_time},
        {for_programs(quantity::particles), &CaseRow::compared, &CaseAnswer::run, &RunSummary::particles},
        {for_programs(quantity::steps), &CaseRow::compared, &CaseAnswer::run, &RunSummary::steps},
        {for_programs(quantity::energy_drift), &CaseRow::compared, &CaseAnswer::run,
         &RunSummary::energy_drift},
        {quantity::reason, &CaseRow::compared, gap_remark}}});
}

/// A row for every case: critical gap, hottest temperature, both less those of the scene as it is, and cost.
Table comparison_table(const ComparisonResult& result) {
  std::vector<CaseRow> rows;
  for (std::size_t i = 0; i < result.answers.size(); ++i) rows.push_back({&result, i});
  return table_of("Variants side by side", compared_case_quantities(result.study.study), rows,
                  said("comparison.note.cases"));
}

struct StationRow {
  CaseRow of;
  double gap;  ///< m
  const StationTemperature* station;
};

Quantities<StationRow> station_quantities(const Study& study) {
  return joined<StationRow>(
      {of_part<StationRow>(place_quantities(study), &StationRow::of),
       {{quantity::gap, &StationRow::gap},
        {quantity::station, &StationRow::station, &StationTemperature::name},
        {always(quantity::temperature_max_inert), &StationRow::station, &StationTemperature::temperature}}});
}

/// A row for every station of every gap and case.
Table station_table(const ComparisonResult& result) {
  std::vector<StationRow> rows;
  for (std::size_t i = 0; i < result.answers.size(); ++i) {
    const auto& stations = result.answers[i].stations;
    for (std::size_t gap = 0; gap < stations.size(); ++gap)
      for (const StationTemperature& each : stations[gap])
        rows.push_back({{&result, i}, result.study.study.gaps[gap], &each});
  }
  return table_of("T max of every station, without reaction", station_quantities(result.study.study), rows);
}

/// Stations side by side at the largest gap: a column for each variant. Peak pressures are compared in the
/// files; here the first one of every variant.
Table stations_side_by_side(const ComparisonResult& result) {
  const std::vector<double>& gaps = result.study.study.gaps;
  const auto gap = static_cast<std::size_t>(std::ranges::max_element(gaps) - gaps.begin());
  std::vector<std::string> rows;
  Quantities<std::string> quantities{{quantity::station, std::identity{}}};
  for (std::size_t i = 0; i < result.answers.size(); ++i) {
    const ComparedCase& each = result.answers[i];
    const std::vector<StationTemperature> stations =
        each.stations.empty() ? std::vector<StationTemperature>{} : each.stations[gap];
    for (const StationTemperature& station : stations)
      if (std::ranges::find(rows, station.name) == rows.end()) rows.push_back(station.name);
    if (result.counterpart(i) != 0) continue;
    const std::string& variant = result.variants()[each.variant].name;
    quantities.emplace_back(variant, variant, fixed(1), "T max of the station under that variant.",
                            [stations](const std::string& name) {
                              const auto* found = keys::find_named(stations, name);
                              return found == nullptr ? not_a_number : found->temperature;
                            });
  }
  Table table =
      table_of("T max [K] by station at " + centimetres(gaps[gap]) + ", without reaction", quantities, rows);
  if (!result.study.study.axes.empty())
    table.notes.emplace_back("Under the first peak pressure; stations.csv has the others.");
  return table;
}

}  // namespace

Kind comparison_kind() {
  return {
      .traits = {.name = "comparison", .bounds_critical_gaps = false, .own_scenes = true},
      .keys = joined({gaps_keys(), own_keys(comparison_keys), search_keys(), calibration_record_keys()}),
      .tables = {vary_table()},
      .varies = {.values = true, .variants = true, .needed = "with variants"},
      .make_cases = make_comparison_cases,
      .run = outcome_of<run_comparison, failures_of<ComparisonResult>>,
      .files = {"model_form.json", "model_form.svg"},
      .results = comparison_results,
  };
}

bool ComparisonResult::any_indeterminate() const {
  return std::ranges::any_of(
      answers, [](const ComparedCase& each) { return each.critical.kind == CriticalGapKind::indeterminate; });
}

ComparisonResult run_comparison(const StudyFile& study, const StudyOptions& options) {
  return run_timed<ComparisonResult>(study, options, [&](ComparisonResult& result) {
    result.answers.resize(study.cases.size());
    run_every_case(study, options, result.timing, [&](std::size_t i, std::vector<FinishedRun>& runs) {
      ComparedCase& of = result.answers[i];
      of.variant = i / result.cases_per_variant();
      judge(result.variants()[of.variant], study.cases[i], runs, of);
    });
  });
}

std::string answer(const ComparisonResult& result) {
  Row facts{{"variants", result.variants().size() - 1},
            {"cases", result.answers.size()},
            {"gaps", result.study.study.gaps.size()}};
  // The variant with the smallest critical gap against that of the scene as it is.
  double least = 0.0;
  std::size_t unknown = 0;
  for (std::size_t i = 0; i < result.answers.size(); ++i) {
    const std::string& label = result.study.cases[i].label;
    if (result.answers[i].variant == 0) {
      facts["own"].push_back({{"case", label}, {"critical_gap", reads_as(result.answers[i].critical)}});
      continue;
    }
    const double shift = shift_of({&result, i});
    unknown += std::isnan(shift);
    if (!(shift < least)) continue;
    least = shift;
    facts["least"] = in_words(shift, significant(3, centimetre)) + ", of " + label;
  }
  facts["unknown"] = unknown;
  return answer_of(said("comparison.answer", facts), result.study);
}

Report report_of(const ComparisonResult& result) {
  Report report{result.study.study.title, answer(result), report::remaking_command(result.study)};
  report.add({comparison_table(result), "comparison.csv", "cases"});
  report.add({station_table(result), "stations.csv", "stations", Shown::file});
  report.add({.table = stations_side_by_side(result), .shown = Shown::page});
  add_model_form(result, report);
  Row variants = Row::array();  // what each does otherwise
  for (const Variant& each : result.variants())
    variants.push_back({{"name", each.name},
                        {"description", each.description},
                        {"changes", each.changes},
                        {"failure", each.calibration ? each.calibration->failure : ""}});
  report.say("## Variants\n\n" + said_below("comparison.variants", {{"variants", variants}}));
  report.say("## What it rests on\n\n" + report::friction_remark(result.study));
  report.say(report::station_note(result.study) + "\n");
  report.say("## Setup\n\n" + report::setup_text(result.study));
  report.say(report::timing_sentence(result.timing));
  report.json =
      study_json(result.study, report,
                 {{"axes", report::axes_json(result.study.study)},
                  {"early_time_ms", shown_value(result.study.study.early_time, quantity::time(2).form)},
                  {"timing", report::timing_json(result.timing)}});
  return report;
}

std::vector<ReportTable> comparison_results() {
  std::vector<ReportTable> tables{{comparison_table(ComparisonResult()), "comparison.csv", "cases"},
                                  {station_table({}), "stations.csv", "stations"}};
  std::ranges::move(model_form_results(), std::back_inserter(tables));
  return tables;
}

}  // namespace launchsafe::kinds
