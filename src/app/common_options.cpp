#include "common_options.hpp"

#include <boost/algorithm/string.hpp>

#include <charconv>
#include <sstream>

namespace launchsafe::app {
namespace {

/// Units by their names in small letters, with their sizes.
using Units = std::map<std::string, double>;

std::optional<double> parse_amount(std::string_view text, const Units& units) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{}) return std::nullopt;
  const std::string rest = boost::algorithm::to_lower_copy(std::string(end, text.data() + text.size()));
  const auto found =
      units.find(boost::algorithm::trim_copy_if(rest, [](char letter) { return letter == ' '; }));
  if (found == units.end()) return std::nullopt;
  const double amount = number * found->second;
  return std::isfinite(amount) && amount > 0 ? std::optional(amount) : std::nullopt;
}

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

Json row_of(const CLI::App& command) {
  Json row{{"name", command.get_name()}, {"names", ""}, {"options", Json::array()}};
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

std::optional<double> parse_size(std::string_view text) {
  Units units{{"b", 1.0}};
  double thousands = 1.0, kibis = 1.0;
  for (const char* prefix : {"k", "m", "g", "t"}) {
    units[prefix] = units[std::string(prefix) + "b"] = thousands *= 1e3;
    units[std::string(prefix) + "ib"] = kibis *= 1024.0;
  }
  const auto size = parse_amount(text, units);
  constexpr double largest = 1e18;  // what whole numbers of bytes are counted with
  return size && *size >= 1 && *size <= largest ? size : std::nullopt;
}

std::optional<double> parse_duration(std::string_view text) {
  return parse_amount(text, {{"ms", 1e-3}, {"s", 1}, {"min", 60}, {"h", 3600}, {"d", 86400}});
}

std::optional<double> parse_temperature_difference(std::string_view text) {
  return parse_amount(text, {{"", 1}, {"k", 1}});
}

std::string footer_of(const std::string& command) {
  const std::string& text = help_texts().at(command + ".txt");
  return "\n" + text.substr(0, text.size() - 1);
}

const OptionWords& words_of(const std::string& command, const std::string& option) {
  static const std::map<std::string, OptionWords> all = [] {
    std::map<std::string, OptionWords> read;
    std::istringstream lines(help_texts().at("options.txt"));
    for (std::string line; std::getline(lines, line);) {
      std::vector<std::string> parts;
      boost::algorithm::iter_split(parts, line, boost::algorithm::first_finder(" | "));
      parts.resize(4);
      read[parts[0]] = {parts[1], parts[2], parts[3]};
    }
    return read;
  }();
  const auto own = all.find(command + " " + option);
  return own != all.end() ? own->second : all.at(option);
}

CLI::Validator real_name(const std::string& type) {
  const auto check = [type, kind = type == "DIR" ? "folder" : "file"](const std::string& text) {
    if (text.empty()) return fmt::format("found \"\"; allowed: {}", type);
    if (!text.starts_with("-")) return std::string{};
    return fmt::format("found {1}, which is an option; allowed: a {0} (./{1} for one of this name)", kind,
                       text);
  };
  return CLI::Validator(check, "");
}

CLI::Option* add_read(CLI::App& command, const std::string& name,
                      std::function<bool(const std::string&)> read) {
  const OptionWords& words = words_of(command.get_name(), name);
  const auto read_or_refuse = [name, read, &words](const std::string& text) {
    if (!read(text))
      throw CLI::ValidationError(name, fmt::format("found \"{}\"; allowed: {}", text, words.allowed));
  };
  return command.add_option_function<std::string>(name, read_or_refuse, words.meaning)->type_name(words.type);
}

void add_jobs(CLI::App& command, int& jobs) {
  constexpr int most_jobs = 4096;
  add(command, "-j,--jobs", jobs)->check(CLI::Range(1, most_jobs));
}

std::string bash_completion(const CLI::App& app) {
  Json facts{{"commands", Json::array()}, {"keys", Json::array()}};
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    facts["commands"].push_back(row_of(*command));
  for (const scene::DocumentedKey& key : scene::describe_keys())
    facts["keys"].push_back(key.description.name + "=");
  return told("completion.bash", facts);
}

}  // namespace launchsafe::app
