#include "launchsafe/report/safety_report.hpp"

#include <regex>
#include <sstream>
#include <variant>

namespace launchsafe::report {
namespace {

/// What a condition may be of, and in which unit; a distance is kept in cm.
struct Measure {
  const char *word, *unit;
  GapCriterion::Condition one;
};
constexpr Measure measures[] = {{"T max", "K", {"temperature_max_K", nullptr, 1.0, true}},
                                {"probability", "", {"probability", nullptr, 1.0, true}},
                                {"margin", "K", {"margin_K"}},
                                {"margin", "uncertainty", {"margin_K", "uncertainty_K"}},
                                {"margin", "uncertainties", {"margin_K", "uncertainty_K"}},
                                {"distance", "cm", {"distance_cm"}},
                                {"distance", "mm", {"distance_cm", nullptr, 0.1}},
                                {"distance", "uncertainty", {"distance_cm", "distance_uncertainty_cm"}},
                                {"distance", "uncertainties", {"distance_cm", "distance_uncertainty_cm"}}};

/// What is wrong with a limit; empty for nothing. One uncertainty, and no ignition (K), are part of SAFE.
std::string fault_of(const Measure& measure, bool at_most, double limit, double ignition) {
  if (at_most != measure.one.at_most)
    return fmt::format("a {} is wanted that is {}", measure.word,
                       measure.one.at_most ? "small: <=" : "large: >=");
  if (!std::isfinite(limit) || limit <= 0.0) return "a limit is more than 0";
  if (measure.one.unit != nullptr && limit < 1.0) return "one uncertainty is part of SAFE already";
  if (*measure.unit == '\0') return limit < 1.0 ? "" : "a probability is below 1";
  if (!at_most || limit < ignition) return "";
  return fmt::format("the charge ignites at {:.6g} K, and every SAFE gap is colder", ignition);
}

/// "margin >= 2 uncertainty", or without blanks. Else why it is none; empty where no measure is recognised.
std::variant<GapCriterion::Condition, std::string> condition_of(const std::string& text, double ignition) {
  static const std::regex form(R"(([a-zA-Z ]*[a-zA-Z]) ?(<=|>=) ?([0-9.eE+-]*[0-9.]) ?([a-zA-Z]*))");
  std::smatch parts;
  if (!std::regex_match(text, parts, form)) return "";
  std::istringstream stream(parts[3]);
  stream.imbue(std::locale::classic());
  double limit = 0;
  if (!(stream >> limit) || stream.peek() != std::istringstream::traits_type::eof()) return "";
  for (const Measure& each : measures) {
    if (parts[1] != each.word || parts[4] != each.unit) continue;
    if (std::string fault = fault_of(each, parts[2] == "<=", limit, ignition); !fault.empty()) return fault;
    return GapCriterion::Condition{each.one.of, each.one.unit, each.one.limit * limit, each.one.at_most};
  }
  return "";
}

/// Words with one blank between them.
std::string on_one_line(const std::string& text) {
  std::istringstream words(text);
  using Word = std::istream_iterator<std::string>;
  return fmt::format("{}", fmt::join(Word(words), Word(), " "));
}

}  // namespace

bool GapCriterion::met_by(const Row& verdict) const {
  return text_of(verdict, "verdict") == "SAFE" && std::ranges::all_of(conditions, [&](const Condition& each) {
           const double unit = each.unit != nullptr ? number_of(verdict, each.unit) : 1.0;
           const double value = number_of(verdict, each.of), limit = each.limit * unit;
           return each.at_most ? value <= limit : value >= limit;  // false for NaN
         });
}

scene::Expected<GapCriterion> parse_criterion(const std::string& text, const std::string& source,
                                              double ignition) {
  GapCriterion criterion{on_one_line(text), on_one_line(source), {}};
  constexpr std::string_view between = " and ";
  const std::string all = criterion.text + std::string(between);
  for (std::size_t begin = 0; begin < all.size();) {
    const std::size_t end = all.find(between, begin);
    const auto condition = condition_of(all.substr(begin, end - begin), ignition);
    if (const auto* why = std::get_if<std::string>(&condition))
      return scene::error_at(
          {}, "--criterion", fmt::format("\"{}\"{}{}", text, why->empty() ? "" : ", where ", *why),
          "\"margin >= N uncertainty\", \"margin >= N K\", \"T max <= N K\", \"distance >= N "
          "uncertainty\", \"distance >= N cm\" or \"probability <= N\" below 1, several with "
          "\"and\" between them");
    criterion.conditions.push_back(std::get<GapCriterion::Condition>(condition));
    begin = end + between.size();
  }
  if (!criterion.source.empty()) return criterion;
  return scene::error_at({}, "--criterion-source", "none",
                         "who asks for the criterion, such as \"works standard 12, section 3\"");
}

std::optional<double> largest_gap_under(const GapCriterion& criterion, std::vector<Row> verdicts) {
  const auto gap = [](const Row& verdict) { return number_of(verdict, "gap_cm"); };
  std::ranges::stable_sort(verdicts, {}, gap);
  std::optional<double> largest;
  for (const Row& each : verdicts) {
    if (!criterion.met_by(each)) break;
    largest = gap(each);
  }
  return largest;
}

}  // namespace launchsafe::report
