#include "command_line.hpp"

#include "command_help.hpp"
#include "launchsafe/scene/quantity.hpp"
#include "shell_words.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <sstream>
#include <string_view>

namespace launchsafe::app {

namespace {

struct UnitFactor {
  std::string_view name;  ///< lower case
  double factor;
};

constexpr std::array<UnitFactor, 14> size_units{{{"", 1},
                                                 {"b", 1},
                                                 {"kb", 1e3},
                                                 {"mb", 1e6},
                                                 {"gb", 1e9},
                                                 {"tb", 1e12},
                                                 {"k", 1e3},
                                                 {"m", 1e6},
                                                 {"g", 1e9},
                                                 {"t", 1e12},
                                                 {"kib", 1024.0},
                                                 {"mib", 1024.0 * 1024},
                                                 {"gib", 1024.0 * 1024 * 1024},
                                                 {"tib", 1024.0 * 1024 * 1024 * 1024}}};

constexpr std::array<UnitFactor, 6> duration_units{
    {{"", 1}, {"ms", 1e-3}, {"s", 1}, {"min", 60}, {"h", 3600}, {"d", 86400}}};

constexpr std::array<UnitFactor, 2> temperature_units{{{"", 1}, {"k", 1}}};

/// The unit's own letters, without the blanks around them.
std::string unit_in(std::string_view text) {
  std::string unit;
  for (const char letter : text) unit += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  const auto first = unit.find_first_not_of(' ');
  if (first == std::string::npos) return {};
  return unit.substr(first, unit.find_last_not_of(' ') - first + 1);
}

template <std::size_t count>
std::optional<double> parse_amount(std::string_view text, const std::array<UnitFactor, count>& units) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{}) return std::nullopt;
  const std::string unit = unit_in(text.substr(static_cast<std::size_t>(end - text.data())));
  const auto found =
      std::find_if(units.begin(), units.end(), [&](const UnitFactor& each) { return each.name == unit; });
  if (found == units.end()) return std::nullopt;
  const double amount = number * found->factor;
  return std::isfinite(amount) && amount > 0 ? std::optional(amount) : std::nullopt;
}

/// Bytes: "8GB", "500 MB", "1.5GiB", "8e9". kB, MB, GB and TB are powers of 1000; KiB, MiB, GiB and TiB of
/// 1024. Nothing for any other text, and for less than a byte or more than 1e18.
std::optional<double> parse_size(std::string_view text) {
  const auto size = parse_amount(text, size_units);
  constexpr double largest = 1e18;  // what whole numbers of bytes are counted with
  return size && *size >= 1 && *size <= largest ? size : std::nullopt;
}
constexpr const char* allowed_sizes = "a size such as 500MB, 8GB, 1.5GiB or 8e9, up to 1e18";

/// Seconds: "90s", "10min", "2h", "1.5 d", "90". Nothing for any other text, and for what is not more than
/// zero.
std::optional<double> parse_duration(std::string_view text) { return parse_amount(text, duration_units); }
constexpr const char* allowed_durations = "a duration such as 90s, 10min, 2h or 1d";

/// K: "2K", "0.5 K", "2". Nothing for any other text, and for what is not more than zero.
std::optional<double> parse_temperature(std::string_view text) {
  return parse_amount(text, temperature_units);
}
constexpr const char* allowed_temperatures = "a temperature difference such as 2K or 0.5K";

/// SI, of a quantity as scenes have them: "5 MPa", "-0.3 bar", "0.2 ms", "155 mm".
template <scene::Dimension dimension>
std::optional<double> parse_scene_quantity(std::string_view text) {
  const auto value = scene::parse_quantity(text, dimension);
  return value ? std::optional(*value) : std::nullopt;
}
/// The same of what is more than zero.
template <scene::Dimension dimension>
std::optional<double> parse_positive(std::string_view text) {
  const auto value = parse_scene_quantity<dimension>(text);
  return value && *value > 0.0 ? value : std::nullopt;
}

constexpr int most_jobs = 4096;

/// Everything the options write to while CLI11 parses.
struct Parsed {
  CommandLine line;
  RunArguments run;
  StudyArguments study;
  MergeArguments merge;
  EmitArguments emit;
  VerifyArguments verify;
  ExplainArguments explain;
  PlotArguments plot;
  InitArguments init;
  ImportCurveArguments import_curve;
  ReportArguments report;
};

/// A subcommand whose arguments become the request.
template <class Arguments>
CLI::App& add_command(CLI::App& app, Parsed& parsed, const Arguments& arguments, const char* name,
                      const char* meaning, const char* examples) {
  CLI::App& command = *app.add_subcommand(name, meaning);
  command.footer(examples);
  command.callback([&parsed, &arguments, name] {
    parsed.line.request = arguments;
    parsed.line.command = name;
  });
  return command;
}

/// Last in every command's help.
void add_output_options(CLI::App& command, Parsed& parsed) {
  command.add_flag("--json", parsed.line.json, "Print one JSON object on stdout instead of text");
  command.add_flag("-q,--quiet", parsed.line.quiet, "No progress and no remarks on stderr; errors remain");
}

/// A place to write to. `-o --json` would name a folder that nobody means.
template <class Path>
CLI::Option* add_place(CLI::App& command, const char* name, Path& path, const char* type, const char* kind,
                       const char* meaning) {
  const auto check = [kind](const std::string& text) {
    if (!text.starts_with("-")) return std::string{};
    return fmt::format("found {1}, which is an option; allowed: a {0} (./{1} for one of this name)", kind,
                       text);
  };
  return command.add_option(name, path, meaning)->check(CLI::Validator(check, ""))->type_name(type);
}

template <class Path>
CLI::Option* add_folder(CLI::App& command, Path& path, const char* meaning) {
  return add_place(command, "-o,--output", path, "DIR", "folder", meaning);
}

/// An option whose text is read by `parse`.
template <class Parse>
void add_amount(CLI::App& command, const std::string& name, std::optional<double>& value, Parse parse,
                const char* allowed, const char* type, const char* meaning) {
  const auto read = [name, &value, parse, allowed](const std::string& text) {
    value = parse(text);
    if (!value) throw CLI::ValidationError(name, fmt::format("found \"{}\"; allowed: {}", text, allowed));
  };
  command.add_option_function<std::string>(name, read, meaning)->type_name(type);
}

void add_longest_run(CLI::App& command, std::optional<double>& longest_run) {
  add_amount(command, "--longest-run", longest_run, parse_duration, allowed_durations, "DURATION",
             "Refuse a case that is predicted to take longer; 30d unless given");
}

void add_run(CLI::App& app, Parsed& parsed) {
  CLI::App& command =
      add_command(app, parsed, parsed.run, "run",
                  "Run one case: a scene in, temperatures of the charge bottom out", run_footer);
  command.add_option("scene", parsed.run.scene, "Scene file")->required()->type_name("SCENE.toml");
  add_folder(command, parsed.run.output, "Folder to write the HDF5 case file to");
  add_longest_run(command, parsed.run.longest_run);
  command.add_flag("--dry-run", parsed.run.dry_run, "Say what would be run and at what cost; write nothing");
  add_output_options(command, parsed);
}

void add_jobs(CLI::App& command, int& jobs, const char* meaning) {
  command.add_option("-j,--jobs", jobs, meaning)->check(CLI::Range(1, most_jobs))->type_name("N");
}

void add_limits(CLI::App& command, std::optional<double>& memory, std::optional<double>& time_limit) {
  add_amount(command, "--memory", memory, parse_size, allowed_sizes, "SIZE",
             "Memory of all running cases together, such as 8GB; most of what is free unless given");
  add_amount(command, "--time-limit", time_limit, parse_duration, allowed_durations, "DURATION",
             "Wall time after which a case is given up, such as 10min");
}

void add_shard(CLI::App& command, study::Shard& shard) {
  const auto read = [&shard](const std::string& text) {
    if (!study::parse_shard(text, shard))
      throw CLI::ValidationError("--shard", fmt::format("found \"{}\"; allowed: i/N such as 2/4", text));
  };
  command
      .add_option_function<std::string>("--shard", read,
                                        "Run only part i of N of the mechanical runs; see launchsafe merge")
      ->type_name("i/N");
}

void add_tolerance(CLI::App& command, std::optional<double>& tolerance) {
  add_amount(command, "--tolerance", tolerance, parse_temperature, allowed_temperatures, "KELVIN",
             "Use the cheapest setting of the study's accuracy record that knows T max to this, such as 2K");
}

void add_update(CLI::App& command, bool& update) {
  command.add_flag("--update", update,
                   "Use the stored cases of another study in DIR; its report moves to DIR/earlier-N");
}

void add_study(CLI::App& app, Parsed& parsed) {
  StudyArguments& study = parsed.study;
  CLI::App& command = add_command(app, parsed, study, "study",
                                  "Run a study: many cases, a verdict for every gap", study_footer);
  command.add_option("study", study.study, "Study file")->required()->type_name("STUDY.toml");
  add_folder(command, study.output, "Folder for cases, tables and report; what is stored there is used again")
      ->type_name("DIR");
  add_jobs(command, study.jobs, "Cases at a time; as many as there are processors unless given");
  add_limits(command, study.memory, study.time_limit);
  add_longest_run(command, study.longest_run);
  add_shard(command, study.shard);
  add_tolerance(command, study.tolerance);
  command.add_flag("--dry-run", study.dry_run, "Say what would be run and at what cost; write nothing");
  command.add_flag("--explain", study.explain, "Say of every mechanical run why it runs or is used again");
  add_update(command, study.update);
  add_output_options(command, parsed);
}

void add_merge(CLI::App& app, Parsed& parsed) {
  MergeArguments& merge = parsed.merge;
  CLI::App& command = add_command(app, parsed, merge, "merge",
                                  "Make one report of the shards of a study; runs nothing", merge_footer);
  command.add_option("study", merge.study, "Study file")->required()->type_name("STUDY.toml");
  add_folder(command, merge.output, "Folder for cases, tables and report")->required();
  command.add_option("folder", merge.folders, "Folders of shards; none where they all used DIR")
      ->type_name("FOLDER...");
  add_update(command, merge.update);
  add_tolerance(command, merge.tolerance);
  add_jobs(command, merge.jobs, "Threads that judge gaps; as many as there are processors unless given");
  add_output_options(command, parsed);
}

void add_emit(CLI::App& app, Parsed& parsed) {
  EmitArguments& emit = parsed.emit;
  CLI::App& command = add_command(
      app, parsed, emit, "emit", "Write batch scripts that run a study on a cluster, in shards", emit_footer);
  command.add_option("engine", emit.engine, "What the scripts are for: slurm")
      ->required()
      ->check(CLI::IsMember({"slurm"}))
      ->type_name("slurm");
  command.add_option("study", emit.study, "Study file")->required()->type_name("STUDY.toml");
  add_folder(command, emit.output, "Folder for cases, tables and report, seen by all nodes")->required();
  constexpr int most_shards = 10000;
  command.add_option("--shards", emit.shards, "Number of shards")
      ->required()
      ->check(CLI::Range(1, most_shards))
      ->type_name("N");
  add_jobs(command, emit.jobs, "Cases at a time, and processors, of every shard");
  add_limits(command, emit.memory, emit.time_limit);
  command.add_option("--sbatch", emit.sbatch, "A further #SBATCH option, such as --sbatch=--partition=long")
      ->allow_extra_args(false)
      ->type_name("TEXT");
  add_output_options(command, parsed);
}

void add_verify(CLI::App& app, Parsed& parsed) {
  CLI::App& command = add_command(app, parsed, parsed.verify, "verify",
                                  "Compare the program with closed-form solutions", verify_footer);
  command.add_option("--filter", parsed.verify.filter, "Only checks with this in their name, case ignored")
      ->type_name("TEXT");
  CLI::Option* table = command.add_flag(
      "--error-against-time", parsed.verify.error_against_time,
      "Error against processor time of the parts with exact solutions, over step, tolerance and mesh");
  command
      .add_flag("--finite-elements", parsed.verify.finite_elements,
                "Static stresses at the charge bottom against CalculiX (ccx): minutes")
      ->excludes(table);
  add_folder(command, parsed.verify.output,
             "Folder for parts.md, parts.csv and parts.svg of --error-against-time, or summary.md and "
             "stresses.csv of --finite-elements");
  add_output_options(command, parsed);
}

void add_explain(CLI::App& app, Parsed& parsed) {
  CLI::App& command = add_command(
      app, parsed, parsed.explain, "explain",
      "Say what a scene or a study will compute, what it leaves out, and the cost", explain_footer);
  command
      .add_option("file", parsed.explain.file,
                  "Scene or study file; with --keys or --materials the beginning of names, such as load")
      ->type_name("SCENE.toml|STUDY.toml");
  CLI::Option* keys = command.add_flag("--keys", parsed.explain.keys,
                                       "List the keys of scene and study files, or those whose name begins "
                                       "with the word given in the place of a "
                                       "file: unit, range, default, standing, meaning");
  CLI::Option* materials =
      command.add_flag("--materials", parsed.explain.materials,
                       "List the materials that ship, or those whose name begins with the "
                       "word given in the place of a file: every number and its source");
  CLI::Option* schema = command
                            .add_option("--schema", parsed.explain.schema,
                                        "Print the JSON schema of scene or study files, for editors")
                            ->check(CLI::IsMember({"scene", "study", "references"}))
                            ->type_name("scene|study|references");
  CLI::Option* manual = command.add_flag("--manual", parsed.explain.manual, "Print the manual page, for man");
  CLI::Option* completion = command
                                .add_option("--completion", parsed.explain.completion,
                                            "Print what makes a shell complete commands and options")
                                ->check(CLI::IsMember({"bash"}))
                                ->type_name("bash");
  for (CLI::Option* option : {keys, materials, schema, manual, completion})
    for (CLI::Option* other : {keys, materials, schema, manual, completion})
      if (other != option) option->excludes(other);
  add_place(command, "--grid", parsed.explain.picture, "FILE.svg", "file",
            "File to draw the half section of a scene and its grid to");
  add_output_options(command, parsed);
}

void add_plot(CLI::App& app, Parsed& parsed) {
  CLI::App& command =
      add_command(app, parsed, parsed.plot, "plot",
                  "Draw a case: histories, profiles, and fields over the section", plot_footer);
  command.add_option("case", parsed.plot.file, "Case file")->required()->type_name("CASE.h5");
  add_folder(command, parsed.plot.output,
             "Folder for the pictures; CASE_pictures beside the file unless given");
  command
      .add_option("--what", parsed.plot.what,
                  "pressure, fields, histories, profile, air, energy, combustion; all that the case has data "
                  "for unless given")
      ->type_name("LIST");
  command
      .add_option("--times", parsed.plot.times,
                  "Times of fields, which must be snapshots, and of profiles, such as \"8, 10 ms\"")
      ->type_name("LIST");
  add_output_options(command, parsed);
}

void add_init(CLI::App& app, Parsed& parsed) {
  InitArguments& init = parsed.init;
  CLI::App& command =
      add_command(app, parsed, init, "init", "Write a scene and a study of a shell of your own to start from",
                  init_footer);
  const auto read_calibre = [&init](const std::string& text) {
    constexpr double smallest = 0.02, largest = 0.5;
    const auto calibre = parse_positive<scene::Dimension::length>(text);
    if (!calibre || *calibre < smallest || *calibre > largest)
      throw CLI::ValidationError(
          "--calibre", fmt::format("found \"{}\"; allowed: 20 mm to 50 cm, such as \"105 mm\"", text));
    init.calibre = *calibre;
  };
  command.add_option_function<std::string>("--calibre", read_calibre, "Calibre, such as \"105 mm\"")
      ->required()
      ->type_name("LENGTH");
  CLI::Option* curve = command
                           .add_option("--curve", init.curve,
                                       "Measured pressure that scenes take, such as import-curve writes")
                           ->type_name("FILE.csv");
  add_amount(command, "--peak", init.peak, parse_positive<scene::Dimension::pressure>,
             "a pressure such as 380MPa", "PRESSURE",
             "Peak chamber pressure, where there is no measured curve");
  command.get_option("--peak")->excludes(curve);
  add_folder(command, init.output, "Folder for the files")->required();
  add_output_options(command, parsed);
}

void add_import_curve(CLI::App& app, Parsed& parsed) {
  ImportCurveArguments& import = parsed.import_curve;
  CLI::App& command =
      add_command(app, parsed, import, "import-curve",
                  "Clean the record of a pressure gauge: offset, trigger, units, noise", import_curve_footer);
  command
      .add_option("record", import.record, "Record of a gauge, with a header that names quantities and units")
      ->required()
      ->type_name("RECORD.csv");
  add_place(command, "-o,--output", import.output, "FILE.csv", "file",
            "File for the curve, with a picture beside it; nothing is written unless given");
  command.add_option("--pressure", import.pressure, "Name of the pressure's column, where there are several")
      ->type_name("COLUMN");
  add_amount(command, "--offset", import.offset, parse_scene_quantity<scene::Dimension::pressure>,
             "a pressure such as \"0.3 MPa\"", "PRESSURE",
             "What the gauge shows before the launch; the median of the points before the rise unless given");
  add_amount(
      command, "--trigger", import.trigger, parse_positive<scene::Dimension::pressure>,
      "a pressure such as \"5 MPa\"", "PRESSURE",
      "Pressure at which the launch begins; 1 % of the peak, or five deviations of noise, unless given");
  add_output_options(command, parsed);
}

void add_report(CLI::App& app, Parsed& parsed) {
  ReportArguments& report = parsed.report;
  CLI::App& command = add_command(app, parsed, report, "report",
                                  "Make the safety report of studies that were run", report_footer);
  command.add_option("study", report.studies, "Folders of studies, at most one of each kind")
      ->required()
      ->type_name("STUDY_DIR...");
  add_folder(command, report.output, "Folder for report.html, report.md, report.json and the figures")
      ->required();
  command
      .add_option("--criterion", report.criterion,
                  "What a gap must meet to be recommended, besides SAFE: \"margin >= 2 uncertainty\"")
      ->type_name("TEXT");
  command
      .add_option("--criterion-source", report.criterion_source, "Who asks for that, as the report is to say")
      ->type_name("TEXT");
  add_place(command, "--templates", report.templates, "DIR", "folder",
            "Folder of templates in place of those built in: letterhead, language");
  add_output_options(command, parsed);
}

std::string text_of_success(const CLI::App& app, const CLI::Success& success) {
  std::ostringstream text;
  app.exit(success, text, text);
  return text.str();
}

/// Whether --json is on a command line that is not read to its end.
bool asks_for_json(int argument_count, const char* const* arguments) {
  for (int i = 1; i < argument_count; ++i) {
    const std::string_view argument = arguments[i];
    if (argument == "--") return false;
    if (argument == "--json") return true;
  }
  return false;
}

/// What the options of one command ask for makes no sense together.
std::string contradiction(const StudyArguments& study) {
  return study.output.empty() && !study.dry_run ? "study: --output is required unless with --dry-run" : "";
}
std::string contradiction(const VerifyArguments& verify) {
  const bool writes = verify.error_against_time || verify.finite_elements;
  return verify.output && !writes ? "verify: --output requires --error-against-time or --finite-elements"
                                  : "";
}
std::string contradiction(const ExplainArguments& explain) {
  const bool of_program = !explain.schema.empty() || explain.manual || !explain.completion.empty();
  const bool lists = explain.keys || explain.materials;
  if (!lists && of_program != explain.file.empty())
    return "explain: allowed: a scene or study file, or one of --keys, --materials, --schema, --manual and "
           "--completion";
  if (explain.picture && (of_program || lists))
    return "explain: --grid draws the grid of a scene; allowed: with a scene file";
  return {};
}
std::string contradiction(const ReportArguments& report) {
  if (report.criterion.has_value() == report.criterion_source.has_value()) return {};
  return report.criterion ? "report: --criterion requires --criterion-source, which says who asks for it"
                          : "report: --criterion-source requires --criterion";
}
template <class Other>
std::string contradiction(const Other&) {
  return {};
}

void add_commands(CLI::App& app, Parsed& parsed) {
  app.require_subcommand(1);
  app.footer(footer);
  app.set_version_flag("--version", "", "Version, commit, compiler, flags and libraries");
  add_run(app, parsed);
  add_study(app, parsed);
  add_merge(app, parsed);
  add_emit(app, parsed);
  add_verify(app, parsed);
  add_explain(app, parsed);
  add_plot(app, parsed);
  add_init(app, parsed);
  add_import_curve(app, parsed);
  add_report(app, parsed);
}

CommandDescription describe(const CLI::App& command) {
  CommandDescription described{command.get_name(), command.get_description(), command.get_footer(), {}, {}};
  for (const CLI::Option* option : command.get_options()) {
    const std::string type = option->get_type_name();  // "N:INT in [1 - 4096]" where there is a check
    described.options.push_back({option->get_name(option->get_positional(), true),
                                 type.substr(0, type.find(':')), option->get_description(),
                                 option->get_positional()});
  }
  for (const CLI::App* subcommand : command.get_subcommands({}))
    described.subcommands.push_back(describe(*subcommand));
  return described;
}

}  // namespace

CommandDescription describe_commands() {
  CLI::App app(description, "launchsafe");
  Parsed parsed;
  add_commands(app, parsed);
  return describe(app);
}

CommandLine parse_command_line(int argument_count, const char* const* arguments) {
  CLI::App app(description, "launchsafe");
  Parsed parsed;
  add_commands(app, parsed);
  parsed.study.command = parsed.merge.command = shell_command({arguments, arguments + argument_count});

  CommandLine& line = parsed.line;
  try {
    app.parse(argument_count, arguments);
  } catch (const CLI::Success& success) {
    const bool version = dynamic_cast<const CLI::CallForVersion*>(&success) != nullptr;
    line.request = Information{version ? std::string{} : text_of_success(app, success), version};
    line.json = asks_for_json(argument_count, arguments);
    return line;
  } catch (const CLI::ParseError& error) {
    line.request = UsageError{error.what()};
    line.json = asks_for_json(argument_count, arguments);
    return line;
  }
  const std::string fault =
      std::visit([](const auto& request) { return contradiction(request); }, line.request);
  if (!fault.empty()) line.request = UsageError{fault};
  return line;
}

}  // namespace launchsafe::app
