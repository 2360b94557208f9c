#include "launchsafe/report/number.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace launchsafe::report {
namespace {

/// The text of what is no finite number; empty for those that are.
std::string not_finite(double value) {
  if (std::isnan(value)) return "n/a";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return {};
}

/// "-0.00" without its sign.
std::string without_negative_zero(std::string text) {
  const bool is_zero = text.starts_with('-') && text.find_first_of("123456789") == std::string::npos;
  return is_zero ? text.substr(1) : text;
}

}  // namespace

std::string fixed(double value, int decimals) {
  if (std::string text = not_finite(value); !text.empty()) return text;
  return without_negative_zero(fmt::format("{:.{}f}", value, decimals));
}

std::string scientific(double value, int decimals) {
  if (std::string text = not_finite(value); !text.empty()) return text;
  return without_negative_zero(fmt::format("{:.{}e}", value, decimals));
}

std::string significant(double value, int digits) {
  if (std::string text = not_finite(value); !text.empty()) return text;
  return without_negative_zero(fmt::format("{:.{}g}", value, digits));
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

}  // namespace launchsafe::report
