#include "console.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cerrno>
#include <cstdio>

namespace launchsafe::app {

void Console::print_text(std::string_view text) {
  if (!json_) write_result(text);
}

void Console::print_json(const nlohmann::ordered_json& object) {
  if (json_)
    write_result(object.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

void Console::remark(std::string_view text) const {
  if (!quiet_) fmt::print(stderr, "{}\n", text);
}

void Console::error(std::string_view text) const { fmt::print(stderr, "launchsafe: {}\n", text); }

void Console::write_result(std::string_view text) {
  const bool written =
      std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  if (!written && errno != EPIPE) output_lost_ = true;
}

}  // namespace launchsafe::app
