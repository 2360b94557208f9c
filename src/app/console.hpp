// Where a command's words go: results to stdout, everything else to stderr, progress in place on a terminal;
// the exit codes; the flag by which a user stops it; and the texts that are built in.
#pragma once

#include "launchsafe/kinds/kind.hpp"

#include <chrono>
#include <mutex>

namespace launchsafe::app {

using Json = nlohmann::ordered_json;
using std::filesystem::path;

/// What the program returns to its caller. `failed` is a fault of the machine or of the program itself.
enum class ExitCode { done = 0, bad_input = 2, cases_failed = 3, failed = 70, interrupted = 75 };

/// Ends a command, with a message for its user. It is thrown; main prints it, as it does scene::InputError
/// and store::Error.
struct Ended {
  std::string message;
  ExitCode code = ExitCode::bad_input;
};

/// Throws what is wrong with the input, if anything.
inline void refuse_any(const std::optional<std::string>& fault) {
  if (fault) throw Ended{*fault};
}

/// Text goes out at once. A result that is wanted as JSON is collected, with errors, and goes out as one
/// object by `finish`.
class Console {
 public:
  Console(bool quiet, bool json) : quiet_(quiet), json_(json) {}

  bool quiet() const { return quiet_; }
  bool json() const { return json_; }

  /// A text result, to stdout; nothing when the result is wanted as JSON.
  void print_text(std::string_view text);
  /// Members of the one JSON object; nothing unless it is wanted.
  void print_json(const Json& members);
  /// The result as text and as members, at the end of a command that did what was asked.
  ExitCode done(std::string_view text, const Json& members);
  /// Remarks on stderr; nothing when quiet.
  void remark(std::string_view text) const;
  void remarks(const std::vector<std::string>& texts) const;
  /// The error that ended the command, on stderr always, and as the member `error`.
  void error(const std::string& message, const scene::InputError& parts = {});
  /// Cases that failed, the first of them by name on stderr, all of them as the member `failures`.
  void failures(const std::vector<kinds::Failure>& failures);

  /// Writes the JSON object, if it is wanted. To be called once, at the end. The exit code, which is `failed`
  /// where something could not be written to stdout. That its reader has gone is no loss.
  ExitCode finish(ExitCode code);

 private:
  void write_result(std::string_view text);

  const bool quiet_, json_;
  bool output_lost_ = false;
  Json object_ = Json::object();
};

/// True once the user wants the program to end. Whoever finds that nothing useful can follow may set it too.
inline constinit std::atomic<bool> stop_requested{false};

/// Columns of the terminal that stdout leads to; 0, for any width, where it is none.
std::size_t width_of_output();

/// A progress line on stderr: rewritten in place on a terminal, a plain line now and then elsewhere. Any
/// thread may report.
class Progress {
 public:
  explicit Progress(bool quiet);
  /// Removes the line from the terminal.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Shows the line unless quiet, or the last one is too fresh: a fifth of a second on a terminal, ten
  /// seconds elsewhere.
  void show(const std::string& line);

 private:
  const bool quiet_, in_place_;
  std::mutex mutex_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  bool shown_ = false;
};

/// The words with a blank between them, as a POSIX shell reads them back.
std::string shell_command(const std::vector<std::string>& words);

/// What --help says below the options of a command: "run.txt"; "launchsafe.txt" of all.
const std::map<std::string, std::string>& help_texts();

/// A text for people, of facts as programs have them as JSON: "estimate.txt"; also a file: "scene.toml".
/// Names in double braces stand for values; see report/report.hpp.
std::string told(const std::string& name, const Json& facts);

}  // namespace launchsafe::app
