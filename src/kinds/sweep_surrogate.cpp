#include "critical_gap_tables.hpp"
#include "launchsafe/kinds/shown_surrogate.hpp"

namespace launchsafe::kinds {

using report::number;
using study::SurrogateOutput, study::SurrogateRecord;

namespace {

/// Shown numbers are SI times the scale.
double scale_of(const Form& form) { return shown_value(1.0, form) - shown_value(0.0, form); }

Row input_json(const SurrogateRecord& record, const StudyFile& study, std::size_t input,
               const math::Interval& range) {
  const ShownKey key = report::shown_axes(study.study)[input];
  const math::Distribution& distribution = record.inputs.distributions[input];
  return {{"name", key.name},
          {"heading", key.heading},
          {"unit", key.form.unit},
          {"scale", scale_of(key.form)},
          {"zero", shown_value(0.0, key.form)},
          {"from", range.lower},
          {"to", range.upper},
          {"value", study::number_in(study.scene, record.keys[input])},
          {"kind", static_cast<int>(distribution.kind)},
          {"lower", number(distribution.lower)},
          {"upper", number(distribution.upper)},
          {"centre", number(distribution.centre)},
          {"deviation", number(distribution.deviation)}};
}

Row output_json(const SurrogateRecord& record, const SurrogateOutput& output) {
  const study::Surrogate surrogate(record, output);
  const Column column = shown(output);
  const math::FittedForm& form =
      std::visit([](const auto& fit) -> const math::FittedForm& { return fit.form(); }, surrogate.fit());
  Row json{{"name", output.name},
           {"heading", column.heading},
           {"unit", column.form.unit},
           {"digits", column.form.digits},
           {"scale", scale_of(column.form)},
           {"weights", form.weights},
           {"matrix", form.matrix},
           {"offset", form.offset},
           {"error", surrogate.error_without_leverage()},
           {"largest_leverage", surrogate.largest_leverage()},
           {"degree", output.fit.chaos.degree}};
  if (const auto* process = std::get_if<math::FittedProcess>(&surrogate.fit())) {
    json["lengths"] = output.fit.process.lengths;
    json["coordinates"] = process->coordinates();
  } else {
    for (const math::ChaosTerm& term : output.fit.chaos.terms) json["terms"].push_back(term.degrees);
  }
  return json;
}

/// The page with the fit as JSON, in which no tag of the page can end.
std::string ask_page(const SurrogateRecord& record, const StudyFile& study) {
  Row fit{{"gap_cm", shown_gap(record.gap)}, {"largest_gap_cm", shown_gap(study.study.largest_gap)}};
  const std::vector<math::Interval> ranges = ranges_of(record);
  for (std::size_t input = 0; input < record.keys.size(); ++input)
    fit["inputs"].push_back(input_json(record, study, input, ranges[input]));
  if (const auto& together = record.inputs.correlated)
    fit["correlated"] = {
        {"first", together->first}, {"count", together->count}, {"factor", together->factor}};
  if (record.drawn && record.predicted(quantity::critical_gap.name) != nullptr)
    for (const study::Prediction& each : drawn_critical_gaps(record))
      fit["draws"].push_back(
          {study::nanometres(each.value), each.covered ? study::nanometres(each.error) : -1});
  Row facts{{"fitted", record.fitted()}, {"held_out", record.held_out.size()}};
  for (const SurrogateOutput& output : record.outputs) {
    if (output.reason.empty())
      fit["outputs"].push_back(output_json(record, output));
    else
      facts["open"].push_back({{"heading", shown(output).heading}, {"reason", output.reason}});
  }
  std::string data = fit.dump();
  for (std::size_t at = 0; (at = data.find('<', at)) != std::string::npos;) data.replace(at, 1, "\\u003c");
  facts["fit"] = data;
  return report::filled(ask_template(), {&facts});
}

constexpr std::size_t most_launches = 2000, fewest_values = 4;

/// Values of an axis whose cases are held out.
std::vector<double> held_out_values(const Axis& axis) {
  std::vector<double> values = axis.values, held_out;
  std::ranges::sort(values);
  for (std::size_t i = 2; i + 1 < values.size(); i += 3) held_out.push_back(values[i]);
  return held_out;
}

/// Over a decade the logarithm is the smoother coordinate.
math::Distribution range_of_axis(const Axis& axis) {
  constexpr double decade = 10.0;
  const auto [lower, upper] = std::ranges::minmax(axis.values);
  return lower > 0.0 && upper >= decade * lower ? math::Distribution::log_uniform(lower, upper)
                                                : math::Distribution::uniform(lower, upper);
}

void check_axis(const StudyFile& study, const Axis& axis) {
  if (axis.key.dimension == Dimension::count)
    refuse_at(study, axis.study_key, axis.key.name + ", a whole number, in a study with surrogate = true",
              "a key that may take any number between two");
  // What a launch may change by a leap with.
  const keys::Part part = axis.key.role().part;
  if (part == keys::Part::setting || part == keys::Part::minor_setting ||
      axis.key.name == "charge.face_friction" || axis.key.name == "charge.crack_friction")
    refuse_at(study, axis.study_key,
              axis.key.name + ", with which launches may change by leaps, in a study with surrogate = true",
              "keys with which they change smoothly: pressures, times, temperatures, sizes");
  if (axis.values.size() < fewest_values)
    refuse_at(study, axis.values_key,
              fmt::format("{} values in a study with surrogate = true", axis.values.size()),
              fmt::format("at least {}: one between others is held out", fewest_values));
}

SurrogateOutput temperature_output(const CriticalGapResult& result, std::size_t gap) {
  const std::vector<double>& gaps = result.study.study.gaps;
  const bool inert = any_ignites(result.answers, gap);
  SurrogateOutput output{.name = quantity::temperature_max.name,
                         .gap = gaps[gap],
                         .inert = inert,
                         .values = of_each(result.answers, [&](const auto& answer) {
                           return temperature_of(answer, gap, inert);
                         })};
  if (gaps.size() > 1) output.name += fmt::format("_{:.6g}cm", shown_gap(gaps[gap]));
  return output;
}

SurrogateOutput critical_gap_output(const CriticalGapResult& result) {
  return {.name = quantity::critical_gap.name,
          .values = of_each(result.answers, critical_gap_number),
          .reason = gap_reason(result.answers)};
}

const Quantities<SurrogateOutput> surrogate_quantities = joined<SurrogateOutput>(
    {{{quantity::output, &SurrogateOutput::name},
      {quantity::unit, [](const SurrogateOutput& output) { return shown(output).form.unit; }}},
     fit_quantities(),
     {{quantity::reason, &SurrogateOutput::reason}}});

}  // namespace

Column shown(const SurrogateOutput& output) {
  if (output.name == quantity::critical_gap.name) return {output.name, "critical gap", fixed(5, centimetre)};
  std::string heading = "T max at a gap of " + centimetres(output.gap);
  if (output.inert) heading += ", without reaction";
  return {output.name, std::move(heading), fixed(1, kelvin)};
}

Quantities<SurrogateOutput> fit_quantities() {
  using math::PolynomialChaos, study::HeldOutError, study::SurrogateFit;
  const auto fitted = [](const SurrogateOutput& output) {
    return output.fit.chaos.points > 0 ? &output : nullptr;
  };
  const auto in_unit = [](auto get) {
    return [=](const SurrogateOutput& output) { return shown_value(get(output), shown(output).form); };
  };
  return {{"fitted", "fitted", count(), "Evaluations that were fitted.", fitted, &SurrogateOutput::fit,
           &SurrogateFit::chaos, &PolynomialChaos::points},
          {"fit", "fit", text(), "What predicts: the one with the smaller leave-one-out error.", fitted,
           &SurrogateOutput::fit,
           [](const SurrogateFit& fit) { return fit.by_process() ? "Gaussian process" : "polynomial"; }},
          {"terms", "terms", count(), "Terms of the polynomial.", fitted,
           [](const SurrogateOutput& output) { return output.fit.chaos.terms.size(); }},
          {"leave_one_out", "leave-one-out error", significant(2), "Root mean square, of the polynomial.",
           fitted, in_unit([](const SurrogateOutput& output) { return output.fit.chaos.leave_one_out; })},
          {"process_leave_one_out", "of the process", significant(2), "The same of the Gaussian process.",
           fitted, in_unit([](const SurrogateOutput& output) {
             const math::GaussianProcess& process = output.fit.process;
             return process.reason.empty() ? process.leave_one_out : not_a_number;
           })},
          {"held_out", "held out", count(), "Evaluations that were not fitted.", fitted,
           &SurrogateOutput::error, &HeldOutError::launches},
          {"held_out_error", "error there", significant(2), "Root mean square of the fit's error there.",
           fitted, in_unit([](const SurrogateOutput& output) { return output.error.root_mean_square; })},
          {"held_out_largest", "largest there", significant(2), "Largest error of the fit there.", fitted,
           in_unit([](const SurrogateOutput& output) { return output.error.largest; })}};
}

std::string gap_reason(const std::vector<CaseAnswer>& answers, std::string otherwise) {
  if (const auto bounds = std::ranges::count_if(answers, is_bound))
    otherwise = fmt::format("{} of {} critical gaps are bounds, not numbers", bounds, answers.size());
  const auto first = std::ranges::find_if(
      answers, [](const CaseAnswer& answer) { return std::isnan(critical_gap_number(answer)); });
  if (otherwise.empty() || first == answers.end()) return otherwise;
  return fmt::format("{} (the first without a number: {})", otherwise, gap_remark(*first));
}

void predict_from_sound_launches(SurrogateRecord& record, const std::vector<CaseAnswer>& answers) {
  if (const std::size_t failed = count_failed(answers); failed > 0)
    for (SurrogateOutput& output : record.outputs)
      output.reason = fmt::format("{} of {} launches failed", failed, answers.size());
  const auto has_warnings = [](const CaseAnswer& answer) { return !answer.validity_warnings.empty(); };
  const auto unsound = std::ranges::count_if(answers, has_warnings);
  if (unsound == 0) return;
  const CaseAnswer& first = *std::ranges::find_if(answers, has_warnings);
  for (SurrogateOutput& output : record.outputs)
    if (output.reason.empty())
      output.reason = fmt::format("{} of {} launches have validity warnings, such as: {}", unsound,
                                  answers.size(), first.validity_warnings.front());
}

std::vector<report::TextFile> surrogate_files(const SurrogateRecord& record, const StudyFile& study) {
  return {{"surrogate.json", to_json_text(record)}, {"ask.html", ask_page(record, study)}};
}

void check_sweep_surrogate(const StudyFile& study) {
  const std::vector<Axis>& axes = study.study.axes;
  if (axes.empty())
    refuse_at(study, "surrogate", "nothing that varies", "a [[vary]] for every input of the fit");
  std::size_t all = 1, fitted = 1;
  for (const Axis& axis : axes) {
    check_axis(study, axis);
    all *= axis.values.size();
    fitted *= axis.values.size() - held_out_values(axis).size();
  }
  const std::size_t fewest = math::fewest_chaos_points(axes.size());
  if (all - fitted < study::fewest_held_out || fitted < fewest || all > most_launches)
    refuse_at(study, "surrogate",
              fmt::format("{} cases, {} to be fitted and {} between these to be held out", all, fitted,
                          all - fitted),
              fmt::format("up to {} cases, at least {} of them fitted and {} held out", most_launches, fewest,
                          study::fewest_held_out));
}

SurrogateRecord sweep_surrogate(const CriticalGapResult& result) {
  const StudyFile& study = result.study;
  SurrogateRecord record{.scene = study.scene.scene, .gap = study.study.gaps.back(), .drawn = false};
  scene::clear_remarks(record.scene);
  std::vector<std::vector<double>> held_out;
  for (const Axis& axis : study.study.axes) {
    record.keys.push_back(axis.key.name);
    record.inputs.distributions.push_back(range_of_axis(axis));
    held_out.push_back(held_out_values(axis));
  }
  for (std::size_t row = 0; row < result.answers.size(); ++row) {
    const std::vector<double>& values = study.cases.coordinates(row);
    const std::vector<double> point = record.inputs.point_of(values);
    record.points.insert(record.points.end(), point.begin(), point.end());
    bool is_held_out = false;
    for (std::size_t i = 0; i < values.size(); ++i)
      is_held_out = is_held_out || std::ranges::find(held_out[i], values[i]) != held_out[i].end();
    if (is_held_out) record.held_out.push_back(row);
  }
  for (std::size_t gap = 0; gap < study.study.gaps.size(); ++gap)
    fit_output(record, record.outputs.emplace_back(temperature_output(result, gap)));
  SurrogateOutput& critical = record.outputs.emplace_back(critical_gap_output(result));
  if (critical.reason.empty()) {
    fit_output(record, critical);
    critical.reason = gap_reason(result.answers, critical.reason);
  }
  predict_from_sound_launches(record, result.answers);
  return record;
}

Table surrogate_table(const SurrogateRecord& record) {
  return table_of("What the fit of these cases misses", surrogate_quantities, record.outputs,
                  said("critical_gap.surrogate"));
}

}  // namespace launchsafe::kinds
