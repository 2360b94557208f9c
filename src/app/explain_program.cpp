// What launchsafe explains of itself: the keys of its files and the columns of its results.
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
                      {"plausible", scene::plausible_text(described)},
                      {"default", default_text},
                      {"required", described.required},
                      {"standing", scene::letter_of(described.standing)},
                      {"sentence", described.sentence}});
  return rows;
}

/// For people, who are told what is plausible only where a reason is known.
std::string text_of_keys(Json rows) {
  for (Json& row : rows)
    if (row["plausible"].get_ref<std::string&>().find(", because ") == std::string::npos)
      row.erase("plausible");
  return told("key_list.txt", {{"rows", rows}});
}

/// The keys of scene and study files, from the same descriptions that read them.
ExitCode explain_keys(const std::string& word, Console& console) {
  NameSearch search{word};
  Json rows{{"keys", listed(scene::describe_keys(), search)}};
  if (word.empty())
    for (const auto& [described, value] : scene::derived_quantities())
      rows["derived_quantities"].push_back({{"quantity", described.name},
                                            {"si_unit", scene::si_unit_of(described.dimension)},
                                            {"plausible", scene::plausible_text(described)},
                                            {"sentence", described.sentence}});
  rows["study_keys"] = listed(kinds::describe_study_keys(), search);
  Json facts{{"standings", word.empty() ? standings() : ""}};
  for (const auto& [name, list] : rows.items()) facts[name] = text_of_keys(list);
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

}  // namespace

ExitCode explain_program(const ExplainArguments& arguments, Console& console) {
  const std::string word = arguments.file.string();
  return arguments.keys ? explain_keys(word, console) : explain_results(word, console);
}

}  // namespace launchsafe::app
