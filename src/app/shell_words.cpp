#include "shell_words.hpp"

#include <algorithm>
#include <cctype>

namespace launchsafe::app {
namespace {

bool is_plain(char letter) {
  constexpr std::string_view plain = "_-./,:+=@%";
  const auto code = static_cast<unsigned char>(letter);
  return (code < 128 && std::isalnum(code) != 0) || plain.find(letter) != std::string_view::npos;
}

}  // namespace

std::string shell_quoted(std::string_view word) {
  if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) return std::string(word);
  std::string quoted = "'";
  for (const char letter : word) {
    if (letter == '\'') {
      quoted += R"('\'')";
    } else {
      quoted += letter;
    }
  }
  return quoted + "'";
}

std::string shell_command(const std::vector<std::string>& words) {
  std::string command;
  for (const std::string& word : words) command += (command.empty() ? "" : " ") + shell_quoted(word);
  return command;
}

}  // namespace launchsafe::app
