// Statements of a publication as a file: their keys, and what each quantity has to say.
#include "launchsafe/scene/stations.hpp"
#include "launchsafe/study/published_statements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace launchsafe::study {
namespace {

using scene::Dimension, scene::Key, scene::Place;
using scene::Standing;
using Q = StatementQuantity;

std::vector<StatementTraits> make_statement_traits() {
  using enum Dimension;
  return {
      {Q::region,
       "hottest region",
       temperature,
       {"gaps", "time"},
       {},
       "lowest and highest temperature over the stations of the charge's bottom; it agrees where both lie "
       "within the published range, whose ends are limits of colours"},
      {Q::temperature,
       "temperature",
       temperature,
       {"gaps"},
       {"time", "point"},
       "that of the station in which the point lies, or of the hottest; without a time the highest of the "
       "launch"},
      {Q::hottest_point,
       "hottest point",
       {},
       {"gaps", "time"},
       {},
       "the station that is hottest at the time"},
      {Q::hottest_part,
       "hottest part",
       {},
       {"gaps", "time"},
       {},
       "the third of the bottom's radius in which that station lies: centre, between or outer"},
      {Q::spread,
       "spread",
       temperature_difference,
       {"gaps", "time"},
       {},
       "highest less lowest temperature of the stations"},
      {Q::fast_rise_begins,
       "fast rise begins",
       time,
       {"gaps"},
       {},
       "when the rate of the highest temperature, over 0.5 ms, first exceeds half of its largest before an "
       "ignition"},
      {Q::fast_rise_ends, "fast rise ends", time, {"gaps"}, {}, "when that rate last falls below that half"},
      {Q::reaches,
       "reaches",
       time,
       {"gaps", "level"},
       {"point"},
       "when the station, or the first one, comes to the level"},
      {Q::ignition_time, "ignition", time, {"gaps"}, {}, "of the first station"},
      {Q::ignition_point, "ignition point", {}, {"gaps"}, {}, "that station"},
      {Q::peak_pressure, "peak pressure", pressure, {}, {}, "the highest on the shell's base"},
      {Q::air_temperature,
       "air temperature",
       temperature,
       {"ratio"},
       {},
       "on the adiabat of the scene's air"},
      {Q::critical_gap, "critical gap", length, {}, {}, "by bisection"},
      {Q::slope,
       "slope",
       number,
       {},
       {},
       "K per cm, of the least-squares line through the gaps that do not ignite"},
      {Q::intercept, "intercept", temperature, {}, {}, "of that line at no gap"},
      {Q::not_computed, "not computed", {}, {"remark"}, {"gaps", "time"}, "listed for completeness"},
  };
}

std::vector<Key<PublishedStatement>> make_statement_keys() {
  using S = PublishedStatement;
  std::vector<std::pair<std::string, StatementQuantity>> words;
  for (const StatementTraits& each : statement_traits()) words.emplace_back(each.word, each.quantity);
  const std::vector<std::pair<std::string, Use>> uses{{"held out", Use::held_out},
                                                      {"selection", Use::selection},
                                                      {"calibration", Use::calibration},
                                                      {"input", Use::input}};
  const auto text = [](std::string name, std::string sentence, std::string example, std::string S::*member) {
    return scene::text_key<S>(std::move(name), Standing::paper, std::move(sentence), std::move(example),
                              member);
  };
  return {
      scene::required(scene::word_key<S>("quantity", Standing::paper, "What the statement is about.",
                                         std::move(words), &S::quantity)),
      scene::list_key<S>("gaps", Dimension::length, scene::between(0, 0.01), Standing::paper,
                         "Gaps of each of which it is said.", &S::gaps),
      scene::number_key<S>("time", Dimension::time, scene::at_least(0), Standing::paper,
                           "Instant of which it is said.", &S::time),
      text("point", "Observation point or station at which a temperature is said.", "G2", &S::point),
      scene::number_key<S>("level", Dimension::temperature, scene::above(0), Standing::paper,
                           "Temperature that is reached.", &S::level),
      scene::number_key<S>("ratio", Dimension::number, scene::at_least(1), Standing::paper,
                           "Pressure of the air over its initial one.", &S::ratio),
      scene::required(text("value",
                           "What is published: a quantity, a range such as \"400 to 445 K\", a point, or a "
                           "part of the bottom.",
                           "328.5 K", &S::value)),
      text("tolerance", "How far a number may be off: half the last printed digit, or what a figure shows.",
           "0.05 K", &S::tolerance_text),
      scene::word_key<S>("used", Standing::input, "What the number was used for.", uses, &S::use),
      scene::required(text("source", "Where the publication says it.", "Section 4.1", &S::source)),
      text("remark", "Why it is not computed, or what else is to be said of it.", "read off a figure",
           &S::remark),
  };
}

/// One [[statement]] as it is read.
struct StatementSource {
  const std::map<std::string, Place>& places;
  Place place;  ///< of the table
  const scene::Scene& scene;

  Place place_of(const std::string& key) const {
    const auto found = places.find(key);
    return found == places.end() ? place : found->second;
  }
  scene::InputError fault(const std::string& key, std::string_view found, std::string_view allowed,
                          std::string_view suggestion = {}) const {
    return scene::error_at(place_of(key), "statement." + key, found, allowed, suggestion);
  }
};

/// The keys that its quantity needs, and none that would do nothing.
Fault check_statement_keys(const StatementSource& source, const StatementTraits& traits) {
  std::vector<std::string> needs = traits.needs;
  if (traits.dimension) needs.emplace_back("tolerance");
  for (const std::string& key : needs)
    if (!source.places.contains(key))
      return source.fault(key, "missing", fmt::format("quantity \"{}\" needs it", traits.word));
  for (const auto& [key, place] : source.places) {
    constexpr std::array always{"quantity", "value", "source", "used", "remark"};
    const auto has = [&key = key](const auto& names) {
      return std::find(names.begin(), names.end(), key) != names.end();
    };
    if (has(always) || has(needs) || has(traits.may_have)) continue;
    std::vector<std::string> allowed = needs;
    allowed.insert(allowed.end(), traits.may_have.begin(), traits.may_have.end());
    return source.fault(key, fmt::format("a key that quantity \"{}\" does not have", traits.word),
                        allowed.empty()
                            ? std::string("value, source, used and remark alone")
                            : "besides value, source, used and remark: " + scene::quoted_list(allowed));
  }
  return std::nullopt;
}

Fault settle_number(const StatementSource& source, Dimension dimension, PublishedStatement& statement) {
  const bool range = statement.value.find(" to ") != std::string::npos;
  const bool region = statement.quantity == Q::region;
  const scene::KeyDescription value{.name = "statement.value",
                                    .kind = range || region ? scene::KeyKind::range : scene::KeyKind::number,
                                    .dimension = dimension};
  const auto read = scene::parse_value(statement.value, value, source.place_of("value"));
  if (!read) return read.error();
  const auto* ends = std::get_if<std::vector<double>>(&*read);
  statement.low = ends ? ends->front() : std::get<double>(*read);
  statement.high = ends ? ends->back() : std::get<double>(*read);
  const scene::KeyDescription tolerance{.name = "statement.tolerance",
                                        .dimension = scene::difference_of(dimension),
                                        .limits = scene::at_least(0)};
  const auto slack = scene::parse_value(statement.tolerance_text, tolerance, source.place_of("tolerance"));
  if (!slack) return slack.error();
  statement.tolerance = std::get<double>(*slack);
  return std::nullopt;
}

Fault check_place(const StatementSource& source, const std::string& key, const std::string& found,
                  const std::vector<std::string>& known) {
  if (std::find(known.begin(), known.end(), found) != known.end()) return std::nullopt;
  return source.fault(key, '"' + found + '"', scene::quoted_list(known), scene::nearest_of(found, known));
}

std::vector<std::string> points_of(const scene::Scene& scene) {
  std::vector<std::string> names;
  for (const scene::ObservationPoint& each : scene.output.observation_points) names.push_back(each.name);
  for (const scene::StationExtent& each : scene::stations_of(scene)) names.push_back(each.name);
  return names;
}

Fault settle_statement(const StatementSource& source, PublishedStatement& statement) {
  const StatementTraits& traits = traits_of(statement.quantity);
  if (Fault fault = check_statement_keys(source, traits)) return fault;
  const double end = source.scene.load.duration;
  if (statement.time > end * (1.0 + 1e-9))
    return source.fault("time", scene::time_text(statement.time),
                        "an instant of the launch, until " + scene::time_text(end));
  if (!statement.point.empty())
    if (Fault fault = check_place(source, "point", statement.point, points_of(source.scene))) return fault;
  if (traits.dimension) return settle_number(source, *traits.dimension, statement);
  if (statement.quantity == Q::hottest_part)
    return check_place(source, "value", statement.value, bottom_parts());
  if (statement.quantity != Q::not_computed)
    return check_place(source, "value", statement.value, points_of(source.scene));
  return std::nullopt;
}

}  // namespace

const std::vector<StatementTraits>& statement_traits() {
  static const std::vector<StatementTraits> traits = make_statement_traits();
  return traits;
}

const StatementTraits& traits_of(StatementQuantity quantity) {
  return *std::find_if(statement_traits().begin(), statement_traits().end(),
                       [quantity](const StatementTraits& each) { return each.quantity == quantity; });
}

const std::vector<std::string>& bottom_parts() {
  static const std::vector<std::string> parts{"centre", "between", "outer"};
  return parts;
}

const std::vector<Key<PublishedStatement>>& statement_keys() {
  static const std::vector<Key<PublishedStatement>> keys = make_statement_keys();
  return keys;
}

Fault read_statements(const toml::table& root, const std::string& file, StudyFile& study) {
  auto read =
      scene::read_tables(root, "statement", statement_keys(), file, "tables, each written [[statement]]");
  if (!read) return read.error();
  for (auto& [statement, places] : *read) {
    const StatementSource source{places, places.at("quantity"), study.scene.scene};
    if (Fault fault = settle_statement(source, statement)) return fault;
    study.study.statements.push_back(std::move(statement));
  }
  return std::nullopt;
}

}  // namespace launchsafe::study
