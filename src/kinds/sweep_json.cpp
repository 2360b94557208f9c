// A sweep as one JSON object.
#include "launchsafe/kinds/sweep_report.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/report/verdict_text.hpp"
#include "sweep_text.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace launchsafe::kinds {

using namespace study;
using namespace report;
namespace {

using Json = nlohmann::ordered_json;

Json axes_json(const study::Study& study) {
  Json axes = Json::array();
  for (const study::Axis& axis : study.axes) {
    const ShownKey key = shown(axis);
    Json values = Json::array();
    for (const double value : axis.values) values.push_back(number(key.value(value)));
    axes.push_back({{"name", axis.name},
                    {"scene_key", key.scene_key},
                    {"key", key.key},
                    {"unit", key.unit},
                    {"values", std::move(values)}});
  }
  return axes;
}

Json coordinates_json(const std::vector<ShownKey>& keys, const study::StudyCase& input) {
  Json json = Json::object();
  for (std::size_t i = 0; i < std::min(keys.size(), input.coordinates.size()); ++i)
    json[keys[i].key] = number(keys[i].value(input.coordinates[i]));
  return json;
}

Json critical_json(const study::CriticalGap& gap) {
  Json json = critical_gap_json(gap);
  json["reads_as"] = reads_as(gap);
  return json;
}

Json run_json(const study::CaseAnswer& answer) {
  const run::LimiterCounts& limiters = answer.run.limiters;
  return {{"status", status_of(answer)},
          {"steps", answer.run.steps},
          {"particles", answer.run.particles},
          {"energy_drift", number(answer.run.energy_drift)},
          {"limiters",
           {{"crack_at_bound", limiters.crack_at_bound},
            {"tension_cutoff", limiters.tension_cutoff},
            {"hugoniot_guard", limiters.hugoniot_guard}}}};
}

Json verdicts_json(const study::CaseAnswer& answer) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < answer.verdicts.size(); ++i) {
    Json row{{"gap_cm", number(in_centimetres(answer.verdicts[i].gap))}};
    add_verdict(row, answer.verdicts[i]);
    row["heated_K"] =
        i < answer.heated_temperature.size() ? number(answer.heated_temperature[i]) : Json(nullptr);
    rows.push_back(std::move(row));
  }
  return rows;
}

Json case_json(const std::vector<ShownKey>& keys, const study::StudyCase& input,
               const study::CaseAnswer& answer) {
  return {{"case", name_of(keys, input)},
          {"coordinates", coordinates_json(keys, input)},
          {"failure", answer.completed() ? Json(nullptr) : Json(answer.failure)},
          {"critical_gap", critical_json(answer.critical)},
          {"run", run_json(answer)},
          {"verdicts", verdicts_json(answer)}};
}

Json counts_json(const SweepCounts& counts) {
  return {
      {"cases", counts.cases},
      {"failed", counts.failed},
      {"limiters_acted", counts.limited},
      {"critical_gaps",
       {{"value", counts.values},
        {"all-safe", counts.all_safe},
        {"all-ignite", counts.all_ignite},
        {"indeterminate", counts.indeterminate}}},
      {"verdicts", {{"SAFE", counts.safe}, {"UNSAFE", counts.unsafe}, {"INDETERMINATE", counts.undecided}}}};
}

/// Everything but the cases.
Json head_json(const SweepResult& result) {
  Json json{{"kind", "sweep"},
            {"study", study_file_name(result.study)},
            {"title", result.study.study.title},
            {"answer", answer(result)},
            {"axes", axes_json(result.study.study)},
            {"gaps_cm", Json::array()},
            {"counts", counts_json(counts_of(result.answers))},
            {"cited_limits", to_json(cited_limit_table(result))["rows"]},
            {"notes", mesh_notes(result.study)}};
  for (const double gap : result.study.study.gaps) json["gaps_cm"].push_back(number(in_centimetres(gap)));
  return json;
}

std::size_t cases_of(const SweepResult& result) {
  return std::min(result.study.cases.size(), result.answers.size());
}

}  // namespace

Json to_json(const SweepResult& result) {
  const auto keys = shown_axes(result.study.study);
  Json json = head_json(result);
  json["cases"] = Json::array();
  for (std::size_t i = 0; i < cases_of(result); ++i)
    json["cases"].push_back(case_json(keys, result.study.cases[i], result.answers[i]));
  return json;
}

std::string json_text(const SweepResult& result) {
  const auto keys = shown_axes(result.study.study);
  std::string text = json_file_text(head_json(result));
  text.resize(text.rfind("\n}"));  // open the object again
  text += ",\n  \"cases\": [";
  for (std::size_t i = 0; i < cases_of(result); ++i) {
    text += i == 0 ? "\n    " : ",\n    ";
    text += case_json(keys, result.study.cases[i], result.answers[i])
                .dump(-1, ' ', false, Json::error_handler_t::replace);
  }
  return text + "\n  ]\n}\n";
}

}  // namespace launchsafe::kinds
