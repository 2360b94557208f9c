// The command line: what can be written on it, and what `perform` does with it. Each subcommand lives in a
// file of its own.
#pragma once

#include "console.hpp"
#include "launchsafe/report/safety_report.hpp"
#include "launchsafe/study/options.hpp"

#include <ctime>
#include <filesystem>

namespace launchsafe::app {

struct RunArguments {
  std::filesystem::path scene;
  std::optional<std::filesystem::path> output;  ///< folder of the case file; none: nothing is written
  std::optional<double> longest_run;            ///< s, predicted; a longer one is refused
};
ExitCode perform(const RunArguments& arguments, Console& console);

struct StudyArguments {
  std::filesystem::path study;
  std::filesystem::path output;       ///< folder of cases, tables and report; may be empty for a dry run
  int jobs = 0;                       ///< threads; 0: as many as there are processors for us
  std::optional<double> memory;       ///< bytes of all running cases together
  std::optional<double> time_limit;   ///< s of wall time, of one case
  std::optional<double> longest_run;  ///< s, predicted, of one case; a longer one is refused
  study::Shard shard;                 ///< the part that is ours
  std::optional<double> tolerance;    ///< K, of T max; picks a setting from the study's accuracy record
  std::optional<std::time_t> until;   ///< when it stops, with what it has
  bool dry_run = false;               ///< say what would be run, and run nothing
  bool update = false;                ///< the folder may hold the results of an earlier study
  std::string command;                ///< the whole command, to be repeated in a shell
};
ExitCode perform(const StudyArguments& arguments, Console& console);

struct MergeArguments {
  std::filesystem::path study;
  std::filesystem::path output;                ///< folder of cases, tables and report
  std::vector<std::filesystem::path> folders;  ///< of shards, to be copied from
  std::optional<double> tolerance;             ///< K, as of StudyArguments
  int jobs = 0;         ///< threads that judge gaps; 0: as many as there are processors
  bool update = false;  ///< the folder may hold the results of an earlier study
  std::string command;  ///< the whole command, to be repeated in a shell
};
ExitCode perform(const MergeArguments& arguments, Console& console);

struct StatusArguments {
  std::vector<std::filesystem::path> folders;  ///< of one study: its own, or those of its shards
  bool watch = false;                          ///< look again until it has ended
};
ExitCode perform(const StatusArguments& arguments, Console& console);

struct EmitArguments {
  std::string engine;  ///< what the script is for: "slurm"
  std::filesystem::path study, output;
  int shards = 0;
  int jobs = 0;                      ///< threads of a shard; 0: not given
  std::optional<double> memory;      ///< bytes, of a shard
  std::optional<double> time_limit;  ///< s of wall time, of one case
  std::vector<std::string> sbatch;   ///< further options for every #SBATCH line, such as "--partition=long"
};
ExitCode perform(const EmitArguments& arguments, Console& console);

struct AskArguments {
  std::filesystem::path study;        ///< folder of a finished study, or its surrogate.json
  std::vector<std::string> settings;  ///< "KEY=VALUE", or a list of values
  std::optional<double> gap;          ///< m; none: the study's
  bool csv = false;                   ///< a row a launch, for programs
};
ExitCode perform(const AskArguments& arguments, Console& console);

struct VerifyArguments {
  std::string filter;  ///< part of a check's group or name, case ignored
};
ExitCode perform(const VerifyArguments& arguments, Console& console);

struct ExplainArguments {
  std::filesystem::path
      file;  ///< scene or study; with one of the lists that follow the beginning of names, or empty
  bool keys = false, results = false, materials = false;
  bool lists() const { return keys || results || materials; }
  std::string schema;                            ///< "scene", "study" or "references"; empty: not asked for
  std::optional<std::filesystem::path> picture;  ///< SVG file for the scene's grid; none: nothing is written
};
ExitCode perform(const ExplainArguments& arguments, Console& console);

struct PlotArguments {
  std::filesystem::path file;                   ///< of a case
  std::optional<std::filesystem::path> output;  ///< folder; none: CASE_pictures beside the file
  std::optional<std::string> what;              ///< words of kinds of pictures; none: all with data
  std::optional<std::string> times;             ///< with units, of fields and profiles
  bool tables = false;                          ///< CSV files of numbers instead
};
ExitCode perform(const PlotArguments& arguments, Console& console);

struct InitArguments {
  std::filesystem::path output;                ///< folder for the files
  double calibre = 0.155;                      ///< m
  std::optional<std::filesystem::path> curve;  ///< measured pressure; none: the analytic shape
  std::optional<double> peak;                  ///< Pa, of the analytic shape
};
ExitCode perform(const InitArguments& arguments, Console& console);

struct ImportCurveArguments {
  std::filesystem::path record;                 ///< CSV file of a gauge
  std::optional<std::filesystem::path> output;  ///< CSV file for the curve; none: nothing is written
  std::string pressure;                         ///< name of the column; empty: the only one
  std::optional<double> offset, trigger;        ///< Pa
  std::optional<std::filesystem::path> scene;   ///< of a shell whose modes are told beside rings
  std::string command;                          ///< the whole command, to be repeated in a shell
};
ExitCode perform(const ImportCurveArguments& arguments, Console& console);

struct ReportArguments {
  std::vector<std::filesystem::path> studies;      ///< folders
  std::filesystem::path output;                    ///< folder of the report; empty with `index`
  std::optional<std::filesystem::path> templates;  ///< folder; none: those built in
  std::optional<std::string> criterion, criterion_source;
  report::DocumentHead document;
  bool pdf = false;    ///< also as PDF, by a browser
  bool index = false;  ///< instead: the page that leads to all reports of one folder
};
ExitCode perform(const ReportArguments& arguments, Console& console);

/// What `--help` or `--version` asks for.
struct Information {
  std::string help;
  bool version = false;  ///< it is the version that is asked for
};
/// Why the command line makes no sense.
struct UsageError {
  std::string message;
};

using Request = std::variant<Information, UsageError, RunArguments, StudyArguments, StatusArguments,
                             MergeArguments, EmitArguments, VerifyArguments, ExplainArguments, PlotArguments,
                             InitArguments, ImportCurveArguments, ReportArguments, AskArguments>;

struct CommandLine {
  Request request;
  std::string command;  ///< "run"; empty where there is none
  bool quiet = false;
  bool json = false;  ///< also where the rest of the command line makes no sense
};

CommandLine parse_command_line(int argument_count, const char* const* arguments);

}  // namespace launchsafe::app
