#include "input_text.hpp"

#include "launchsafe/scene/toml_reader.hpp"

#include <boost/locale/utf.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <vector>

namespace launchsafe::scene {
namespace {

/// Scenes and studies need five.
constexpr std::size_t deepest_nesting = 16;

Place place_at(std::string_view text, std::size_t position, const std::string& file) {
  const std::string_view before = text.substr(0, position);
  const std::size_t line_begin = before.rfind('\n') + 1;  // 0 where there is none
  return {file, 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n')),
          1 + static_cast<int>(position - line_begin)};
}

/// Walks over the texts and comments of TOML, so that what is between them can be counted. It need only be
/// right up to the first fault of the syntax, where the parser stops.
class TomlScanner {
 public:
  explicit TomlScanner(std::string_view text) : text_(text) {}

  bool done() const { return position_ >= text_.size(); }
  std::size_t position() const { return position_; }

  /// The next character outside of texts and comments; 0 where one of these was passed over.
  char next() {
    const char c = text_[position_++];
    if (c == '#') {
      position_ = std::min(text_.find('\n', position_), text_.size());
    } else if (c == '"' || c == '\'') {
      pass_text(c);
    } else {
      return c;
    }
    return 0;
  }

 private:
  bool three_quotes(char quote) const {
    return text_.substr(position_).starts_with(std::string_view(quote == '"' ? "\"\"\"" : "'''"));
  }

  void pass_text(char quote) {
    --position_;
    if (three_quotes(quote)) return pass_long_text(quote);
    for (++position_; !done(); ++position_) {
      if (text_[position_] == '\n') return;
      if (text_[position_] == quote) {
        ++position_;
        return;
      }
      if (text_[position_] == '\\' && quote == '"') ++position_;
    }
  }

  /// Ends at the last three of up to five quotation marks.
  void pass_long_text(char quote) {
    for (position_ += 3; !done(); ++position_) {
      if (three_quotes(quote)) {
        position_ += 3;
        for (int more = 0; more < 2 && !done() && text_[position_] == quote; ++more) ++position_;
        return;
      }
      if (text_[position_] == '\\' && quote == '"') ++position_;
    }
  }

  std::string_view text_;
  std::size_t position_ = 0;
};

}  // namespace

std::string_view without_blanks_around(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& letter : result) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return result;
}

std::optional<InputError> check_encoding(std::string_view text, const std::string& file) {
  for (const char* at = text.data(); at != text.data() + text.size();) {
    const char* const character = at;
    // Neither overlong forms nor surrogates nor what is beyond U+10FFFF are characters (Unicode, table 3-7).
    const auto code = boost::locale::utf::utf_traits<char>::decode(at, text.data() + text.size());
    if (code != 0 && boost::locale::utf::is_valid_codepoint(code)) continue;
    const std::string found = code == 0 ? "a NUL byte, as in UTF-16 or in a file that is no text"
                                        : fmt::format("the byte 0x{:02X}, which is no UTF-8",
                                                      static_cast<unsigned char>(*character));
    return error_at(place_at(text, static_cast<std::size_t>(character - text.data()), file), {}, found,
                    "text in UTF-8");
  }
  return std::nullopt;
}

std::optional<InputError> check_nesting(std::string_view toml, const std::string& file) {
  TomlScanner scanner(toml);
  std::size_t open = 0, points = 0;  // brackets, and points since the last character that ends a key
  while (!scanner.done()) {
    const char c = scanner.next();
    if (c == '[' || c == '{') ++open;
    if ((c == ']' || c == '}') && open > 0) --open;
    if (c == '.') ++points;
    if (c == '[' || c == '{' || c == '=' || c == ',' || c == '\n') points = 0;
    if (std::max(open, points) < deepest_nesting) continue;
    return error_at(place_at(toml, scanner.position() - 1, file), {},
                    open >= deepest_nesting ? fmt::format("{} brackets inside each other", open)
                                            : fmt::format("a key of more than {} parts", points),
                    fmt::format("tables and arrays nested less than {} deep", deepest_nesting));
  }
  return std::nullopt;
}

}  // namespace launchsafe::scene
