// Where values come from: [[source]] in scenes and materials.
#include "launchsafe/scene/named_material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

namespace launchsafe::scene {
namespace {

/// "a, b" as its parts.
std::vector<std::string> parts_of_list(const std::string& text) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::size_t first = text.find_first_not_of(" \t", begin);
    if (first < end) {
      const std::size_t last = text.find_last_not_of(" \t", end - 1);
      parts.push_back(text.substr(first, last - first + 1));
    }
    begin = end + 1;
  }
  return parts;
}

Key<Source> keys_of_source_key() {
  KeyDescription described =
      keys::description("keys", KeyKind::text, Standing::input, "Keys whose values have this source.");
  described.example = "density, specific_heat";
  return keys::bound_key<Source>(
      std::move(described), &Source::keys,
      [](auto& keys, const Value& value) { keys = parts_of_list(std::get<std::string>(value)); },
      [](const auto& keys) { return fmt::format("{}", fmt::join(keys, ", ")); });
}

std::optional<InputError> check_source(const Source& source, const std::map<std::string, Place>& places,
                                       const std::vector<std::string>& known, std::set<std::string>& cited) {
  if (source.keys.empty())
    return error_at(places.at("keys"), "source.keys", "no key", "names of keys, such as \"density\"");
  for (const std::string& key : source.keys) {
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      InputError error = unknown_key(places.at("keys"), key, known);
      error.found = fmt::format("\"{}\", which no key with a value here is called", key);
      error.key = "source.keys";
      return error;
    }
    if (!cited.insert(key).second)
      return error_at(places.at("keys"), "source.keys", fmt::format("\"{}\" a second time", key),
                      "one source of each key");
  }
  if (source.citation.find_first_not_of(" \t\n") == std::string::npos)
    return error_at(places.at("citation"), "source.citation", "no words",
                    "where the values come from, in words");
  return std::nullopt;
}

}  // namespace

const std::vector<Key<Source>>& source_keys() {
  using enum Standing;
  const auto for_people = [](Key<Source> key) {
    return always_plausible(std::move(key), "it is for people");
  };
  static const std::vector<Key<Source>> keys{
      for_people(required(keys_of_source_key())),
      for_people(word_key("standing", literature,
                          "What the values are: published, derived from such, assumed or calibrated.",
                          {{"literature", literature},
                           {"paper", paper},
                           {"derived", derived},
                           {"assumed", assumed},
                           {"calibrated", calibrated}},
                          &Source::standing)),
      for_people(
          required(text_key("citation", input, "Where the values come from, in words.",
                            "Gibbs and Popolato, LASL Explosive Property Data, 1980", &Source::citation))),
  };
  return keys;
}

Expected<std::vector<Source>> read_sources(const toml::table& table, const std::vector<std::string>& known,
                                           const std::string& file) {
  auto tables = read_tables(table, "source", source_keys(), file,
                            "tables, such as source = [{ keys = \"density\", citation = \"...\" }]");
  if (!tables) return tables.error();
  std::vector<Source> sources;
  std::set<std::string> cited;
  for (auto& [source, places] : *tables) {
    if (auto error = check_source(source, places, known, cited)) return *error;
    sources.push_back(std::move(source));
  }
  return sources;
}

const Source* source_of(const std::vector<Source>& sources, const std::string& key) {
  for (const Source& source : sources)
    if (std::find(source.keys.begin(), source.keys.end(), key) != source.keys.end()) return &source;
  return nullptr;
}

void forget_source(std::vector<Source>& sources, const std::string& key) {
  for (Source& source : sources) std::erase(source.keys, key);
  std::erase_if(sources, [](const Source& source) { return source.keys.empty(); });
}

}  // namespace launchsafe::scene
