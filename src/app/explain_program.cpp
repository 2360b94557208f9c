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

using Json = nlohmann::ordered_json;

std::string standings() {
  using enum scene::Standing;
  std::string text;
  for (const scene::Standing standing : {paper, literature, derived, assumed, calibrated}) {
    text += fmt::format("{}[{}] {}", text.empty() ? "" : ", ", scene::letter_of(standing),
                        scene::meaning_of(standing));
  }
  return text;
}

/// What is plausible of a key or a quantity; empty where nothing is said.
std::string plausible_line(const scene::KeyDescription& key) {
  if (key.plausible.because.empty()) return {};
  return fmt::format("    plausible: {}\n", scene::plausible_text(key));
}

std::string default_of(const scene::DocumentedKey& key) {
  if (key.description.required) return "must be given";
  if (key.default_text.empty()) return "default: none";
  return fmt::format("default: {}  [{}]", key.default_text, scene::letter_of(key.description.standing));
}

/// What is listed, for people and for programs.
struct Listed {
  std::string text;
  Json rows = Json::array();
};

/// The keys whose name begins with a word; all for an empty one.
Listed listed(const std::vector<scene::DocumentedKey>& keys, const std::string& word) {
  Listed listed;
  for (const scene::DocumentedKey& key : keys) {
    const scene::KeyDescription& described = key.description;
    if (!described.name.starts_with(word)) continue;
    listed.text += fmt::format("\n{}\n    {}\n    {}\n{}    {}\n", described.name, described.sentence,
                               scene::allowed_text(described), plausible_line(described), default_of(key));
    listed.rows.push_back({{"key", described.name},
                           {"si_unit", scene::si_unit_of(described.dimension)},
                           {"allowed", scene::allowed_text(described)},
                           {"plausible", scene::plausible_text(described)},
                           {"default", key.default_text},
                           {"required", described.required},
                           {"standing", scene::letter_of(described.standing)},
                           {"sentence", described.sentence}});
  }
  return listed;
}

Listed listed_quantities() {
  Listed listed;
  for (const auto& [described, value] : scene::derived_quantities()) {
    listed.text +=
        fmt::format("\n{}\n    {}\n{}", described.name, described.sentence, plausible_line(described));
    listed.rows.push_back({{"quantity", described.name},
                           {"si_unit", scene::si_unit_of(described.dimension)},
                           {"plausible", scene::plausible_text(described)},
                           {"sentence", described.sentence}});
  }
  return listed;
}

/// The keys of scene and study files, from the same descriptions that read them.
ExitCode explain_keys(const std::string& word, Console& console) {
  const Listed of_scene = listed(scene::describe_keys(), word),
               of_study = listed(kinds::describe_study_keys(), word);
  if (of_scene.rows.empty() && of_study.rows.empty())
    return console.refuse(
        fmt::format("explain --keys: found \"{}\", with which no key begins; allowed: the beginning of a "
                    "name, such as load",
                    word));
  console.print_json({{"keys", of_scene.rows}});
  if (word.empty()) {
    const Listed derived = listed_quantities();
    console.print_json({{"derived_quantities", derived.rows}});
    console.print_text(fmt::format(
        "Keys of a scene file; a key a.b is written b under [a]. Standing of a default: {}.\n{}\n\n"
        "Quantities that follow from the keys of a scene; what is not plausible of one gives validity "
        "warnings too.\n{}\n\nStudy files\n\nA study file also has [set], a table of scene keys with "
        "other values.\n{}",
        standings(), of_scene.text, derived.text, of_study.text));
  } else {
    const bool both = !of_scene.rows.empty() && !of_study.rows.empty();
    if (!of_scene.rows.empty()) console.print_text("Scene files\n" + of_scene.text + (both ? "\n" : ""));
    if (!of_study.rows.empty()) console.print_text("Study files\n" + of_study.text);
  }
  console.print_json({{"study_keys", of_study.rows}});
  return ExitCode::done;
}

/// Every column of the tables of all kinds, from the same descriptions that write them.
ExitCode explain_results(const std::string& word, Console& console) {
  std::string text;
  Json list = Json::array();
  for (const kinds::Kind& kind : kinds::kinds()) {
    for (const kinds::ResultTable& table : kind.results()) {
      std::vector<report::Column> columns = table.columns;
      std::erase_if(columns, [&](const report::Column& column) { return !column.key().starts_with(word); });
      if (columns.empty()) continue;
      text += fmt::format("{}{}, `{}` of study.json{}\n", text.empty() ? "" : "\n", kind.traits.name,
                          table.member, table.csv.empty() ? "" : ", " + table.csv);
      Json described = Json::array();
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
  const Json schema = what == "study"   ? study_schema()
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
