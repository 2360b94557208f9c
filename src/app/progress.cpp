#include "progress.hpp"

#include "descriptors.hpp"
#include "launchsafe/report/number.hpp"
#include "terminal_width.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>

namespace launchsafe::app {
namespace {

using namespace std::chrono_literals;

/// A line that wraps cannot be rewritten.
std::string fitted(const std::string& line) {
  return line.substr(0, terminal_width(STDERR_FILENO).value_or(80) - 1);
}

}  // namespace

ProgressStyle progress_style(bool quiet) {
  if (quiet) return ProgressStyle::none;
  const char* terminal = std::getenv("TERM");
  const bool dumb = terminal == nullptr || std::string_view(terminal) == "dumb";
  return ::isatty(STDERR_FILENO) == 1 && !dumb ? ProgressStyle::terminal : ProgressStyle::plain;
}

Progress::Progress(ProgressStyle style)
    : style_(style), pause_(10s), last_(std::chrono::steady_clock::now()) {
  if (style != ProgressStyle::terminal) return;
  pause_ = 200ms;
  last_ -= pause_;
}

Progress::~Progress() {
  const std::lock_guard lock(mutex_);
  if (shown_) write_or_drop(STDERR_FILENO, "\r\x1b[K");
}

void Progress::show(const std::string& line) {
  if (style_ == ProgressStyle::none) return;
  const std::lock_guard lock(mutex_);
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < pause_) return;
  last_ = now;
  shown_ = style_ == ProgressStyle::terminal;
  const std::string text = shown_ ? fmt::format("\r{}\x1b[K", fitted(line)) : line + "\n";
  write_or_drop(STDERR_FILENO, text);
}

std::string time_left(double share, double elapsed) {
  constexpr double too_early = 0.005;
  if (!(share > too_early) || share > 1.0) return {};
  return fmt::format("{} left", report::duration(elapsed * (1.0 - share) / share));
}

}  // namespace launchsafe::app
