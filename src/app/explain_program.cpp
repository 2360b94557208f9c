// What launchsafe explains of itself: the keys of its files, the columns of its results, and its warnings.
#include "explain.hpp"

namespace launchsafe::app {
namespace {

std::string standings() {
  using enum scene::Standing;
  std::vector<std::string> texts;
  for (const scene::Standing standing : {paper, literature, derived, assumed, calibrated})
    texts.push_back(fmt::format("[{}] {}", scene::letter_of(standing), scene::meaning_of(standing)));
  return fmt::format("{}", fmt::join(texts, ", "));
}

/// A list whose every entry ends with an empty line.
ExitCode print_list(std::string text, Json members, Console& console) {
  text.pop_back();
  return console.done(text, std::move(members));
}

/// Names with a word in them; all for an empty one.
struct NameSearch {
  std::string word;
  std::vector<std::string> names = {};  ///< all that were asked about

  bool finds(const std::string& name) {
    names.push_back(name);
    return name.find(word) != std::string::npos;
  }
  /// Ends the command where none was found. `what` they are names of; `example`: a word.
  [[noreturn]] void refuse(const char* option, const char* what, const char* example,
                           Console& console) const {
    console.refuse(scene::error_at({}, option, fmt::format("\"{}\", which no {} has", word, what),
                                   fmt::format("a part of a name, such as {}", example),
                                   scene::nearest_of(word, names)));
  }
};

/// The keys that are searched for.
Json listed(const std::vector<scene::DocumentedKey>& keys, NameSearch& search) {
  Json rows = Json::array();
  for (const auto& [described, default_text] : keys)
    if (search.finds(described.name))
      rows.push_back({{"key", described.name},
                      {"si_unit", scene::si_unit_of(described.dimension)},
                      {"allowed", scene::allowed_text(described)},
                      {"default", default_text},
                      {"required", described.required},
                      {"standing", scene::letter_of(described.standing)},
                      {"sentence", described.sentence}});
  return rows;
}

/// The keys of scene and study files, from the same descriptions that read them.
ExitCode explain_keys(const std::string& word, Console& console) {
  NameSearch search{word};
  Json rows{{"keys", listed(scene::describe_keys(), search)}};
  rows["study_keys"] = listed(kinds::describe_study_keys(), search);
  Json facts{{"standings", word.empty() ? standings() : ""}};
  for (const auto& [name, list] : rows.items()) facts[name] = told("key_list.txt", {{"rows", list}});
  if (facts["keys"] == "" && facts["study_keys"] == "")
    search.refuse("explain --keys", "key", "load", console);
  return print_list(told("keys.txt", facts), rows, console);
}

/// Every column of the tables of all kinds, from the same descriptions that write them.
ExitCode explain_results(const std::string& word, Console& console) {
  NameSearch search{word};
  Json list = Json::array();
  for (const kinds::Kind& kind : kinds::kinds()) {
    for (const report::ReportTable& table : kind.results()) {
      Json columns = Json::array();
      for (const report::Column& column : table.table.columns)
        if (const std::string key = column.key(); search.finds(key))
          columns.push_back({{"key", key},
                             {"name", column.heading},
                             {"unit", column.form.unit},
                             {"meaning", column.meaning}});
      if (!columns.empty())
        list.push_back(
            {{"kind", kind.traits.name}, {"member", table.member}, {"csv", table.csv}, {"columns", columns}});
    }
  }
  if (list.empty()) search.refuse("explain --results", "column", "critical_gap", console);
  return print_list(told("results.txt", {{"tables", list}, {"all", word.empty()}}), {{"results", list}},
                    console);
}

/// Every validity warning on a line of its own.
ExitCode explain_warnings(const std::string& word, Console& console) {
  NameSearch search{word};
  Json list = Json::array();
  std::string text;
  for (const run::WarningKind& kind : run::warning_kinds()) {
    if (!search.finds(kind.name)) continue;
    list.push_back({{"name", kind.name}, {"acceptable", kind.acceptable}, {"meaning", kind.meaning}});
    text += fmt::format("{:<20} {:<14} {}\n", kind.name, kind.acceptable ? "acceptable" : "not acceptable",
                        kind.meaning);
  }
  if (list.empty()) search.refuse("explain --warnings", "warning", "velocity", console);
  return console.done(text, {{"warnings", list}});
}

}  // namespace

ExitCode explain_program(const ExplainArguments& arguments, Console& console) {
  const std::string word = arguments.file.string();
  if (arguments.warnings) return explain_warnings(word, console);
  return arguments.keys ? explain_keys(word, console) : explain_results(word, console);
}

}  // namespace launchsafe::app
