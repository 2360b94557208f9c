// A critical-gap study as one JSON object.
#include "launchsafe/kinds/critical_gap_report.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/report/verdict_text.hpp"

#include <nlohmann/json.hpp>

namespace launchsafe::kinds {

using namespace study;
using namespace report;
namespace {

using Json = nlohmann::ordered_json;

/// The comparison with the published row; nulls where there is none.
void add_reference(Json& json, const study::GapVerdict& row) {
  const study::Reference paper = row.reference.value_or(study::Reference{});
  json["paper_K"] = number(paper.maximum_temperature);
  json["computed_minus_published_K"] = number(row.misfit());
  json["paper_10ms_K"] = number(paper.early_temperature);
  json["computed_minus_published_10ms_K"] = number(row.early_misfit());
  json["paper_ignition_ms"] = number(1e3 * paper.ignition_time);
  json["used_for"] = row.reference ? Json(used_for(paper)) : Json(nullptr);
}

Json json_of(const study::GapVerdict& row, const study::StudyCase& input) {
  Json json{{"gap_cm", number(100.0 * row.gap)},
            {"peak_pressure_MPa", number(1e-6 * input.peak_pressure)},
            {"crack_radius_um", number(1e6 * input.crack_radius)},
            {"flaw_size_mm", number(1e3 * input.flaw_size)}};
  add_verdict(json, row);
  add_reference(json, row);
  return json;
}

Json json_of(const study::Line& line) {
  Json residuals = Json::array();
  for (const double residual : line.residuals) residuals.push_back(number(residual));
  return {{"slope_K_per_cm", number(line.slope)},
          {"intercept_K", number(line.intercept)},
          {"residuals_K", std::move(residuals)},
          {"rms_K", number(line.root_mean_square)}};
}

Json json_of(const std::optional<study::GapFit>& fit) {
  if (!fit) return nullptr;
  Json json = json_of(fit->ordinary);
  json["slope_standard_error_K_per_cm"] = number(fit->least_squares.standard_errors[1]);
  json["intercept_standard_error_K"] = number(fit->least_squares.standard_errors[0]);
  json["r_squared"] = number(fit->least_squares.r_squared);
  json["residual_deviation_K"] = number(fit->least_squares.residual_deviation);
  json["gaps_cm"] = Json::array();
  for (const double gap : fit->gaps) json["gaps_cm"].push_back(number(100.0 * gap));
  json["mixed"] = fit->mixed ? json_of(*fit->mixed) : Json(nullptr);
  json["published"] = fit->published ? json_of(*fit->published) : Json(nullptr);
  return json;
}

Json json_of(const study::Confirmation& each) {
  return {{"gap_cm", number(100.0 * each.gap)},
          {"expected_ignition", each.expected_ignition},
          {"completed", each.completed},
          {"ignited", each.completed ? Json(each.ignited) : Json(nullptr)},
          {"T_max_K", number(each.maximum_temperature)},
          {"coupled_minus_traced_K", number(each.difference)},
          {"reason", each.failure}};
}

Json verdicts_of(const CaseOutcome& outcome) {
  Json rows = Json::array();
  for (const study::GapVerdict& row : outcome.verdicts) rows.push_back(json_of(row, outcome.input));
  return rows;
}

Json json_of(const CaseOutcome& outcome) {
  const run::MechanicsResult& run = outcome.result.mechanics;
  Json json{{"case", outcome.input.label},
            {"status", outcome.completed() ? "completed" : outcome.failure},
            {"energy_drift", number(run::largest_energy_drift(run))},
            {"updates_per_second", number(run.update_rate())},
            {"critical_gap", critical_gap_json(outcome.critical)},
            {"confirmations", Json::array()},
            {"fit", json_of(outcome.fit)}};
  for (const study::Confirmation& each : outcome.confirmations)
    json["confirmations"].push_back(json_of(each));
  json["stored_case"] = outcome.completed() ? Json("cases/" + outcome.hash + ".h5") : Json(nullptr);
  return json;
}

/// The critical gap of the whole study: the only case's, or else nothing that one number could say.
Json overall(const CriticalGapResult& result) {
  if (result.cases.size() == 1) return critical_gap_json(result.cases.front().critical);
  study::CriticalGap none;
  none.reason = "several cases, each with its own critical gap: see cases";
  Json json = critical_gap_json(none);
  json["kind"] = "several";
  return json;
}

}  // namespace

Json to_json(const CriticalGapResult& result) {
  Json json{{"kind", "critical-gap"},
            {"study", study_file_name(result.study)},
            {"title", result.study.study.title},
            {"answer", answer(result)},
            {"critical_gap", overall(result)},
            {"air_models", to_json(air_model_table(result))["rows"]},
            {"cited_limits", to_json(cited_limit_table(result))["rows"]},
            {"verdicts", Json::array()},
            {"fit", nullptr},
            {"timing", timing_json(result.timing)},
            {"cases", Json::array()}};
  for (const CaseOutcome& outcome : result.cases) {
    for (Json& row : verdicts_of(outcome)) json["verdicts"].push_back(std::move(row));
    json["cases"].push_back(json_of(outcome));
  }
  if (result.cases.size() == 1) json["fit"] = json_of(result.cases.front().fit);
  return json;
}

}  // namespace launchsafe::kinds
