#include "filled_text.hpp"

namespace launchsafe::app {

std::string filled(std::string_view text, const TextValues& values) {
  constexpr std::string_view opening = "{{", closing = "}}";
  std::string whole;
  for (std::size_t open = text.find(opening); open != std::string_view::npos; open = text.find(opening)) {
    const std::size_t name = open + opening.size(), close = text.find(closing, name);
    if (close == std::string_view::npos) break;
    const auto value = values.find(text.substr(name, close - name));
    whole += text.substr(0, open);
    whole += value == values.end() ? text.substr(open, close + closing.size() - open) : value->second;
    text.remove_prefix(close + closing.size());
  }
  return whole.append(text);
}

}  // namespace launchsafe::app
