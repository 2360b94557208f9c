#include "gnuplot_text.hpp"

#include "launchsafe/report/number.hpp"

#include <cctype>
#include <cmath>
#include <tuple>

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

void Commands::add(const std::string& name, const std::string& lines, const std::string& how) {
  settings += fmt::format("${} << END_OF_DATA\n{}END_OF_DATA\n", name, lines);
  plots.push_back("$" + name + " using " + how);
}

std::string Commands::text() const {
  return plots.empty() ? settings : settings + fmt::format("plot {}\n", fmt::join(plots, ", \\\n     "));
}

std::string page_commands(double width, double height) {
  return fmt::format(
      "set encoding utf8\n"
      "set terminal svg size {},{} noenhanced font 'sans-serif,14' background rgb '#ffffff' rounded\n",
      width, height);
}

store::Result<std::string> to_svg(const Drawing& drawing, const DrawingLimits& limits,
                                  const std::string& program) {
  const auto [title, why, commands] = std::visit(
      [](const auto& plot) {
        const std::string unfitness = unfit(plot);
        return std::tuple{plot.title, unfitness, unfitness.empty() ? to_gnuplot(plot) : ""};
      },
      drawing);
  if (!why.empty()) return store::Error{store::Error::Kind::failed, "cannot draw '" + title + "': " + why};
  // --default-settings: the user's own start-up file must not change a report.
  auto run = store::run_program(program, {"--default-settings", "-"}, commands, limits);
  if (!run) return run.error();
  if (!run->succeeded || run->output.find("</svg>") == std::string::npos)
    return store::Error{store::Error::Kind::failed,
                        fmt::format("{} could not draw '{}': {}", program, title, run->errors)};
  return run->output;
}

}  // namespace launchsafe::report
