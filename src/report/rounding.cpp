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
std::string printed(double value, const char* notation, int digits) {
  std::string text = not_finite(value);
  if (!text.empty()) return text;
  text = fmt::format(fmt::runtime(notation), value, digits);
  const bool is_zero = text.starts_with('-') && text.find_first_of("123456789") == std::string::npos;
  return is_zero ? text.substr(1) : text;
}

/// By this share a number may be off as it is binary: 0.29 is a hair below its 29 hundredths.
constexpr double round_off = 1e-12;

int leading_place(double value) { return static_cast<int>(std::floor(std::log10(value) + round_off)); }

}  // namespace

std::string fixed(double value, int decimals) { return printed(value, "{:.{}f}", decimals); }
std::string scientific(double value, int decimals) { return printed(value, "{:.{}e}", decimals); }
std::string significant(double value, int digits) {
  constexpr double least_power = 1e6;  // what people read as a power of ten
  const std::string text = printed(value, "{:.{}g}", digits);
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

double rounded(double value, int decimals, Rounding side) {
  const double scale = std::pow(10.0, decimals), scaled = value * scale, nearest = std::round(scaled);
  const bool is_there = std::abs(scaled - nearest) <= round_off * std::max(1.0, std::abs(scaled));
  if (is_there || side == Rounding::nearest) return nearest / scale;
  return (side == Rounding::down ? std::floor(scaled) : std::ceil(scaled)) / scale;
}

std::string shown_digits(double value, const Form& form) {
  if (form.rounding != Rounding::nearest && std::isfinite(value) && value != 0.0)
    value = rounded(
        value,
        form.notation == Notation::fixed ? form.digits : form.digits - 1 - leading_place(std::abs(value)),
        form.rounding);
  if (form.notation == Notation::scientific) return scientific(value, form.digits);
  if (form.notation == Notation::significant) return significant(value, form.digits);
  return fixed(value, form.digits);
}

std::string between_bounds(double value, double at_least, double at_most, const std::string& unit) {
  double minus = value - at_least, plus = at_most - value;
  const double larger = std::max(minus, plus);
  if (!std::isfinite(minus) || !std::isfinite(plus) || !(larger > 0.0)) return {};
  const bool are_equal = minus == plus;
  const int decimals = std::max(0, 1 - leading_place(larger));
  const double middle = rounded(value, decimals, Rounding::down);
  minus = rounded(minus, decimals, Rounding::up);
  // The value went down, and its upper end must not. No gap is below 0, though the value was cut.
  plus = rounded(are_equal ? plus : value + plus - middle, decimals, Rounding::up);
  if (at_least >= 0.0) minus = std::min(minus, middle);
  const std::string up = fixed(plus, decimals), down = fixed(minus, decimals);
  if (up == down) return fmt::format("{} ± {} {}", fixed(middle, decimals), up, unit);
  return fmt::format("{} +{} −{} {}", fixed(middle, decimals), up, down, unit);
}

}  // namespace launchsafe::report
