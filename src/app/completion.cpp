// What completes command lines in bash, from the commands and options as they are parsed.
#include "built_in_texts.hpp"
#include "common_options.hpp"
#include "launchsafe/report/page_texts.hpp"
#include "launchsafe/scene/scene_keys.hpp"

#include <boost/algorithm/string.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace launchsafe::app {
namespace {

/// What an argument takes, by the type that its help shows, as variables of the script: files of an
/// extension, folders, or the words of a closed list, which are in small letters with bars between. Empty for
/// what is free.
std::string candidates_of(const CLI::Option& argument) {
  std::string type = argument.get_type_name();
  type.erase(std::min(type.find(':'), type.size()));  // what the parser adds to the type
  if (type == "KEY=VALUE") return "values=$keys";
  if (type.find("DIR") != std::string::npos || type == "FOLDER...") return "folders=1";
  if (const std::size_t dot = type.rfind('.'); dot != std::string::npos && !type.ends_with("..."))
    return "files=" + type.substr(dot + 1);
  if (type.empty() || type != boost::algorithm::to_lower_copy(type)) return {};
  std::ranges::replace(type, '|', ' ');
  return fmt::format("values='{}'", type);
}

report::Row row_of(const CLI::App& command) {
  report::Row row{{"name", command.get_name()}, {"names", ""}, {"options", report::Row::array()}};
  std::vector<std::string> all, positional;
  for (const CLI::Option* option : command.get_options()) {
    std::vector<std::string> names;
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
    all.insert(all.end(), names.begin(), names.end());
    if (names.empty())
      positional.push_back(candidates_of(*option));
    else if (option->get_items_expected_max() > 0)
      row["options"].push_back(
          {{"names", fmt::format("{}", fmt::join(names, "|"))}, {"take", candidates_of(*option)}});
  }
  row["names"] = fmt::format("{}", fmt::join(all, " "));
  row["positional"] = fmt::format("{}", fmt::join(positional, " "));
  return row;
}

}  // namespace

std::string bash_completion(const CLI::App& app) {
  report::Row facts{{"commands", report::Row::array()}, {"keys", report::Row::array()}};
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    facts["commands"].push_back(row_of(*command));
  for (const scene::DocumentedKey& key : scene::describe_keys())
    facts["keys"].push_back(key.description.name + "=");
  return report::filled(completion_template, {&facts});
}

}  // namespace launchsafe::app
