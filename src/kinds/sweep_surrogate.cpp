#include "sweep_surrogate.hpp"

#include "answer_values.hpp"
#include "kind_texts.hpp"
#include "launchsafe/kinds/shown_surrogate.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/run/model_version.hpp"
#include "surrogate_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace launchsafe::kinds {

using study::Axis, study::Fault, study::StudyFile, study::SurrogateOutput, study::SurrogateRecord;
namespace quantity = report::quantity;

namespace {

constexpr std::size_t fewest_held_out = 30, most_launches = 2000, fewest_values = 4;

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

/// What a launch may change by a leap with.
bool is_cliff(const scene::KeyDescription& key) {
  const keys::Part part = key.role().part;
  return part == keys::Part::setting || part == keys::Part::minor_setting ||
         key.name == "charge.face_friction" || key.name == "charge.crack_friction";
}

/// A fit over what the reservoir says would answer for gaps of which it is not the model.
Fault check_gap_model(const StudyFile& study) {
  if (study.scene.scene.surface.model == scene::GapModel::reservoir) return std::nullopt;
  return fault_at(study, "surrogate", "true for a gap that closes",
                  "surrogate = false, or gap.model = \"reservoir\"");
}

Fault check_axis(const StudyFile& study, const Axis& axis) {
  if (axis.key.dimension == scene::Dimension::count)
    return fault_at(study, axis.study_key,
                    axis.key.name + ", a whole number, in a study with surrogate = true",
                    "a key that may take any number between two");
  if (is_cliff(axis.key))
    return fault_at(
        study, axis.study_key,
        axis.key.name + ", with which launches may change by leaps, in a study with surrogate = true",
        "keys with which they change smoothly: pressures, times, temperatures, sizes");
  if (axis.values.size() < fewest_values)
    return fault_at(study, axis.values_key,
                    fmt::format("{} values in a study with surrogate = true", axis.values.size()),
                    fmt::format("at least {}: one between others is held out", fewest_values));
  return std::nullopt;
}

SurrogateOutput temperature_output(const CriticalGapResult& result, std::size_t gap) {
  const std::vector<double>& gaps = result.study.study.gaps;
  SurrogateOutput output{
      .name = quantity::temperature_max().name, .gap = gaps[gap], .inert = any_ignites(result.answers, gap)};
  if (gaps.size() > 1) output.name += fmt::format("_{:.6g}cm", report::shown_gap(gaps[gap]));
  for (const study::CaseAnswer& answer : result.answers)
    output.values.push_back(temperature_of(answer, gap, output.inert));
  return output;
}

SurrogateOutput critical_gap_output(const CriticalGapResult& result) {
  SurrogateOutput output{.name = quantity::critical_gap().name};
  for (const study::CaseAnswer& answer : result.answers)
    output.values.push_back(answer.completed() ? answer.critical.value : study::not_a_number);
  if (const auto bounds = std::ranges::count_if(result.answers, is_bound))
    output.reason = bounds_reason(static_cast<std::size_t>(bounds), result.answers.size());
  return output;
}

report::Quantities<FitRow> surrogate_quantities() {
  return keys::joined<FitRow>({{{quantity::output(), [](const FitRow& row) { return row.shown.name; }},
                                {quantity::unit(), [](const FitRow& row) { return row.shown.form.unit; }}},
                               fit_quantities(),
                               {{quantity::reason(), [](const FitRow& row) { return row.fit->reason; }}}});
}

}  // namespace

Fault check_sweep_surrogate(const StudyFile& study) {
  const std::vector<Axis>& axes = study.study.axes;
  if (Fault fault = check_gap_model(study)) return fault;
  if (axes.empty())
    return fault_at(study, "surrogate", "nothing that varies", "a [[vary]] for every input of the fit");
  for (const Axis& axis : axes)
    if (Fault fault = check_axis(study, axis)) return fault;
  std::size_t all = 1, fitted = 1;
  for (const Axis& axis : axes) {
    all *= axis.values.size();
    fitted *= axis.values.size() - held_out_values(axis).size();
  }
  const std::size_t fewest = math::fewest_chaos_points(axes.size());
  if (all - fitted >= fewest_held_out && fitted >= fewest && all <= most_launches) return std::nullopt;
  return fault_at(
      study, "surrogate",
      fmt::format("{} cases, {} to be fitted and {} between these to be held out", all, fitted, all - fitted),
      fmt::format("up to {} cases, at least {} of them fitted and {} held out", most_launches, fewest,
                  fewest_held_out));
}

SurrogateRecord sweep_surrogate(const CriticalGapResult& result) {
  const StudyFile& study = result.study;
  SurrogateRecord record{.model_version = run::model_version,
                         .scene = study.scene.scene,
                         .gap = study.study.gaps.back(),
                         .drawn = false};
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
    record.outputs.push_back(temperature_output(result, gap));
  record.outputs.push_back(critical_gap_output(result));
  for (SurrogateOutput& output : record.outputs)
    if (output.reason.empty()) fit_output(record, output, fewest_held_out);
  return record;
}

std::vector<report::Column> surrogate_columns() { return keys::described(surrogate_quantities()); }

report::Table surrogate_table(const SurrogateRecord& record) {
  std::vector<FitRow> rows;
  for (const SurrogateOutput& output : record.outputs) rows.push_back({shown(output), &output});
  report::Table table = report::table_of("What the fit of these cases misses", surrogate_quantities(), rows);
  table.notes = said("critical_gap.surrogate");
  return table;
}

}  // namespace launchsafe::kinds
