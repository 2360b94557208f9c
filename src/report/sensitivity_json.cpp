// A sensitivity study as one JSON object.
#include "launchsafe/report/sensitivity_report.hpp"
#include "sensitivity_text.hpp"
#include "shown_key.hpp"
#include "study_text.hpp"
#include "sweep_text.hpp"
#include "verdict_text.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace launchsafe::report {
namespace {

using Json = nlohmann::ordered_json;
using detail::number;
using study::OutputSensitivity, study::SensitivityResult;

Json inputs_json(const study::Study& study) {
  Json inputs = Json::array();
  for (const study::UncertainInput& input : study.inputs) {
    const detail::ShownKey key = detail::shown(input);
    inputs.push_back({{"name", input.name},
                      {"scene_key", key.scene_key},
                      {"key", key.key},
                      {"unit", key.unit},
                      {"distribution", detail::distribution_text(key, input.distribution)}});
  }
  return inputs;
}

Json method_json(const SensitivityResult& result) {
  const study::Study& study = result.study.study;
  Json json{{"name", study::to_string(study.method)},
            {"text", detail::method_text(result)},
            {"N", detail::size_of(study)},
            {"evaluations", result.answers.size()},
            {"seed", study.seed},
            {"resamples", study.resamples},
            {"confidence", study.confidence}};
  return json;
}

Json json_of(const math::Estimate& estimate, double scale) {
  return {{"value", number(scale * estimate.value)},
          {"low", number(scale * estimate.lower)},
          {"high", number(scale * estimate.upper)}};
}

Json indices_json(const study::Study& study, const OutputSensitivity& output) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < std::min(study.inputs.size(), output.sobol.inputs.size()); ++i) {
    rows.push_back({{"input", study.inputs[i].name},
                    {"S1", json_of(output.sobol.inputs[i].first, 1.0)},
                    {"ST", json_of(output.sobol.inputs[i].total, 1.0)},
                    {"used", output.sobol.rows_used},
                    {"of", output.sobol.rows_used + output.sobol.rows_left_out}});
  }
  return rows;
}

Json effects_json(const study::Study& study, const OutputSensitivity& output, double scale) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < std::min(study.inputs.size(), output.morris.size()); ++i) {
    const math::MorrisEffects& effects = output.morris[i];
    rows.push_back({{"input", study.inputs[i].name},
                    {"mu", number(scale * effects.mu)},
                    {"mu_star", json_of(effects.mu_star, scale)},
                    {"sigma", number(scale * effects.sigma)},
                    {"used", effects.effects},
                    {"of", study.trajectories}});
  }
  return rows;
}

Json output_json(const SensitivityResult& result, const OutputSensitivity& output) {
  const detail::ShownOutput shown = detail::shown(output.output);
  const std::string reason = detail::reason_of(result, output);
  Json json{{"output", shown.key},
            {"unit", shown.unit},
            {"reason", reason.empty() ? Json(nullptr) : Json(reason)},
            {"mean", number(shown.scale * output.mean)},
            {"deviation", number(shown.scale * output.deviation)},
            {"missing", output.missing},
            {"bounds", output.bounds},
            {"inputs", Json::array()}};
  if (!reason.empty()) return json;
  json["inputs"] = result.study.study.method == study::SensitivityMethod::sobol
                       ? indices_json(result.study.study, output)
                       : effects_json(result.study.study, output, shown.scale);
  return json;
}

Json evaluation_json(const SensitivityResult& result, const std::vector<detail::ShownKey>& keys,
                     std::size_t index) {
  const study::StudyCase& input = result.study.cases[index];
  const study::CaseAnswer& answer = result.answers[index];
  Json coordinates = Json::object(), outputs = Json::object();
  for (std::size_t i = 0; i < std::min(keys.size(), input.coordinates.size()); ++i)
    coordinates[keys[i].key] = number(keys[i].value(input.coordinates[i]));
  for (const OutputSensitivity& output : result.outputs) {
    const detail::ShownOutput shown = detail::shown(output.output);
    outputs[shown.key + "_" + shown.unit] =
        index < output.values.size() ? number(shown.scale * output.values[index]) : Json(nullptr);
  }
  return {{"evaluation", input.label},
          {"coordinates", std::move(coordinates)},
          {"outputs", std::move(outputs)},
          {"critical_gap_kind", study::to_string(answer.critical.kind)},
          {"failure", answer.completed() ? Json(nullptr) : Json(answer.failure)}};
}

}  // namespace

Json to_json(const SensitivityResult& result) {
  const auto keys = detail::shown_inputs(result.study.study);
  Json json{{"kind", "sensitivity"},
            {"study", detail::study_file_name(result.study)},
            {"title", result.study.study.title},
            {"answer", answer(result)},
            {"method", method_json(result)},
            {"gap_cm", result.study.study.gaps.empty()
                           ? Json(nullptr)
                           : number(detail::in_centimetres(result.study.study.gaps.front()))},
            {"inputs", inputs_json(result.study.study)},
            {"failed", detail::counts_of(result.answers).failed},
            {"outputs", Json::array()},
            {"notes", detail::mesh_notes(result.study)},
            {"evaluations", Json::array()}};
  for (const OutputSensitivity& output : result.outputs)
    json["outputs"].push_back(output_json(result, output));
  for (std::size_t i = 0; i < std::min(result.study.cases.size(), result.answers.size()); ++i)
    json["evaluations"].push_back(evaluation_json(result, keys, i));
  return json;
}

}  // namespace launchsafe::report
