#include "launchsafe/kinds/comparison.hpp"

#include "answer_tables.hpp"
#include "study_keys.hpp"

#include <fmt/format.h>

namespace launchsafe::kinds {

using study::Fault, study::StudyFile;

namespace {

const std::vector<scene::Key<ComparisonSettings>> comparison_keys{
    scene::text_key("name", scene::Standing::input, "What the scene without changes is called.",
                    "as in the scene", &ComparisonSettings::name),
    scene::text_key("description", scene::Standing::input, "What that is, a phrase.", "frictionless wall",
                    &ComparisonSettings::description),
};

/// The record of a calibration, with or without constants.
scene::Expected<study::CalibrationRecord> read_calibration_record(const StudyFile& study,
                                                                  const StudySource& source,
                                                                  const std::string& name,
                                                                  const std::string& key) {
  const auto text = read_named_file(study, source.folder, key, name, "the calibration.json of a calibration");
  if (!text) return text.error();
  return study::parse_calibration_record(*text, (source.folder / name).string());
}

/// Makes the cases of one variant after another.
struct VariantMaker {
  const StudySource& source;
  StudyFile& study;
  StudyKeys keys = joined({common_keys(), comparison_kind().keys});

  Fault add_scene_itself() {
    const auto& settings = settings_of<ComparisonSettings>(study.study);
    Variant variant{.name = settings.name, .description = settings.description};
    return add(std::move(variant), {}, {{"set", source.root.get("set")}}, source.root);
  }

  Fault add_variant(const toml::table& table, const std::string& key) {
    VariantText text;
    auto read = scene::read_table(table, variant_keys(), {"set", "accept"}, study.file, text);
    if (!read) return scene::within("vary.variants", read.error());
    for (const auto& [name, place] : *read) study.places[key + "." + name] = place;
    for (const Variant& other : variants()) {
      if (other.name == text.name)
        return fault_at(study, key + ".name", fmt::format("\"{}\" a second time", text.name),
                        "a name that no other variant has");
    }
    if (Fault fault = check_gaps(table)) return fault;
    Variant variant{.name = text.name, .description = text.description};
    if (!text.calibration.empty()) {
      auto record = read_calibration_record(study, source, text.calibration, key + ".calibration");
      if (!record) return record.error();
      variant.calibration = std::move(*record);
    }
    const bool own_constants = variant.calibration && variant.calibration->failure.empty();
    return add(std::move(variant), own_constants ? text.calibration : std::string{},
               {{"set", source.root.get("set")}, {"vary.variants.set", table.get("set")}}, table);
  }

  std::vector<Variant>& variants() { return settings_of<ComparisonSettings>(study.study).variants; }

  /// Gaps of a variant would silently do nothing.
  Fault check_gaps(const toml::table& table) const {
    const toml::node* set = table.get("set");
    if (!set || !set->is_table()) return std::nullopt;
    for (const study::Leaf& leaf : study::leaves_as_written(*set->as_table())) {
      if (leaf.name != "gap.thickness" && leaf.name != "gap.opens_by_cooling") continue;
      return scene::error_at(scene::place_of(*leaf.node, study.file), "vary.variants.set." + leaf.name,
                             "gaps of a variant", "the study's gaps, which all variants share");
    }
    return std::nullopt;
  }

  /// `calibration`: the record with the constants of the variant; empty: the study's.
  Fault add(Variant variant, const std::string& calibration, const std::vector<OverrideTable>& overrides,
            const toml::table& acceptances) {
    StudyFile own = start(calibration);
    study::AccuracyRecords records;
    if (Fault fault = settle_scene(source, overrides, own, records)) return fault;
    if (Fault fault = check_load_axes(own)) return fault;
    for (const study::Axis& axis : own.study.axes) {
      if (own.overrides.contains(axis.key.name))
        return fault_at(study, axis.study_key, axis.key.name + ", which a table of scene keys fixes",
                        axis.key.name + " either here or there");
    }
    if (Fault fault = settle_acceptances(source.root, keys, own)) return fault;
    if (&acceptances != &source.root) {
      if (Fault fault = accept_also(acceptances, own)) return fault;
    }
    if (own.study.early_time > scene::end_time(own.scene.scene.load)) {
      return fault_at(study, "early_time",
                      fmt::format("an instant after the launch of variant \"{}\"", variant.name),
                      "a time within the load's duration of every variant");
    }
    if (Fault fault = make_factorial(own)) return fault;
    return take(std::move(variant), own);
  }

  /// The study before its scene was read.
  StudyFile start(const std::string& calibration) const {
    StudyFile own;
    own.study = study.study;
    own.study.settings.reset();
    own.study.implausible.clear();
    own.study.calibration = study::shipped_calibration();
    own.study.fit_uncertainty = study::not_a_number;  // of its own calibration
    if (!calibration.empty()) own.study.calibration_record = calibration;
    own.file = study.file;
    own.places = study.places;
    own.most_cases = study.most_cases;
    return own;
  }

  /// A variant accepts for itself.
  Fault accept_also(const toml::table& table, StudyFile& own) const {
    auto accepted = scene::read_acceptances(table, scene::acceptable_keys(own.scene.scene), study.file);
    if (!accepted) return scene::within("vary.variants", accepted.error());
    for (scene::Acceptance& each : *accepted) scene::accept(own.scene.scene.accepted, std::move(each));
    return std::nullopt;
  }

  /// The cases become those of the study.
  Fault take(Variant variant, StudyFile& own) {
    const std::size_t count = study.cases.size() + own.cases.size();
    if (count > study.most_cases) {
      return fault_at(study, "vary", fmt::format("{} mechanical runs", count),
                      fmt::format("at most {} mechanical runs", study.most_cases));
    }
    if (!variant.calibration && !own.study.calibration_record.empty()) {
      auto record = read_calibration_record(study, source, own.study.calibration_record, "calibration");
      if (!record) return record.error();
      if (variants().empty()) variant.calibration = std::move(*record);
    }
    for (const auto& [key, value] : own.overrides) {
      const auto common = study.overrides.find(key);
      if (common == study.overrides.end() || common->second != value)
        variant.changes.push_back(key + " = " + value);
    }
    if (!variants().empty() && variant.changes.empty())
      return fault_at(study, "vary", fmt::format("\"{}\", which is the scene as it is", variant.name),
                      "a variant with set or calibration");
    variant.scene = own.scene.scene;
    for (study::StudyCase each : own.cases) {
      each.label = variant.name + ": " + each.label;
      each.own_conditions = each.own_conditions && variants().empty();
      study.cases.add(std::move(each));
    }
    variant.judged = std::move(own.study);
    study.records.insert(study.records.end(), own.records.begin(), own.records.end());
    variants().push_back(std::move(variant));
    return std::nullopt;
  }
};

Fault make_comparison_cases(const StudySource& source, StudyFile& study) {
  const auto tables = variants_in(source, study);
  if (!tables) return tables.error();
  VariantMaker maker{source, study};
  if (Fault fault = maker.add_scene_itself()) return fault;
  std::size_t index = 0;
  for (const toml::table* table : *tables) {
    if (Fault fault = maker.add_variant(*table, fmt::format("vary.{}.variants", index++))) return fault;
  }
  return std::nullopt;
}

void judge(const Variant& variant, const study::StudyCase& input, std::vector<study::FinishedRun>& runs,
           ComparedCase& of) {
  static_cast<study::CaseAnswer&>(of) = answer_from(variant.judged, input, runs);
  if (run_without_result(runs) != nullptr || was_cut_off(runs.front())) return;
  const run::MechanicsResult& mechanics = runs.front().result.mechanics;
  of.processor_time = mechanics.work_time();
  if (!of.completed()) return;
  const surface::SkinModel model = study::without_reaction(surface::skin_model(input.scene.scene));
  for (const double gap : variant.judged.gaps)
    of.stations.push_back(
        study::station_temperatures(surface::integrate_skin(model, mechanics.trace, gap), mechanics.trace));
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
  return std::ranges::any_of(answers, [](const ComparedCase& each) {
    return each.critical.kind == study::CriticalGapKind::indeterminate;
  });
}

ComparisonResult run_comparison(const study::StudyFile& study, const study::StudyOptions& options) {
  return run_timed<ComparisonResult>(study, options, [&](ComparisonResult& result) {
    result.answers.resize(study.cases.size());
    run_every_case(study, options, result.timing, [&](std::size_t i, std::vector<study::FinishedRun>& runs) {
      ComparedCase& of = result.answers[i];
      of.variant = i / result.cases_per_variant();
      judge(result.variants()[of.variant], study.cases[i], runs, of);
    });
  });
}

}  // namespace launchsafe::kinds
