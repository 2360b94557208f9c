#include "explain.hpp"

#include <regex>

namespace launchsafe::app {
namespace {

using scene::KeyDescription, scene::KeyKind, scene::Dimension;

/// A decimal number as scenes are written.
constexpr const char* number_pattern = R"([+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?)";

/// "(cm|mm|m)": any of these words.
std::string any_of(std::vector<std::string> words) {
  static const std::regex special(R"([\^$.()/*+?|\[\]{}\\])");
  for (std::string& word : words) word = std::regex_replace(word, special, R"(\$&)");
  return fmt::format("({})", fmt::join(words, "|"));
}

/// A number of several, which may leave the unit to the last one, and the last.
std::pair<std::string, std::string> number_patterns(Dimension dimension) {
  const std::string number = fmt::format("{}\\s*", number_pattern);
  const std::vector<std::string> units = scene::units_of(dimension);
  if (units.empty()) return {number_pattern, number};
  return {number + any_of(units) + "?", number + any_of(units)};
}

Json text_of_pattern(const std::string& pattern) {
  return {{"type", "string"}, {"pattern", fmt::format("^\\s*{}\\s*$", pattern)}};
}

Json number_schema(const KeyDescription& key) {
  if (!scene::units_of(key.dimension).empty()) return text_of_pattern(number_patterns(key.dimension).second);
  Json schema{{"type", key.dimension == Dimension::count ? "integer" : "number"}};
  if (std::isfinite(key.limits.lowest)) {
    schema["minimum"] = key.limits.lowest;
    if (!key.limits.lowest_allowed) schema["exclusiveMinimum"] = true;
  }
  if (std::isfinite(key.limits.highest)) {
    schema["maximum"] = key.limits.highest;
    if (!key.limits.highest_allowed) schema["exclusiveMaximum"] = true;
  }
  return schema;
}

/// "0, 1.5, 2 cm", or an array of numbers each with its unit.
Json list_schema(const KeyDescription& key) {
  Json array{{"type", "array"}, {"items", number_schema(key)}};
  if (!key.may_be_empty) array["minItems"] = 1;
  if (key.list_length > 0) array["minItems"] = array["maxItems"] = key.list_length;
  const auto [first, last] = number_patterns(key.dimension);
  return {{"anyOf", Json::array({text_of_pattern(fmt::format("({}\\s*,\\s*)*{}", first, last)), array})}};
}

Json word_schema(const KeyDescription& key) {
  Json words = key.words;
  for (const keys::FormerWord& each : key.former_words) words.push_back(each.former);
  return {{"type", "string"}, {"enum", words}};
}

Json type_of(const KeyDescription& key) {
  switch (key.kind) {
    case KeyKind::number:
      return number_schema(key);
    case KeyKind::flag:
      return {{"type", "boolean"}};
    case KeyKind::word:
      return word_schema(key);
    case KeyKind::words:
      // "a, b", each one of the words.
      return text_of_pattern(fmt::format("({0}(\\s*,\\s*{0})*)?", any_of(key.words)));
    case KeyKind::text:
      return {{"type", "string"}};
    case KeyKind::list:
      return list_schema(key);
    case KeyKind::range:
      const auto [first, last] = number_patterns(key.dimension);
      return text_of_pattern(fmt::format("{}\\s*to\\s*{}", first, last));
  }
  return {};
}

Json schema_of(const scene::DocumentedKey& documented) {
  const KeyDescription& key = documented.description;
  const bool has_default = !key.required && !documented.default_text.empty();
  Json schema = type_of(key);
  schema["description"] =
      fmt::format("{}\n\nAllowed: {}.{}", key.sentence, scene::allowed_text(key),
                  has_default ? fmt::format("\nDefault: {}.", documented.default_text) : "");
  const std::string_view unit = scene::si_unit_of(key.dimension);
  schema["unit"] = unit.empty() ? "none" : unit;
  schema["range"] = scene::allowed_text(key);
  schema["example"] = scene::example_of(key);
  return schema;
}

Json table_schema() {
  return {{"type", "object"}, {"properties", Json::object()}, {"additionalProperties", false}};
}

/// Puts a key "a.b" under the table a, which is made where it is missing.
void put(Json& table, const std::string& name, const scene::DocumentedKey& key, bool may_require) {
  const auto dot = name.find('.');
  if (dot != std::string::npos) {
    Json& part = table["properties"][name.substr(0, dot)];
    if (part.is_null()) part = table_schema();
    return put(part, name.substr(dot + 1), key, may_require);
  }
  table["properties"][name] = schema_of(key);
  if (may_require && key.description.required) table["required"].push_back(name);
}

/// The keys that are in none of these tables.
Json schema_without(const std::set<std::string>& tables, const std::vector<scene::DocumentedKey>& keys,
                    bool may_require) {
  Json schema = table_schema();
  for (const scene::DocumentedKey& key : keys)
    if (const std::string& name = key.description.name; !tables.contains(name.substr(0, name.find('.'))))
      put(schema, name, key, may_require);
  return schema;
}

/// The keys of one table, without its name before them.
Json schema_of_table(const std::string& table, const std::vector<scene::DocumentedKey>& keys,
                     bool may_require = true) {
  Json schema = table_schema();
  for (const scene::DocumentedKey& key : keys)
    if (const std::string& name = key.description.name; name.starts_with(table + "."))
      put(schema, name.substr(table.size() + 1), key, may_require);
  return schema;
}

Json array_of(Json table) { return {{"type", "array"}, {"items", std::move(table)}}; }
/// Tables each under a name of the user's.
Json named(Json table) { return {{"type", "object"}, {"additionalProperties", std::move(table)}}; }

const std::set<std::string> scene_tables{"body",     "interface", "observation_point", "accept", "source",
                                         "material", "contact"};

/// A table that says where its values come from.
Json with_sources(const std::string& table, const std::vector<scene::DocumentedKey>& keys, bool may_require) {
  Json schema = schema_of_table(table, keys, may_require);
  schema["properties"]["source"] = array_of(schema_of_table(table + ".source", keys));
  return schema;
}

/// A law's numbers by the names that materials have for them.
Json schema_of_law(const std::string& law, const std::vector<scene::DocumentedKey>& keys, bool may_require) {
  Json schema = with_sources("material.NAME", keys, may_require);
  schema["properties"]["law"]["enum"] = Json::array({law});
  for (const scene::DocumentedKey& key : keys) {
    const std::string& name = key.description.name;
    const bool kinetics = law == "charge" && name.starts_with("kinetics.");
    if ((kinetics || name.starts_with(law + ".")) && name != law + ".title")
      put(schema, scene::key_in_material(law, name), key, false);
  }
  return schema;
}

/// Which numbers a material has, its law says.
Json material_schema(const std::vector<scene::DocumentedKey>& keys, bool may_require) {
  Json laws = Json::array();
  for (const scene::Material& material : scene::usual_materials())
    laws.push_back(schema_of_law(material.name, keys, may_require));
  return named({{"anyOf", laws}});
}

/// All that one value of a scene is changed by: the keys of the scene, of its bodies and of its interfaces.
Json changes_schema() {
  const std::vector<scene::DocumentedKey> keys = scene::describe_keys();
  Json schema = schema_without(scene_tables, keys, false);
  schema["properties"]["body"] = named(schema_of_table("body", keys, false));
  schema["properties"]["interface"] = named(schema_of_table("interface.NAME", keys, false));
  schema["properties"]["material"] = material_schema(keys, false);
  return schema;
}

Json with_head(Json schema, const char* title) {
  Json whole{{"$schema", "http://json-schema.org/draft-04/schema#"}, {"title", title}};
  whole.update(schema);
  return whole;
}

/// Numbers of what varies are in a unit of its key, which a schema cannot follow.
void free_of_unit(Json& entry) {
  for (const char* name : {"values", "range", "mean", "deviation"})
    for (const char* rule : {"type", "pattern", "minimum", "exclusiveMinimum", "anyOf", "items"})
      entry["properties"][name].erase(rule);
}

/// What stands in a table of a study besides its documented keys.
Json with_other_tables(Json entry, const std::string& table, const Json& changes) {
  Json& properties = entry["properties"];
  if (table == "vary") {
    free_of_unit(entry);
    entry.erase("required");
    for (const Json& form : {Json{"key", "values"}, Json{"key", "range", "count"},
                             Json{"key", "distribution"}, Json{"calibration"}, Json{"variants"}})
      entry["anyOf"].push_back({{"required", form}});
    Json variant = with_other_tables(std::move(properties["variants"]), "variant", changes);
    properties["variants"] = array_of(std::move(variant));
  }
  if (table == "group") {
    // Some cases are of values that are refused.
    for (const char* changed : {"set", "against"}) properties[changed] = {{"type", "object"}};
    const Json one = entry;
    properties["cases"] = array_of(one);
  }
  if (table == "variant") {
    properties["set"] = changes;
    properties["accept"] = array_of(schema_of_table("accept", scene::describe_keys()));
  }
  // Values of any scene key, under names that the schema of a scene explains.
  if (table == "settings" || table == "variant") entry["additionalProperties"] = true;
  return entry;
}

}  // namespace

Json scene_schema() {
  const std::vector<scene::DocumentedKey> keys = scene::describe_keys();
  Json schema = schema_without(scene_tables, keys, true);
  for (const char* table : {"body", "observation_point", "accept", "source"})
    schema["properties"][table] = array_of(schema_of_table(table, keys));
  Json faces = schema_of_table("interface.NAME", keys, false);
  for (const char* needed : {"condition", "contact"})
    faces["anyOf"].push_back({{"required", Json::array({needed})}});
  schema["properties"]["interface"] = named(std::move(faces));
  schema["properties"]["contact"] = named(with_sources("contact.NAME", keys, true));
  schema["properties"]["material"] = material_schema(keys, true);
  return with_head(std::move(schema), "Scene of launchsafe");
}

Json study_schema() {
  const std::vector<scene::DocumentedKey> keys = kinds::describe_study_keys();
  std::set<std::string> tables{"accept", "settings"};
  for (const kinds::Kind& kind : kinds::kinds())
    for (const kinds::StudyTable& table : kind.tables) tables.insert(table.name);
  Json schema = schema_without(tables, keys, true);
  const Json changes = changes_schema();
  for (const std::string& table : tables) {
    Json entry = with_other_tables(schema_of_table(table, keys), table, changes);
    schema["properties"][table] = array_of(std::move(entry));
  }
  schema["properties"]["set"] = changes;
  return with_head(std::move(schema), "Study of launchsafe");
}

Json references_schema() {
  Json schema = table_schema();
  schema["properties"]["reference"] = array_of(schema_of_table("reference", kinds::describe_study_keys()));
  return with_head(std::move(schema), "Published rows for studies of launchsafe");
}

}  // namespace launchsafe::app
