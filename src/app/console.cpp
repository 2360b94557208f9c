#include "console.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>

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
Json or_null(const Part& part) {
  return part == Part{} ? Json() : Json(part);
}

/// Writes all of the text: 0, or the number of the error that kept the rest from being written. `wait`: where
/// the descriptor is a full pipe that does not block.
int write_to(int descriptor, std::string_view text, bool wait) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written >= 0) {
      text.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno == EAGAIN && wait) {
      pollfd full{descriptor, POLLOUT, 0};
      ::poll(&full, 1, -1);
    } else if (errno != EINTR) {
      return errno;
    }
  }
  return 0;
}

/// On stderr; what cannot be written is dropped.
void say(std::string_view text) { write_to(STDERR_FILENO, text, false); }

using namespace std::chrono_literals;

bool can_move_its_cursor() {
  const char* terminal = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) == 1 && terminal != nullptr && std::string_view(terminal) != "dumb";
}

}  // namespace

Console::Console(bool quiet, bool json) : quiet_(quiet), json_(json) { owed() = json; }

void Console::print_text(std::string_view text) {
  if (!json_) write_result(text);
}

void Console::print_json(Json members) {
  if (!json_) return;
  for (auto& [key, value] : members.items()) object_[key] = std::move(value);
}

ExitCode Console::done(std::string_view text, Json members) {
  print_text(text);
  print_json(std::move(members));
  return ExitCode::done;
}

void Console::remark(std::string_view text) const {
  if (!quiet_) say(fmt::format("{}\n", text));
}

void Console::remarks(const std::vector<std::string>& texts) const {
  for (const std::string& text : texts) remark(text);
}

void Console::fail(const std::string& message, ExitCode code) {
  error(message);
  throw Ended{code};
}

void Console::end_with(const store::Error& error) {
  const bool folder_is_wrong =
      error.kind == store::Error::Kind::conflict || error.kind == store::Error::Kind::corrupt;
  fail(error.message, folder_is_wrong ? ExitCode::bad_input : ExitCode::failed);
}

void Console::error(const std::string& message, const scene::InputError& parts) {
  say(fmt::format("launchsafe: {}\n", message));
  if (!json_) return;
  if (object_.contains("error")) {
    // The first one is the cause; what followed from it is told with it.
    auto& told = object_["error"]["message"];
    told = told.get<std::string>() + "; " + message;
    return;
  }
  object_["error"] = {{"message", message},
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
  auto& list = object_["failures"];
  for (const kinds::Failure& failure : failures)
    list.push_back({{"case", failure.label}, {"reason", failure.reason}});
}

ExitCode Console::finish(ExitCode code) {
  if (json_) {
    const std::string text = object_.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
    owed() = false;
    write_result(text);
  }
  // Of some errors a file system only tells when a descriptor is closed.
  const int copy = ::dup(STDOUT_FILENO);
  output_lost_ = output_lost_ || (copy >= 0 && ::close(copy) != 0 && errno != EPIPE);
  if (!output_lost_) return code;
  say("launchsafe: the result could not be written to standard output\n");
  return ExitCode::failed;
}

void Console::write_result(std::string_view text) {
  const int error = write_to(STDOUT_FILENO, text, true);
  output_lost_ = output_lost_ || (error != 0 && error != EPIPE);
}

void fail_at_once(const char* message, const char* in_json) {
  for (const char* part : {"launchsafe: ", message, "\n"}) say(part);
  if (!owed().exchange(false)) return;
  for (const char* part : {"{\"error\": {\"message\": \"", in_json, "\"}}\n"})
    write_to(STDOUT_FILENO, part, true);
}

std::atomic<bool>& stop_requested() {
  static constinit std::atomic<bool> flag{false};
  return flag;
}

void reserve_standard_descriptors() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(descriptor, F_GETFD) != -1 || errno != EBADF) continue;  // it is open
    // The lowest free number is given away first, which is this one.
    const int mode = descriptor == STDERR_FILENO ? O_WRONLY : O_RDONLY;
    if (::open("/dev/null", mode) < 0) ::open("/", O_RDONLY | O_DIRECTORY);
  }
}

std::optional<std::size_t> terminal_width(int descriptor) {
  struct winsize size {};
  if (::isatty(descriptor) != 1 || ::ioctl(descriptor, TIOCGWINSZ, &size) != 0 || size.ws_col == 0)
    return std::nullopt;
  return size.ws_col;
}

std::size_t width_of_output() { return terminal_width(STDOUT_FILENO).value_or(0); }

Progress::Progress(bool quiet)
    : quiet_(quiet),
      in_place_(can_move_its_cursor()),
      pause_(in_place_ ? 200ms : 10s),
      last_(std::chrono::steady_clock::now() - (in_place_ ? pause_ : 0s)) {}

Progress::~Progress() {
  const std::lock_guard lock(mutex_);
  if (shown_) say("\r\x1b[K");
}

void Progress::show(const std::string& line) {
  if (quiet_) return;
  const std::lock_guard lock(mutex_);
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < pause_) return;
  last_ = now;
  shown_ = in_place_;
  // A line that wraps cannot be rewritten.
  const std::size_t width = terminal_width(STDERR_FILENO).value_or(80) - 1;
  say(in_place_ ? fmt::format("\r{}\x1b[K", line.substr(0, width)) : line + "\n");
}

std::string shell_quoted(std::string_view word) {
  const auto is_plain = [](char letter) {
    const auto code = static_cast<unsigned char>(letter);
    return (code < 128 && std::isalnum(code) != 0) ||
           std::string_view("_-./,:+=@%").find(letter) != std::string_view::npos;
  };
  if (!word.empty() && std::ranges::all_of(word, is_plain)) return std::string(word);
  std::string quoted = "'";
  for (const char letter : word) quoted += letter == '\'' ? R"('\'')" : std::string(1, letter);
  return quoted + "'";
}

std::string shell_command(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(study::of_each(words, shell_quoted), " "));
}

}  // namespace launchsafe::app
