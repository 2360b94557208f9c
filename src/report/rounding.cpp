// Numbers as people read them, with the uncertainty that rounds them.
#include "launchsafe/report/table.hpp"

#include <charconv>

namespace launchsafe::report {
namespace {

/// The text of what is no finite number; empty for those that are.
std::string not_finite(double value) {
  if (std::isnan(value)) return "n/a";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return {};
}

/// A number in one of fmt's notations; "-0.00" without its sign.
std::string rounded(double value, const char* notation, int digits) {
  std::string text = not_finite(value);
  if (!text.empty()) return text;
  text = fmt::format(fmt::runtime(notation), value, digits);
  const bool is_zero = text.starts_with('-') && text.find_first_of("123456789") == std::string::npos;
  return is_zero ? text.substr(1) : text;
}

/// By this share a number may be off as it is binary: 0.29 is a hair below its 29 hundredths.
constexpr double round_off = 1e-12;

int leading_place(double value) { return static_cast<int>(std::floor(std::log10(value) + round_off)); }

double cut(double value, int decimals, double direction) {
  const double scale = std::pow(10.0, decimals), scaled = value * scale;
  const double nearest = std::round(scaled);
  if (std::abs(scaled - nearest) <= round_off * std::max(1.0, std::abs(scaled))) return nearest / scale;
  return (direction < 0 ? std::floor(scaled) : std::ceil(scaled)) / scale;
}

}  // namespace

std::string fixed(double value, int decimals) { return rounded(value, "{:.{}f}", decimals); }
std::string scientific(double value, int decimals) { return rounded(value, "{:.{}e}", decimals); }
std::string significant(double value, int digits) {
  constexpr double least_power = 1e6;  // what people read as a power of ten
  const std::string text = rounded(value, "{:.{}g}", digits);
  if (text.find("e+") == std::string::npos || std::abs(value) >= least_power) return text;
  return fixed(std::stod(text), 0);  // "180", not "1.8e+02"
}

double round_distance(double least) {
  const double decade = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * decade >= least * (1.0 - 1e-9)) return factor * decade;
  return 10.0 * decade;
}

std::string exact(double value) {
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return value > 0 ? "Infinity" : "-Infinity";
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string duration(double seconds) {
  if (std::string text = not_finite(seconds); !text.empty()) return text;
  if (seconds < 9.95) return fixed(seconds, 1) + " s";
  constexpr double countless = 1e12;
  if (seconds > countless) return fmt::format("{:.3g} d", seconds / 86400.0);
  const auto whole = static_cast<long long>(std::llround(seconds));
  constexpr long long minute = 60, hour = 60 * minute, day = 24 * hour;
  if (whole < minute) return fmt::format("{} s", whole);
  if (whole < hour) return fmt::format("{} min {:02} s", whole / minute, whole % minute);
  if (whole < day) return fmt::format("{} h {:02} min", whole / hour, whole % hour / minute);
  return fmt::format("{} d {:02} h", whole / day, whole % day / hour);
}

std::string counted(std::int64_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::size_t display_width(std::string_view text) {
  std::size_t width = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const bool continues = (byte & 0xc0) == 0x80;
    // U+0300 to U+036F, combining marks, begin with CC or with CD 80 to CD AF.
    const bool combines = byte == 0xcc || (byte == 0xcd && i + 1 < text.size() &&
                                           static_cast<unsigned char>(text[i + 1]) <= 0xaf);
    if (!continues && !combines) ++width;
  }
  return width;
}

// --- with an uncertainty ---

int decimals_for(double uncertainty) {
  if (!(uncertainty > 0.0) || !std::isfinite(uncertainty)) return 0;
  return std::max(0, 1 - leading_place(uncertainty));
}

double rounded_down(double value, int decimals) { return cut(value, decimals, -1.0); }
double rounded_up(double value, int decimals) { return cut(value, decimals, 1.0); }

std::string Measured::text(const std::string& unit) const {
  const std::string middle = fixed(value, decimals), up = fixed(plus, decimals),
                    down = fixed(minus, decimals);
  const std::string end = unit.empty() ? "" : " " + unit;
  if (up == down) return fmt::format("{} ± {}{}", middle, up, end);
  return fmt::format("{} +{} −{}{}", middle, up, down, end);
}

Measured measured(double value, double minus, double plus) {
  Measured shown;
  shown.decimals = decimals_for(std::max(minus, plus));
  shown.value = rounded_down(value, shown.decimals);
  shown.minus = rounded_up(minus, shown.decimals);
  // The value went down, and its upper end must not.
  shown.plus = rounded_up(std::max(plus, minus == plus ? plus : value + plus - shown.value), shown.decimals);
  return shown;
}

std::optional<Measured> measured_gap(double value, double at_least, double at_most) {
  const double minus = value - at_least, plus = at_most - value;
  if (!std::isfinite(minus) || !std::isfinite(plus) || !(std::max(minus, plus) > 0.0)) return std::nullopt;
  Measured shown = measured(value, minus, plus);
  // No gap is below 0, though the value was cut.
  if (at_least >= 0.0) shown.minus = std::min(shown.minus, shown.value);
  return shown;
}

std::string allowed_text(double value, int decimals) {
  return fixed(rounded_down(value, decimals), decimals);
}

std::string uncertain_text(double value, int digits) {
  if (!(value > 0.0) || !std::isfinite(value)) return fixed(value, 0);
  const int decimals = digits - 1 - leading_place(value);
  if (decimals >= 0) return significant(rounded_up(value, decimals), digits);
  const double unit = std::pow(10.0, -decimals);
  return fixed(unit * rounded_up(value / unit, 0), 0);
}

}  // namespace launchsafe::report
