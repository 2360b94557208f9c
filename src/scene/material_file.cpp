// Files of materials and contacts, those that ship, decompositions of explosives, and where values come from.
#include "scene_file.hpp"

#include <cstdio>
#include <cstdlib>
#include <set>

namespace launchsafe::scene {
namespace {

/// What `read(table, file, those of the files before)` finds in all shipped files. A fault of one is one of
/// the program itself, which tests find.
template <class Named, class Read>
std::vector<Named> read_built_in(Read&& read) try {
  std::vector<Named> all;
  for (const BuiltInText& each : built_in_materials()) {
    const std::string file = "the shipped " + each.file;
    const std::vector<Named> named = read(parse_toml(each.text, file).or_throw(), file, all);
    all.insert(all.end(), named.begin(), named.end());
  }
  return all;
} catch (const InputError& error) {
  fmt::print(stderr, "{}\n", error.message());
  std::abort();
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

void check_source(const Source& source, const std::map<std::string, Place>& places,
                  const std::vector<std::string>& known, std::set<std::string>& cited) {
  const auto fault_of_keys = [&](std::string found, std::string allowed, std::string suggestion = {}) {
    return error_at(places.at("keys"), "source.keys", found, allowed, suggestion);
  };
  if (source.keys.empty()) throw fault_of_keys("no key", "names of keys, such as \"density\"");
  for (const std::string& key : source.keys) {
    if (!contains(known, key)) {
      const InputError unknown = unknown_key(places.at("keys"), key, known);
      throw fault_of_keys(fmt::format("\"{}\", which no key with a value here is called", key),
                          unknown.allowed, unknown.suggestion);
    }
    if (!cited.insert(key).second)
      throw fault_of_keys(fmt::format("\"{}\" a second time", key), "one source of each key");
  }
  if (source.citation.find_first_not_of(" \t\n") == std::string::npos)
    throw error_at(places.at("citation"), "source.citation", "no words",
                   "where the values come from, in words");
}

/// All tables of that name but materials; `meaning` as of visit_tables, `known`: those of other files.
template <class Named>
std::vector<Named> read_named(const toml::table& root, const std::string& what, std::string_view meaning,
                              const std::vector<Key<Named>>& keys, const std::string& file,
                              const std::vector<Named>& known) {
  std::vector<Named> all;
  visit_tables(root, what, meaning, file, [&](const std::string& name, const toml::table& table) {
    if (find_named(known, name) != nullptr)
      throw error_at(place_of(table, file), what, fmt::format("a {} called \"{}\"", what, name),
                     fmt::format("a name that no other {} has", what));
    Named& named = all.emplace_back();
    named.name = name;
    within(what + "." + name, [&] {
      const auto places = read_table(table, keys, {"source"}, file, named).or_throw();
      std::vector<std::string> given = names_of(keys);
      std::erase_if(given, [&](const auto& key) { return key == "title" || !places.contains(key); });
      named.sources = read_sources(table, given, file);
    });
  });
  return all;
}

}  // namespace

void check_material_tables(const toml::table& root, const std::string& file) {
  read_described(root, {}, {"material", "contact"}, file).or_throw();
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

const std::vector<Key<Decomposition>>& decomposition_keys() {
  using materials::KineticsParameters;
  using enum Standing;
  using enum Dimension;
  static const std::vector<Key<Decomposition>> keys = keys::joined(
      {{text_key("title", input, "Of which explosive, in words.", "RDX", &Decomposition::title) | required()},
       keys::keys_of_part("", &Decomposition::kinetics,
                          {number_key("activation_temperature", temperature_difference, above_to(0, 1e6),
                                      literature, "Activation energy over the gas constant, E/R.",
                                      &KineticsParameters::activation_temperature) |
                               required(),
                           number_key("frequency", frequency, above_to(0, 1e30), literature,
                                      "Frequency factor Z.", &KineticsParameters::frequency) |
                               required(),
                           number_key("heat_of_reaction", specific_energy, above_to(0, 1e8), literature,
                                      "Heat Q.", &KineticsParameters::heat_of_reaction) |
                               required()})});
  return keys;
}

std::vector<NamedContact> read_contacts(const toml::table& root, const std::string& file,
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

std::vector<Source> read_sources(const toml::table& table, const std::vector<std::string>& known,
                                 const std::string& file) {
  const char* allowed = "tables, such as source = [{ keys = \"density\", citation = \"...\" }]";
  std::vector<Source> sources;
  std::set<std::string> cited;
  for (auto& [source, places] : read_tables(table, "source", source_keys(), file, allowed).or_throw()) {
    check_source(source, places, known, cited);
    sources.push_back(std::move(source));
  }
  return sources;
}

const Source* source_of(const std::vector<Source>& sources, const std::string& key) {
  for (const Source& source : sources)
    if (contains(source.keys, key)) return &source;
  return nullptr;
}

void forget_source(std::vector<Source>& sources, const std::string& key) {
  for (Source& source : sources) std::erase(source.keys, key);
  std::erase_if(sources, [](const Source& source) { return source.keys.empty(); });
}

}  // namespace launchsafe::scene
