// launchsafe import-curve: what a pressure gauge recorded as a curve that scenes take.
#include "common_options.hpp"
#include "explain.hpp"

#include <set>

namespace launchsafe::app {
namespace {

struct ImportCurveArguments {
  path record;                            ///< CSV file of a gauge
  std::optional<path> output;             ///< CSV file for the curve; none: nothing is written
  std::string pressure;                   ///< name of the column; empty: the only one
  std::optional<double> offset, trigger;  ///< Pa
  std::string command;                    ///< the whole command, to be repeated in a shell
};

using scene::pressure_text, scene::time_text;

/// A record, and what was made of it.
struct Import {
  scene::PressureCurve record;
  scene::CleanedRecord cleaned;
  scene::Load load;  ///< the curve as a load
};

/// What was done, a line each. `sha256`: of the record.
std::string what_was_done(const ImportCurveArguments& arguments, const Import& import,
                          const std::string& sha256) {
  const scene::CleanedRecord& cleaned = import.cleaned;
  const scene::PressureCurve &record = import.record, &curve = cleaned.curve;
  return told("import_curve.txt", {{"record", arguments.record.filename().string()},
                                   {"sha256", sha256},
                                   {"points", record.time.size()},
                                   {"from", time_text(record.time.front())},
                                   {"to", time_text(record.time.back())},
                                   {"offset", pressure_text(cleaned.offset)},
                                   {"given", arguments.offset.has_value()},
                                   {"quiet", cleaned.quiet_points},
                                   {"trigger", pressure_text(cleaned.trigger)},
                                   {"start", time_text(cleaned.start)},
                                   {"before", cleaned.points_before},
                                   {"peak", pressure_text(cleaned.peak)},
                                   {"peak_time", time_text(cleaned.peak_time)},
                                   {"end", pressure_text(curve.pressure.back())},
                                   {"end_time", time_text(curve.time.back())},
                                   {"below", cleaned.points_below_zero},
                                   {"lowest", pressure_text(-cleaned.lowest)}});
}

/// The lowest and the highest point of each of so many parts: a picture resolves no more.
constexpr std::size_t drawn_parts = 2000;

/// A line in ms and MPa, from a time (s) and a pressure (Pa) on.
report::Series drawn_line(const std::string& label, int colour, const scene::PressureCurve& curve,
                          double start, double offset) {
  report::Series series{.label = label, .style = report::Style::line, .colour = colour};
  const auto begin = curve.pressure.begin();
  const auto points = static_cast<std::ptrdiff_t>(curve.pressure.size());
  const std::ptrdiff_t step = std::max<std::ptrdiff_t>(1, points / drawn_parts);
  for (std::ptrdiff_t i = 0; i < points; i += step) {
    const auto ends = std::minmax_element(begin + i, begin + std::min(i + step, points));
    for (const auto& point : std::set{ends.first, ends.second})
      series.add(1e3 * (curve.time[static_cast<std::size_t>(point - begin)] - start),
                 1e-6 * (*point - offset));
  }
  return series;
}

report::Plot plot_of(const ImportCurveArguments& arguments, const Import& import) {
  const scene::CleanedRecord& cleaned = import.cleaned;
  report::Plot plot;
  plot.title = "Chamber pressure of " + arguments.record.filename().string();
  plot.x.label = "time from the trigger [ms]";
  plot.y.label = "pressure above the offset [MPa]";
  plot.series = {drawn_line("record", 7, import.record, cleaned.start, cleaned.offset),
                 drawn_line("curve", 0, cleaned.curve, 0.0, 0.0)};
  return plot;
}

Json json_of(const Import& import) {
  const scene::CleanedRecord& cleaned = import.cleaned;
  return {{"points", cleaned.curve.time.size()},
          {"points_before", cleaned.points_before},
          {"points_below_zero", cleaned.points_below_zero},
          {"lowest_MPa", 1e-6 * cleaned.lowest},
          {"offset_MPa", 1e-6 * cleaned.offset},
          {"quiet_points", cleaned.quiet_points},
          {"trigger_MPa", 1e-6 * cleaned.trigger},
          {"start_ms", 1e3 * cleaned.start},
          {"peak_MPa", 1e-6 * cleaned.peak},
          {"peak_time_ms", 1e3 * cleaned.peak_time},
          {"end_ms", 1e3 * cleaned.curve.time.back()},
          {"uncovered", run::uncovered_load(import.load)}};
}

/// The curve and its picture, beside each other. A curve is whole without its picture.
void write(const ImportCurveArguments& arguments, const Import& import, const std::string& text,
           Console& console) {
  const path& file = *arguments.output;
  if (file.extension() != ".csv")
    console.refuse(fmt::format(
        "--output: found \"{}\"; allowed: the name of a CSV file, such as pressure.csv", file.string()));
  const path folder = store::folder_of(file);
  const std::string csv = scene::csv_of(import.cleaned.curve, text);
  path picture = file;
  picture.replace_extension(".svg");
  const auto svg = report::to_svg(plot_of(arguments, import));
  NamedTexts texts{{file.filename(), csv}};
  if (svg) texts.push_back({picture.filename(), *svg});
  write_where_absent(folder, texts, console);
  if (!svg) console.remark("no picture: " + svg.error().message);
  console.print_text(fmt::format(
      "\nwrote {}{}\nnext: {}\n", file.string(), svg ? " and " + picture.string() : "",
      shell_command({"launchsafe", "init", "--calibre", "155 mm", "--curve", file.string(), "-o", "shell"})));
  console.print_json({{"file", file.string()}});
}

ExitCode perform(const ImportCurveArguments& arguments, Console& console) {
  const std::string file = arguments.record.string();
  const std::string text = console.value_of(scene::read_text_file(file, scene::largest_curve));
  Import import;
  import.record = console.value_of(scene::parse_gauge_record(text, file, arguments.pressure));
  import.cleaned = console.value_of(scene::clean(import.record, {arguments.offset, arguments.trigger}, file));
  import.load.curve_time = import.cleaned.curve.time;
  import.load.curve_pressure = import.cleaned.curve.pressure;
  const std::string done = what_was_done(arguments, import, store::sha256(text));
  console.print_text(done + uncovered_text(import.load));
  console.print_json(json_of(import));
  if (arguments.output)
    write(arguments, import, done, console);
  else
    console.print_text(fmt::format("\nnext: {}\n", arguments.command + " -o pressure.csv"));
  return ExitCode::done;
}

}  // namespace

void add_import_curve(CLI::App& app, CommandLine& line) {
  auto [command, import] = add_command<ImportCurveArguments>(app, line, "import-curve");
  add_required(command, "record", import.record);
  add(command, "-o,--output", import.output);
  add(command, "--pressure", import.pressure);
  add_amount(command, "--offset", import.offset, parse_scene_quantity<Dimension::pressure>);
  add_amount(command, "--trigger", import.trigger, parse_positive<Dimension::pressure>);
}

}  // namespace launchsafe::app
