// Files of materials and contacts, those that ship, decompositions of explosives, and where values come from.
#include "input_text.hpp"
#include "scene_file.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <optional>
#include <set>

namespace launchsafe::scene {
namespace {

/// A fault of a shipped file is one of the program itself, which tests find.
template <class Value>
Value without_fault(Expected<Value> value) {
  if (value) return std::move(*value);
  fmt::print(stderr, "{}\n", value.error().message());
  std::abort();
}

struct BuiltInTable {
  std::string file;
  toml::table table;
};
const std::vector<BuiltInTable>& built_in_tables() {
  static const std::vector<BuiltInTable> tables = [] {
    std::vector<BuiltInTable> parsed;
    for (const BuiltInText& each : built_in_materials()) {
      const std::string file = "the shipped " + each.file;
      parsed.push_back({file, without_fault(parse_toml(each.text, file))});
    }
    return parsed;
  }();
  return tables;
}

/// What `read(table, file, those of the files before)` finds in all of them.
template <class Named, class Read>
std::vector<Named> read_built_in(Read&& read) {
  std::vector<Named> all;
  for (const auto& [file, table] : built_in_tables()) {
    const std::vector<Named> named = without_fault(read(table, file, all));
    all.insert(all.end(), named.begin(), named.end());
  }
  return all;
}

/// Those of the shipped ones that the file names.
template <class Named>
std::vector<Named> named_in(const toml::table& root, const char* what, const std::vector<Named>& shipped) {
  std::vector<Named> own;
  const toml::table* tables = root[what].as_table();
  for (const Named& each : shipped)
    if (tables != nullptr && tables->contains(each.name)) own.push_back(each);
  return own;
}

Key<Source> keys_of_source_key() {
  KeyDescription described =
      keys::description("keys", KeyKind::text, Standing::input, "Keys whose values have this source.");
  described.example = "density, specific_heat";
  return keys::bound_key<Source>(
      std::move(described), &Source::keys,
      [](auto& keys, const Value& value) {
        keys.clear();
        for (const std::string_view part : parts_of_list(std::get<std::string>(value)))
          if (!part.empty()) keys.emplace_back(part);
      },
      [](const auto& keys) { return fmt::format("{}", fmt::join(keys, ", ")); });
}

Fault check_source(const Source& source, const std::map<std::string, Place>& places,
                   const std::vector<std::string>& known, std::set<std::string>& cited) {
  if (source.keys.empty())
    return error_at(places.at("keys"), "source.keys", "no key", "names of keys, such as \"density\"");
  for (const std::string& key : source.keys) {
    if (std::ranges::find(known, key) == known.end()) {
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

/// All tables of that name but materials; `meaning` as of visit_tables, `known`: those of other files.
template <class Named>
Expected<std::vector<Named>> read_named(const toml::table& root, const std::string& what,
                                        std::string_view meaning, const std::vector<Key<Named>>& keys,
                                        const std::string& file, const std::vector<Named>& known) {
  std::vector<Named> all;
  const auto read = [&](const std::string& name, const toml::table& table) -> Fault {
    if (find_named(known, name) != nullptr)
      return error_at(place_of(table, file), what, fmt::format("a {} called \"{}\"", what, name),
                      fmt::format("a name that no other {} has", what));
    Named& named = all.emplace_back();
    named.name = name;
    const auto places = read_table(table, keys, {"source"}, file, named);
    if (!places) return within(what + "." + name, places.error());
    std::vector<std::string> given;
    for (const Key<Named>& key : keys)
      if (key.name != "title" && places->contains(key.name)) given.push_back(key.name);
    auto sources = read_sources(table, given, file);
    if (!sources) return within(what + "." + name, sources.error());
    named.sources = std::move(*sources);
    return std::nullopt;
  };
  if (auto error = visit_tables(root, what, meaning, file, read)) return *error;
  return all;
}

}  // namespace

Fault check_material_tables(const toml::table& root, const std::string& file) {
  if (auto read = read_described(root, {}, {"material", "contact"}, file); !read) return read.error();
  return std::nullopt;
}

const std::vector<NamedMaterial>& shipped_materials() {
  static const std::vector<NamedMaterial> all = read_built_in<NamedMaterial>(read_materials);
  return all;
}

const std::vector<NamedContact>& shipped_contacts() {
  static const std::vector<NamedContact> all = read_built_in<NamedContact>(read_contacts);
  return all;
}

const std::vector<Decomposition>& shipped_decompositions() {
  static const std::vector<Decomposition> all = read_built_in<Decomposition>(
      [](const toml::table& root, const std::string& file, const std::vector<Decomposition>& known) {
        return read_named(root, "decomposition", "that combustion.kinetics refers to", decomposition_keys(),
                          file, known);
      });
  return all;
}

Expected<NamedMaterials> read_material_file(const std::filesystem::path& file) {
  const auto text = read_text_file(file);
  if (!text) return text.error();
  const auto table = parse_toml(*text, file.string());
  if (!table) return table.error();
  if (auto error = check_content(*table, file.string(), InputContent::materials)) return *error;
  const auto& shipped = built_in_materials();
  if (std::ranges::find(shipped, *text, &BuiltInText::text) != shipped.end())
    return NamedMaterials{named_in(*table, "material", shipped_materials()),
                          named_in(*table, "contact", shipped_contacts()),
                          named_in(*table, "decomposition", shipped_decompositions())};
  if (auto error = check_material_tables(*table, file.string())) return *error;
  auto materials = read_materials(*table, file.string(), shipped_materials());
  if (!materials) return materials.error();
  auto contacts = read_contacts(*table, file.string(), shipped_contacts());
  if (!contacts) return contacts.error();
  return NamedMaterials{std::move(*materials), std::move(*contacts), {}};
}

const std::vector<Key<Decomposition>>& decomposition_keys() {
  using materials::KineticsParameters;
  static const std::vector<Key<Decomposition>> keys = keys::joined(
      {{text_key("title", Standing::input, "Of which explosive, for reports.", "RDX", &Decomposition::title) |
        required()},
       keys::keys_of_part(
           "", &Decomposition::kinetics,
           {number_key("activation_temperature", Dimension::temperature_difference, above_to(0, 1e6),
                       Standing::literature, "Activation energy over the gas constant, E/R.",
                       &KineticsParameters::activation_temperature) |
                required(),
            number_key("frequency", Dimension::frequency, above_to(0, 1e30), Standing::literature,
                       "Frequency factor Z.", &KineticsParameters::frequency) |
                required(),
            number_key("heat_of_reaction", Dimension::specific_energy, above_to(0, 1e8), Standing::literature,
                       "Heat Q.", &KineticsParameters::heat_of_reaction) |
                required()})});
  return keys;
}

Expected<std::vector<NamedContact>> read_contacts(const toml::table& root, const std::string& file,
                                                  const std::vector<NamedContact>& known) {
  return read_named(root, "contact", "that interfaces refer to", contact_keys(), file, known);
}

materials::KineticsParameters flame_kinetics(const Scene& scene) {
  materials::KineticsParameters kinetics = scene.charge().kinetics;
  const Decomposition* found = find_named(shipped_decompositions(), scene.combustion.kinetics);
  if (found == nullptr) return kinetics;
  kinetics.name = found->name;
  kinetics.activation_temperature = found->kinetics.activation_temperature;
  kinetics.frequency = found->kinetics.frequency;
  kinetics.heat_of_reaction = std::min(kinetics.heat_of_reaction, found->kinetics.heat_of_reaction);
  return kinetics;
}

const std::vector<Key<Source>>& source_keys() {
  using enum Standing;
  const auto for_people = always_plausible("it is for people");
  static const std::vector<Key<Source>> keys{
      keys_of_source_key() | required() | for_people,
      word_key("standing", literature,
               "What the values are: published, derived from such, assumed or calibrated.",
               {{"literature", literature},
                {"paper", paper},
                {"derived", derived},
                {"assumed", assumed},
                {"calibrated", calibrated}},
               &Source::standing) |
          for_people,
      text_key("citation", input, "Where the values come from, in words.",
               "Gibbs and Popolato, LASL Explosive Property Data, 1980", &Source::citation) |
          required() | for_people,
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
    if (std::ranges::find(source.keys, key) != source.keys.end()) return &source;
  return nullptr;
}

void forget_source(std::vector<Source>& sources, const std::string& key) {
  for (Source& source : sources) std::erase(source.keys, key);
  std::erase_if(sources, [](const Source& source) { return source.keys.empty(); });
}

}  // namespace launchsafe::scene
