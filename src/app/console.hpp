// Where a command's words go: results to stdout, everything else to stderr; and the exit codes.
#pragma once

#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/scene/input_error.hpp"
#include "launchsafe/store/result.hpp"

#include <nlohmann/json_fwd.hpp>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace launchsafe::app {

/// What the program returns to its caller. `failed` is a fault of the machine or of the program itself.
enum class ExitCode {
  done = 0,
  bad_input = 2,
  cases_failed = 3,
  indeterminate = 4,
  failed = 70,
  interrupted = 75
};

/// Text goes out at once. What is wanted as JSON is collected, results and errors alike, and goes out as one
/// object by `finish`. Nothing here fails because stderr is closed or full.
class Console {
 public:
  Console(bool quiet, bool json);
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  bool quiet() const { return quiet_; }
  bool json() const { return json_; }

  /// A text result, to stdout; nothing when the result is wanted as JSON.
  void print_text(std::string_view text);
  /// Members of the one JSON object; nothing unless it is wanted.
  void print_json(nlohmann::ordered_json members);
  /// A remark on stderr; nothing when quiet.
  void remark(std::string_view text) const;
  /// What ended the command, on stderr always, and as the member `error`.
  void error(const std::string& message);
  void error(const scene::InputError& error);
  /// `error` as the end of the command: of an input that is wrong, or of a machine that fails.
  template <class Fault>
  ExitCode refuse(const Fault& fault) {
    error(fault);
    return ExitCode::bad_input;
  }
  ExitCode fail(const std::string& message);
  /// What kept a result from being stored: a folder that is wrong, or a machine that fails.
  ExitCode end_with(const store::Error& error);
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
  std::unique_ptr<nlohmann::ordered_json> object_;

  void write_result(std::string_view text);
  void add_error(const std::string& message, const scene::InputError& parts);
};

/// For the end that nothing else could be made of: one line on stderr, the JSON object where it is owed.
/// Allocates nothing, never throws.
ExitCode fail_at_once(const char* message);

}  // namespace launchsafe::app
