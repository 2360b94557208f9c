// Where a command's words go: results to stdout, everything else to stderr, progress in place on a terminal;
// the exit codes; the flag by which a user stops it; commands that a person can copy into a shell; and the
// words that are built in.
#pragma once

#include "launchsafe/kinds/kind.hpp"

namespace launchsafe::app {

using Json = nlohmann::ordered_json;
using std::filesystem::path;

/// What the program returns to its caller. `failed` is a fault of the machine or of the program itself.
enum class ExitCode { done = 0, bad_input = 2, cases_failed = 3, failed = 70, interrupted = 75 };

/// Ends a command before its own end; what there was to say is said.
struct Ended {
  ExitCode code;
};

/// Text goes out at once. What is wanted as JSON is collected, results and errors alike, and goes out as one
/// object by `finish`. Nothing here fails because stderr is closed or full.
class Console {
 public:
  Console(bool quiet, bool json);
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  bool quiet() const { return quiet_; }
  bool json() const { return json_; }

  /// A text result, to stdout; nothing when the result is wanted as JSON.
  void print_text(std::string_view text);
  /// Members of the one JSON object; nothing unless it is wanted.
  void print_json(Json members);
  /// The result as text and as members, at the end of a command that did what was asked.
  ExitCode done(std::string_view text, Json members);
  /// Remarks on stderr; nothing when quiet.
  void remark(std::string_view text) const;
  void remarks(const std::vector<std::string>& texts) const;
  /// What ended the command, on stderr always, and as the member `error`.
  void error(const std::string& message, const scene::InputError& parts = {});
  void error(const scene::InputError& fault) { error(fault.message(), fault); }
  void error(const store::Error& fault) { error(fault.message); }
  /// `error` as the end of the command: of an input that is wrong, or of a machine that fails.
  template <class Fault>
  [[noreturn]] void refuse(const Fault& fault) {
    error(fault);
    throw Ended{ExitCode::bad_input};
  }
  [[noreturn]] void fail(const std::string& message, ExitCode code = ExitCode::failed);
  /// What kept a result from being stored: a folder that is wrong, or a machine that fails.
  [[noreturn]] void end_with(const store::Error& error);
  template <class Fault>
  void refuse_any(const std::optional<Fault>& fault) {
    if (fault) refuse(*fault);
  }
  /// What was read, or stored; a fault instead of it ends the command.
  template <class Value, class Fault>
  Value value_of(scene::Expected<Value, Fault> read) {
    if (!read) refuse(read.error());
    return std::move(*read);
  }
  template <class Value>
  Value stored(store::Result<Value> result) {
    if (!result) end_with(result.error());
    return std::move(*result);
  }
  /// Cases that failed, the first of them by name on stderr, all of them as the member `failures`.
  void failures(const std::vector<kinds::Failure>& failures);

  /// Writes the JSON object, if it is wanted. To be called once, at the end. The exit code, which is `failed`
  /// where something could not be written to stdout. That its reader has gone is the reader's choice and no
  /// loss.
  ExitCode finish(ExitCode code);

 private:
  bool quiet_;
  bool json_;
  bool output_lost_ = false;
  Json object_ = Json::object();

  void write_result(std::string_view text);
};

/// For the end that nothing else could be made of: one line on stderr, the JSON object where it is owed, with
/// `in_json` for its message. Allocates nothing, never throws; a signal handler may call it.
void fail_at_once(const char* message, const char* in_json = "internal error");

/// True once the user wants the program to end. Whoever finds that nothing useful can follow may set it too.
std::atomic<bool>& stop_requested();

/// Opens descriptors 0 to 2 where the caller closed them, so that no file of ours gets one of these numbers
/// and is written to as if it were stdout or stderr. To be called before anything else is opened. Writing to
/// a stdout that was closed still fails, so that lost results are noticed; a closed stderr swallows all.
void reserve_standard_descriptors();

/// Columns of the terminal that a descriptor leads to; nothing where it leads to none, or to one that does
/// not tell.
std::optional<std::size_t> terminal_width(int descriptor);
/// Those of standard output; 0, for any width, where it is no terminal.
std::size_t width_of_output();

/// A progress line on stderr: rewritten in place on a terminal that can move its cursor (not TERM=dumb), a
/// plain line now and then elsewhere. Any thread may report.
class Progress {
 public:
  explicit Progress(bool quiet);
  /// Removes the line from the terminal.
  ~Progress();

  /// Shows the line unless quiet, or the last one is too fresh: a fifth of a second on a terminal, where the
  /// first is shown at once; ten seconds elsewhere, from the beginning on.
  void show(const std::string& line);

 private:
  const bool quiet_, in_place_;
  std::mutex mutex_;
  std::chrono::steady_clock::duration pause_;
  std::chrono::steady_clock::time_point last_;
  bool shown_ = false;
};

/// The word as a POSIX shell reads it back: in quotes where it needs them.
std::string shell_quoted(std::string_view word);
/// The words with a blank between them, each quoted where needed.
std::string shell_command(const std::vector<std::string>& words);

// What --help says below the options, what commands print for people, and files that launchsafe init
// writes, as they are in the source. Names in double braces stand for values; see report/report.hpp.

/// By command, "run.txt"; "launchsafe.txt" is that of all.
const std::map<std::string, std::string>& help_texts();

/// A text for people, of such facts as programs have as JSON: "estimate.txt"; also a file: "scene.toml".
std::string told(const std::string& name, const Json& facts);

}  // namespace launchsafe::app
