// Built-in texts with names in double braces that stand for values.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace launchsafe::app {

using TextValues = std::map<std::string, std::string, std::less<>>;

/// The text with the value of every {{name}}, as it is; a name without one stays as it stands.
std::string filled(std::string_view text, const TextValues& values);

}  // namespace launchsafe::app
