// launchsafe init: a scene and a study of a shell of the user's own to start from.
#include "common_options.hpp"

namespace launchsafe::app {
namespace {

struct InitArguments {
  path output;                     ///< folder for the files
  std::optional<double> calibre;   ///< m
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
  const double factor = *arguments.calibre / published_calibre;
  const double duration = curve ? curve->time.back() : published_exit;
  return {{"calibre", fmt::format("{:g} mm", 1e3 * *arguments.calibre)},
          {"factor", fmt::format("{:.4g}", factor)},
          {"charge_begin", scaled_length(118, factor)},
          {"charge_end", scaled_length(678, factor)},
          {"length", scaled_length(740, factor)},
          {"bore", scaled_length(65, factor)},
          {"outer", fmt::format("{:g}", 500 * *arguments.calibre)},
          {"curve", curve ? "\"pressure.csv\"" : ""},
          {"peak", scene::pressure_text(arguments.peak.value_or(scene::Load().peak))},
          {"velocity", arguments.velocity ? fmt::format("{:.4g} m/s", *arguments.velocity) : ""},
          {"exit", fmt::format("{:.4g}", 1e3 * duration)},
          {"early_time", fmt::format("{:.3g}", 0.55e3 * duration)}};
}

/// Refuses a curve of no gun's launch, as one whose header has another unit than its numbers.
void check_curve(const scene::PressureCurve& curve, const std::string& file) {
  constexpr double lowest_peak = 10e6, highest_peak = 1e9, shortest_rise = 0.1e-3;  // Pa, s
  const auto peak = std::ranges::max_element(curve.pressure);
  const double rise =
      curve.time[static_cast<std::size_t>(peak - curve.pressure.begin())] - curve.time.front();
  if (*peak >= lowest_peak && *peak <= highest_peak && rise >= shortest_rise) return;
  const std::string found =
      fmt::format("a peak of {} after {:.3g} ms", scene::pressure_text(*peak), 1e3 * rise);
  throw scene::InputError{
      file, 0, 0, "pressure", found, "a peak of 10 MPa to 1 GPa that takes 0.1 ms or more to rise", {}};
}

/// Refuses what makes no scene, before anything is written. The velocity is that of the shell as drawn, whose
/// lengths the user has yet to write.
void check_scene(const InitArguments& arguments, Json values) {
  values["velocity"] = "";
  if (arguments.curve)
    values["curve"] = scene::exact_toml({.kind = keys::KeyKind::text},
                                        std::filesystem::absolute(*arguments.curve).string());
  try {
    scene::parse_scene(told("scene.toml", values), arguments.output / "scene.toml");
  } catch (scene::InputError& error) {
    error.file = arguments.curve ? arguments.curve->string() : "--peak";
    error.line = error.column = 0;
    throw;
  }
}

ExitCode perform(const InitArguments& arguments, Console& console) {
  std::optional<scene::PressureCurve> curve;
  std::string csv;
  if (arguments.curve) {
    csv = scene::read_text_file(*arguments.curve, scene::largest_curve);
    curve = scene::parse_pressure_curve(csv, arguments.curve->string());
    check_curve(*curve, arguments.curve->string());
  }
  const Json values = values_of(arguments, curve);
  check_scene(arguments, values);
  NamedTexts files;
  for (const char* name : {"scene.toml", "critical_gap.toml"}) files.push_back({name, told(name, values)});
  if (curve) files.push_back({"pressure.csv", csv});
  const std::vector<std::string> places = write_where_absent(arguments.output, files);
  const path study = arguments.output / "critical_gap.toml";
  return console.done(
      fmt::format("wrote {}\nThe shell is the published one, scaled: put the lengths of a drawing into {}.\n"
                  "next: {}\n",
                  fmt::join(places, ", "), places.front(),
                  shell_command({"launchsafe", "study", study.string(), "-o",
                                 (arguments.output / "results").string()})),
      {{"files", places}});
}

}  // namespace

void add_init(CLI::App& app, CommandLine& line) {
  auto [command, init] = add_command<InitArguments>(
      app, line, "init", "Write a scene and a study of a shell of your own to start from");
  add_quantity(command, "--calibre", init.calibre, scene::Dimension::length, "Calibre, such as \"105 mm\"",
               "20 mm to 50 cm, such as \"105 mm\"", 0.02, 0.5)
      ->required();
  CLI::Option* curve = add(command, "--curve", init.curve, "FILE.csv",
                           "Measured pressure that scenes take, such as import-curve writes");
  add_quantity(command, "--peak", init.peak, scene::Dimension::pressure,
               "Peak chamber pressure, where there is no measured curve", "a pressure such as 380MPa")
      ->excludes(curve);
  add_quantity(command, "--velocity", init.velocity, scene::Dimension::speed,
               "Velocity at the muzzle, from a range table; a load that gives another one is refused",
               "a speed such as \"800 m/s\"");
  add(command, "-o,--output", init.output, "DIR", "Folder for the files")->required();
}

}  // namespace launchsafe::app
