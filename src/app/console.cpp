#include "console.hpp"

#include "descriptors.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>

namespace launchsafe::app {
namespace {

constexpr std::size_t most_failures_named = 20;

/// True from the moment that a JSON object is promised until it is about to be written: whoever ends the
/// program early has to write one.
std::atomic<bool>& owed() {
  static constinit std::atomic<bool> flag{false};
  return flag;
}

/// Null for an empty text, and for 0.
template <class Part>
nlohmann::ordered_json or_null(const Part& part) {
  return part == Part{} ? nlohmann::ordered_json() : nlohmann::ordered_json(part);
}

void say(std::string_view text) { write_or_drop(STDERR_FILENO, text); }

}  // namespace

Console::Console(bool quiet, bool json)
    : quiet_(quiet),
      json_(json),
      object_(std::make_unique<nlohmann::ordered_json>(nlohmann::ordered_json::object())) {
  owed() = json;
}

Console::~Console() = default;

void Console::print_text(std::string_view text) {
  if (!json_) write_result(text);
}

void Console::print_json(nlohmann::ordered_json members) {
  if (!json_) return;
  for (auto& [key, value] : members.items()) (*object_)[key] = std::move(value);
}

void Console::remark(std::string_view text) const {
  if (!quiet_) say(fmt::format("{}\n", text));
}

void Console::error(const std::string& message) { add_error(message, {}); }

void Console::error(const scene::InputError& error) { add_error(error.message(), error); }

ExitCode Console::fail(const std::string& message) {
  error(message);
  return ExitCode::failed;
}

ExitCode Console::end_with(const store::Error& error) {
  const bool folder_is_wrong =
      error.kind == store::Error::Kind::conflict || error.kind == store::Error::Kind::corrupt;
  return folder_is_wrong ? refuse(error.message) : fail(error.message);
}

void Console::add_error(const std::string& message, const scene::InputError& parts) {
  say(fmt::format("launchsafe: {}\n", message));
  if (!json_) return;
  if (object_->contains("error")) {
    // The first one is the cause; what followed from it is told with it.
    auto& told = (*object_)["error"]["message"];
    told = told.get<std::string>() + "; " + message;
    return;
  }
  (*object_)["error"] = {{"message", message},
                         {"file", or_null(parts.file)},
                         {"line", or_null(parts.line)},
                         {"column", or_null(parts.column)},
                         {"key", or_null(parts.key)},
                         {"found", or_null(parts.found)},
                         {"allowed", or_null(parts.allowed)},
                         {"suggestion", or_null(parts.suggestion)}};
}

void Console::failures(const std::vector<kinds::Failure>& failures) {
  const std::size_t named = std::min(failures.size(), most_failures_named);
  for (std::size_t i = 0; i < named; ++i)
    say(fmt::format("launchsafe: {}: {}\n", failures[i].label, failures[i].reason));
  if (named < failures.size())
    say(fmt::format("launchsafe: and {} more cases failed\n", failures.size() - named));
  if (!json_ || failures.empty()) return;
  auto& list = (*object_)["failures"];
  for (const kinds::Failure& failure : failures)
    list.push_back({{"case", failure.label}, {"reason", failure.reason}});
}

ExitCode Console::finish(ExitCode code) {
  if (json_) {
    const std::string text =
        object_->dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
    owed() = false;
    write_result(text);
  }
  const int late = late_error_of(STDOUT_FILENO);
  output_lost_ = output_lost_ || (late != 0 && late != EPIPE);
  if (!output_lost_) return code;
  say("launchsafe: the result could not be written to standard output\n");
  return ExitCode::failed;
}

void Console::write_result(std::string_view text) {
  const int error = write_all(STDOUT_FILENO, text);
  output_lost_ = output_lost_ || (error != 0 && error != EPIPE);
}

ExitCode fail_at_once(const char* message) {
  for (const char* part : {"launchsafe: ", message, "\n"}) say(part);
  if (owed().exchange(false)) write_all(STDOUT_FILENO, "{\"error\": {\"message\": \"internal error\"}}\n");
  return ExitCode::failed;
}

}  // namespace launchsafe::app
