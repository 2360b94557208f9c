#include "command_manual.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace launchsafe::app {

namespace {

/// Text as roff prints it: no escapes, no requests, hyphens that can be copied.
std::string roff(const std::string& text) {
  std::string escaped;
  bool at_line_start = true;
  for (const char letter : text) {
    if (at_line_start && (letter == '.' || letter == '\'')) escaped += "\\&";
    if (letter == '\\')
      escaped += "\\e";
    else if (letter == '-')
      escaped += "\\-";
    else
      escaped += letter;
    at_line_start = letter == '\n';
  }
  return escaped;
}

std::string upper_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

/// "--output,-o" as "-o, --output".
std::string names_in_order(const std::string& names) {
  std::vector<std::string> list;
  std::istringstream stream(names);
  for (std::string name; std::getline(stream, name, ',');) list.push_back(name);
  std::stable_sort(list.begin(), list.end(),
                   [](const auto& a, const auto& b) { return a.size() < b.size(); });
  return fmt::format("{}", fmt::join(list, ", "));
}

std::string option_entries(const CommandDescription& command) {
  std::string text;
  for (const OptionDescription& option : command.options) {
    const std::string type = option.type.empty() ? "" : fmt::format(" \\fI{}\\fR", roff(option.type));
    text += option.positional ? fmt::format(".TP\n\\fI{}\\fR\n{}\n", roff(option.type), roff(option.meaning))
                              : fmt::format(".TP\n\\fB{}\\fR{}\n{}\n", roff(names_in_order(option.names)),
                                            type, roff(option.meaning));
  }
  return text;
}

/// Lines that keep their breaks and their columns.
std::string as_written(const std::string& text) {
  const auto first = text.find_first_not_of('\n');
  if (first == std::string::npos) return {};
  return fmt::format(".PP\n.nf\n{}\n.fi\n", roff(text.substr(first)));
}

/// The options that a shell offers: those that begin with a dash.
std::string option_words(const CommandDescription& command) {
  std::string words;
  for (const OptionDescription& option : command.options) {
    if (option.positional) continue;
    std::string names = option.names;
    std::replace(names.begin(), names.end(), ',', ' ');
    words += (words.empty() ? "" : " ") + names;
  }
  return words;
}

/// "scene|study" is a choice of words; "FILE" and "SCENE.toml|STUDY.toml" name what the user has.
bool is_choice(const std::string& type) {
  return !type.empty() &&
         std::all_of(type.begin(), type.end(), [](unsigned char c) { return std::islower(c) || c == '|'; });
}

/// The words that may follow an option, or stand for the argument that is a choice.
std::string choices_of(const OptionDescription& option) {
  std::string words = option.type;
  std::replace(words.begin(), words.end(), '|', ' ');
  return words;
}

/// A case of the script for the options of one command that take one of a few words.
std::string choice_cases(const CommandDescription& command) {
  std::string cases;
  for (const OptionDescription& option : command.options) {
    if (option.positional || !is_choice(option.type)) continue;
    std::string names = option.names;
    std::replace(names.begin(), names.end(), ',', '|');
    cases += fmt::format("    {0}:{1}) words=\"{2}\" ;;\n", command.name, names, choices_of(option));
  }
  return cases;
}

/// Words of positional arguments that are a choice, such as the engine of `emit`.
std::string positional_words(const CommandDescription& command) {
  std::string words;
  for (const OptionDescription& option : command.options)
    if (option.positional && is_choice(option.type)) words += " " + choices_of(option);
  return words;
}

}  // namespace

std::string manual_page(const CommandDescription& program, const std::string& version) {
  const auto end_of_title = program.meaning.find('\n');
  std::string page = fmt::format(
      ".TH LAUNCHSAFE 1 \"\" \"launchsafe {}\" \"User Commands\"\n.SH NAME\nlaunchsafe \\- launch safety of "
      "explosive shells by the material point method\n.SH SYNOPSIS\n.B launchsafe\n\\fICOMMAND\\fR "
      "[\\fIOPTIONS\\fR]\n.SH DESCRIPTION\n{}\n.PP\n{}\n.SH OPTIONS\n{}",
      roff(version), roff(program.meaning.substr(0, end_of_title)),
      roff(end_of_title == std::string::npos ? "" : program.meaning.substr(end_of_title + 1)),
      option_entries(program));
  page += ".SH COMMANDS\n";
  for (const CommandDescription& command : program.subcommands)
    page += fmt::format(".TP\n\\fB{}\\fR\n{}\n", roff(command.name), roff(command.meaning));
  for (const CommandDescription& command : program.subcommands)
    page += fmt::format(".SH LAUNCHSAFE {}\n{}.\n{}{}", upper_case(roff(command.name)), roff(command.meaning),
                        option_entries(command), as_written(command.footer));
  return page + ".SH EXAMPLES AND EXIT CODES\n" + as_written(program.footer);
}

std::string bash_completion(const CommandDescription& program) {
  std::string commands, options, cases;
  for (const CommandDescription& command : program.subcommands) {
    commands += (commands.empty() ? "" : " ") + command.name;
    options += fmt::format("    {}) words=\"{}{}\" ;;\n", command.name, option_words(command),
                           positional_words(command));
    cases += choice_cases(command);
  }
  return fmt::format(R"(# Completion of launchsafe in bash, written by launchsafe explain --completion bash.
_launchsafe() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD-1]}} command=${{COMP_WORDS[1]}} words=
  if ((COMP_CWORD == 1)); then
    COMPREPLY=($(compgen -W "{} {}" -- "$current"))
    return
  fi
  case $command:$previous in
{}  esac
  if [[ -n $words ]]; then
    COMPREPLY=($(compgen -W "$words" -- "$current"))
    return
  fi
  case $command in
{}  esac
  if [[ $current == -* ]]; then
    COMPREPLY=($(compgen -W "$words" -- "$current"))
  else
    compopt -o filenames
    COMPREPLY=($(compgen -f -- "$current"))
  fi
}}
complete -F _launchsafe launchsafe
)",
                     commands, option_words(program), cases, options);
}

}  // namespace launchsafe::app
