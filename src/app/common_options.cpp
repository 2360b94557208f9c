#include "common_options.hpp"

#include "built_in_texts.hpp"
#include "launchsafe/report/page_texts.hpp"
#include "launchsafe/scene/scene_keys.hpp"

#include <boost/algorithm/string.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <charconv>
#include <cmath>

namespace launchsafe::app {
namespace {

struct UnitFactor {
  std::string_view name;  ///< lower case
  double factor;
};

constexpr std::array<UnitFactor, 13> size_units{{{"b", 1},
                                                 {"kb", 1e3},
                                                 {"mb", 1e6},
                                                 {"gb", 1e9},
                                                 {"tb", 1e12},
                                                 {"k", 1e3},
                                                 {"m", 1e6},
                                                 {"g", 1e9},
                                                 {"t", 1e12},
                                                 {"kib", 1024.0},
                                                 {"mib", 1024.0 * 1024},
                                                 {"gib", 1024.0 * 1024 * 1024},
                                                 {"tib", 1024.0 * 1024 * 1024 * 1024}}};

constexpr std::array<UnitFactor, 5> duration_units{
    {{"ms", 1e-3}, {"s", 1}, {"min", 60}, {"h", 3600}, {"d", 86400}}};

template <std::size_t count>
std::optional<double> parse_amount(std::string_view text, const std::array<UnitFactor, count>& units) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{}) return std::nullopt;
  const std::string rest = boost::algorithm::to_lower_copy(std::string(end, text.data() + text.size()));
  const std::string unit = boost::algorithm::trim_copy_if(rest, [](char letter) { return letter == ' '; });
  const auto found = std::ranges::find(units, unit, &UnitFactor::name);
  if (found == units.end()) return std::nullopt;
  const double amount = number * found->factor;
  return std::isfinite(amount) && amount > 0 ? std::optional(amount) : std::nullopt;
}

/// Bytes: "8GB", "500 MB", "1.5GiB", "8e9 B". kB, MB, GB and TB are powers of 1000; KiB, MiB, GiB and TiB of
/// 1024. Nothing for any other text, and for less than a byte or more than 1e18.
std::optional<double> parse_size(std::string_view text) {
  const auto size = parse_amount(text, size_units);
  constexpr double largest = 1e18;  // what whole numbers of bytes are counted with
  return size && *size >= 1 && *size <= largest ? size : std::nullopt;
}

/// Seconds: "90s", "10min", "2h", "1.5 d". Nothing for any other text, and for what is not more than
/// zero.
std::optional<double> parse_duration(std::string_view text) { return parse_amount(text, duration_units); }
constexpr const char* allowed_durations = "a duration such as 90s, 10min, 2h or 1d";

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

std::string footer_of(const std::string& command) {
  const std::string& text = help_texts().at(command + ".txt");
  return "\n" + text.substr(0, text.size() - 1);
}

CLI::Validator no_option_name(const char* kind) {
  const auto check = [kind](const std::string& text) {
    if (!text.starts_with("-")) return std::string{};
    return fmt::format("found {1}, which is an option; allowed: a {0} (./{1} for one of this name)", kind,
                       text);
  };
  return CLI::Validator(check, "");
}

CLI::Option* add_read(CLI::App& command, const std::string& name,
                      std::function<bool(const std::string&)> read, const char* allowed, const char* type,
                      const char* meaning) {
  const auto read_or_refuse = [name, read, allowed](const std::string& text) {
    if (!read(text))
      throw CLI::ValidationError(name, fmt::format("found \"{}\"; allowed: {}", text, allowed));
  };
  return command.add_option_function<std::string>(name, read_or_refuse, meaning)->type_name(type);
}

void add_longest_run(CLI::App& command, std::optional<double>& longest_run) {
  add_amount(command, "--longest-run", longest_run, parse_duration, allowed_durations, "DURATION",
             "Refuse a case that is predicted to take longer; 30d unless given");
}

void add_jobs(CLI::App& command, int& jobs, const char* meaning) {
  constexpr int most_jobs = 4096;
  command.add_option("-j,--jobs", jobs, meaning)->check(CLI::Range(1, most_jobs))->type_name("N");
}

void add_limits(CLI::App& command, std::optional<double>& memory, std::optional<double>& time_limit) {
  add_amount(command, "--memory", memory, parse_size, "a size such as 500MB, 8GB, 1.5GiB or 8e9B, up to 1e18",
             "SIZE", "Memory of all running cases together, such as 8GB; most of what is free unless given");
  add_amount(command, "--time-limit", time_limit, parse_duration, allowed_durations, "DURATION",
             "Wall time after which a case is given up, such as 10min");
}

void add_tolerance(CLI::App& command, std::optional<double>& tolerance) {
  const auto parse_temperature = [](std::string_view text) {
    return parse_amount(text, std::array<UnitFactor, 2>{{{"", 1}, {"k", 1}}});
  };
  add_amount(command, "--tolerance", tolerance, parse_temperature,
             "a temperature difference such as 2K or 0.5K", "KELVIN",
             "Use the cheapest setting of the study's accuracy record that knows T max to this, such as 2K");
}

void add_update(CLI::App& command, bool& update) {
  command.add_flag("--update", update,
                   "Use the stored cases of another study in DIR; its report moves to DIR/earlier-N");
}

std::string bash_completion(const CLI::App& app) {
  report::Row facts{{"commands", report::Row::array()}, {"keys", report::Row::array()}};
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    facts["commands"].push_back(row_of(*command));
  for (const scene::DocumentedKey& key : scene::describe_keys())
    facts["keys"].push_back(key.description.name + "=");
  return report::filled(completion_template, {&facts});
}

}  // namespace launchsafe::app
