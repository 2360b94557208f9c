#include "terminal_width.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

namespace launchsafe::app {

std::optional<std::size_t> terminal_width(int descriptor) {
  struct winsize size {};
  if (::isatty(descriptor) != 1 || ::ioctl(descriptor, TIOCGWINSZ, &size) != 0 || size.ws_col == 0)
    return std::nullopt;
  return size.ws_col;
}

std::size_t width_of_output() { return terminal_width(STDOUT_FILENO).value_or(0); }

}  // namespace launchsafe::app
