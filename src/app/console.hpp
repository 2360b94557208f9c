// Where a command's words go: results to stdout, everything else to stderr; and the exit codes.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string_view>

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

class Console {
 public:
  Console(bool quiet, bool json) : quiet_(quiet), json_(json) {}

  bool quiet() const { return quiet_; }
  bool json() const { return json_; }

  /// A text result, to stdout; nothing when the result is wanted as JSON.
  void print_text(std::string_view text);
  /// The JSON result, to stdout; nothing unless it is wanted.
  void print_json(const nlohmann::ordered_json& object);
  /// Whether something could not be written to stdout. That its reader has gone is the reader's choice and no
  /// loss.
  bool output_lost() const { return output_lost_; }
  /// A remark on stderr; nothing when quiet.
  void remark(std::string_view text) const;
  /// An error on stderr, always.
  void error(std::string_view text) const;

 private:
  bool quiet_;
  bool json_;
  bool output_lost_ = false;

  void write_result(std::string_view text);
};

}  // namespace launchsafe::app
