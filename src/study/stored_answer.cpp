#include "launchsafe/study/case_answer.hpp"

namespace launchsafe::study {
namespace {

using nlohmann::json, store::Database;

/// The values of an answer one after the other. One description of them serves writing and reading.
class Values {
 public:
  /// To be written.
  Values() = default;
  /// To be read.
  explicit Values(json stored) : list_(std::move(stored)), reading_(true) {}

  /// Members, parts by their own descriptions, and lists of either.
  template <class... Members>
  void add(Members&... members) {
    (add_one(members), ...);
  }

  std::string bytes() const {
    std::string bytes;
    json::to_cbor(list_, bytes);
    return bytes;
  }

 private:
  template <class Member>
  void add_one(Member& member) {
    if constexpr (requires { describe(*this, member); })
      describe(*this, member);
    else if (reading_)
      list_.at(next_++).get_to(member);
    else
      list_.push_back(member);
  }
  template <class Part>
  void add_one(std::vector<Part>& parts) {
    std::size_t count = parts.size();
    add(count);
    parts.resize(count);
    for (Part& each : parts) add_one(each);
  }

  json list_ = json::array();
  bool reading_ = false;
  std::size_t next_ = 0;
};

void describe(Values& values, AsCalibrated& each) { values.add(each.key, each.ignites, each.temperature); }

void describe(Values& values, Peak& peak) { values.add(peak.temperature, peak.time, peak.point); }

void describe(Values& values, GapVerdict& row) {
  Uncertainty& u = row.uncertainty;
  values.add(row.gap, row.spread, row.heated, row.margin, row.maximum, row.until_exit, row.early,
             row.air.taken, row.air.supplied);
  values.add(u.sampling, u.integration, u.coupling, u.numerical, u.fit, u.input, u.load_curve, u.model_form,
             u.sliding);
  bool ignites = row.ignition.has_value();
  values.add(row.as_calibrated, ignites);
  if (!ignites) return;
  NamedIgnition& ignition = row.ignition ? *row.ignition : row.ignition.emplace();
  values.add(ignition.cause, ignition.time, ignition.point, ignition.chemical_share);
}

void describe(Values& values, GapShare& share) { values.add(share.kind, share.raised, share.lowered); }

void describe(Values& values, GapReason& reason) {
  values.add(reason.code, reason.gap, reason.lower, reason.upper, reason.because);
}

/// The bounds of a critical gap, which follow from its shares, where they were sought.
void describe(Values& values, CriticalGap& gap) {
  values.add(gap.kind, gap.value, gap.lower, gap.upper, gap.indicative);
  bool bounded = !std::isnan(gap.bounds.at_least) || !gap.shares.empty();
  values.add(gap.reason, bounded, gap.shares);
  if (bounded) set_shares(gap, std::exchange(gap.shares, {}));
}

void describe(Values& values, ModelGap& model) { values.add(model.name, model.critical_gap, model.failure); }

void describe(Values& values, CaseAnswer& answer) {
  values.add(answer.failure, answer.friction_rise, answer.run.status, answer.run.steps, answer.run.particles,
             answer.run.energy_drift);
  for (const run::Limiter& each : run::limiters) values.add(answer.run.limiters.*each.member);
  values.add(answer.runs, answer.validity_warnings, answer.critical, answer.models, answer.verdicts);
}

}  // namespace

std::string bytes_of(CaseAnswer answer) {
  Values values;
  describe(values, answer);
  return values.bytes();
}

void save_answer(Database& database, const std::string& key, const CaseAnswer& answer) {
  database.run("CREATE TABLE IF NOT EXISTS stored_case_answers (key TEXT PRIMARY KEY, answer BLOB) STRICT");
  database.run("INSERT OR REPLACE INTO stored_case_answers VALUES (?, CAST(? AS BLOB))",
               {key, bytes_of(answer)});
}

std::optional<CaseAnswer> read_answer(Database& database, const std::string& key) try {
  const auto found = database.rows("SELECT answer FROM stored_case_answers WHERE key = ?", {key});
  if (found.empty()) return std::nullopt;
  Values values(json::from_cbor(std::get<std::string>(found.front()[0])));
  CaseAnswer answer;
  describe(values, answer);
  return answer;
} catch (const store::Error&) {  // no table yet
  return std::nullopt;
} catch (const json::exception&) {
  return std::nullopt;
}

}  // namespace launchsafe::study
