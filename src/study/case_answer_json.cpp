// Answers as JSON, to be stored and read back exactly. Verdicts are not stored: they follow from what is.
#include "launchsafe/study/case_answer.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace launchsafe::study {
namespace {

using nlohmann::json;

/// What is read is no answer of ours.
struct Damage : std::runtime_error {
  using std::runtime_error::runtime_error;
};

void require(bool holds, const char* what) {
  if (!holds) throw Damage(what);
}

/// An array of so many values.
const json& list_of(const json& value, std::size_t count) {
  require(value.is_array() && value.size() == count, "a list has another length");
  return value;
}

constexpr const char* infinite = "infinite";

/// nlohmann-json prints the shortest text that reads back to the same number, and null for what is not
/// finite.
json json_of_number(double number) { return std::isinf(number) ? json(infinite) : json(number); }
double number_of(const json& value) {
  if (value.is_null()) return not_a_number;
  if (value == infinite) return std::numeric_limits<double>::infinity();
  require(value.is_number(), "a number is none");
  return value.get<double>();
}

/// One that may be NaN but not negative.
double amount_of(const json& value) {
  const double amount = number_of(value);
  require(!(amount < 0.0), "an amount is negative");
  return amount;
}

std::uint64_t count_of(const json& value) {
  require(value.is_number_unsigned(), "a count is none");
  return value.get<std::uint64_t>();
}

/// An enumerator that is not beyond the last one.
template <class Enumeration>
Enumeration enumerator_of(const json& value, Enumeration last) {
  require(value.is_number_unsigned() && value.get<std::uint64_t>() <= static_cast<std::uint64_t>(last),
          "an enumerator is unknown");
  return static_cast<Enumeration>(value.get<int>());
}

json json_of(const Peak& peak) { return {peak.temperature, peak.time, peak.point}; }
Peak peak_of(const json& value) {
  list_of(value, 3);
  return {amount_of(value.at(0)), amount_of(value.at(1)), value.at(2).get<std::string>()};
}

json json_of(const std::optional<NamedIgnition>& ignition) {
  if (!ignition) return nullptr;
  return {static_cast<int>(ignition->cause), ignition->time, ignition->point, ignition->chemical_share};
}
std::optional<NamedIgnition> ignition_of(const json& value) {
  if (value.is_null()) return std::nullopt;
  list_of(value, 4);
  return NamedIgnition{enumerator_of(value.at(0), surface::IgnitionCause::arrhenius), amount_of(value.at(1)),
                       value.at(2).get<std::string>(), number_of(value.at(3))};
}

json json_of(const std::vector<GapShare>& shares) {
  json list = json::array();
  for (const GapShare& share : shares)
    list.push_back(
        {static_cast<int>(share.kind), json_of_number(share.raised), json_of_number(share.lowered)});
  return list;
}
std::vector<GapShare> shares_of(const json& value) {
  require(value.is_array(), "shares are no list");
  std::vector<GapShare> shares;
  for (const json& each : value) {
    list_of(each, 3);
    shares.push_back(
        {enumerator_of(each.at(0), last_share_kind), amount_of(each.at(1)), amount_of(each.at(2))});
  }
  return shares;
}

/// Bounds are not stored: they follow from the shares. One without shares has bounds all the same where none
/// was found, and none where they were not sought.
json json_of(const CriticalGap& gap) {
  const bool bounded = !std::isnan(gap.bounds.at_least) || !gap.shares.empty();
  return {static_cast<int>(gap.kind),
          gap.value,
          gap.lower,
          gap.upper,
          gap.reason,
          bounded ? json_of(gap.shares) : json(nullptr),
          json_of_number(gap.indicative)};
}
CriticalGap critical_gap_of(const json& value) {
  list_of(value, 7);
  CriticalGap gap;
  gap.kind = enumerator_of(value.at(0), CriticalGapKind::several_crossings);
  gap.value = amount_of(value.at(1));
  gap.lower = amount_of(value.at(2));
  gap.upper = amount_of(value.at(3));
  gap.reason = value.at(4).get<std::string>();
  require((gap.kind == CriticalGapKind::value) == std::isfinite(gap.value),
          "a critical gap that is no value has one, or the other way round");
  if (gap.kind == CriticalGapKind::value)
    require(gap.lower <= gap.value && gap.value <= gap.upper, "a critical gap is outside its bracket");
  if (!value.at(5).is_null()) set_shares(gap, shares_of(value.at(5)));
  gap.indicative = amount_of(value.at(6));
  return gap;
}

json json_of(const Uncertainty& u) {
  json list = json::array();
  for (const double part : {u.sampling, u.integration, u.coupling, u.numerical, u.fit, u.input, u.load_curve,
                            u.model_form, u.sliding})
    list.push_back(json_of_number(part));
  return list;
}
Uncertainty uncertainty_of(const json& value) {
  list_of(value, 9);
  return {amount_of(value.at(0)), amount_of(value.at(1)), amount_of(value.at(2)),
          amount_of(value.at(3)), amount_of(value.at(4)), amount_of(value.at(5)),
          amount_of(value.at(6)), amount_of(value.at(7)), amount_of(value.at(8))};
}

json json_of(const surface::AirEnergy& air) { return {air.taken, air.supplied, air.stored, air.isothermal}; }
surface::AirEnergy air_of(const json& value) {
  list_of(value, 4);
  const surface::AirEnergy air{amount_of(value.at(0)), amount_of(value.at(1)), amount_of(value.at(2)),
                               amount_of(value.at(3))};
  require(!(air.supplied < air.stored), "compression supplies less than the air stores");
  return air;
}

json json_of(const std::vector<AsCalibrated>& all) {
  json list = json::array();
  for (const AsCalibrated& each : all) list.push_back({each.key, each.temperature, each.ignites});
  return list;
}
std::vector<AsCalibrated> as_calibrated_of(const json& value) {
  std::vector<AsCalibrated> all;
  for (const json& each : value) {
    list_of(each, 3);
    all.push_back({each.at(0).get<std::string>(), amount_of(each.at(1)), each.at(2).get<bool>()});
  }
  return all;
}

json json_of(const GapVerdict& row) {
  return {{"gap", row.gap},
          {"maximum", json_of(row.maximum)},
          {"until_exit", json_of(row.until_exit)},
          {"early", json_of(row.early)},
          {"spread", {row.spread, row.early_spread}},
          {"margin", row.margin},
          {"air", json_of(row.air)},
          {"uncertainty", json_of(row.uncertainty)},
          {"ignition", json_of(row.ignition)},
          {"as_calibrated", json_of(row.as_calibrated)},
          {"doubt", row.evidence.validity_warnings},  // as stored answers name it
          {"unaccepted", row.evidence.unaccepted},
          {"ring", row.evidence.ring},
          {"accepted", row.evidence.accepted},
          {"optimistic", row.evidence.optimistic},
          {"model_form", row.evidence.model_form},
          {"extrapolated", row.evidence.extrapolated}};
}
GapVerdict row_of(const json& value) {
  GapVerdict row;
  row.gap = amount_of(value.at("gap"));
  row.maximum = peak_of(value.at("maximum"));
  row.until_exit = peak_of(value.at("until_exit"));
  row.early = peak_of(value.at("early"));
  const json& spread = list_of(value.at("spread"), 2);
  row.spread = amount_of(spread.at(0));
  row.early_spread = amount_of(spread.at(1));
  row.margin = number_of(value.at("margin"));
  row.air = air_of(value.at("air"));
  row.uncertainty = uncertainty_of(value.at("uncertainty"));
  row.ignition = ignition_of(value.at("ignition"));
  row.as_calibrated = as_calibrated_of(value.at("as_calibrated"));
  row.evidence.validity_warnings = value.at("doubt").get<std::string>();
  row.evidence.unaccepted = value.at("unaccepted").get<std::string>();
  row.evidence.ring = value.at("ring").get<std::string>();
  row.evidence.accepted = value.at("accepted").get<std::string>();
  row.evidence.optimistic = value.at("optimistic").get<std::string>();
  row.evidence.model_form = value.at("model_form").get<std::string>();
  row.evidence.extrapolated = value.at("extrapolated").get<std::string>();
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
  run.status = enumerator_of(value.at("status"), run::last_status);
  run.steps = count_of(value.at("steps"));
  run.particles = count_of(value.at("particles"));
  run.energy_drift = amount_of(value.at("energy_drift"));
  const json& l = list_of(value.at("limiters"), 3);
  run.limiters = {count_of(l.at(0)), count_of(l.at(1)), count_of(l.at(2))};
  return run;
}

/// Throws Damage, or what the JSON library throws where a value is missing or of another type.
CaseAnswer answer_of(const json& value) {
  CaseAnswer answer;
  answer.failure = value.at("failure").get<std::string>();
  answer.run = run_of(value.at("run"));
  answer.critical = critical_gap_of(value.at("critical"));
  for (const json& row : value.at("verdicts")) answer.verdicts.push_back(row_of(row));
  for (const json& heated : list_of(value.at("heated"), answer.verdicts.size()))
    answer.heated_temperature.push_back(amount_of(heated));
  require(answer.run.status == run::RunStatus::completed || !answer.completed(),
          "a run that did not complete has no failure");
  for (GapVerdict& row : answer.verdicts)
    judge_row(answer.failure, answer.run.limiters, answer.critical, row);
  return answer;
}

}  // namespace

std::string to_json_line(const CaseAnswer& answer) {
  json verdicts = json::array();
  for (const GapVerdict& row : answer.verdicts) verdicts.push_back(json_of(row));
  const json line = {{"failure", answer.failure},
                     {"run", json_of(answer.run)},
                     {"critical", json_of(answer.critical)},
                     {"verdicts", std::move(verdicts)},
                     {"heated", answer.heated_temperature}};
  return line.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::optional<CaseAnswer> answer_from_json(const std::string& line) {
  try {
    return answer_of(json::parse(line));
  } catch (const json::exception&) {
    return std::nullopt;
  } catch (const Damage&) {
    return std::nullopt;
  }
}

}  // namespace launchsafe::study
