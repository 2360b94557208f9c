#include "command_line.hpp"

#include "version_text.hpp"

#include <CLI/CLI.hpp>

#include <sstream>

namespace launchsafe::app {
namespace {

constexpr int most_jobs = 4096;

constexpr const char* description =
    "launchsafe: how thick may the gap under an explosive charge be before a launch can ignite it?\n"
    "Simulates shells under launch loads by the material point method.";

constexpr const char* footer = R"(
Examples:
  launchsafe run studies/scene_155mm.toml -o results
  launchsafe study studies/critical_gap_155mm.toml -o results --jobs 2
  launchsafe verify
  launchsafe explain studies/scene_155mm.toml

Results go to stdout, progress and messages to stderr. Nothing is written but under the folder of --output.
Exit codes: 0 done, 2 bad usage or input, 3 some cases or checks failed, 4 a verdict is indeterminate,
70 the machine or the program failed (memory, disk, internal error), 75 interrupted.)";

constexpr const char* run_footer = R"(
Examples:
  launchsafe run studies/scene_155mm.toml                print the table, write nothing
  launchsafe run studies/scene_155mm.toml -o results     write results/scene_155mm.h5 as well
  launchsafe run studies/scene_155mm.toml --json --quiet > case.json

A file with the result of another input is never overwritten.)";

constexpr const char* study_footer = R"(
Examples:
  launchsafe study studies/critical_gap_155mm.toml -o results
  launchsafe study studies/critical_gap_155mm.toml -o results --jobs 2 --json > study.json)";

constexpr const char* verify_footer = R"(
Examples:
  launchsafe verify                      every check
  launchsafe verify --filter jwl         those with "jwl" in their name)";

constexpr const char* explain_footer = R"(
Examples:
  launchsafe explain studies/scene_155mm.toml            physics in and out, particles, steps, time, memory
  launchsafe explain studies/critical_gap_155mm.toml     the runs that the study needs
  launchsafe explain --keys                              every key of a scene file)";

/// Everything the options write to while CLI11 parses.
struct Parsed {
  CommandLine line;
  RunArguments run;
  StudyArguments study;
  VerifyArguments verify;
  ExplainArguments explain;
};

void add_output_options(CLI::App& command, Parsed& parsed) {
  command.add_flag("--json", parsed.line.json, "Print one JSON object on stdout instead of text");
  command.add_flag("-q,--quiet", parsed.line.quiet, "No progress and no remarks on stderr; errors remain");
}

CLI::App* add_run(CLI::App& app, Parsed& parsed) {
  CLI::App* command =
      app.add_subcommand("run", "Run one case: a scene in, temperatures of the charge bottom out");
  command->add_option("scene", parsed.run.scene, "Scene file")->required()->type_name("SCENE.toml");
  command->add_option("-o,--output", parsed.run.output, "Folder to write the HDF5 case file to")
      ->type_name("DIR");
  add_output_options(*command, parsed);
  command->footer(run_footer);
  return command;
}

CLI::App* add_study(CLI::App& app, Parsed& parsed) {
  CLI::App* command = app.add_subcommand("study", "Run a study: many cases, a fit, a verdict for every gap");
  command->add_option("study", parsed.study.study, "Study file")->required()->type_name("STUDY.toml");
  command->add_option("-o,--output", parsed.study.output, "Folder for cases, tables and report")
      ->required()
      ->type_name("DIR");
  command->add_option("-j,--jobs", parsed.study.jobs, "Threads; as many as there are processors unless given")
      ->check(CLI::Range(1, most_jobs))
      ->type_name("N");
  add_output_options(*command, parsed);
  command->footer(study_footer);
  return command;
}

CLI::App* add_verify(CLI::App& app, Parsed& parsed) {
  CLI::App* command = app.add_subcommand("verify", "Compare the program with closed-form solutions");
  command->add_option("--filter", parsed.verify.filter, "Only checks with this in their name, case ignored")
      ->type_name("TEXT");
  add_output_options(*command, parsed);
  command->footer(verify_footer);
  return command;
}

CLI::App* add_explain(CLI::App& app, Parsed& parsed) {
  CLI::App* command = app.add_subcommand(
      "explain", "Say what a scene or a study will compute, what it leaves out, and the cost");
  command->add_option("file", parsed.explain.file, "Scene or study file")->type_name("SCENE.toml|STUDY.toml");
  command->add_flag("--keys", parsed.explain.keys,
                    "List every key of a scene file: unit, range, default, standing, meaning");
  add_output_options(*command, parsed);
  command->footer(explain_footer);
  return command;
}

std::string text_of_success(const CLI::App& app, const CLI::Success& success) {
  std::ostringstream text;
  app.exit(success, text, text);
  return text.str();
}

}  // namespace

CommandLine parse_command_line(int argument_count, const char* const* arguments) {
  CLI::App app(description, "launchsafe");
  Parsed parsed;
  app.require_subcommand(1);
  app.footer(footer);
  app.set_version_flag("--version", version_text, "Version, commit, compiler, flags and libraries");
  const CLI::App* run = add_run(app, parsed);
  const CLI::App* study = add_study(app, parsed);
  const CLI::App* verify = add_verify(app, parsed);
  add_explain(app, parsed);

  CommandLine& line = parsed.line;
  try {
    app.parse(argument_count, arguments);
  } catch (const CLI::Success& success) {
    line.request = Information{text_of_success(app, success)};
    return line;
  } catch (const CLI::ParseError& error) {
    line.request = UsageError{error.what()};
    return line;
  }
  if (run->parsed()) {
    line.request = parsed.run;
  } else if (study->parsed()) {
    line.request = parsed.study;
  } else if (verify->parsed()) {
    line.request = parsed.verify;
  } else if (parsed.explain.keys != parsed.explain.file.empty()) {
    line.request = UsageError{"explain: allowed: either a scene or study file, or --keys"};
  } else {
    line.request = parsed.explain;
  }
  return line;
}

}  // namespace launchsafe::app
