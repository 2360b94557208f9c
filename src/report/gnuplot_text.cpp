#include "gnuplot_text.hpp"

#include "launchsafe/report/number.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <string_view>

namespace launchsafe::report {

std::string quoted(const std::string& text) {
  constexpr std::string_view harmless = " ,.:;()[]+-=/_<>";
  std::string result = "\"";
  for (const char character : text) {
    const auto byte = static_cast<unsigned char>(character);
    if (byte < 0x20 || byte == 0x7f) {
      result += ' ';
    } else if (byte >= 0x80 || std::isalnum(byte) != 0 ||
               harmless.find(character) != std::string_view::npos) {
      result += character;
    } else {
      result += fmt::format("\\{:03o}", byte);
    }
  }
  return result + "\"";
}

bool drawable(double value, Scale scale) {
  return std::isfinite(value) && (scale == Scale::linear || value > 0);
}

std::string coordinate(double value, Scale scale) { return drawable(value, scale) ? exact(value) : "NaN"; }

std::string data_block(const std::string& name, const std::string& lines) {
  return fmt::format("${} << END_OF_DATA\n{}END_OF_DATA\n", name, lines);
}

}  // namespace launchsafe::report
