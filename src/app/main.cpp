#include "command_line.hpp"
#include "signals.hpp"

#include <fmt/format.h>

#include <exception>
#include <new>

namespace {

using namespace launchsafe::app;

ExitCode perform(const Information& information, Console& console) {
  console.print_text(information.text);
  return ExitCode::done;
}

ExitCode perform(const UsageError& error, Console& console) {
  console.error(error.message + " (launchsafe --help shows the usage)");
  return ExitCode::bad_input;
}

ExitCode perform(const RunArguments& arguments, Console& console) { return run_command(arguments, console); }
ExitCode perform(const StudyArguments& arguments, Console& console) {
  return study_command(arguments, console);
}
ExitCode perform(const MergeArguments& arguments, Console& console) {
  return merge_command(arguments, console);
}
ExitCode perform(const EmitArguments& arguments, Console& console) {
  return emit_command(arguments, console);
}
ExitCode perform(const VerifyArguments& arguments, Console& console) {
  return verify_command(arguments, console);
}
ExitCode perform(const ExplainArguments& arguments, Console& console) {
  return explain_command(arguments, console);
}

ExitCode perform(const CommandLine& line) {
  const bool json = line.json && !std::holds_alternative<Information>(line.request);
  Console console(line.quiet, json);
  const ExitCode code =
      std::visit([&](const auto& request) { return perform(request, console); }, line.request);
  if (!console.output_lost()) return code;
  console.error("the result could not be written to standard output");
  return ExitCode::failed;
}

}  // namespace

int main(int argument_count, char** arguments) {
  const Console console(false, false);
  try {
    catch_signals();
    return static_cast<int>(perform(parse_command_line(argument_count, arguments)));
  } catch (const std::bad_alloc&) {
    console.error(
        "out of memory; a coarser numerics.cell_size, fewer --jobs or a smaller --memory need less");
  } catch (const std::exception& error) {
    console.error(fmt::format("internal error: {}", error.what()));
  }
  return static_cast<int>(ExitCode::failed);
}
