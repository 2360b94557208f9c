#include "launchsafe/report/safety_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <regex>
#include <sstream>
#include <string_view>

namespace launchsafe::report {
namespace {

scene::InputError fault_of(const char* key, std::string found, const char* allowed) {
  scene::InputError fault;
  fault.key = key;
  fault.found = std::move(found);
  fault.allowed = allowed;
  return fault;
}

/// What a condition may be of, and in which unit; a distance is kept in cm.
struct Measure {
  const char *word, *unit;
  GapCriterion::Condition one;
};
constexpr Measure measures[] = {
    {"T max", "K", {&JudgedGap::temperature, nullptr, 1.0, true}},
    {"probability", "", {&JudgedGap::probability, nullptr, 1.0, true}},
    {"margin", "K", {&JudgedGap::margin}},
    {"margin", "uncertainty", {&JudgedGap::margin, &JudgedGap::uncertainty}},
    {"margin", "uncertainties", {&JudgedGap::margin, &JudgedGap::uncertainty}},
    {"distance", "cm", {&JudgedGap::distance}},
    {"distance", "mm", {&JudgedGap::distance, nullptr, 0.1}},
    {"distance", "uncertainty", {&JudgedGap::distance, &JudgedGap::distance_uncertainty}},
    {"distance", "uncertainties", {&JudgedGap::distance, &JudgedGap::distance_uncertainty}}};

/// "margin >= 2 uncertainty", or without blanks. One uncertainty is part of SAFE already.
std::optional<GapCriterion::Condition> condition_of(const std::string& text) {
  static const std::regex form(R"(([a-zA-Z ]*[a-zA-Z]) ?(<=|>=) ?([0-9.eE+-]*[0-9.]) ?([a-zA-Z]*))");
  std::smatch parts;
  if (!std::regex_match(text, parts, form)) return std::nullopt;
  std::istringstream stream(parts[3]);
  stream.imbue(std::locale::classic());
  double limit = 0;
  if (!(stream >> limit) || stream.peek() != std::istringstream::traits_type::eof()) return std::nullopt;
  for (const Measure& each : measures)
    if (parts[1] == each.word && parts[2] == (each.one.at_most ? "<=" : ">=") && parts[4] == each.unit &&
        std::isfinite(limit) && (each.one.unit != nullptr ? limit >= 1.0 : limit > 0.0) &&
        (*each.unit != '\0' || limit < 1.0))
      return GapCriterion::Condition{each.one.of, each.one.unit, each.one.limit * limit, each.one.at_most};
  return std::nullopt;
}

/// Words with one blank between them.
std::string on_one_line(const std::string& text) {
  std::istringstream stream(text);
  std::string line;
  for (std::string word; stream >> word;) line += (line.empty() ? "" : " ") + word;
  return line;
}

}  // namespace

bool GapCriterion::met_by(const JudgedGap& row) const {
  return row.safe && std::ranges::all_of(conditions, [&](const Condition& each) {
           const double unit = each.unit != nullptr ? row.*each.unit : 1.0;
           const double value = row.*each.of, limit = each.limit * unit;
           return each.at_most ? value <= limit : value >= limit;  // false for NaN
         });
}

scene::Expected<GapCriterion> parse_criterion(const std::string& text, const std::string& source) {
  GapCriterion criterion{on_one_line(text), on_one_line(source), {}};
  constexpr std::string_view between = " and ";
  const std::string all = criterion.text + std::string(between);
  for (std::size_t begin = 0; begin < all.size();) {
    const std::size_t end = all.find(between, begin);
    const auto condition = condition_of(all.substr(begin, end - begin));
    if (!condition)
      return fault_of("--criterion", fmt::format("\"{}\"", text),
                      "\"margin >= N uncertainty\", \"margin >= N K\", \"T max <= N K\", \"distance >= N "
                      "uncertainty\", \"distance >= N cm\" or \"probability <= N\" below 1, several with "
                      "\"and\" between them");
    criterion.conditions.push_back(*condition);
    begin = end + between.size();
  }
  if (!criterion.source.empty()) return criterion;
  return fault_of("--criterion-source", "none",
                  "who asks for the criterion, such as \"works standard 12, section 3\"");
}

std::size_t largest_gap_under(const GapCriterion& criterion, const std::vector<JudgedGap>& rows) {
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t row) { return rows[row].gap; });
  std::size_t largest = rows.size();
  for (const std::size_t each : order) {
    if (!criterion.met_by(rows[each])) break;
    largest = each;
  }
  return largest;
}

}  // namespace launchsafe::report
