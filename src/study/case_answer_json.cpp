// Answers as JSON, to be stored and read back exactly.
#include "launchsafe/study/case_answer.hpp"

#include <nlohmann/json.hpp>

namespace launchsafe::study {
namespace {

using nlohmann::json;

/// nlohmann-json prints the shortest text that reads back to the same number, and null for what is not
/// finite.
double number_of(const json& value) { return value.is_null() ? not_a_number : value.get<double>(); }

json json_of(const Peak& peak) { return {peak.temperature, peak.time, peak.point}; }
Peak peak_of(const json& value) {
  return {number_of(value.at(0)), number_of(value.at(1)), value.at(2).get<std::string>()};
}

json json_of(const std::optional<NamedIgnition>& ignition) {
  if (!ignition) return nullptr;
  return {static_cast<int>(ignition->cause), ignition->time, ignition->point, ignition->chemical_share};
}
std::optional<NamedIgnition> ignition_of(const json& value) {
  if (value.is_null()) return std::nullopt;
  return NamedIgnition{static_cast<surface::IgnitionCause>(value.at(0).get<int>()), number_of(value.at(1)),
                       value.at(2).get<std::string>(), number_of(value.at(3))};
}

json json_of(const CriticalGap& gap) {
  return {static_cast<int>(gap.kind), gap.value, gap.lower, gap.upper, gap.uncertainty, gap.reason};
}
CriticalGap critical_gap_of(const json& value) {
  CriticalGap gap;
  gap.kind = static_cast<CriticalGapKind>(value.at(0).get<int>());
  gap.value = number_of(value.at(1));
  gap.lower = number_of(value.at(2));
  gap.upper = number_of(value.at(3));
  gap.uncertainty = number_of(value.at(4));
  gap.reason = value.at(5).get<std::string>();
  return gap;
}

json json_of(const GapVerdict& row) {
  const Uncertainty& u = row.uncertainty;
  return {{"gap", row.gap},
          {"maximum", json_of(row.maximum)},
          {"early", json_of(row.early)},
          {"spread", {row.spread, row.early_spread}},
          {"anywhere", json_of(row.anywhere)},
          {"margin", row.margin},
          {"uncertainty", {u.sampling, u.integration, u.coupling, u.numerical, u.fit, u.input}},
          {"ignition", json_of(row.ignition)},
          {"ignition_anywhere", json_of(row.ignition_anywhere)},
          {"verdict", static_cast<int>(row.judgement.verdict)},
          {"reason", row.judgement.reason}};
}
GapVerdict verdict_of(const json& value) {
  GapVerdict row;
  row.gap = number_of(value.at("gap"));
  row.maximum = peak_of(value.at("maximum"));
  row.early = peak_of(value.at("early"));
  row.spread = number_of(value.at("spread").at(0));
  row.early_spread = number_of(value.at("spread").at(1));
  row.anywhere = peak_of(value.at("anywhere"));
  row.margin = number_of(value.at("margin"));
  const json& u = value.at("uncertainty");
  row.uncertainty = {number_of(u.at(0)), number_of(u.at(1)), number_of(u.at(2)),
                     number_of(u.at(3)), number_of(u.at(4)), number_of(u.at(5))};
  row.ignition = ignition_of(value.at("ignition"));
  row.ignition_anywhere = ignition_of(value.at("ignition_anywhere"));
  row.judgement = {static_cast<Verdict>(value.at("verdict").get<int>()),
                   value.at("reason").get<std::string>()};
  return row;
}

json json_of(const RunSummary& run) {
  const run::LimiterCounts& l = run.limiters;
  return {{"status", static_cast<int>(run.status)},
          {"steps", run.steps},
          {"particles", run.particles},
          {"energy_drift", run.energy_drift},
          {"limiters", {l.crack_at_bound, l.tension_cutoff, l.hugoniot_guard}}};
}
RunSummary run_of(const json& value) {
  RunSummary run;
  run.status = static_cast<run::RunStatus>(value.at("status").get<int>());
  run.steps = value.at("steps").get<std::uint64_t>();
  run.particles = value.at("particles").get<std::uint64_t>();
  run.energy_drift = number_of(value.at("energy_drift"));
  const json& l = value.at("limiters");
  run.limiters = {l.at(0).get<std::uint64_t>(), l.at(1).get<std::uint64_t>(), l.at(2).get<std::uint64_t>()};
  return run;
}

}  // namespace

std::string to_json_line(const CaseAnswer& answer) {
  json verdicts = json::array();
  for (const GapVerdict& row : answer.verdicts) verdicts.push_back(json_of(row));
  const json line = {{"failure", answer.failure},
                     {"run", json_of(answer.run)},
                     {"critical", json_of(answer.critical)},
                     {"critical_anywhere", json_of(answer.critical_anywhere)},
                     {"verdicts", std::move(verdicts)},
                     {"heated", answer.heated_temperature}};
  return line.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::optional<CaseAnswer> answer_from_json(const std::string& line) {
  try {
    const json value = json::parse(line);
    CaseAnswer answer;
    answer.failure = value.at("failure").get<std::string>();
    answer.run = run_of(value.at("run"));
    answer.critical = critical_gap_of(value.at("critical"));
    answer.critical_anywhere = critical_gap_of(value.at("critical_anywhere"));
    for (const json& row : value.at("verdicts")) answer.verdicts.push_back(verdict_of(row));
    for (const json& heated : value.at("heated")) answer.heated_temperature.push_back(number_of(heated));
    return answer;
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

}  // namespace launchsafe::study
