// What launchsafe explains of itself: the keys of its files, and what editors take.
#include "explain_program.hpp"

#include "key_schema.hpp"
#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/kinds/read_study.hpp"
#include "launchsafe/scene/plausibility.hpp"
#include "launchsafe/scene/scene_keys.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace launchsafe::app {

namespace {

std::string default_of(const scene::DocumentedKey& key) {
  if (key.description.required) return "must be given";
  if (key.default_text.empty()) return "default: none";
  return fmt::format("default: {}  [{}]", key.default_text, scene::letter_of(key.description.standing));
}

std::string standings() {
  using enum scene::Standing;
  std::string text;
  for (const scene::Standing standing : {paper, literature, derived, assumed, calibrated}) {
    text += fmt::format("{}[{}] {}", text.empty() ? "" : ", ", scene::letter_of(standing),
                        scene::meaning_of(standing));
  }
  return text;
}

/// Empty where nothing is said.
std::string plausible_line(const scene::KeyDescription& key) {
  if (key.plausible.because.empty()) return {};
  return fmt::format("    plausible: {}\n", scene::plausible_text(key));
}

std::string derived_text() {
  std::string text =
      "Quantities that follow from the keys of a scene; what is not plausible of one gives "
      "validity warnings too.\n";
  for (const scene::DerivedQuantity& each : scene::derived_quantities()) {
    text += fmt::format("\n{}\n    {}\n{}", each.description.name, each.description.sentence,
                        plausible_line(each.description));
  }
  return text;
}

nlohmann::ordered_json derived_json() {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const scene::DerivedQuantity& each : scene::derived_quantities()) {
    list.push_back({{"quantity", each.description.name},
                    {"si_unit", scene::si_unit_of(each.description.dimension)},
                    {"plausible", scene::plausible_text(each.description)},
                    {"sentence", each.description.sentence}});
  }
  return list;
}

std::string documented(const std::vector<scene::DocumentedKey>& keys) {
  std::string text;
  for (const scene::DocumentedKey& key : keys) {
    text +=
        fmt::format("\n{}\n    {}\n    {}\n{}    {}\n", key.description.name, key.description.sentence,
                    scene::allowed_text(key.description), plausible_line(key.description), default_of(key));
  }
  return text;
}

nlohmann::ordered_json json_of(const std::vector<scene::DocumentedKey>& keys) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const scene::DocumentedKey& key : keys) {
    list.push_back({{"key", key.description.name},
                    {"si_unit", scene::si_unit_of(key.description.dimension)},
                    {"allowed", scene::allowed_text(key.description)},
                    {"plausible", scene::plausible_text(key.description)},
                    {"default", key.default_text},
                    {"required", key.description.required},
                    {"standing", scene::letter_of(key.description.standing)},
                    {"sentence", key.description.sentence}});
  }
  return list;
}

/// The keys whose name begins with a word; all for an empty one.
std::vector<scene::DocumentedKey> beginning_with(const std::string& word,
                                                 std::vector<scene::DocumentedKey> keys) {
  std::erase_if(keys, [&](const auto& key) { return !key.description.name.starts_with(word); });
  return keys;
}

/// Every key of a scene file and of a study file, from the same descriptions that read them.
std::string keys_text() {
  return fmt::format(
             "Keys of a scene file; a key a.b is written b under [a]. Standing of a default: {}.\n{}\n\n",
             standings(), documented(scene::describe_keys())) +
         derived_text() +
         "\n\nStudy files\n\nA study file also has [set], a table of scene keys with other values.\n" +
         documented(kinds::describe_study_keys());
}

/// Those whose name begins with a word.
std::string keys_text(const std::string& word) {
  const std::string of_scene = documented(beginning_with(word, scene::describe_keys()));
  const std::string of_study = documented(beginning_with(word, kinds::describe_study_keys()));
  return (of_scene.empty() ? "" : "Scene files\n" + of_scene) +
         (of_study.empty() ? "" : (of_scene.empty() ? "" : "\n") + std::string("Study files\n") + of_study);
}

nlohmann::ordered_json keys_json(const std::string& word) {
  nlohmann::ordered_json object{{"keys", json_of(beginning_with(word, scene::describe_keys()))}};
  if (word.empty()) object["derived_quantities"] = derived_json();
  object["study_keys"] = json_of(beginning_with(word, kinds::describe_study_keys()));
  return object;
}

ExitCode explain_keys(const std::string& word, Console& console) {
  const std::string text = word.empty() ? keys_text() : keys_text(word);
  if (text.empty())
    return console.refuse(
        fmt::format("explain --keys: found \"{}\", with which no key begins; allowed: the beginning of a "
                    "name, such as load",
                    word));
  console.print_text(text);
  console.print_json(keys_json(word));
  return ExitCode::done;
}

/// The columns of a table whose key begins with a word.
std::vector<report::Column> beginning_with(const std::string& word, std::vector<report::Column> columns) {
  std::erase_if(columns, [&](const report::Column& column) { return !column.key().starts_with(word); });
  return columns;
}

/// Every column of the tables of all kinds, from the same descriptions that write them.
ExitCode explain_results(const std::string& word, Console& console) {
  std::string text;
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const kinds::Kind& kind : kinds::kinds()) {
    for (const kinds::ResultTable& table : kind.results()) {
      const std::vector<report::Column> columns = beginning_with(word, table.columns);
      if (columns.empty()) continue;
      text += fmt::format("{}{}, `{}` of study.json{}\n", text.empty() ? "" : "\n", kind.traits.name,
                          table.member, table.csv.empty() ? "" : ", " + table.csv);
      nlohmann::ordered_json described = nlohmann::ordered_json::array();
      for (const report::Column& column : columns) {
        text += fmt::format("  {}\n      {}\n", column.key(), column.meaning);
        described.push_back({{"key", column.key()},
                             {"name", column.heading},
                             {"unit", column.form.unit},
                             {"meaning", column.meaning}});
      }
      list.push_back({{"kind", kind.traits.name},
                      {"member", table.member},
                      {"csv", table.csv},
                      {"columns", std::move(described)}});
    }
  }
  if (text.empty())
    return console.refuse(fmt::format(
        "explain --results: found \"{}\", with which no column begins; allowed: the beginning of a name, "
        "such as critical_gap",
        word));
  console.print_text(text + (word.empty()
                                 ? "\nTables also begin with the axes that their study varies, and some "
                                   "have columns for every gap, mesh or pressure of their study.\n"
                                 : ""));
  console.print_json({{"results", std::move(list)}});
  return ExitCode::done;
}

ExitCode explain_schema(const std::string& what, Console& console) {
  const nlohmann::ordered_json schema = what == "study"   ? study_schema()
                                        : what == "scene" ? scene_schema()
                                                          : references_schema();
  console.print_text(schema.dump(2) + "\n");
  console.print_json(schema);
  return ExitCode::done;
}

}  // namespace

bool explains_program(const ExplainArguments& arguments) {
  return arguments.lists() || !arguments.schema.empty();
}

ExitCode explain_program(const ExplainArguments& arguments, Console& console) {
  if (arguments.keys) return explain_keys(arguments.file.string(), console);
  if (arguments.results) return explain_results(arguments.file.string(), console);
  if (arguments.materials) return explain_materials(arguments.file.string(), console);
  return explain_schema(arguments.schema, console);
}

}  // namespace launchsafe::app
