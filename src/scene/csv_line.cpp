#include "csv_line.hpp"

#include "input_text.hpp"

#include <algorithm>
#include <cstddef>

namespace launchsafe::scene {
namespace {

/// A cell that begins with a quotation mark; what follows it stays in `rest`.
std::optional<std::string> take_quoted(std::string_view& rest) {
  std::string cell;
  rest.remove_prefix(1);
  for (;;) {
    const std::size_t mark = rest.find('"');
    if (mark == std::string_view::npos) return std::nullopt;
    cell += rest.substr(0, mark);
    rest.remove_prefix(mark + 1);
    if (!rest.starts_with('"')) return std::string(without_blanks_around(cell));
    cell += '"';
    rest.remove_prefix(1);
  }
}

/// Like `without_blanks_around`, but a tab that separates cells stays.
std::string_view without_blanks_before(std::string_view text, char separator) {
  while (!text.empty() && text[0] != separator && (text[0] == ' ' || text[0] == '\t')) text.remove_prefix(1);
  return text;
}

}  // namespace

std::string_view take_line(std::string_view& text) {
  const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
  const std::string_view line = text.substr(0, end);
  const std::string_view rest = text.substr(end);
  text.remove_prefix(end + (rest.starts_with("\r\n") ? 2 : std::min<std::size_t>(rest.size(), 1)));
  return line;
}

char separator_of(std::string_view header) {
  std::string outside;
  bool quoted = false;
  for (const char c : header) {
    if (c == '"') quoted = !quoted;
    if (!quoted) outside += c;
  }
  for (const char separator : {';', '\t'})
    if (outside.find(separator) != std::string::npos) return separator;
  return ',';
}

std::optional<std::vector<std::string>> cells_of(std::string_view line, char separator) {
  std::vector<std::string> cells;
  for (;;) {
    line = without_blanks_before(line, separator);
    if (line.starts_with('"')) {
      auto cell = take_quoted(line);
      line = without_blanks_before(line, separator);
      if (!cell || (!line.empty() && line[0] != separator)) return std::nullopt;
      cells.push_back(std::move(*cell));
    } else {
      const std::size_t end = std::min(line.find(separator), line.size());
      cells.emplace_back(without_blanks_around(line.substr(0, end)));
      line.remove_prefix(end);
    }
    if (line.empty()) return cells;
    line.remove_prefix(1);
  }
}

}  // namespace launchsafe::scene
