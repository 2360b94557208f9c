#include "console.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>

namespace launchsafe::app {
namespace {

constexpr std::size_t most_failures_named = 20;

/// On stderr; what cannot be written is dropped.
void say(const std::string& text) { std::fputs(text.c_str(), stderr); }

std::size_t terminal_width(int descriptor) {
  struct winsize size {};
  return ::isatty(descriptor) == 1 && ::ioctl(descriptor, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

/// The word in quotes where a shell needs them.
std::string quoted(const std::string& word) {
  constexpr const char* plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-./,:+=@%";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string text = "'";
  for (const char letter : word) text += letter == '\'' ? R"('\'')" : std::string(1, letter);
  return text + "'";
}

}  // namespace

void Console::print_text(std::string_view text) {
  if (!json_) write_result(text);
}

void Console::print_json(const Json& members) {
  if (json_) object_.update(members);
}

ExitCode Console::done(std::string_view text, const Json& members) {
  print_text(text);
  print_json(members);
  return ExitCode::done;
}

void Console::remark(std::string_view text) const {
  if (!quiet_) say(fmt::format("{}\n", text));
}

void Console::remarks(const std::vector<std::string>& texts) const {
  for (const std::string& text : texts) remark(text);
}

void Console::error(const std::string& message, const scene::InputError& parts) {
  say(fmt::format("launchsafe: {}\n", message));
  print_json({{"error",
               {{"message", message},
                {"file", parts.file},
                {"line", parts.line},
                {"column", parts.column},
                {"key", parts.key},
                {"found", parts.found},
                {"allowed", parts.allowed},
                {"suggestion", parts.suggestion}}}});
}

void Console::failures(const std::vector<kinds::Failure>& failures) {
  for (std::size_t i = 0; i < std::min(failures.size(), most_failures_named); ++i)
    say(fmt::format("launchsafe: {}: {}\n", failures[i].label, failures[i].reason));
  if (most_failures_named < failures.size())
    say(fmt::format("launchsafe: and {} more cases failed\n", failures.size() - most_failures_named));
  for (const kinds::Failure& failure : failures)
    if (json_) object_["failures"].push_back({{"case", failure.label}, {"reason", failure.reason}});
}

ExitCode Console::finish(ExitCode code) {
  if (json_) write_result(object_.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  if (!output_lost_) return code;
  say("launchsafe: the result could not be written to standard output\n");
  return ExitCode::failed;
}

void Console::write_result(std::string_view text) {
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (std::fflush(stdout) != 0 || !written) output_lost_ = output_lost_ || errno != EPIPE;
}

std::size_t width_of_output() { return terminal_width(STDOUT_FILENO); }

Progress::Progress(bool quiet) : quiet_(quiet), in_place_(::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (shown_) say("\r\x1b[K");
}

void Progress::show(const std::string& line) {
  using namespace std::chrono_literals;
  const std::lock_guard lock(mutex_);
  const auto now = std::chrono::steady_clock::now();
  if (quiet_ || now - last_ < (in_place_ ? 200ms : 10'000ms)) return;
  last_ = now;
  shown_ = in_place_;
  // A line that wraps cannot be rewritten.
  const std::size_t width = std::max<std::size_t>(20, terminal_width(STDERR_FILENO)) - 1;
  say(in_place_ ? fmt::format("\r{}\x1b[K", line.substr(0, width)) : line + "\n");
}

std::string shell_command(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(study::of_each(words, quoted), " "));
}

}  // namespace launchsafe::app
