// Text of input files before it is parsed: what no reader may see, and what all readers do with text.
#pragma once

#include "launchsafe/scene/input_error.hpp"

namespace launchsafe::scene {

/// Without blanks, tabs and line ends at its ends.
std::string_view without_blanks_around(std::string_view text);

/// "a, b" as its parts between commas, without blanks around them; at least one, which may be empty.
std::vector<std::string_view> parts_of_list(std::string_view text);

/// With small letters (ASCII).
std::string lower_case(std::string_view text);

/// The first byte of a text that is no UTF-8, or a NUL, with its line.
Fault check_encoding(std::string_view text, const std::string& file);

/// TOML nested deeper than any scene or study is, which would exhaust the stack of whoever walks through it:
/// brackets inside each other, or a dotted key of many parts.
Fault check_nesting(std::string_view toml, const std::string& file);

}  // namespace launchsafe::scene
