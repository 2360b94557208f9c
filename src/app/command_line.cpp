#include "built_in_texts.hpp"
#include "commands.hpp"
#include "common_options.hpp"
#include "launchsafe/report/case_pictures.hpp"
#include "launchsafe/report/study_status.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <sstream>

namespace launchsafe::app {
namespace {

constexpr const char* description =
    "launchsafe: how thick may the gap under an explosive charge be before a launch can ignite it?\n"
    "Simulates shells under launch loads by the material point method.";

/// What the help of a command says below its options.
std::string footer_of(const std::string& command) {
  const std::string& text = help_texts().at(command + ".txt");
  return "\n" + text.substr(0, text.size() - 1);
}

/// A subcommand and what its options write to while CLI11 parses, which becomes the request.
template <class Arguments>
std::pair<CLI::App&, Arguments&> add_command(CLI::App& app, CommandLine& line, const char* name,
                                             const char* meaning) {
  CLI::App& command = *app.add_subcommand(name, meaning);
  command.footer(footer_of(name));
  const auto arguments = std::make_shared<Arguments>();
  command.callback([&line, arguments, name] {
    line.request = *arguments;
    line.command = name;
  });
  return {command, *arguments};
}

/// What must be given.
template <class Value>
CLI::Option* add_required(CLI::App& command, const char* name, Value& value, const char* type,
                          const char* meaning) {
  return command.add_option(name, value, meaning)->required()->type_name(type);
}

/// What may be given.
template <class Value>
CLI::Option* add_optional(CLI::App& command, const char* name, Value& value, const char* type,
                          const char* meaning) {
  return command.add_option(name, value, meaning)->type_name(type);
}

void add_run(CLI::App& app, CommandLine& line) {
  auto [command, run] = add_command<RunArguments>(
      app, line, "run", "Run one case: a scene in, temperatures of the charge bottom out");
  add_required(command, "scene", run.scene, "SCENE.toml", "Scene file");
  add_folder(command, run.output, "Folder to write the HDF5 case file to");
  add_longest_run(command, run.longest_run);
}

void add_study(CLI::App& app, CommandLine& line) {
  auto [command, study] =
      add_command<StudyArguments>(app, line, "study", "Run a study: many cases, a verdict for every gap");
  add_required(command, "study", study.study, "STUDY.toml", "Study file");
  add_folder(command, study.output,
             "Folder for cases, tables and report; what is stored there is used again");
  add_jobs(command, study.jobs, "Cases at a time; as many as there are processors unless given");
  add_limits(command, study.memory, study.time_limit);
  add_longest_run(command, study.longest_run);
  const auto read_time = [](const std::string& text) {
    return report::next_clock_time(text, std::time(nullptr));
  };
  add_amount(command, "--until", study.until, read_time, "a time of the day such as 06:00, of the next 24 h",
             "HH:MM",
             "Stop at this local time, as on Ctrl-C: what was run is kept, the same command goes on");
  const auto read_shard = [&shard = study.shard](const std::string& text) {
    return study::parse_shard(text, shard);
  };
  add_read(command, "--shard", read_shard, "i/N such as 2/4", "i/N",
           "Run only part i of N of the mechanical runs; see launchsafe merge");
  add_tolerance(command, study.tolerance);
  command.add_flag("--dry-run", study.dry_run,
                   "Say which mechanical runs it needs and why, and at what cost; write nothing");
  add_update(command, study.update);
}

void add_merge(CLI::App& app, CommandLine& line) {
  auto [command, merge] = add_command<MergeArguments>(
      app, line, "merge", "Make one report of the shards of a study; runs nothing");
  add_required(command, "study", merge.study, "STUDY.toml", "Study file");
  add_folder(command, merge.output, "Folder for cases, tables and report")->required();
  add_optional(command, "folder", merge.folders, "FOLDER...",
               "Folders of shards; none where they all used DIR");
  add_update(command, merge.update);
  add_tolerance(command, merge.tolerance);
  add_jobs(command, merge.jobs, "Threads that judge gaps; as many as there are processors unless given");
}

void add_status(CLI::App& app, CommandLine& line) {
  auto [command, status] = add_command<StatusArguments>(
      app, line, "status", "Say how far a study is: done, failed, left, when it will end");
  add_required(command, "folder", status.folders, "DIR...",
               "Folder of a study or of its shards, or those of shards that have one each");
  command.add_flag("--watch", status.watch, "Look again every few seconds until it has ended");
}

void add_emit(CLI::App& app, CommandLine& line) {
  auto [command, emit] = add_command<EmitArguments>(
      app, line, "emit", "Write batch scripts that run a study on a cluster, in shards");
  add_required(command, "engine", emit.engine, "slurm", "What the scripts are for: slurm")
      ->check(CLI::IsMember({"slurm"}));
  add_required(command, "study", emit.study, "STUDY.toml", "Study file");
  add_folder(command, emit.output, "Folder for cases, tables and report, seen by all nodes")->required();
  constexpr int most_shards = 10000;
  add_required(command, "--shards", emit.shards, "N", "Number of shards")->check(CLI::Range(1, most_shards));
  add_jobs(command, emit.jobs, "Cases at a time, and processors, of every shard");
  add_limits(command, emit.memory, emit.time_limit);
  add_optional(command, "--sbatch", emit.sbatch, "TEXT",
               "A further #SBATCH option, such as --sbatch=--partition=long")
      ->allow_extra_args(false);
}

void add_ask(CLI::App& app, CommandLine& line) {
  auto [command, ask] = add_command<AskArguments>(
      app, line, "ask", "Ask the fit of a study about a launch that nobody computed");
  add_required(command, "study", ask.study, "STUDY_DIR",
               "Folder of a finished study of kind sensitivity with method = \"polynomial-chaos\"");
  add_optional(command, "--set", ask.settings, "KEY=VALUE",
               "An input of the launch, or a list of values, of which all combinations are launches; those "
               "that are not set are as in the study's scene")
      ->allow_extra_args(false);
  const auto read_gap = [](std::string_view text) {
    const auto gap = parse_scene_quantity<scene::Dimension::length>(text);
    return gap && *gap >= 0.0 ? gap : std::nullopt;
  };
  add_amount(command, "--gap", ask.gap, read_gap, "a length such as \"0.3 mm\"", "LENGTH",
             "Gap to be told of; the study's unless given");
  CLI::Option* csv = command.add_flag("--csv", ask.csv, "A row a launch, as CSV, in place of text");
  csv->excludes(command.get_option("--gap"));
}

void add_verify(CLI::App& app, CommandLine& line) {
  auto [command, verify] =
      add_command<VerifyArguments>(app, line, "verify", "Test an installed program against known numbers");
  add_optional(command, "--filter", verify.filter, "TEXT",
               "Only checks with this in their name, case ignored");
}

void add_explain(CLI::App& app, CommandLine& line) {
  auto [command, explain] = add_command<ExplainArguments>(
      app, line, "explain", "Say what a scene or a study will compute, what it leaves out, and the cost");
  add_optional(
      command, "file", explain.file, "SCENE.toml|STUDY.toml|MATERIALS.toml",
      "Scene, study or file of materials; with --keys, --results or --materials the beginning of names, such "
      "as load");
  CLI::Option* keys = command.add_flag("--keys", explain.keys,
                                       "List the keys of scene and study files, or those whose name begins "
                                       "with the word given in the place of a "
                                       "file: unit, range, default, standing, meaning");
  CLI::Option* results = command.add_flag(
      "--results", explain.results,
      "List the columns of the tables that studies write, or those whose name begins with the word given in "
      "the place of a file: name in files with its unit, meaning");
  CLI::Option* materials =
      command.add_flag("--materials", explain.materials,
                       "List the materials that ship, or those whose name begins with the "
                       "word given in the place of a file: every number and its source");
  CLI::Option* schema = command
                            .add_option("--schema", explain.schema,
                                        "Print the JSON schema of scene or study files, for editors")
                            ->check(CLI::IsMember({"scene", "study", "references"}))
                            ->type_name("scene|study|references");
  for (CLI::Option* option : {keys, results, materials, schema})
    for (CLI::Option* other : {keys, results, materials, schema})
      if (other != option) option->excludes(other);
  add_place(command, "--grid", explain.picture, "FILE.svg", "file",
            "File to draw the half section of a scene and its grid to");
}

void add_plot(CLI::App& app, CommandLine& line) {
  auto [command, plot] = add_command<PlotArguments>(
      app, line, "plot", "Draw a case: histories, profiles, and fields over the section");
  add_required(command, "case", plot.file, "CASE.h5", "Case file");
  add_folder(command, plot.output, "Folder for the pictures; CASE_pictures beside the file unless given");
  std::vector<const char*> kinds;
  for (const report::PictureKind& kind : report::picture_kinds()) kinds.push_back(kind.word);
  command
      .add_option("--what", plot.what,
                  "One or several, with commas between; all that the case has data for unless given")
      ->type_name(fmt::format("{}", fmt::join(kinds, "|")));
  add_optional(command, "--times", plot.times, "LIST",
               "Times of fields, which must be snapshots, and of profiles, such as \"8, 10 ms\"");
  command.add_flag("--csv", plot.tables,
                   "Their numbers instead of pictures: pressure, fields and histories, as CSV files");
}

void add_init(CLI::App& app, CommandLine& line) {
  auto [command, init] = add_command<InitArguments>(
      app, line, "init", "Write a scene and a study of a shell of your own to start from");
  const auto read_calibre = [&calibre = init.calibre](const std::string& text) {
    constexpr double smallest = 0.02, largest = 0.5;
    calibre = parse_scene_quantity<scene::Dimension::length>(text).value_or(0.0);
    return calibre >= smallest && calibre <= largest;
  };
  add_read(command, "--calibre", read_calibre, "20 mm to 50 cm, such as \"105 mm\"", "LENGTH",
           "Calibre, such as \"105 mm\"")
      ->required();
  CLI::Option* curve = add_optional(command, "--curve", init.curve, "FILE.csv",
                                    "Measured pressure that scenes take, such as import-curve writes");
  add_amount(command, "--peak", init.peak, parse_positive<scene::Dimension::pressure>,
             "a pressure such as 380MPa", "PRESSURE",
             "Peak chamber pressure, where there is no measured curve")
      ->excludes(curve);
  add_folder(command, init.output, "Folder for the files")->required();
}

void add_import_curve(CLI::App& app, CommandLine& line) {
  auto [command, import] = add_command<ImportCurveArguments>(
      app, line, "import-curve", "Clean the record of a pressure gauge: offset, trigger, units, noise");
  add_required(command, "record", import.record, "RECORD.csv",
               "Record of a gauge, with a header that names quantities and units");
  add_place(command, "-o,--output", import.output, "FILE.csv", "file",
            "File for the curve, with a picture beside it; nothing is written unless given");
  add_optional(command, "--pressure", import.pressure, "COLUMN",
               "Name of the pressure's column, where there are several");
  add_amount(command, "--offset", import.offset, parse_scene_quantity<scene::Dimension::pressure>,
             "a pressure such as \"0.3 MPa\"", "PRESSURE",
             "What the gauge shows before the launch; the median of the points before the rise unless given");
  add_amount(
      command, "--trigger", import.trigger, parse_positive<scene::Dimension::pressure>,
      "a pressure such as \"5 MPa\"", "PRESSURE",
      "Pressure at which the launch begins; 1 % of the peak, or five deviations of noise, unless given");
  add_optional(command, "--scene", import.scene, "SCENE.toml",
               "Scene of a shell: says which ring of the record is near a frequency at which it swings");
}

void add_report(CLI::App& app, CommandLine& line) {
  auto [command, report] =
      add_command<ReportArguments>(app, line, "report", "Make the safety report of studies that were run");
  add_required(command, "study", report.studies, "STUDY_DIR...",
               "Folders of studies, at most one of each kind");
  add_folder(command, report.output, "Folder for report.html, report.md, report.json and the figures");
  add_optional(command, "--criterion", report.criterion, "TEXT",
               "What a gap must meet to be recommended, besides SAFE: \"margin >= 2 uncertainty\"");
  add_optional(command, "--criterion-source", report.criterion_source, "TEXT",
               "Who asks for that, as the report is to say");
  add_optional(command, "--document", report.document.number, "TEXT", "Number of the document, for its head");
  add_optional(command, "--author", report.document.author, "TEXT", "Who made it");
  add_optional(command, "--date", report.document.date, "TEXT", "Its date, as it is to be printed");
  add_optional(command, "--approvals", report.document.approvals, "NAME...",
               "Who approves it: a line each for name, date and signature");
  command.add_flag("--pdf", report.pdf, "Also report.pdf, by Chromium or Chrome where one is there");
  add_place(command, "--templates", report.templates, "DIR", "folder",
            "Folder of templates in place of those built in: letterhead, language");
  CLI::Option* index = command.add_flag(
      "--index", report.index, "Instead: STUDY_DIR/index.html, which leads to all reports in folders there");
  for (const char* other : {"--output", "--criterion", "--pdf", "--templates"})
    index->excludes(command.get_option(other));
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

/// What is not among these words, with the nearest of them; `place` is where it stands.
std::string unknown_word(const std::string& place, const std::string& word, const std::string& allowed,
                         const std::vector<std::string>& known) {
  const std::string nearest = word == "help" ? "--help" : scene::nearest_of(word, known);
  return scene::InputError{{}, 0, 0, place, '"' + word + '"', allowed, nearest}.message();
}

/// The first command or option that there is none of; empty where all are known.
std::string unknown_word_in(const CLI::App& app, int argument_count, const char* const* arguments) {
  if (argument_count < 2 || arguments[1][0] == '-') return {};
  const std::string given = arguments[1];
  std::vector<std::string> commands, options;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    commands.push_back(command->get_name());
    if (command->get_name() != given) continue;
    for (const CLI::Option* option : command->get_options())
      for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
  }
  if (options.empty()) return unknown_word("", given, fmt::format("{}", fmt::join(commands, ", ")), commands);
  for (int i = 2; i < argument_count; ++i) {
    const std::string_view argument = arguments[i];
    if (argument == "--") break;
    const std::string name(argument.substr(0, argument.find('=')));
    if (name.starts_with("--") && std::ranges::find(options, name) == options.end())
      return unknown_word(given, name, "the options that launchsafe " + given + " --help lists", options);
  }
  return {};
}

/// What the options of one command ask for makes no sense together.
std::string contradiction(const ExplainArguments& explain) {
  const bool of_program = !explain.schema.empty();
  const bool lists = explain.lists();
  if (!lists && of_program != explain.file.empty())
    return "explain: allowed: a scene, study or file of materials, or one of --keys, --results, "
           "--materials and --schema";
  if (explain.picture && (of_program || lists))
    return "explain: --grid draws the grid of a scene; allowed: with a scene file";
  return {};
}
std::string contradiction(const ReportArguments& report) {
  if (report.index && report.studies.size() != 1) return "report: --index is of one folder";
  if (!report.index && report.output.empty()) return "--output is required";
  if (report.criterion.has_value() == report.criterion_source.has_value()) return {};
  return report.criterion ? "report: --criterion requires --criterion-source, which says who asks for it"
                          : "report: --criterion-source requires --criterion";
}
template <class Other>
std::string contradiction(const Other&) {
  return {};
}

void add_commands(CLI::App& app, CommandLine& line) {
  app.require_subcommand(1);
  app.footer(footer_of("launchsafe"));
  app.set_version_flag("--version", "", "Version, commit, compiler, flags and libraries");
  const auto print_completion = [&app, &line] {
    line.request = Information{bash_completion(app)};
    throw CLI::Success();
  };
  app.add_flag_callback("--bash-completion", print_completion,
                        "A script by which bash completes commands, options and their values: eval it");
  for (const auto add : {add_run, add_study, add_status, add_merge, add_emit, add_ask, add_verify,
                         add_explain, add_plot, add_init, add_import_curve, add_report})
    add(app, line);
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) {
    command->add_flag("--json", line.json, "Print one JSON object on stdout instead of text");
    command->add_flag("-q,--quiet", line.quiet, "No progress and no remarks on stderr; errors remain");
  }
}

}  // namespace

CommandLine parse_command_line(int argument_count, const char* const* arguments) {
  CLI::App app(description, "launchsafe");
  CommandLine line;
  add_commands(app, line);
  try {
    app.parse(argument_count, arguments);
  } catch (const CLI::Success& success) {
    const bool version = dynamic_cast<const CLI::CallForVersion*>(&success) != nullptr;
    std::ostringstream help;
    app.exit(success, help, help);
    if (version || !help.str().empty())
      line.request = Information{version ? std::string{} : help.str(), version};
    line.json = asks_for_json(argument_count, arguments);
    return line;
  } catch (const CLI::ParseError& error) {
    const std::string unknown = unknown_word_in(app, argument_count, arguments);
    line.request = UsageError{unknown.empty() ? error.what() : unknown};
    line.json = asks_for_json(argument_count, arguments);
    return line;
  }
  const std::string fault = std::visit(
      [&](auto& request) {
        if constexpr (requires { request.command; })
          request.command = shell_command({arguments, arguments + argument_count});
        return contradiction(request);
      },
      line.request);
  if (!fault.empty()) line.request = UsageError{fault};
  return line;
}

}  // namespace launchsafe::app
