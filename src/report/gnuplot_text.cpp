#include "gnuplot_text.hpp"

#include "launchsafe/report/number.hpp"
#include "launchsafe/store/program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

namespace launchsafe::report::detail {
namespace {

/// Okabe and Ito's colours, told apart by the colour-blind too; grey for the yellow that white paper
/// swallows.
constexpr std::array<std::string_view, 8> palette{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                  "#e69f00", "#56b4e9", "#000000", "#7f7f7f"};

Range widened(Range range, Scale scale) {
  constexpr double share = 0.05;
  if (scale == Scale::logarithmic) {
    const double factor = range.high > range.low ? std::pow(range.high / range.low, share) : 2.0;
    return {range.low / factor, range.high * factor};
  }
  const double width = range.high - range.low;
  const double margin = width > 0 ? share * width : std::max(0.1 * std::abs(range.high), 1e-12);
  return {range.low - margin, range.high + margin};
}

std::string tics_command(const std::string& name, const Axis& axis) {
  std::string list;
  for (const Tic& tic : axis.tics) {
    if (!drawable(tic.at, axis.scale)) continue;
    list += fmt::format("{}{} {}", list.empty() ? "" : ", ", quoted(tic.label), exact(tic.at));
  }
  return list.empty() ? std::string{} : fmt::format("unset m{0}tics\nset {0}tics ({1})\n", name, list);
}

}  // namespace

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

void Range::include(double value, Scale scale) {
  if (!drawable(value, scale)) return;
  low = std::min(low, value);
  high = std::max(high, value);
}

Range with_limits(Range range, const Axis& axis) {
  range = widened(range, axis.scale);
  if (axis.minimum) range.low = *axis.minimum;
  if (axis.maximum) range.high = *axis.maximum;
  return range;
}

std::string_view palette_colour(std::size_t index) { return palette[index % palette.size()]; }

int point_type(Mark mark) {
  // In the order of Mark: gnuplot's filled signs, open signs, and the cross.
  constexpr std::array<int, 9> types{7, 5, 9, 13, 11, 6, 4, 8, 2};
  return types[static_cast<std::size_t>(mark)];
}

std::string page_commands(int width, int height, const std::string& title) {
  return fmt::format(
      "set encoding utf8\n"
      "set terminal svg size {},{} noenhanced font 'sans-serif,14' background rgb '#ffffff' rounded\n"
      "set border 3 linewidth 1 linecolor rgb '#444444'\n"
      "set tics nomirror out scale 0.6 textcolor rgb '#222222'\n"
      "set grid linewidth 0.7 dashtype 1 linecolor rgb '#dddddd'\n"
      "set title {} font ',16'\n",
      width, height, quoted(title));
}

std::string axis_commands(const std::string& name, const Axis& axis, const Range& range) {
  std::string text = fmt::format("set {}label {}\nset {}range [{}:{}]\n", name, quoted(axis.label), name,
                                 exact(range.low), exact(range.high));
  if (axis.scale == Scale::logarithmic) text += fmt::format("set logscale {}\n", name);
  return text + tics_command(name, axis);
}

std::string legend_below(int height, std::size_t entries, double centre) {
  // In pixels: tics and label of the axis, and each row of the legend. gnuplot's own guess is too small.
  constexpr double below_axis = 78, row = 26;
  const int rows = entries > 3 ? 2 : 1;
  return fmt::format(
      "set bmargin at screen {:.4f}\nset key at screen {:.4f}, screen {:.4f} center bottom vertical maxrows "
      "{} "
      "Left reverse samplen 1.6 spacing 1.25 width 1\n",
      (below_axis + row * rows) / height, centre, 6.0 / height, rows);
}

store::Result<std::string> drawn(const std::string& program, const std::string& commands,
                                 const std::string& title, const DrawingLimits& limits) {
  // --default-settings: the user's own start-up file must not change a report.
  auto run = store::run_program(program, {"--default-settings", "-"}, commands, limits);
  if (!run) return run.error();
  if (!run->succeeded || run->output.find("</svg>") == std::string::npos) {
    return store::Error{store::Error::Kind::failed,
                        fmt::format("{} could not draw '{}': {}", program, title, run->errors)};
  }
  return run->output;
}

}  // namespace launchsafe::report::detail
