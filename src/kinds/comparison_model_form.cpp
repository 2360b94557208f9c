#include "study_keys.hpp"

namespace launchsafe::kinds {

using study::ModelAlternative, study::ModelFormEntry, study::ModelFormRecord, study::StationConvergence;

namespace {

/// The models with their critical gaps, and the record made of them.
struct ModelForm {
  std::vector<ModelFormEntry> entries;  ///< the default first
  ModelFormRecord record;
  double largest_gap;  ///< m, where the searches ended
};

/// "0.0395", "none to 0.3", "ignites without a gap" or "not known"; cm.
std::string gap_text(study::GapOrBound gap, double largest) {
  if (std::isnan(gap)) return "not known";
  if (gap == study::no_ignition) return "none to " + digits_of(largest, significant(3, centimetre));
  if (gap == 0.0) return "ignites without a gap";
  return digits_of(gap, significant(4, centimetre));
}

/// m; critical gaps are bracketed to a tenth of it.
constexpr double least_shift = 1e-6;

/// Pressures at which an alternative ignites at smaller gaps than the default, in MPa.
std::string towards_ignition(const ModelFormRecord& record, const ModelAlternative& alternative) {
  std::vector<std::string> pressures;
  for (std::size_t i = 0; i < record.peak_pressures.size(); ++i)
    if (alternative.critical_gap[i] < record.critical_gap[i] - least_shift)
      pressures.push_back(digits_of(record.peak_pressures[i], quantity::peak_pressure.form));
  return fmt::format("{}", fmt::join(pressures, ", "));
}

std::string counts_for(const ModelFormRecord& record, const ModelAlternative* alternative) {
  if (alternative == nullptr) return "the default";
  if (!alternative->not_counted.empty()) return "no share; named only: " + alternative->not_counted;
  const std::string pressures = towards_ignition(record, *alternative);
  if (pressures.empty()) return "no share: nowhere towards ignition by more than " + centimetres(least_shift);
  return "a share: towards ignition at " + pressures + " " + quantity::peak_pressure.form.unit;
}

/// What is said of a model, or of all that count.
struct ModelRow {
  std::string name, title;
  std::vector<std::string> gaps;  ///< at every pressure
  std::string counts_as;
};

Quantities<ModelRow> model_quantities(const std::vector<double>& pressures) {
  Quantities<ModelRow> quantities{
      {for_programs(Column{"model", "name", text(), "The model."}), &ModelRow::name},
      {"what_it_is", "model", text(), "What it does otherwise.", &ModelRow::title}};
  for (std::size_t i = 0; i < pressures.size(); ++i) {
    const std::string pressure = in_words(pressures[i], quantity::peak_pressure.form);
    quantities.emplace_back("critical_gap_at_" + keys::key_text(pressure), pressure, text(),
                            "Critical gap, cm, or its bound at that peak pressure.",
                            [i](const ModelRow& row) { return row.gaps[i]; });
  }
  quantities.emplace_back("counts_as", "counts as", text(), "Whether verdicts carry a share for it.",
                          &ModelRow::counts_as);
  return quantities;
}

Table model_form_table(const ModelForm& form) {
  std::vector<ModelRow> rows;
  for (const ModelFormEntry& each : form.entries) {
    const auto text = [&](study::GapOrBound gap) { return gap_text(gap, form.largest_gap); };
    rows.push_back({each.name, each.title, of_each(each.critical_gap, text),
                    counts_for(form.record, keys::find_named(form.record.alternatives, each.name))});
  }
  ModelRow shift{"shift", "of a SAFE's gap towards ignition", {}, "the largest of the models that count"};
  for (const double pressure : form.record.peak_pressures) {
    Scene scene = form.record.scene;
    scene.load.peak = pressure;
    const auto most = study::model_form_shift(form.record, scene);
    shift.gaps.push_back(std::isnan(most.gap) ? "not known"
                                              : digits_of(most.gap, significant(3, centimetre)));
  }
  rows.push_back(std::move(shift));
  return table_of("Critical gap [cm] by model and peak pressure",
                  model_quantities(form.record.peak_pressures), rows);
}

using CalibratedModel = const ModelFormEntry*;

Quantities<CalibratedModel> model_constant_quantities() {
  using scene::Surface;
  const Quantities<Scene> of_scene{
      {quantity::load_peak_time, &Scene::load, &Load::peak_time},
      {quantity::load_width, &Scene::load, &Load::width},
      {quantity::load_steepness, &Scene::load, &Load::steepness},
      {quantity::localisation, &Scene::surface, &Surface::localisation},
      {quantity::exchange_time, &Scene::surface, &Surface::exchange_time},
      {"ignition_temperature", "T1", significant(6, kelvin), "Ignition temperature.",
       [](const Scene& scene) { return scene.charge().kinetics.ignition_temperature; }}};
  const Quantities<CalibrationRecord> of_record{
      {"selection_rms", "RMS of selection", significant(4, kelvin), quantity::selection_rms.meaning,
       &CalibrationRecord::selection_root_mean_square},
      {"misfit_bound", "95 % of misfits below", significant(3, kelvin),
       "Bound of the misfits of what nothing was fitted to.", &CalibrationRecord::misfit_bound},
      {quantity::change_to_finer, &CalibrationRecord::stations, &StationConvergence::finer},
      {quantity::change_from_coarser, &CalibrationRecord::stations, &StationConvergence::coarser},
      {"stations_converge", "stations converge", text(), "Whether they settle as cells shrink.",
       &CalibrationRecord::stations, &StationConvergence::converges}};
  return joined<CalibratedModel>(
      {{{for_programs(Column{"model", "name", text(), "The model."}), &ModelFormEntry::name},
        {"what_it_is", "model", text(), "What it does otherwise.", &ModelFormEntry::title}},
       of_part<CalibratedModel>(of_scene, &ModelFormEntry::calibration, &CalibrationRecord::calibration,
                                &study::Calibration::scene),
       of_part<CalibratedModel>(of_record, &ModelFormEntry::calibration)});
}

Table model_constants_table(const ModelForm& form) {
  std::vector<CalibratedModel> rows;
  for (const ModelFormEntry& each : form.entries)
    if (each.calibration->failure.empty()) rows.push_back(&each);
  return table_of("Constants of each model, calibrated by the same rule", model_constant_quantities(), rows,
                  said("comparison.note.constants"));
}

/// Where models differ most, and where least.
std::string apart_text(const ModelForm& form) {
  std::vector<std::pair<double, double>> apart;  ///< m, at Pa
  for (std::size_t i = 0; i < form.record.peak_pressures.size(); ++i) {
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (const ModelFormEntry& each : form.entries) {
      if (i >= each.critical_gap.size() || !std::isfinite(each.critical_gap[i])) continue;
      least = std::min<double>(least, each.critical_gap[i]);
      most = std::max<double>(most, each.critical_gap[i]);
    }
    if (least <= most) apart.emplace_back(most - least, form.record.peak_pressures[i]);
  }
  if (apart.empty()) return "Critical gap by model";
  const auto [least, most] = std::ranges::minmax(apart);
  const auto text = [](const std::pair<double, double>& each) {
    return fmt::format("{} at {}", digits_of(each.first, significant(2, centimetre)) + " cm",
                       in_words(each.second, quantity::peak_pressure.form));
  };
  return fmt::format("Models differ by {}, by {}", text(most), text(least));
}

/// Models that would lie on the default's line are named; those without a share in verdicts are grey.
Plot model_form_plot(const ModelForm& form) {
  constexpr int grey = 7;
  constexpr double seen = 2e-6;  // m
  const auto is_near = [](double a, double b) { return std::abs(a - b) < seen; };
  int coloured = 0;
  Plot plot{.title = apart_text(form),
            .x = {.label = headed("peak pressure", quantity::peak_pressure).label()},
            .y = {.label = quantity::critical_gap.label(), .minimum = 0.0},
            .width = 1100,
            .height = 620,
            .subtitle = "each calibrated by the same rule",
            .named_in_place = true};
  const auto peak_of = [](const ModelFormEntry& each) {
    return each.calibration->calibration.scene.load.peak;
  };
  const double peak = peak_of(form.entries.front());
  if (std::ranges::all_of(form.entries, [&](const auto& each) { return peak_of(each) == peak; }))
    plot.vertical_lines = {{shown_value(peak, quantity::peak_pressure.form), "all calibrated here"}};
  std::vector<std::string> alike;
  for (const ModelFormEntry& each : form.entries) {
    Series series{each.title, {}, {}, Style::line_and_points};
    const ModelAlternative* alternative = keys::find_named(form.record.alternatives, each.name);
    if (alternative == nullptr) {
      series.label += " (default)";
    } else if (std::ranges::equal(each.critical_gap, form.entries.front().critical_gap, is_near)) {
      alike.push_back(series.label);
      continue;
    }
    if (alternative != nullptr && towards_ignition(form.record, *alternative).empty()) {
      series.label += ": no share in verdicts";
      series.style = Style::dashed_line;
      series.colour = grey;
    } else {
      series.colour = coloured++ % grey;
    }
    for (std::size_t i = 0; i < each.critical_gap.size(); ++i) {
      if (!std::isfinite(each.critical_gap[i])) continue;
      series.add(shown_value(form.record.peak_pressures[i], quantity::peak_pressure.form),
                 shown_gap(each.critical_gap[i]));
    }
    if (!series.x.empty()) plot.series.push_back(std::move(series));
  }
  if (!alike.empty())
    plot.subtitle += fmt::format("; within {} of the default: {}", centimetres(seen), fmt::join(alike, ", "));
  return plot;
}

/// Of a comparison over peak pressures whose variants all name the record of a calibration; or why there is
/// none, a clause. The comparison has to live as long as what is made of it.
scene::Expected<ModelForm, std::string> model_form_of(const ComparisonResult& result) {
  ModelForm form{{}, {}, result.study.study.largest_gap};
  // The cases of the scene as it is by increasing pressure; those of variants are in the same order.
  const auto pressure_of = [&](std::size_t i) { return result.study.cases[i].peak_pressure; };
  const std::vector<std::size_t> order = study::places_by(result.cases_per_variant(), pressure_of);
  for (const Variant& each : result.variants()) {
    const std::size_t first = form.entries.size() * result.cases_per_variant();
    const auto gap = [&](std::size_t i) { return gap_or_bound(result.answers[first + i].critical); };
    form.entries.push_back({each.name, each.description.empty() ? each.name : each.description,
                            &*each.calibration, each.scene, of_each(order, gap)});
  }
  auto made = make_model_form(form.entries, of_each(order, pressure_of));
  if (!made) return made.error();
  form.record = std::move(*made);
  return form;
}

}  // namespace

void add_model_form(const ComparisonResult& result, Report& report) {
  // Whether the variants are models that were calibrated: all, or there is nothing to say of models.
  const bool is_of_models = std::ranges::all_of(
      result.variants(), [](const Variant& each) { return each.calibration.has_value(); });
  if (!is_of_models || result.study.study.axes.empty()) return;
  const auto form = model_form_of(result);
  if (!form) return report.say("There is no record of other models: " + form.error() + ".\n");
  report.files.push_back({"model_form.json", to_json_text(form->record)});
  report.say("## Other models\n\n" + said_below("comparison.models"));
  report.add({model_form_table(*form), "model_form.csv", "models"});
  report.draw({"model_form.svg", model_form_plot(*form), "critical gap by model"});
  report.add({model_constants_table(*form), "", "constants", Shown::page});
}

std::vector<ReportTable> model_form_results() {
  return {{table_of({}, model_quantities({}), {}), "model_form.csv", "models"},
          {table_of({}, model_constant_quantities(), {}), "", "constants"}};
}

}  // namespace launchsafe::kinds
