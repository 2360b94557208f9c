#include "launchsafe/scene/acceptance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

namespace launchsafe::scene {
namespace {

constexpr std::ptrdiff_t fewest_letters = 8;

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

/// Characters that nobody sees: soft hyphen, zero-width and directional ones, byte-order marks (UTF-8).
bool has_invisible(const std::string& text) {
  for (const char* unseen : {"\xc2\xad", "\xe2\x80\x8b", "\xe2\x80\x8c", "\xe2\x80\x8d", "\xe2\x80\x8e",
                             "\xe2\x80\x8f", "\xe2\x80\xaa", "\xe2\x80\xab", "\xe2\x80\xac", "\xe2\x80\xad",
                             "\xe2\x80\xae", "\xe2\x81", "\xe3\x85\xa4", "\xef\xbb\xbf"}) {
    if (text.find(unseen) != std::string::npos) return true;
  }
  return false;
}

/// First bytes of letters of any language.
bool is_letter(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || byte >= 0xc0;
}

/// Whether a reason is one in words: several, of enough letters, not one letter again and again.
bool is_in_words(const std::string& text) {
  std::set<char> letters;
  std::ptrdiff_t count = 0;
  for (const char c : text) {
    if (!is_letter(c)) continue;
    ++count;
    letters.insert(c);
  }
  return count >= fewest_letters && letters.size() > 2 && text.find(' ') != std::string::npos;
}

std::optional<InputError> check(const Acceptance& acceptance, const std::map<std::string, Place>& places,
                                const std::vector<Acceptance>& earlier,
                                const std::vector<std::string>& known) {
  if (std::find(known.begin(), known.end(), acceptance.key) == known.end()) {
    InputError error = unknown_key(places.at("key"), acceptance.key, known);
    error.found = fmt::format("the unknown key \"{}\"", acceptance.key);
    error.key = "accept.key";
    return error;
  }
  if (!reason_for(earlier, acceptance.key).empty()) {
    return error_at(places.at("key"), "accept.key", fmt::format("\"{}\" a second time", acceptance.key),
                    "each key once");
  }
  return check_reason(acceptance.because, places.at("because"), "accept.because");
}

}  // namespace

std::optional<InputError> check_reason(const std::string& text, const Place& place, const std::string& key) {
  if (is_in_words(text) && !has_invisible(text) && std::none_of(text.begin(), text.end(), is_control))
    return std::nullopt;
  return error_at(
      place, key, fmt::format("a reason of {} characters", text.size()),
      fmt::format(
          "a reason in words, at least two and {} letters on one line: it is printed beside every verdict",
          fewest_letters));
}

const std::vector<Key<Acceptance>>& acceptance_keys() {
  static const std::vector<Key<Acceptance>> keys{
      required(text_key(
          "key", Standing::input,
          "Key, or quantity that follows from keys, whose value is meant though it is not plausible.",
          "load.peak", &Acceptance::key)),
      required(text_key("because", Standing::input, "Why, in words; printed beside every verdict.",
                        "proof shots are fired at this pressure", &Acceptance::because)),
  };
  return keys;
}

Expected<std::vector<Acceptance>> read_acceptances(const toml::table& root,
                                                   const std::vector<std::string>& known,
                                                   const std::string& file) {
  auto tables = read_tables(root, "accept", acceptance_keys(), file,
                            "tables, such as accept = [{ key = \"gap.exchange_time\", because = \"...\" }]");
  if (!tables) return tables.error();
  std::vector<Acceptance> accepted;
  for (auto& [acceptance, places] : *tables) {
    if (auto error = check(acceptance, places, accepted, known)) return *error;
    accepted.push_back(std::move(acceptance));
  }
  return accepted;
}

void accept(std::vector<Acceptance>& accepted, Acceptance acceptance) {
  std::erase_if(accepted, [&](const Acceptance& each) { return each.key == acceptance.key; });
  accepted.push_back(std::move(acceptance));
}

std::string reason_for(const std::vector<Acceptance>& accepted, const std::string& key) {
  const auto found =
      std::find_if(accepted.begin(), accepted.end(), [&](const Acceptance& each) { return each.key == key; });
  return found == accepted.end() ? std::string{} : found->because;
}

}  // namespace launchsafe::scene
