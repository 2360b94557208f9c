#include "launchsafe/report/gap_criterion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <sstream>

namespace launchsafe::report {
namespace {

constexpr const char* allowed_criteria =
    "\"margin >= N uncertainty\", \"margin >= N K\", \"distance >= N uncertainty\" or \"distance >= N cm\", "
    "several with \"and\" between them";

scene::InputError criterion_fault(const std::string& found) {
  scene::InputError fault;
  fault.key = "--criterion";
  fault.found = found;
  fault.allowed = allowed_criteria;
  return fault;
}

std::optional<double> whole_number(const std::string& word) {
  std::istringstream stream(word);
  stream.imbue(std::locale::classic());
  double value = 0;
  if (!(stream >> value) || stream.peek() != std::istringstream::traits_type::eof()) return std::nullopt;
  return std::isfinite(value) && value > 0.0 ? std::optional(value) : std::nullopt;
}

/// Four words: "margin", ">=", "2", "uncertainty".
std::optional<GapCriterion::Condition> condition_of(const std::vector<std::string>& words) {
  if (words.size() != 4 || words[1] != ">=") return std::nullopt;
  GapCriterion::Condition condition;
  if (words[0] == "distance") {
    condition.of = GapCriterion::Of::distance;
  } else if (words[0] != "margin") {
    return std::nullopt;
  }
  const auto least = whole_number(words[2]);
  if (!least) return std::nullopt;
  condition.least = *least;
  const bool of_margin = condition.of == GapCriterion::Of::margin;
  if (words[3] == "uncertainty" || words[3] == "uncertainties") {
    condition.times_uncertainty = true;
    return *least >= 1.0 ? std::optional(condition) : std::nullopt;
  }
  if (!of_margin && words[3] == "mm") condition.least *= 0.1;
  return words[3] == (of_margin ? "K" : "cm") || (!of_margin && words[3] == "mm") ? std::optional(condition)
                                                                                  : std::nullopt;
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
  return row.safe && std::all_of(conditions.begin(), conditions.end(), [&](const Condition& each) {
           const bool of_margin = each.of == Of::margin;
           const double unit = !each.times_uncertainty ? 1.0
                               : of_margin             ? row.uncertainty
                                                       : row.distance_uncertainty;
           return (of_margin ? row.margin : row.distance) >= each.least * unit;  // false for NaN
         });
}

scene::Expected<GapCriterion> parse_criterion(const std::string& text, const std::string& source) {
  GapCriterion criterion{on_one_line(text), on_one_line(source), {}};
  std::istringstream stream(text);
  std::vector<std::string> words;
  const auto close = [&] {
    const auto condition = condition_of(words);
    if (condition) criterion.conditions.push_back(*condition);
    words.clear();
    return condition.has_value();
  };
  for (std::string word; stream >> word;) {
    if (word != "and") {
      words.push_back(word);
    } else if (!close()) {
      return criterion_fault(fmt::format("\"{}\"", text));
    }
  }
  if (!close()) return criterion_fault(fmt::format("\"{}\"", text));
  if (criterion.source.empty()) {
    scene::InputError fault;
    fault.key = "--criterion-source";
    fault.found = "none";
    fault.allowed = "who asks for the criterion, such as \"works standard 12, section 3\"";
    return fault;
  }
  return criterion;
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
