// The cells of one line of a CSV file.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace launchsafe::scene {

/// The next line of a text, which is shortened by it; lines end with LF, CRLF or CR.
std::string_view take_line(std::string_view& text);

/// The first of semicolon, tab and comma that separates cells of this header, outside of quotation marks; a
/// comma if none does.
char separator_of(std::string_view header);

/// The cells of a line without blanks around them and without their quotation marks; a doubled quotation mark
/// in these is one. Nothing where a quotation mark is not closed, or closed before the end of its cell.
std::optional<std::vector<std::string>> cells_of(std::string_view line, char separator);

}  // namespace launchsafe::scene
