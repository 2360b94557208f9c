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
  explicit Values(json stored) : list_(std::move(stored)), reading_(true), sound_(list_.is_array()) {}

  /// Members, parts by their own descriptions, and lists of either.
  template <class... Members>
  void add(Members&... members) {
    (add_one(members), ...);
  }
  /// Of amounts, which are not negative but may be NaN.
  template <class... Members>
  void amounts(Members&... members) {
    add(members...);
    sound_ = sound_ && !((members < Members{}) || ...);
  }
  /// An enumerator that is not beyond the last one.
  template <class Enumeration>
  void choice(Enumeration& value, Enumeration last) {
    auto number = static_cast<std::size_t>(value);
    add(number);
    sound_ = sound_ && number <= static_cast<std::size_t>(last);
    if (sound_) value = static_cast<Enumeration>(number);
  }

  /// Whether all that was stored was read, and each value is one of its member.
  bool is_sound() const { return sound_ && next_ == list_.size(); }
  std::string bytes() const {
    std::string bytes;
    json::to_cbor(list_, bytes);
    return bytes;
  }

 private:
  template <class Member>
  void add_one(Member& member) {
    if constexpr (requires { describe(*this, member); }) {
      describe(*this, member);
    } else if (!reading_) {
      list_.push_back(member);
    } else {
      sound_ = sound_ && next_ < list_.size() && list_[next_].type() == json(member).type();
      if (sound_) list_[next_++].get_to(member);
    }
  }
  template <class Part>
  void add_one(std::vector<Part>& parts) {
    std::size_t count = parts.size();
    add(count);
    if (reading_) parts.resize(std::min(count, list_.size()));
    for (Part& each : parts) add_one(each);
  }

  json list_ = json::array();
  bool reading_ = false, sound_ = true;
  std::size_t next_ = 0;
};

void describe(Values& values, AsCalibrated& each) {
  values.add(each.key, each.ignites);
  values.amounts(each.temperature);
}

void describe(Values& values, Peak& peak) {
  values.amounts(peak.temperature, peak.time);
  values.add(peak.point);
}

void describe(Values& values, GapVerdict& row) {
  Uncertainty& u = row.uncertainty;
  values.amounts(row.gap, row.spread, row.early_spread, row.heated);
  values.add(row.margin);
  values.add(row.maximum, row.until_exit, row.early);
  values.amounts(row.air.taken, row.air.supplied);
  values.amounts(u.sampling, u.integration, u.coupling, u.numerical, u.fit, u.input, u.load_curve,
                 u.model_form, u.sliding);
  bool ignites = row.ignition.has_value();
  values.add(row.as_calibrated, ignites);
  if (!ignites) return;
  NamedIgnition& ignition = row.ignition ? *row.ignition : row.ignition.emplace();
  values.choice(ignition.cause, surface::IgnitionCause::arrhenius);
  values.amounts(ignition.time);
  values.add(ignition.point, ignition.chemical_share);
}

void describe(Values& values, GapShare& share) {
  values.choice(share.kind, ShareKind::accepted);
  values.amounts(share.raised, share.lowered);
}

void describe(Values& values, GapReason& reason) {
  values.choice(reason.code, GapReasonCode::coupled_safe);
  values.amounts(reason.gap, reason.lower, reason.upper);
  values.add(reason.gaps, reason.because);
}

/// The bounds of a critical gap, which follow from its shares, where they were sought.
void describe(Values& values, CriticalGap& gap) {
  values.choice(gap.kind, CriticalGapKind::several_crossings);
  values.amounts(gap.value, gap.lower, gap.upper, gap.indicative);
  bool bounded = !std::isnan(gap.bounds.at_least) || !gap.shares.empty();
  values.add(gap.reason, bounded, gap.shares);
  if (bounded) set_shares(gap, std::exchange(gap.shares, {}));
}

void describe(Values& values, CaseAnswer& answer) {
  values.add(answer.failure, answer.friction_rise);
  values.choice(answer.run.status, run::last_status);
  values.amounts(answer.run.steps, answer.run.particles, answer.run.energy_drift);
  for (const run::Limiter& each : run::limiters) values.amounts(answer.run.limiters.*each.member);
  values.add(answer.runs, answer.validity_warnings, answer.critical, answer.verdicts);
}

/// Whether its numbers contradict each other.
bool is_sound(const CaseAnswer& answer) {
  const CriticalGap& gap = answer.critical;
  const bool is_value = gap.kind == CriticalGapKind::value;
  if (is_value != std::isfinite(gap.value)) return false;
  if (is_value && !(gap.lower <= gap.value && gap.value <= gap.upper)) return false;
  return answer.run.status == run::RunStatus::completed || !answer.completed();
}

std::string check_of(const std::string& key, const std::string& bytes) { return store::sha256(key + bytes); }

}  // namespace

std::string bytes_of(CaseAnswer answer) {
  Values values;
  describe(values, answer);
  return values.bytes();
}

void save_answer(Database& database, const std::string& key, const CaseAnswer& answer) {
  database.run(
      "CREATE TABLE IF NOT EXISTS stored_case_answers (key TEXT PRIMARY KEY, check_sum TEXT, answer BLOB) "
      "STRICT");
  const std::string bytes = bytes_of(answer);
  database.run("INSERT OR REPLACE INTO stored_case_answers VALUES (?, ?, CAST(? AS BLOB))",
               {key, check_of(key, bytes), bytes});
}

std::optional<CaseAnswer> read_answer(Database& database, const std::string& key) try {
  const auto found = database.rows("SELECT check_sum, answer FROM stored_case_answers WHERE key = ?", {key});
  if (found.size() != 1) return std::nullopt;
  const auto* check = std::get_if<std::string>(&found.front()[0]);
  const auto* bytes = std::get_if<std::string>(&found.front()[1]);
  if (check == nullptr || bytes == nullptr || *check != check_of(key, *bytes)) return std::nullopt;
  Values values(json::from_cbor(*bytes, true, false));
  CaseAnswer answer;
  describe(values, answer);
  return values.is_sound() && is_sound(answer) ? std::optional(std::move(answer)) : std::nullopt;
} catch (const store::Error&) {
  return std::nullopt;
}

}  // namespace launchsafe::study
