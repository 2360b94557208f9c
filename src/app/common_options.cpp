#include "common_options.hpp"

#include <boost/algorithm/string.hpp>
#include <unistd.h>

#include <charconv>
#include <sstream>

namespace launchsafe::app {
namespace {

/// Why `read` refuses a text, for which it may throw the fault; none of a text that it takes.
scene::Fault fault_of_text(const std::string& text, const std::function<bool(const std::string&)>& read) {
  try {
    if (read(text)) return std::nullopt;
    return scene::error_at({}, {}, '"' + text + '"', {});
  } catch (const scene::InputError& fault) {
    return fault;
  }
}

}  // namespace

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
    scene::Fault fault = fault_of_text(text, read);
    if (!fault) return;
    // Of what any quantity of its kind may be only the units are kept.
    const std::size_t units = std::min(fault->allowed.find(" (units: "), fault->allowed.size());
    fault->allowed = words.allowed + fault->allowed.substr(units);
    throw CLI::ValidationError(name, fault->message());
  };
  return command.add_option_function<std::string>(name, read_or_refuse, words.meaning)->type_name(words.type);
}

CLI::Option* add_count(CLI::App& command, const std::string& name, int& count, int most) {
  return add_read(command, name, [&count, most](const std::string& text) {
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), count);
    return fault == std::errc{} && end == text.data() + text.size() && count >= 1 && count <= most;
  });
}

void add_jobs(CLI::App& command, int& jobs) {
  constexpr int most_jobs = 4096;
  add_count(command, "-j,--jobs", jobs, most_jobs);
}

// --- folders of results ---

namespace {

/// Why a file with this content may not be written there: a link, or something with another content. A file
/// that holds the content already is none.
std::optional<std::string> obstacle_to_file(const path& file, std::string_view content) {
  std::error_code unknown;  // a name that is too long, say: reading it tells
  if (std::filesystem::is_symlink(file, unknown))
    return fmt::format("{} is a link, and nothing is written through one; move it away", file.string());
  const auto present = store::read_file(file);
  if (present && *present == content) return std::nullopt;
  if (!present && present.error().kind == store::Error::Kind::missing) return std::nullopt;
  if (!present) return present.error().message;
  return fmt::format(
      "{} is there with another content, and nothing is overwritten; move it away or name another place",
      file.string());
}

}  // namespace

std::optional<std::string> prepare_output_folder(const path& folder) {
  std::error_code error, unknown;  // a name that is too long, say
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder, unknown))
    return fmt::format("{} is no folder and cannot be made one{}; allowed: a folder", folder.string(),
                       error ? " (" + error.message() + ")" : "");
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    return fmt::format("{} may not be written to; allowed: a folder of yours", folder.string());
  return std::nullopt;
}

std::vector<std::string> write_where_absent(const path& folder, const NamedTexts& texts, Console& console) {
  console.refuse_any(prepare_output_folder(folder));
  for (const auto& [name, text] : texts) console.refuse_any(obstacle_to_file(folder / name, text));
  std::vector<std::string> said;
  for (const auto& [name, text] : texts) {
    const bool is_there = std::filesystem::exists(folder / name);  // with this content
    said.push_back((is_there ? "kept " : "wrote ") + (folder / name).string());
    if (is_there) continue;
    if (const auto error = store::write_file_atomically(folder / name, text, store::IfExists::refuse))
      console.end_with(*error);
  }
  return said;
}

std::vector<std::string> places_of(const path& folder, const NamedTexts& texts) {
  return study::of_each(texts, [&](const auto& each) { return (folder / each.name).string(); });
}

store::Manifest study_manifest(const study::StudyFile& file, int jobs) {
  std::ostringstream values;  // of the study file; none if it has gone since it was read
  if (const auto text = scene::read_text_file(file.file))
    if (const auto table = scene::parse_toml(*text, file.file)) values << *table;
  std::string input = fmt::format("# model version {}\n{}\n\n# scene\n{}", run::model_version, values.str(),
                                  scene::to_toml(file.scene.scene));
  // With another one its report is no longer true.
  if (!file.records.empty())
    input += fmt::format("\n\n# SHA-256 of the files that it rests on\n{}\n", fmt::join(file.records, "\n"));
  if (file.study.kind.own_scenes) {
    std::string scenes;
    for (const study::StudyCase& each : file.cases) scenes += scene::to_toml(each.scene.scene);
    input += "\n\n# SHA-256 of the scenes of all cases\n" + store::sha256(scenes) + "\n";
  }
  return store::make_manifest(input, jobs);
}

bool same_study(const store::Manifest& one, const store::Manifest& other) {
  return one.input_sha256 == other.input_sha256;
}

bool holds_store(const path& folder) {
  return !store::results_files_in(folder).empty() || !scene::list_folder(folder / "cases").empty();
}

std::optional<std::string> obstacle_in_folder(const path& folder, const store::Manifest& manifest,
                                              bool update) {
  const auto record = store::record_of_folder(folder);
  if (!record) return record.error().message;
  if (update || record->manifest.input_sha256.empty() || same_study(record->manifest, manifest))
    return std::nullopt;
  return fmt::format(
      "{} holds the results of a different study or model, and nothing is overwritten; with --update the "
      "report there moves to {} and stored cases are used where they fit; or name another folder",
      folder.string(), (folder / "earlier-N").string());
}

}  // namespace launchsafe::app
