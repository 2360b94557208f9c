#include "launchsafe/store/sha256.hpp"
#include "launchsafe/study/case_answer.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace launchsafe::study {
namespace {

using store::Database, store::MaybeError, store::Result, store::SqlColumn, store::SqlTable, store::SqlValue;

/// The part of an answer that is one row.
struct AnswerRow {
  std::string key;
  std::int64_t check = 0;  ///< of the bytes of the answer
  CaseAnswer answer;
  bool bounded = false;                 ///< bounds of the critical gap were sought
  std::string runs, validity_warnings;  ///< JSON lists of texts
};

/// The way from a row to a member through members.
template <class... Members>
auto way(Members... members) {
  return [=](auto& row) -> auto& { return (row.*....*members); };
}

/// Of an amount, which is not negative but may be NaN.
template <class Row, class Member>
SqlColumn<Row> amount(std::string name, Member member) {
  return store::not_negative(store::sql_column<Row>(std::move(name), member));
}

/// Of an enumerator that is not beyond the last one.
template <class Row, class Member, class Enumeration>
SqlColumn<Row> choice(std::string name, Member member, Enumeration last) {
  SqlColumn<Row> column = store::not_negative(store::sql_column<Row>(std::move(name), member));
  column.set = [set = column.set, last](Row& row, const SqlValue& stored) {
    const std::int64_t* number = std::get_if<std::int64_t>(&stored);
    return number != nullptr && *number <= static_cast<std::int64_t>(last) && set(row, stored);
  };
  return column;
}

const SqlTable<AnswerRow>& answer_table() {
  using Row = AnswerRow;
  using store::sql_column, store::repeated_text;
  const auto of_run = [](auto... members) { return way(&Row::answer, &CaseAnswer::run, members...); };
  const auto of_gap = [](auto... members) { return way(&Row::answer, &CaseAnswer::critical, members...); };
  const auto of_reason = [&](auto member) { return of_gap(&CriticalGap::reason, member); };
  const auto of_limiters = [&](auto member) { return of_run(&RunSummary::limiters, member); };
  static const SqlTable<Row> table{
      "stored_answers",
      {"answer"},
      "answer",
      {sql_column<Row>("key", &Row::key),
       sql_column<Row>("check_sum", &Row::check),
       repeated_text<Row>("failure", way(&Row::answer, &CaseAnswer::failure)),
       choice<Row>("run_status", of_run(&RunSummary::status), run::last_status),
       amount<Row>("steps", of_run(&RunSummary::steps)),
       amount<Row>("particles", of_run(&RunSummary::particles)),
       amount<Row>("energy_drift", of_run(&RunSummary::energy_drift)),
       amount<Row>("crack_at_bound", of_limiters(&run::LimiterCounts::crack_at_bound)),
       amount<Row>("tension_cutoff", of_limiters(&run::LimiterCounts::tension_cutoff)),
       amount<Row>("hugoniot_guard", of_limiters(&run::LimiterCounts::hugoniot_guard)),
       choice<Row>("critical_gap_kind", of_gap(&CriticalGap::kind), CriticalGapKind::several_crossings),
       amount<Row>("critical_gap_m", of_gap(&CriticalGap::value)),
       amount<Row>("critical_gap_lower_m", of_gap(&CriticalGap::lower)),
       amount<Row>("critical_gap_upper_m", of_gap(&CriticalGap::upper)),
       choice<Row>("reason", of_reason(&GapReason::code), GapReason::Code::longer_launch_failed),
       amount<Row>("reason_gap_m", of_reason(&GapReason::gap)),
       amount<Row>("reason_lower_m", of_reason(&GapReason::lower)),
       amount<Row>("reason_upper_m", of_reason(&GapReason::upper)),
       amount<Row>("reason_gaps", of_reason(&GapReason::gaps)),
       repeated_text<Row>("reason_detail", of_reason(&GapReason::detail)),
       amount<Row>("critical_gap_indicative_m", of_gap(&CriticalGap::indicative)),
       sql_column<Row>("bounded", &Row::bounded),
       sql_column<Row>("runs", &Row::runs),
       repeated_text<Row>("validity_warnings", &Row::validity_warnings),
       sql_column<Row>("friction_rise_K", way(&Row::answer, &CaseAnswer::friction_rise))}};
  return table;
}

/// A temperature, its time and its place.
void add_peak(std::vector<SqlColumn<GapVerdict>>& columns, const std::string& name, Peak GapVerdict::*peak) {
  columns.push_back(amount<GapVerdict>(name + "_temperature_K", way(peak, &Peak::temperature)));
  columns.push_back(amount<GapVerdict>(name + "_time_s", way(peak, &Peak::time)));
  columns.push_back(store::sql_column<GapVerdict>(name + "_point", way(peak, &Peak::point)));
}

/// A column that is empty where the gap does not ignite.
template <class Member>
SqlColumn<GapVerdict> of_ignition(std::string name, Member member) {
  SqlColumn<GapVerdict> column = store::sql_column<GapVerdict>(
      std::move(name), [member](auto& row) -> auto& { return std::invoke(member, *row.ignition); });
  column.get = [get = column.get](const GapVerdict& row) { return row.ignition ? get(row) : SqlValue(); };
  column.set = [set = column.set](GapVerdict& row, const SqlValue& stored) {
    if (std::holds_alternative<std::monostate>(stored)) return true;
    if (!row.ignition) row.ignition.emplace();
    return set(row, stored);
  };
  return column;
}

std::vector<SqlColumn<GapVerdict>> gap_columns() {
  using Row = GapVerdict;
  const auto share = [](const char* name, auto member) {
    return amount<Row>(name, way(&Row::uncertainty, member));
  };
  const auto of_air = [](const char* name, auto member) { return amount<Row>(name, way(&Row::air, member)); };
  std::vector<SqlColumn<Row>> columns{amount<Row>("gap_m", &Row::gap)};
  add_peak(columns, "maximum", &GapVerdict::maximum);
  add_peak(columns, "until_exit", &GapVerdict::until_exit);
  add_peak(columns, "early", &GapVerdict::early);
  const std::vector<SqlColumn<Row>> more{
      amount<Row>("spread_K", &Row::spread),
      amount<Row>("early_spread_K", &Row::early_spread),
      store::sql_column<Row>("margin_K", &Row::margin),
      amount<Row>("heated_temperature_K", &Row::heated),
      of_air("air_taken_J_per_m2", &surface::AirEnergy::taken),
      of_air("air_supplied_J_per_m2", &surface::AirEnergy::supplied),
      of_air("air_stored_J_per_m2", &surface::AirEnergy::stored),
      of_air("air_isothermal_J_per_m2", &surface::AirEnergy::isothermal),
      share("sampling_K", &Uncertainty::sampling),
      share("integration_K", &Uncertainty::integration),
      share("coupling_K", &Uncertainty::coupling),
      share("numerical_K", &Uncertainty::numerical),
      share("fit_K", &Uncertainty::fit),
      share("input_K", &Uncertainty::input),
      share("load_curve_K", &Uncertainty::load_curve),
      share("model_form_K", &Uncertainty::model_form),
      share("sliding_K", &Uncertainty::sliding),
      of_ignition("ignition_cause", &NamedIgnition::cause),
      store::not_negative(of_ignition("ignition_time_s", &NamedIgnition::time)),
      of_ignition("ignition_point", &NamedIgnition::point),
      of_ignition("ignition_chemical_share", &NamedIgnition::chemical_share)};
  columns.insert(columns.end(), more.begin(), more.end());
  return columns;
}

const SqlTable<GapVerdict>& gap_table() {
  static const SqlTable<GapVerdict> table{
      "stored_gaps", {"answer", "position"}, "answer, position", gap_columns()};
  return table;
}

const SqlTable<GapShare>& share_table() {
  static const SqlTable<GapShare> table{
      "stored_shares",
      {"answer", "position"},
      "answer, position",
      {choice<GapShare>("kind", &GapShare::kind, last_share_kind),
       amount<GapShare>("raised_m", &GapShare::raised), amount<GapShare>("lowered_m", &GapShare::lowered)}};
  return table;
}

const SqlTable<AsCalibrated>& as_calibrated_table() {
  static const SqlTable<AsCalibrated> table{
      "stored_as_calibrated",
      {"answer", "gap", "position"},
      "answer, gap, position",
      {store::repeated_text<AsCalibrated>("constant", &AsCalibrated::key),
       amount<AsCalibrated>("temperature_K", &AsCalibrated::temperature),
       store::sql_column<AsCalibrated>("ignites", &AsCalibrated::ignites)}};
  return table;
}

std::string json_of(const std::vector<std::string>& texts) {
  return nlohmann::json(texts).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

AnswerRow row_of(const CaseAnswer& answer) {
  const bool bounded = !std::isnan(answer.critical.bounds.at_least) || !answer.critical.shares.empty();
  return {.key = {},
          .check = 0,
          .answer = answer,
          .bounded = bounded,
          .runs = json_of(answer.runs),
          .validity_warnings = json_of(answer.validity_warnings)};
}

constexpr std::size_t number_digits = 15;  // 60 bits: a positive number
std::int64_t number_of(const std::string& hexadecimal) {
  return std::stoll(hexadecimal.substr(0, number_digits), nullptr, 16);
}

std::int64_t check_of(const CaseAnswer& answer) { return number_of(store::sha256(bytes_of(answer))); }

MaybeError make_tables(Database& database) {
  if (database.has_table(answer_table().name)) return {};
  for (const std::string& statement :
       {gap_table().create_statement(), share_table().create_statement(),
        as_calibrated_table().create_statement(), answer_table().create_statement()})
    if (MaybeError error = database.run(statement)) return error;
  return {};
}

template <class Row>
MaybeError put_all(Database& database, const SqlTable<Row>& table, std::vector<std::int64_t> keys,
                   const std::vector<Row>& rows) {
  for (keys.push_back(0); const Row& row : rows) {
    if (MaybeError error = table.put(database, keys, row)) return error;
    ++keys.back();
  }
  return {};
}

/// Fills a list from JSON; false where it is none of texts.
bool read_texts(const std::string& json, std::vector<std::string>& texts) {
  const auto list = nlohmann::json::parse(json, nullptr, false);
  if (!list.is_array()) return false;
  for (const auto& each : list) {
    if (!each.is_string()) return false;
    texts.push_back(each.get<std::string>());
  }
  return true;
}

/// Whether its numbers contradict each other.
bool is_sound(const CaseAnswer& answer) {
  const CriticalGap& gap = answer.critical;
  const bool is_value = gap.kind == CriticalGapKind::value;
  if (is_value != std::isfinite(gap.value)) return false;
  if (is_value && !(gap.lower <= gap.value && gap.value <= gap.upper)) return false;
  for (const GapVerdict& row : answer.verdicts) {
    if (row.air.supplied < row.air.stored) return false;
    if (row.ignition && row.ignition->cause > surface::IgnitionCause::arrhenius) return false;
  }
  return answer.run.status == run::RunStatus::completed || !answer.completed();
}

}  // namespace

std::string bytes_of(const CaseAnswer& answer) {
  std::string bytes;
  answer_table().append_bytes_of(row_of(answer), bytes);
  for (const GapVerdict& row : answer.verdicts) {
    gap_table().append_bytes_of(row, bytes);
    for (const AsCalibrated& each : row.as_calibrated) as_calibrated_table().append_bytes_of(each, bytes);
  }
  for (const GapShare& share : answer.critical.shares) share_table().append_bytes_of(share, bytes);
  return bytes;
}

MaybeError save_answer(Database& database, const std::string& key, const CaseAnswer& answer) {
  if (MaybeError error = make_tables(database)) return error;
  const std::int64_t number = number_of(key);
  for (const std::string& table : {gap_table().name, share_table().name, as_calibrated_table().name})
    if (MaybeError error = database.run("DELETE FROM " + table + " WHERE answer = ?", {number})) return error;
  AnswerRow row = row_of(answer);
  row.key = key;
  row.check = check_of(answer);
  if (MaybeError error = answer_table().put(database, {number}, row)) return error;
  if (MaybeError error = put_all(database, gap_table(), {number}, answer.verdicts)) return error;
  if (MaybeError error = put_all(database, share_table(), {number}, answer.critical.shares)) return error;
  for (std::size_t i = 0; i < answer.verdicts.size(); ++i)
    if (MaybeError error = put_all(database, as_calibrated_table(), {number, static_cast<std::int64_t>(i)},
                                   answer.verdicts[i].as_calibrated))
      return error;
  return {};
}

void save_answer(store::CaseStore& store, const std::string& key, const CaseAnswer& answer) {
  store.write([&](Database& database) { return save_answer(database, key, answer); });
}

std::optional<CaseAnswer> read_answer(Database& database, const std::string& key) {
  const std::int64_t number = number_of(key);
  auto found = answer_table().select(database, {number});
  if (!found || found->size() != 1 || found->front().key != key) return std::nullopt;
  AnswerRow& row = found->front();
  CaseAnswer answer = std::move(row.answer);
  if (!read_texts(row.runs, answer.runs) || !read_texts(row.validity_warnings, answer.validity_warnings))
    return std::nullopt;
  auto gaps = gap_table().select(database, {number});
  auto shares = share_table().select(database, {number});
  const auto as_calibrated = as_calibrated_table().select(database, {number});
  if (!gaps || !shares || !as_calibrated) return std::nullopt;
  // Every gap has as many, in the order of the gaps; the checksum tells where that is not so.
  const auto of_gap =
      static_cast<std::ptrdiff_t>(as_calibrated->size() / std::max<std::size_t>(1, gaps->size()));
  answer.verdicts = std::move(*gaps);
  for (auto next = as_calibrated->begin(); GapVerdict & each : answer.verdicts) {
    each.as_calibrated.assign(next, next + of_gap);
    next += of_gap;
  }
  if (row.bounded) set_shares(answer.critical, std::move(*shares));
  if (check_of(answer) != row.check || !is_sound(answer)) return std::nullopt;
  return answer;
}

std::optional<CaseAnswer> read_answer(const store::CaseStore& store, const std::string& key) {
  std::optional<CaseAnswer> answer;
  store.read([&](Database& database) { answer = read_answer(database, key); });
  return answer;
}

}  // namespace launchsafe::study
