#include "scene_file.hpp"

#include <boost/algorithm/string/predicate.hpp>

#include <set>

namespace launchsafe::scene {
namespace {

constexpr std::size_t fewest_letters = 8;

/// Characters that nobody sees: soft hyphen, zero-width and directional ones, byte-order marks (UTF-8).
bool has_invisible(const std::string& text) {
  for (const char* unseen : {"\xc2\xad", "\xe2\x80\x8b", "\xe2\x80\x8c", "\xe2\x80\x8d", "\xe2\x80\x8e",
                             "\xe2\x80\x8f", "\xe2\x80\xaa", "\xe2\x80\xab", "\xe2\x80\xac", "\xe2\x80\xad",
                             "\xe2\x80\xae", "\xe2\x81", "\xe3\x85\xa4", "\xef\xbb\xbf"})
    if (text.find(unseen) != std::string::npos) return true;
  return false;
}

/// First bytes of letters of any language.
bool is_letter(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || byte >= 0xc0;
}

/// Whether a reason is one in words: several, of enough letters, not one letter again and again, and no mark
/// of one that is still to be written.
bool is_in_words(const std::string& text) {
  for (const char* unwritten : {"todo", "tbd", "fixme", "fill in", "reason here"})
    if (boost::algorithm::icontains(text, unwritten)) return false;
  std::string letters;
  std::ranges::copy_if(text, std::back_inserter(letters), is_letter);
  const std::set<char> different(letters.begin(), letters.end());
  return letters.size() >= fewest_letters && different.size() > 2 && contains(text, ' ');
}

/// The range of numbers that a text accepts; nothing where it is none.
std::optional<std::vector<double>> accepted_range(const KeyDescription& key, const std::string& text) {
  if (key.kind != KeyKind::number || text.find(" to ") == std::string::npos) return std::nullopt;
  auto range = parse_range(text, key.dimension);
  return range ? std::optional(std::move(*range)) : std::nullopt;
}

bool accepts(const Acceptance& acceptance, const KeyDescription& key, const Value& value) {
  if (acceptance.value == format_value(key, value)) return true;
  if (const auto range = accepted_range(key, acceptance.value))
    return (*range)[0] <= std::get<double>(value) && std::get<double>(value) <= (*range)[1];
  const auto meant = parse_value(acceptance.value, key, {});
  constexpr double digits = 1e-5;  // in which people read numbers
  return meant && same_value(*meant, value, digits);
}

/// { key = "K", value = "V", because = "..." }, ready to copy.
std::string entry_to_write(const std::string& key, const std::string& value) {
  const bool plain = value.find_first_of("\"\\\n") == std::string::npos;
  return fmt::format("{{ key = \"{}\", value = {}, because = \"...\" }}", key,
                     plain ? '"' + value + '"' : exact_toml({.kind = KeyKind::text}, value));
}

/// The value under another prefix of its unit, where that makes it plausible: "496 MPa" of 496 kPa. What
/// follows from keys is written nowhere.
std::string under_another_prefix(const KeyDescription& key, const Value& value) {
  const auto* number = std::get_if<double>(&value);
  if (!number || key.standing == Standing::derived || units_of(key.dimension).empty()) return {};
  for (const double factor : {1.0, 1e3, 1e-3, 1e6, 1e-6})
    if (is_plausible(key, factor * *number)) return factor == 1.0 ? "" : format_value(key, factor * *number);
  return {};
}

void check_value(const Acceptance& acceptance, const KeyDescription& key,
                 const std::map<std::string, Place>& places) {
  constexpr double widest = 2.0;
  if (acceptance.value.empty())
    throw error_at(places.at("key"), "accept.value", "nothing",
                   fmt::format("the value that is accepted, such as {}: of another one nothing is said",
                               entry_to_write(acceptance.key, "...")));
  const Place& place = places.at("value");
  if (acceptance.value.starts_with("inf")) return;  // as people read what has no bound
  if (const auto range = accepted_range(key, acceptance.value)) {
    if ((*range)[0] > 0.0 && (*range)[1] <= widest * (*range)[0]) return;
    throw error_at(place, "accept.value", '"' + acceptance.value + '"',
                   fmt::format("a value, or a range up to a factor of {:g}", widest));
  }
  KeyDescription of_acceptance = key;
  of_acceptance.name = "accept.value";
  parse_value(acceptance.value, of_acceptance, place).or_throw();
}

bool are_same(const Acceptance& one, const Acceptance& other) {
  return one.key == other.key && one.value == other.value;
}

void check(const Acceptance& acceptance, const std::map<std::string, Place>& places,
           const std::vector<Acceptance>& earlier, const std::vector<KeyDescription>& known) {
  const std::string& name = acceptance.key;
  const auto fault_of_key = [&](std::string found, std::string allowed, std::string suggestion = {}) {
    return error_at(places.at("key"), "accept.key", found, allowed, suggestion);
  };
  if (name == "calibration")
    throw fault_of_key("\"calibration\", for all that is foreign to it at once",
                       fmt::format("an entry for each property, with the value that is accepted, such as "
                                   "accept = [{}]; launchsafe explain prints them ready to copy",
                                   entry_to_write(foreign_shell, "...")));
  const KeyDescription* key = find_named(known, name);
  if (key == nullptr) {
    const InputError unknown = unknown_key(places.at("key"), name, names_of(known));
    throw fault_of_key(fmt::format("the unknown key \"{}\"", name), unknown.allowed, unknown.suggestion);
  }
  if (std::ranges::any_of(earlier, [&](const auto& each) { return are_same(each, acceptance); }))
    throw fault_of_key(fmt::format("\"{}\" a second time", name), "each key once, or with several values");
  check_value(acceptance, *key, places);
  check_reason(acceptance.because, places.at("because"), "accept.because");
}

}  // namespace

bool same_value(const Value& a, const Value& b, double tolerance) {
  if (a.index() != b.index()) return false;
  const auto is_same = [tolerance](double one, double other) {
    return one == other || std::abs(one - other) <= tolerance * std::max(std::abs(one), std::abs(other));
  };
  if (const auto* number = std::get_if<double>(&a)) return is_same(*number, std::get<double>(b));
  const auto* numbers = std::get_if<std::vector<double>>(&a);
  return numbers == nullptr ? a == b
                            : std::ranges::equal(*numbers, std::get<std::vector<double>>(b), is_same);
}

Implausible implausible(const std::vector<Acceptance>& accepted, const KeyDescription& key, std::string name,
                        const Value& value, std::string range) {
  Implausible found{std::move(name),
                    format_value(key, value),
                    std::move(range),
                    {},
                    {},
                    under_another_prefix(key, value),
                    {}};
  for (const Acceptance& each : accepted) {
    if (each.key != found.key || found.accepted()) continue;
    found.accepted_value = each.value;
    if (accepts(each, key, value)) found.because = each.because;
  }
  return found;
}

std::string value_text(const Implausible& value) {
  const bool other = !value.accepted() && !value.accepted_value.empty();
  return fmt::format("{} = {}{}", value.key, value.value,
                     other ? fmt::format(" (accepted is {})", value.accepted_value) : "");
}

std::string accepted_text(const std::vector<Implausible>& values) {
  std::vector<std::string> texts;
  for (const Implausible& each : values)
    if (each.accepted()) texts.push_back(fmt::format("{}, because {}", value_text(each), each.because));
  return texts.empty() ? "" : fmt::format("accepted: {}", fmt::join(texts, "; "));
}

std::string acceptances_to_write(const std::vector<Implausible>& values) {
  std::string text;
  for (const Implausible& each : values)
    if (!each.accepted()) text += fmt::format("  {},\n", entry_to_write(each.key, each.value));
  return text.empty() ? text : "accept = [\n" + text + "]";
}

void check_reason(const std::string& text, const Place& place, const std::string& key) {
  const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  if (is_in_words(text) && !has_invisible(text) && std::ranges::none_of(text, is_control)) return;
  throw error_at(
      place, key, fmt::format("\"{}\"", text),
      fmt::format(
          "a reason in words, at least two and {} letters on one line, none to be written later: it is "
          "printed beside every verdict",
          fewest_letters));
}

const std::vector<Key<Acceptance>>& acceptance_keys() {
  static const std::vector<Key<Acceptance>> keys{
      text_key(
          "key", Standing::input,
          "Key, or quantity that follows from keys, whose value is meant though it is not plausible or not "
          "the calibrated one.",
          "load.peak", &Acceptance::key) |
          required(),
      text_key(
          "value", Standing::input,
          "The value that is meant, as it is written or printed, or a range of numbers up to a factor of 2; "
          "of another value nothing is accepted.",
          "620 MPa", &Acceptance::value),
      text_key("because", Standing::input, "Why, in words; printed beside every verdict.",
               "proof shots are fired at this pressure", &Acceptance::because) |
          required(),
  };
  return keys;
}

Expected<std::vector<Acceptance>> read_acceptances(const toml::table& root,
                                                   const std::vector<KeyDescription>& known,
                                                   const std::string& file) {
  const std::string allowed =
      "tables, such as accept = [" + entry_to_write("gap.exchange_time", "1 ms") + "]";
  return caught([&] {
    std::vector<Acceptance> accepted;
    for (auto& [acceptance, places] :
         read_tables(root, "accept", acceptance_keys(), file, allowed).or_throw()) {
      check(acceptance, places, accepted, known);
      accepted.push_back(std::move(acceptance));
    }
    return accepted;
  });
}

void accept(std::vector<Acceptance>& accepted, Acceptance acceptance) {
  std::erase_if(accepted, [&](const Acceptance& each) { return are_same(each, acceptance); });
  accepted.push_back(std::move(acceptance));
}

}  // namespace launchsafe::scene
