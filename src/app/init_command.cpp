// launchsafe init: a scene and a study of a shell of the user's own to start from.
#include "common_options.hpp"

namespace launchsafe::app {
namespace {

struct InitArguments {
  path output;                     ///< folder for the files
  double calibre = 0.155;          ///< m
  std::optional<path> curve;       ///< measured pressure; none: the analytic shape
  std::optional<double> peak;      ///< Pa, of the analytic shape
  std::optional<double> velocity;  ///< m/s at the muzzle, from a range table
};

constexpr double published_calibre = 0.155;  // m
constexpr double published_exit = 18e-3;     // s, when the published shell leaves its barrel

/// A length of the published shell (mm), scaled and rounded to half a millimetre.
std::string scaled_length(double published, double factor) {
  return fmt::format("{:g}", std::round(2.0 * published * factor) / 2.0);
}

/// What the texts take from the arguments. `curve`: TOML text with the name of its file.
Json values_of(const InitArguments& arguments, const std::optional<scene::PressureCurve>& curve) {
  const double factor = arguments.calibre / published_calibre;
  const double duration = curve ? curve->time.back() : published_exit;
  return {{"calibre", fmt::format("{:g} mm", 1e3 * arguments.calibre)},
          {"factor", fmt::format("{:.4g}", factor)},
          {"charge_begin", scaled_length(118, factor)},
          {"charge_end", scaled_length(678, factor)},
          {"length", scaled_length(740, factor)},
          {"bore", scaled_length(65, factor)},
          {"outer", fmt::format("{:g}", 500 * arguments.calibre)},
          {"curve", curve ? "\"pressure.csv\"" : ""},
          {"peak", scene::pressure_text(arguments.peak.value_or(scene::Load().peak))},
          {"velocity", arguments.velocity ? fmt::format("{:.4g} m/s", *arguments.velocity) : ""},
          {"exit", fmt::format("{:.4g}", 1e3 * duration)},
          {"early_time", fmt::format("{:.3g}", 0.55e3 * duration)}};
}

NamedTexts files_of(const Json& values) {
  NamedTexts files;
  for (const char* name : {"scene.toml", "critical_gap.toml"}) files.push_back({name, told(name, values)});
  return files;
}

/// Refuses a curve of no gun's launch, as one whose header has another unit than its numbers.
void check_curve(const scene::PressureCurve& curve, const std::string& file, Console& console) {
  constexpr double lowest_peak = 10e6, highest_peak = 1e9, shortest_rise = 0.1e-3;  // Pa, s
  const auto peak = std::ranges::max_element(curve.pressure);
  const double rise =
      curve.time[static_cast<std::size_t>(peak - curve.pressure.begin())] - curve.time.front();
  if (*peak >= lowest_peak && *peak <= highest_peak && rise >= shortest_rise) return;
  const std::string found =
      fmt::format("a peak of {} after {:.3g} ms", scene::pressure_text(*peak), 1e3 * rise);
  console.refuse(scene::InputError{
      file, 0, 0, "pressure", found, "a peak of 10 MPa to 1 GPa that takes 0.1 ms or more to rise", {}});
}

/// Refuses what makes no scene, before anything is written. The velocity is that of the shell as drawn, whose
/// lengths the user has yet to write.
void check_scene(const InitArguments& arguments, Json values, Console& console) {
  values["velocity"] = "";
  if (arguments.curve)
    values["curve"] = scene::exact_toml({.kind = keys::KeyKind::text},
                                        std::filesystem::absolute(*arguments.curve).string());
  const auto scene = scene::parse_scene(told("scene.toml", values), arguments.output / "scene.toml");
  if (scene) return;
  scene::InputError error = scene.error();
  error.file = arguments.curve ? arguments.curve->string() : "--peak";
  error.line = error.column = 0;
  console.refuse(error);
}

ExitCode perform(const InitArguments& arguments, Console& console) {
  std::optional<scene::PressureCurve> curve;
  std::string csv;
  if (arguments.curve) {
    csv = console.value_of(scene::read_text_file(*arguments.curve, scene::largest_curve));
    curve = console.value_of(scene::parse_pressure_curve(csv, arguments.curve->string()));
    check_curve(*curve, arguments.curve->string(), console);
  }
  const Json values = values_of(arguments, curve);
  check_scene(arguments, values, console);
  NamedTexts files = files_of(values);
  if (curve) files.push_back({"pressure.csv", csv});
  const std::vector<std::string> said = write_where_absent(arguments.output, files, console);
  console.print_text(fmt::format("{}\n", fmt::join(said, "\n")));
  const path study = arguments.output / "critical_gap.toml";
  return console.done(
      fmt::format(
          "\nThe shell is the published one, scaled: put the lengths of a drawing into {}.\nnext: {}\n",
          (arguments.output / "scene.toml").string(),
          shell_command(
              {"launchsafe", "study", study.string(), "-o", (arguments.output / "results").string()})),
      {{"files", places_of(arguments.output, files)}});
}

}  // namespace

void add_init(CLI::App& app, CommandLine& line) {
  auto [command, init] = add_command<InitArguments>(app, line, "init");
  const auto read_calibre = [&calibre = init.calibre](const std::string& text) {
    constexpr double smallest = 0.02, largest = 0.5;
    calibre = parse_scene_quantity<Dimension::length>(text);
    return calibre >= smallest && calibre <= largest;
  };
  add_read(command, "--calibre", read_calibre)->required();
  CLI::Option* curve = add(command, "--curve", init.curve);
  add_amount(command, "--peak", init.peak, parse_positive<Dimension::pressure>)->excludes(curve);
  add_amount(command, "--velocity", init.velocity, parse_positive<Dimension::speed>);
  add_required(command, "-o,--output", init.output);
}

}  // namespace launchsafe::app
