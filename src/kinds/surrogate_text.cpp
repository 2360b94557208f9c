#include "surrogate_text.hpp"

#include "kind_texts.hpp"
#include "launchsafe/kinds/shown_surrogate.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/shown_key.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/study/study_cases.hpp"

#include <fmt/format.h>

#include <functional>
#include <optional>

namespace launchsafe::kinds {

using report::number, report::Row, report::shown_value;
using study::StudyFile, study::SurrogateOutput, study::SurrogateRecord;

report::Column shown(const SurrogateOutput& output) {
  if (output.name == report::quantity::critical_gap().name)
    return {output.name, "critical gap", keys::fixed(5, keys::centimetre)};
  std::string heading = "T max at a gap of " + report::centimetres(output.gap);
  if (output.inert) heading += ", without reaction";
  return {output.name, std::move(heading), keys::fixed(1, keys::kelvin)};
}

report::Quantities<FitRow> fit_quantities() {
  using keys::count, keys::significant, keys::text;
  const auto is_fitted = [](const FitRow& row) { return row.fit && row.fit->fit.chaos.points > 0; };
  const auto of_fit = [=](auto get) {
    return [=](const FitRow& row) {
      return is_fitted(row) ? std::optional(std::invoke(get, *row.fit)) : std::nullopt;
    };
  };
  const auto error_of = [=](auto get) {
    return [=](const FitRow& row) {
      return is_fitted(row) ? shown_value(std::invoke(get, *row.fit), row.shown.form) : study::not_a_number;
    };
  };
  return {{{"fitted", "fitted", count(), "Evaluations that were fitted."},
           of_fit([](const SurrogateOutput& output) { return output.fit.chaos.points; })},
          {{"fit", "fit", text(), "What predicts: the one with the smaller leave-one-out error."},
           [=](const FitRow& row) {
             if (!is_fitted(row)) return "";
             return row.fit->fit.by_process() ? "Gaussian process" : "polynomial";
           }},
          {{"terms", "terms", count(), "Terms of the polynomial."},
           of_fit([](const SurrogateOutput& output) { return output.fit.chaos.terms.size(); })},
          {{"leave_one_out", "leave-one-out error", significant(2), "Root mean square, of the polynomial."},
           error_of([](const SurrogateOutput& output) { return output.fit.chaos.leave_one_out; })},
          {{"process_leave_one_out", "of the process", significant(2), "The same of the Gaussian process."},
           error_of([](const SurrogateOutput& output) {
             const math::GaussianProcess& process = output.fit.process;
             return process.reason.empty() ? process.leave_one_out : study::not_a_number;
           })},
          {{"held_out", "held out", count(), "Evaluations that were not fitted."},
           of_fit([](const SurrogateOutput& output) { return output.error.launches; })},
          {{"held_out_error", "error there", significant(2), "Root mean square of the fit's error there."},
           error_of([](const SurrogateOutput& output) { return output.error.root_mean_square; })},
          {{"held_out_largest", "largest there", significant(2), "Largest error of the fit there."},
           error_of([](const SurrogateOutput& output) { return output.error.largest; })}};
}

namespace {

/// Shown numbers are SI times the scale.
double scale_of(const keys::Form& form) { return shown_value(1.0, form) - shown_value(0.0, form); }

Row input_json(const SurrogateRecord& record, const StudyFile& study, std::size_t input) {
  const report::ShownKey key = report::shown_axes(study.study)[input];
  const math::Distribution& distribution = record.inputs.distributions[input];
  const study::InputRange range = range_of(record, input);
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
  const report::Column column = shown(output);
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
  Row fit{{"gap_cm", report::shown_gap(record.gap)},
          {"largest_gap_cm", report::shown_gap(study.study.largest_gap)}};
  for (std::size_t input = 0; input < record.keys.size(); ++input)
    fit["inputs"].push_back(input_json(record, study, input));
  if (const auto& together = record.inputs.correlated)
    fit["correlated"] = {
        {"first", together->first}, {"count", together->count}, {"factor", together->factor}};
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

}  // namespace

std::string bounds_reason(std::size_t bounds, std::size_t all) {
  return fmt::format("{} of {} critical gaps are bounds, not numbers", bounds, all);
}

std::vector<report::TextFile> surrogate_files(const SurrogateRecord& record, const StudyFile& study) {
  return {{"surrogate.json", to_json_text(record)}, {"ask.html", ask_page(record, study)}};
}

}  // namespace launchsafe::kinds
