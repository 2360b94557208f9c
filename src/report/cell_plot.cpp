#include "launchsafe/report/plot.hpp"
#include "launchsafe/report/table.hpp"

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
  const auto [title, commands] = std::visit(
      [](const auto& plot) {
        return std::pair{plot.title, to_gnuplot(plot)};
      },
      drawing);
  // --default-settings: the user's own start-up file must not change a report.
  auto run = store::run_program(program, {"--default-settings", "-"}, commands, limits);
  if (!run) return run.error();
  if (!run->succeeded || run->output.find("</svg>") == std::string::npos)
    return store::Error{store::Error::Kind::failed,
                        fmt::format("{} could not draw '{}': {}", program, title, run->errors)};
  return run->output;
}

// --- sections of cells ---

namespace {

// --- the page: pixels, y downward ---

constexpr double cell_page_width = 1400, page_left = 86, page_top = 92;
constexpr double bar_width = 18, bar_distance = 140, before_bars = 64;
constexpr double most_whole_height = 620, window_height = 460;
constexpr double edge_margin = 0.002;  // share of the length
constexpr double below_axis = 66;

/// A window of the section and where it is on the page.
struct CellPanel {
  double x_begin = 0, x_end = 0, r_begin = 0, r_end = 0;  ///< mm
  double scale_x = 0, scale_r = 0;                        ///< pixels per mm
  double top = 0;                                         ///< pixels

  double width() const { return scale_x * (x_end - x_begin); }
  double height() const { return scale_r * (r_end - r_begin); }
  double bottom() const { return top + height(); }
};

/// Pixels that the section has along x, beside the colour bars.
double drawing_width(const CellPlot& plot) {
  return cell_page_width - page_left - before_bars - bar_distance * static_cast<double>(plot.scales.size());
}

CellPanel whole_section(const CellPlot& plot) {
  CellPanel panel{HUGE_VAL, -HUGE_VAL, 0, 0, 0, 0, page_top};
  for (const FieldCell& cell : plot.cells) {
    panel.x_begin = std::min(panel.x_begin, cell.x - cell.half_x);
    panel.x_end = std::max(panel.x_end, cell.x + cell.half_x);
    panel.r_end = std::max(panel.r_end, cell.r + cell.half_r);
  }
  // So that an outline along the edge of the panel is not cut off.
  const double margin = edge_margin * (panel.x_end - panel.x_begin);
  panel.x_begin -= margin;
  panel.x_end += margin;
  panel.r_end += margin;
  panel.r_begin = -panel.r_end;
  panel.scale_x = panel.scale_r =
      std::min(drawing_width(plot) / (panel.x_end - panel.x_begin), most_whole_height / (2.0 * panel.r_end));
  return panel;
}

CellPanel window_section(const CellPlot& plot) {
  const Window& part = *plot.window;
  const double margin = edge_margin * (part.x_end - part.x_begin);
  CellPanel panel{part.x_begin, part.x_end + margin, 0, part.r_end + margin, 0, 0, page_top};
  panel.scale_x = drawing_width(plot) / (panel.x_end - panel.x_begin);
  panel.scale_r = window_height / panel.r_end;
  return panel;
}

// --- data ---

/// 1 for a value above the colours of its scale, -1 for one below, else 0, also without a value.
int beyond(const CellPlot& plot, const FieldCell& cell) {
  const ColourScale& scale = plot.scales[cell.scale];
  return cell.value > scale.maximum ? 1 : cell.value < scale.minimum ? -1 : 0;
}

/// Bounds of a cell in a panel and its value; empty where it lies outside.
std::string cell_line(const FieldCell& cell, double side, const CellPanel& panel) {
  const double left = std::max(cell.x - cell.half_x, panel.x_begin),
               right = std::min(cell.x + cell.half_x, panel.x_end);
  const double low = std::max(side * cell.r - cell.half_r, panel.r_begin),
               high = std::min(side * cell.r + cell.half_r, panel.r_end);
  if (!(left < right) || !(low < high)) return {};
  const std::string value = std::isfinite(cell.value) ? " " + exact(cell.value) : "";
  return fmt::format("{} {} {} {} {} {}{}\n", exact(0.5 * (left + right)), exact(0.5 * (low + high)),
                     exact(left), exact(right), exact(low), exact(high), value);
}

/// Adds the cells that `is_wanted`, where there are any, mirrored where the panel shows both sides of the
/// axis.
template <class IsWanted>
void add_cells(const CellPlot& plot, const CellPanel& panel, const std::string& name, IsWanted is_wanted,
               const std::string& how, Commands& commands) {
  std::string lines;
  for (const FieldCell& cell : plot.cells) {
    if (!is_wanted(cell)) continue;
    lines += cell_line(cell, 1.0, panel);
    if (panel.r_begin < 0.0) lines += cell_line(cell, -1.0, panel);
  }
  if (!lines.empty()) commands.add(name, lines, how);
}

/// Closed where it does not lie on the axis.
std::string path_lines(const Outline& outline) {
  std::string lines;
  const auto add = [&](const Place& place) {
    lines += fmt::format("{} {}\n", exact(place.x), exact(place.r));
  };
  std::ranges::for_each(outline.path, add);
  if (!outline.path.empty() && !outline.open_at_axis) add(outline.path.front());
  return lines;
}

// --- commands ---

/// Distances from the axis, on both sides of it.
std::string radius_marks(const CellPanel& panel) {
  const double distance = round_distance(34 / panel.scale_r);
  std::string marks = "\"0\" 0";
  for (double r = distance; r <= panel.r_end * (1.0 + 1e-9); r += distance)
    for (const double place : {r, -r})
      if (place >= panel.r_begin) marks += fmt::format(", \"{}\" {}", significant(r, 6), exact(place));
  return marks;
}

/// Where the panel is on the page, and what it shows.
std::string panel_range(const CellPanel& panel, double page_height) {
  return fmt::format(
      "set lmargin at screen {}\nset rmargin at screen {}\nset tmargin at screen {}\nset bmargin at screen "
      "{}\nset xrange [{}:{}]\nset yrange [{}:{}]\n",
      exact(page_left / cell_page_width), exact((page_left + panel.width()) / cell_page_width),
      exact(1.0 - panel.top / page_height), exact(1.0 - panel.bottom() / page_height), exact(panel.x_begin),
      exact(panel.x_end), exact(panel.r_begin), exact(panel.r_end));
}

constexpr std::string_view filled_boxes = "with boxxyerror fillstyle solid 1.0 noborder linecolor";

/// The colours of values: viridis without its darkest part, so that black lines show everywhere. Its
/// lightness rises evenly, so that it also reads in grey.
constexpr const char* coloured =
    "set palette defined (0 '#485c9e', 1 '#317ea1', 2 '#2aa094', 3 '#5cc06e', 4 '#a8db44', 5 '#f6e63c')\n";

/// Range and look of a scale; its bar stands beside the first panel.
std::string scale_commands(const ColourScale& scale, std::size_t index, const CellPanel& first,
                           double page_height) {
  const double widened = scale.minimum < scale.maximum ? 0.0 : std::max(1.0, 1e-3 * std::abs(scale.maximum));
  const double left = page_left + first.width() + before_bars + bar_distance * static_cast<double>(index);
  return fmt::format(
      "{}set cbrange [{}:{}]\nset cblabel {} offset 1.5, 0\n"
      "set colorbox vertical user origin screen {}, screen {} size screen {}, screen {}\n",
      index == 0 ? coloured : "set palette defined (0 '#f4f4f4', 1 '#4a4a4a')\n",
      exact(scale.minimum - widened), exact(scale.maximum + widened), quoted(scale.label),
      exact(left / cell_page_width), exact(1.0 - first.bottom() / page_height),
      exact(bar_width / cell_page_width), exact(first.height() / page_height));
}

/// The cells of one scale, without axes; those without a value below the first.
std::string scale_cells(const CellPlot& plot, std::size_t scale, const CellPanel& panel) {
  Commands commands;
  if (scale == 0)
    add_cells(
        plot, panel, "grey", [](const FieldCell& cell) { return !std::isfinite(cell.value); },
        fmt::format("1:2:3:4:5:6 {} rgb '#d0d0d0' notitle", filled_boxes), commands);
  add_cells(
      plot, panel, fmt::format("cells{}", scale),
      [scale](const FieldCell& cell) { return cell.scale == scale && std::isfinite(cell.value); },
      fmt::format("1:2:3:4:5:6:7 {} palette notitle", filled_boxes), commands);
  return commands.text();
}

/// Cells beyond the colours, in two that the colour-blind too tell from them; over all cells the edges of
/// bodies, on both sides of the axis.
std::string outline_commands(const CellPlot& plot, const CellPanel& panel) {
  Commands commands;
  for (const int side : {1, -1})
    add_cells(
        plot, panel, side > 0 ? "above" : "below",
        [&](const FieldCell& cell) { return beyond(plot, cell) == side; },
        fmt::format("1:2:3:4:5:6 {} rgb '{}' notitle", filled_boxes, side > 0 ? "#d55e00" : "#cc79a7"),
        commands);
  constexpr std::string_view look = "with lines linewidth 1.2 linecolor rgb '#111111' notitle";
  for (std::size_t i = 0; i < plot.outlines.size(); ++i) {
    const std::string data = fmt::format("outline{}", i);
    commands.add(data, path_lines(plot.outlines[i]),
                 fmt::format("1:2 {}, ${} using 1:(-$2) {}", look, data, look));
  }
  return commands.text();
}

/// The axis of symmetry, beyond the base alone, where it hides no cell.
std::string axis_line(const CellPanel& panel) {
  return fmt::format(
      "set arrow 1 from first {0}, first 0 to first {1}, first 0 nohead front linewidth 1.2 linecolor rgb "
      "'#b23a48'\n"
      "set label 3 'axis' at first {1}, first 0 left offset 0.3, 0 font ',12' textcolor rgb '#b23a48'\n",
      exact(panel.x_end), exact(panel.x_end + 14.0 / panel.scale_x));
}

std::string page_text(const CellPlot& plot, const CellPanel& first) {
  std::string small = plot.subtitle;
  if (!plot.without_value.empty()) small += "; grey: " + plot.without_value;
  for (const int side : {1, -1})
    if (std::ranges::any_of(plot.cells, [&](const auto& cell) { return beyond(plot, cell) == side; }))
      small += side > 0 ? "; orange: above the colours" : "; pink: below the colours";
  if (plot.window)
    small += fmt::format("; x, towards the base, is stretched {} times",
                         significant(first.scale_x / first.scale_r, 2));
  return fmt::format(
      "set label 1 {} at screen {}, graph 1 offset 0, character 3.2 font ',17'\n"
      "set label 2 {} at screen {}, graph 1 offset 0, character 1.4 font ',13' textcolor rgb '#444444'\n",
      quoted(plot.title), exact(page_left / cell_page_width), report::quoted(small),
      exact(page_left / cell_page_width));
}

/// Axes, their marks and labels, which belong to the last plot of a panel.
constexpr std::string_view without_axes =
    "unset border\nunset xtics\nunset ytics\nunset xlabel\nunset ylabel\n";
constexpr std::string_view with_axes =
    "set border 3 linewidth 1 linecolor rgb '#444444'\nset xlabel \"x [mm]\"\nset ylabel \"r [mm]\"\n";

}  // namespace

std::string to_gnuplot(const CellPlot& plot) {
  const CellPanel panel = plot.window ? window_section(plot) : whole_section(plot);
  const double height = std::ceil(panel.bottom() + below_axis);
  std::string text =
      page_commands(cell_page_width, height) +
      "set tics nomirror out scale 0.6 textcolor rgb '#222222'\nset format '%g'\nunset key\nset multiplot\n" +
      panel_range(panel, height) + std::string(without_axes);
  for (std::size_t i = 0; i < plot.scales.size(); ++i)
    text += scale_commands(plot.scales[i], i, panel, height) + scale_cells(plot, i, panel);
  return text + "unset colorbox\n" + std::string(with_axes) +
         fmt::format("set xtics nomirror out scale 0.6 {}\nset ytics nomirror out scale 0.6 ({})\n",
                     exact(round_distance(70 / panel.scale_x)), radius_marks(panel)) +
         page_text(plot, panel) + axis_line(panel) + outline_commands(plot, panel) + "unset multiplot\n";
}

}  // namespace launchsafe::report
