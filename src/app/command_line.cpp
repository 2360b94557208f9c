#include "command_line.hpp"

#include "command_help.hpp"
#include "common_options.hpp"
#include "shell_words.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <sstream>
#include <string_view>

namespace launchsafe::app {

namespace {

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
                                  "Test an installed program against known numbers", verify_footer);
  command.add_option("--filter", parsed.verify.filter, "Only checks with this in their name, case ignored")
      ->type_name("TEXT");
  add_output_options(command, parsed);
}

void add_explain(CLI::App& app, Parsed& parsed) {
  CLI::App& command = add_command(
      app, parsed, parsed.explain, "explain",
      "Say what a scene or a study will compute, what it leaves out, and the cost", explain_footer);
  command
      .add_option(
          "file", parsed.explain.file,
          "Scene, study or file of materials; with --keys or --materials the beginning of names, such as "
          "load")
      ->type_name("SCENE.toml|STUDY.toml|MATERIALS.toml");
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
  for (CLI::Option* option : {keys, materials, schema})
    for (CLI::Option* other : {keys, materials, schema})
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
  command.add_flag("--csv", parsed.plot.tables,
                   "Their numbers instead of pictures: pressure, fields and histories, as CSV files");
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
std::string contradiction(const ExplainArguments& explain) {
  const bool of_program = !explain.schema.empty();
  const bool lists = explain.keys || explain.materials;
  if (!lists && of_program != explain.file.empty())
    return "explain: allowed: a scene, study or file of materials, or one of --keys, --materials and "
           "--schema";
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

}  // namespace

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
