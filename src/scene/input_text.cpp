// Text of input: whole files, the one place where they are read, and what they are of; and messages on what
// is wrong in them.
#include "scene_file.hpp"

#include <cerrno>
#include <fstream>
#include <set>
#include <system_error>

namespace launchsafe::scene {
namespace {

/// Edit distance that counts a swap of neighbours as one change (optimal string alignment).
std::size_t letters_apart(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) cost[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) cost[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, cost[i - 1][j - 1] + change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
    }
  }
  return cost[a.size()][b.size()];
}

/// Whether words surely mean different things, however near they are: those with other digits, as "G1" and
/// "G4", or with letters before the whole of the other, as "elastic" and "viscoelastic".
bool differ_in_meaning(std::string_view a, std::string_view b) {
  const auto digits = [](std::string word) {
    std::erase_if(word, [](char c) { return c < '0' || c > '9'; });
    return word;
  };
  return a != b && (a.ends_with(b) || b.ends_with(a) || digits(std::string(a)) != digits(std::string(b)));
}

/// What to suggest in the place of a file that does not exist, named by its path from a folder: such a path
/// to the nearest name there is beside it; empty for none.
std::string nearest_file(const std::filesystem::path& folder, const std::filesystem::path& name) {
  const std::string near = nearest_of(name.filename().string(), list_folder(folder / name.parent_path()));
  return near.empty() ? near : in_quotes((name.parent_path() / near).string());
}

}  // namespace

std::string_view without_blanks_around(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::vector<std::string_view> parts_of_list(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(without_blanks_around(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return parts;
}

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& letter : result) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return result;
}

std::string read_text_file(const std::filesystem::path& file, std::size_t largest) {
  const auto refuse = [&](const std::string& found, const std::string& allowed) {
    throw error_at({file.string()}, {}, found, allowed);
  };
  std::error_code failure;
  const std::filesystem::file_status status = std::filesystem::status(file, failure);
  if (status.type() == std::filesystem::file_type::not_found) {
    InputError missing = error_at({file.string()}, {}, {}, {}, nearest_file({}, file));
    missing.file_missing = true;
    throw missing;
  }
  // A pipe or a device may never end.
  if (!failure && !std::filesystem::is_regular_file(status))
    refuse(std::filesystem::is_directory(status) ? "a folder" : "a pipe or a device", "a regular file");
  const std::uintmax_t size = failure ? 0 : std::filesystem::file_size(file, failure);
  if (size > largest)
    refuse(fmt::format("a file of more than {} MiB", largest >> 20),
           fmt::format("a file of at most {} MiB", largest >> 20));
  std::string text(size, '\0');
  std::ifstream stream(file, std::ios::binary);
  if (failure || !stream.read(text.data(), static_cast<std::streamsize>(size)))
    refuse(fmt::format("a file that cannot be read ({})", std::generic_category().message(errno)),
           "a readable file");
  return text;
}

std::vector<std::string> list_folder(const std::filesystem::path& folder) {
  std::vector<std::string> found;
  std::error_code status;
  for (std::filesystem::directory_iterator entry(folder.empty() ? "." : folder, status), end;
       !status && entry != end; entry.increment(status))
    found.push_back(entry->path().filename());
  std::ranges::sort(found);
  return found;
}

std::filesystem::path named_file(const std::filesystem::path& folder, const std::string& name,
                                 const Place& place, std::string_view key, const std::string& wanted) {
  std::error_code failure;
  if (std::filesystem::exists(folder / name, failure)) return folder / name;
  throw error_at(place, key, fmt::format("\"{}\", which does not exist", name),
                 wanted + ", by its path from this file's folder", nearest_file(folder, name));
}

InputContent content_of(const toml::table& root) {
  if (root.contains("law")) return InputContent::material;
  if (root.contains("body")) return InputContent::scene;
  return root.contains("kind") || root.contains("scene") ? InputContent::study : InputContent::unknown;
}

void check_content(const toml::table& root, const std::string& file, InputContent wanted) {
  const InputContent content = content_of(root);
  if (content == wanted || content == InputContent::unknown) return;
  constexpr std::array found{"a scene, which launchsafe run computes",
                             "a study, which launchsafe study computes",
                             "a material, which bodies of a scene name"};
  throw error_at({file}, {}, found[static_cast<std::size_t>(content)],
                 wanted == InputContent::scene ? "a scene: a file with tables [[body]]"
                                               : "a study: a file with the keys kind and scene");
}

std::string quotable(std::string_view text, std::size_t longest) {
  constexpr std::string_view gap = " ...";
  const bool is_long = text.size() > longest;
  std::size_t kept = is_long ? longest - gap.size() : text.size();
  // No character of UTF-8 is cut in two.
  while (is_long && kept > 0 && (static_cast<unsigned char>(text[kept]) & 0xC0u) == 0x80u) --kept;
  std::string line;
  for (const char each : text.substr(0, kept)) {
    const auto byte = static_cast<unsigned char>(each);
    if (byte < 0x20 || byte == 0x7F)
      line += byte == '\n' ? "\\n" : fmt::format("\\x{:02x}", byte);
    else
      line += each;
  }
  return is_long ? line + std::string(gap) : line;
}

std::string InputError::message() const {
  std::string text = file;
  if (line > 0) text += fmt::format(":{}", line);
  if (line > 0 && column > 0) text += fmt::format(":{}", column);
  if (!text.empty()) text += ": ";
  if (!key.empty()) text += key + ": ";
  text += file_missing ? "file not found" : "found " + found;
  if (!allowed.empty()) text += "; allowed: " + allowed;
  if (!suggestion.empty()) text += "; did you mean " + suggestion + "?";
  return text;
}

std::string nearest_of(std::string_view word, const std::vector<std::string>& candidates) {
  constexpr std::size_t longest_word = 200;  // longer ones are near to none
  const std::string wanted = lower_case(word);
  std::set<std::string> nearest;
  std::size_t fewest = std::min<std::size_t>(2, word.size() / 3);
  for (const std::string& candidate : candidates) {
    const std::string other = lower_case(candidate);
    if (std::max(wanted.size(), other.size()) > longest_word || differ_in_meaning(wanted, other)) continue;
    const std::size_t apart = letters_apart(wanted, other);
    if (apart > fewest) continue;
    if (apart < fewest) nearest.clear();
    fewest = apart;
    nearest.insert(candidate);
  }
  return nearest.size() == 1 ? *nearest.begin() : std::string{};
}

std::string first_of(std::vector<std::string> names, std::size_t most) {
  const std::size_t more = names.size() - std::min(most, names.size());
  names.resize(names.size() - more);
  return fmt::format("{}{}", fmt::join(names, ", "), more > 0 ? fmt::format(" and {} more", more) : "");
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
