#include "launchsafe/report/gap_criterion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <sstream>

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
    {"margin", "K", {&JudgedGap::margin}},
    {"margin", "uncertainty", {&JudgedGap::margin, &JudgedGap::uncertainty}},
    {"margin", "uncertainties", {&JudgedGap::margin, &JudgedGap::uncertainty}},
    {"distance", "cm", {&JudgedGap::distance}},
    {"distance", "mm", {&JudgedGap::distance, nullptr, 0.1}},
    {"distance", "uncertainty", {&JudgedGap::distance, &JudgedGap::distance_uncertainty}},
    {"distance", "uncertainties", {&JudgedGap::distance, &JudgedGap::distance_uncertainty}}};

/// Four words: "margin", ">=", "2", "uncertainty". One uncertainty is part of SAFE already.
std::optional<GapCriterion::Condition> condition_of(const std::vector<std::string>& words) {
  if (words.size() != 4 || words[1] != ">=") return std::nullopt;
  std::istringstream stream(words[2]);
  stream.imbue(std::locale::classic());
  double least = 0;
  if (!(stream >> least) || stream.peek() != std::istringstream::traits_type::eof()) return std::nullopt;
  for (const Measure& each : measures)
    if (words[0] == each.word && words[3] == each.unit && std::isfinite(least) &&
        (each.one.unit != nullptr ? least >= 1.0 : least > 0.0))
      return GapCriterion::Condition{each.one.of, each.one.unit, each.one.least * least};
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
           return row.*each.of >= each.least * unit;  // false for NaN
         });
}

scene::Expected<GapCriterion> parse_criterion(const std::string& text, const std::string& source) {
  GapCriterion criterion{on_one_line(text), on_one_line(source), {}};
  std::istringstream stream(text + " and");
  std::vector<std::string> words;
  for (std::string word; stream >> word;) {
    if (word != "and") {
      words.push_back(word);
      continue;
    }
    const auto condition = condition_of(words);
    if (!condition)
      return fault_of("--criterion", fmt::format("\"{}\"", text),
                      "\"margin >= N uncertainty\", \"margin >= N K\", \"distance >= N uncertainty\" or "
                      "\"distance >= N cm\", several with \"and\" between them");
    criterion.conditions.push_back(*condition);
    words.clear();
  }
  if (!criterion.source.empty()) return criterion;
  return fault_of("--criterion-source", "none",
                  "who asks for the criterion, such as \"works standard 12, section 3\"");
}

std::size_t largest_gap_under(const GapCriterion& criterion, const std::vector<JudgedGap>& rows) {
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return rows[a].gap < rows[b].gap; });
  std::size_t largest = rows.size();
  for (const std::size_t each : order) {
    if (!criterion.met_by(rows[each])) break;
    largest = each;
  }
  return largest;
}

}  // namespace launchsafe::report
