#include "amounts.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

namespace launchsafe::app {
namespace {

struct UnitFactor {
  std::string_view name;  ///< lower case
  double factor;
};

constexpr std::array<UnitFactor, 14> size_units{{{"", 1},
                                                 {"b", 1},
                                                 {"kb", 1e3},
                                                 {"mb", 1e6},
                                                 {"gb", 1e9},
                                                 {"tb", 1e12},
                                                 {"k", 1e3},
                                                 {"m", 1e6},
                                                 {"g", 1e9},
                                                 {"t", 1e12},
                                                 {"kib", 1024.0},
                                                 {"mib", 1024.0 * 1024},
                                                 {"gib", 1024.0 * 1024 * 1024},
                                                 {"tib", 1024.0 * 1024 * 1024 * 1024}}};

constexpr std::array<UnitFactor, 6> duration_units{
    {{"", 1}, {"ms", 1e-3}, {"s", 1}, {"min", 60}, {"h", 3600}, {"d", 86400}}};

constexpr std::array<UnitFactor, 2> temperature_units{{{"", 1}, {"k", 1}}};

/// The unit's own letters, without the blanks around them.
std::string unit_in(std::string_view text) {
  std::string unit;
  for (const char letter : text) unit += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  const auto first = unit.find_first_not_of(' ');
  if (first == std::string::npos) return {};
  return unit.substr(first, unit.find_last_not_of(' ') - first + 1);
}

template <std::size_t count>
std::optional<double> parse_amount(std::string_view text, const std::array<UnitFactor, count>& units) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{}) return std::nullopt;
  const std::string unit = unit_in(text.substr(static_cast<std::size_t>(end - text.data())));
  const auto found =
      std::find_if(units.begin(), units.end(), [&](const UnitFactor& each) { return each.name == unit; });
  if (found == units.end()) return std::nullopt;
  const double amount = number * found->factor;
  return std::isfinite(amount) && amount > 0 ? std::optional(amount) : std::nullopt;
}

}  // namespace

std::optional<double> parse_size(std::string_view text) {
  const auto size = parse_amount(text, size_units);
  constexpr double largest = 1e18;  // what whole numbers of bytes are counted with
  return size && *size >= 1 && *size <= largest ? size : std::nullopt;
}

std::optional<double> parse_duration(std::string_view text) { return parse_amount(text, duration_units); }

std::optional<double> parse_temperature(std::string_view text) {
  return parse_amount(text, temperature_units);
}

}  // namespace launchsafe::app
