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

/// A record, and what was made of it.
struct Import {
  scene::PressureCurve record;
  scene::CleanedRecord cleaned;
  scene::Load load;  ///< the curve as a load
};

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
          {"end_MPa", 1e-6 * cleaned.curve.pressure.back()},
          {"end_ms", 1e3 * cleaned.curve.time.back()},
          {"uncovered", run::uncovered_load(import.load)}};
}

/// The curve and its picture, beside each other. A curve is whole without its picture.
void write(const ImportCurveArguments& arguments, const Import& import, const std::string& text,
           Console& console) {
  const path& file = *arguments.output;
  if (file.extension() != ".csv")
    throw Ended{fmt::format("--output: found \"{}\"; allowed: the name of a CSV file, such as pressure.csv",
                            file.string())};
  const auto svg = report::to_svg(plot_of(arguments, import));
  NamedTexts texts{{file.filename(), scene::csv_of(import.cleaned.curve, text)}};
  if (svg) texts.push_back({path(file).replace_extension(".svg").filename(), *svg});
  const std::vector<std::string> places = write_where_absent(store::folder_of(file), texts);
  if (!svg) console.remark("no picture: " + svg.error().message);
  console.print_text(fmt::format(
      "\nwrote {}\nnext: {}\n", fmt::join(places, " and "),
      shell_command({"launchsafe", "init", "--calibre", "155 mm", "--curve", file.string(), "-o", "shell"})));
  console.print_json({{"file", file.string()}});
}

ExitCode perform(const ImportCurveArguments& arguments, Console& console) {
  const std::string file = arguments.record.string();
  const std::string text = scene::read_text_file(file, scene::largest_curve);
  Import import;
  import.record = scene::parse_gauge_record(text, file, arguments.pressure);
  import.cleaned = scene::clean(import.record, {arguments.offset, arguments.trigger}, file);
  import.load.curve_time = import.cleaned.curve.time;
  import.load.curve_pressure = import.cleaned.curve.pressure;
  Json facts = json_of(import);
  console.print_json(facts);
  facts.update({{"record", arguments.record.filename().string()},
                {"record_points", import.record.time.size()},
                {"sha256", store::sha256(text)}});
  const std::string done = told("import_curve.txt", facts);
  console.print_text(done + uncovered_text(import.load));
  if (arguments.output)
    write(arguments, import, done, console);
  else
    console.print_text(fmt::format("\nnext: {}\n", arguments.command + " -o pressure.csv"));
  return ExitCode::done;
}

}  // namespace

void add_import_curve(CLI::App& app, CommandLine& line) {
  auto [command, import] = add_command<ImportCurveArguments>(
      app, line, "import-curve", "Clean the record of a pressure gauge: offset, trigger, units");
  add(command, "record", import.record, "RECORD.csv", "Record, with a header that names quantities and units")
      ->required();
  add(command, "-o,--output", import.output, "FILE.csv",
      "File for the curve, with a picture beside it; nothing is written unless given");
  add(command, "--pressure", import.pressure, "COLUMN",
      "Name of the pressure's column, where there are several");
  add_quantity(
      command, "--offset", import.offset, scene::Dimension::pressure,
      "What the gauge shows before the launch; the median of the points before the rise unless given",
      "a pressure such as \"0.3 MPa\"", -1e18);
  add_quantity(command, "--trigger", import.trigger, scene::Dimension::pressure,
               "Pressure at which the launch begins; 1 % of the peak unless given",
               "a pressure such as \"5 MPa\"");
}

}  // namespace launchsafe::app
