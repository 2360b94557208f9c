#include "launchsafe/scene/input_error.hpp"

#include "input_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace launchsafe::scene {
namespace {

/// Longest word that is compared letter by letter with others.
constexpr std::size_t longest_word = 200;

bool continues_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0u) == 0x80u; }

/// Control characters, those of the second block (U+0080 to U+009F) and the two separators of lines and
/// paragraphs beyond ASCII, as escapes.
std::string on_one_line(std::string_view text) {
  std::string line;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const std::string_view rest = text.substr(i);
    if (byte < 0x20 || byte == 0x7F) {
      line += byte == '\n' ? "\\n" : byte == '\t' ? "\\t" : fmt::format("\\x{:02x}", byte);
    } else if (byte == 0xC2 && rest.size() > 1 && static_cast<unsigned char>(rest[1]) < 0xA0) {
      line += fmt::format("\\u00{:02x}", static_cast<unsigned char>(text[++i]));
    } else if (rest.starts_with("\u2028") || rest.starts_with("\u2029")) {
      line += rest.starts_with("\u2028") ? "\\u2028" : "\\u2029";
      i += 2;
    } else {
      line += text[i];
    }
  }
  return line;
}

/// Edit distance that counts a swap of neighbours as one change (optimal string alignment).
std::size_t letters_apart(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) cost[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) cost[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, cost[i - 1][j - 1] + change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
      }
    }
  }
  return cost[a.size()][b.size()];
}

}  // namespace

std::string quotable(std::string_view text, std::size_t longest) {
  constexpr std::string_view gap = " ... ";
  const std::size_t kept = longest > gap.size() ? longest - gap.size() : 0;
  if (text.size() <= longest) return on_one_line(text);
  std::size_t head = kept - kept / 4, tail = text.size() - kept / 4;
  while (head > 0 && continues_character(text[head])) --head;
  while (tail < text.size() && continues_character(text[tail])) ++tail;
  return on_one_line(text.substr(0, head)) + std::string(gap) + on_one_line(text.substr(tail));
}

std::string InputError::message() const {
  std::string text = quotable(file, longest_file_quoted);
  if (line > 0) text += fmt::format(":{}", line);
  if (line > 0 && column > 0) text += fmt::format(":{}", column);
  if (!text.empty()) text += ": ";
  if (!key.empty()) text += quotable(key, longest_quoted) + ": ";
  text += file_missing ? "file not found" : "found " + quotable(found, longest_quoted);
  if (!allowed.empty()) text += "; allowed: " + quotable(allowed, longest_allowed_quoted);
  if (!suggestion.empty()) text += "; did you mean " + quotable(suggestion, longest_quoted) + "?";
  return text;
}

std::string nearest_of(std::string_view word, const std::vector<std::string>& candidates) {
  if (word.size() > longest_word) return {};
  const std::string wanted = lower_case(word);
  std::string nearest;
  std::size_t fewest = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    if (candidate.size() > longest_word) continue;
    const std::size_t apart = letters_apart(wanted, lower_case(candidate));
    if (apart < fewest && apart < candidate.size()) {
      fewest = apart;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string quoted_list(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
    text += '"' + words[i] + '"';
  }
  return text;
}

}  // namespace launchsafe::scene
