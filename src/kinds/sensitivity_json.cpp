// A sensitivity study as one JSON object.
#include "launchsafe/kinds/sensitivity_report.hpp"
#include "launchsafe/report/shown_key.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/report/verdict_text.hpp"
#include "sensitivity_text.hpp"
#include "sweep_text.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace launchsafe::kinds {

using namespace study;
using namespace report;
namespace {

using Json = nlohmann::ordered_json;

Json inputs_json(const study::Study& study) {
  Json inputs = Json::array();
  for (const study::Axis& input : study.axes) {
    const ShownKey key = shown(input);
    inputs.push_back({{"name", input.name},
                      {"scene_key", key.scene_key},
                      {"key", key.key},
                      {"unit", key.unit},
                      {"distribution", distribution_text(key, *input.distribution)}});
  }
  return inputs;
}

Json method_json(const SensitivityResult& result) {
  const study::Study& study = result.study.study;
  Json json{{"name", to_string(settings_of<SensitivitySettings>(study).method)},
            {"text", method_text(result)},
            {"N", size_of(study)},
            {"evaluations", result.answers.size()},
            {"seed", settings_of<SensitivitySettings>(study).seed},
            {"resamples", settings_of<SensitivitySettings>(study).resamples},
            {"confidence", settings_of<SensitivitySettings>(study).confidence}};
  return json;
}

Json json_of(const math::Estimate& estimate, double scale) {
  return {{"value", number(scale * estimate.value)},
          {"low", number(scale * estimate.lower)},
          {"high", number(scale * estimate.upper)}};
}

Json indices_json(const study::Study& study, const OutputSensitivity& output) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < std::min(study.axes.size(), output.sobol.inputs.size()); ++i) {
    rows.push_back({{"input", study.axes[i].name},
                    {"S1", json_of(output.sobol.inputs[i].first, 1.0)},
                    {"ST", json_of(output.sobol.inputs[i].total, 1.0)},
                    {"used", output.sobol.rows_used},
                    {"of", output.sobol.rows_used + output.sobol.rows_left_out}});
  }
  return rows;
}

Json effects_json(const study::Study& study, const OutputSensitivity& output, double scale) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < std::min(study.axes.size(), output.morris.size()); ++i) {
    const math::MorrisEffects& effects = output.morris[i];
    rows.push_back({{"input", study.axes[i].name},
                    {"mu", number(scale * effects.mu)},
                    {"mu_star", json_of(effects.mu_star, scale)},
                    {"sigma", number(scale * effects.sigma)},
                    {"used", effects.effects},
                    {"of", settings_of<SensitivitySettings>(study).trajectories}});
  }
  return rows;
}

Json output_json(const SensitivityResult& result, const OutputSensitivity& output) {
  const ShownOutput shown = shown_output(output.output);
  const std::string reason = reason_of(result, output);
  Json json{{"output", shown.key},
            {"unit", shown.unit},
            {"reason", reason.empty() ? Json(nullptr) : Json(reason)},
            {"mean", number(shown.scale * output.mean)},
            {"deviation", number(shown.scale * output.deviation)},
            {"missing", output.missing},
            {"bounds", output.bounds},
            {"inputs", Json::array()}};
  if (!reason.empty()) return json;
  json["inputs"] = settings_of<SensitivitySettings>(result.study.study).method == SensitivityMethod::sobol
                       ? indices_json(result.study.study, output)
                       : effects_json(result.study.study, output, shown.scale);
  return json;
}

Json evaluation_json(const SensitivityResult& result, const std::vector<ShownKey>& keys, std::size_t index) {
  const study::StudyCase& input = result.study.cases[index];
  const study::CaseAnswer& answer = result.answers[index];
  Json coordinates = Json::object(), outputs = Json::object();
  for (std::size_t i = 0; i < std::min(keys.size(), input.coordinates.size()); ++i)
    coordinates[keys[i].key] = number(keys[i].value(input.coordinates[i]));
  for (const OutputSensitivity& output : result.outputs) {
    const ShownOutput shown = shown_output(output.output);
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
  const auto keys = shown_axes(result.study.study);
  Json json{
      {"kind", "sensitivity"},
      {"study", study_file_name(result.study)},
      {"title", result.study.study.title},
      {"answer", answer(result)},
      {"method", method_json(result)},
      {"gap_cm", result.study.study.gaps.empty() ? Json(nullptr)
                                                 : number(in_centimetres(result.study.study.gaps.front()))},
      {"inputs", inputs_json(result.study.study)},
      {"failed", counts_of(result.answers).failed},
      {"outputs", Json::array()},
      {"notes", mesh_notes(result.study)},
      {"evaluations", Json::array()}};
  for (const OutputSensitivity& output : result.outputs)
    json["outputs"].push_back(output_json(result, output));
  for (std::size_t i = 0; i < std::min(result.study.cases.size(), result.answers.size()); ++i)
    json["evaluations"].push_back(evaluation_json(result, keys, i));
  return json;
}

}  // namespace launchsafe::kinds
