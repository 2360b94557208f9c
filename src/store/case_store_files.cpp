#include "case_store_files.hpp"

#include "launchsafe/scene/toml_reader.hpp"

namespace launchsafe::store {
namespace {

constexpr std::string_view stem = "study", ending = ".db";

/// The part of a name that is BEGIN + END, which is empty, or BEGIN.PART + END, where a part is "1-of-4".
std::optional<std::string> part_in(std::string_view name, std::string_view begin, std::string_view end) {
  if (!name.starts_with(begin) || !name.ends_with(end) || name.size() < begin.size() + end.size()) return {};
  const std::string_view part = name.substr(begin.size(), name.size() - begin.size() - end.size());
  if (part.empty()) return std::string();
  if (!part.starts_with('.') || part.find("-of-") == std::string_view::npos) return {};
  return std::string(part.substr(1));
}

/// Throws what has the name of a case but is no file.
void demand_files_of_cases(const StoreNames& names) {
  std::error_code ignored;
  for (const std::string& hash : stored_hashes(names)) {
    const std::filesystem::path path = names.case_file(hash);
    if (!std::filesystem::is_regular_file(std::filesystem::symlink_status(path, ignored)))
      throw refusal(path, "is no plain file");
  }
}

/// Whether the content of a file is that of SQLite's rollback journal: its mark, or zeros once it is done
/// with.
bool is_rollback_journal(std::string_view content) {
  constexpr std::string_view mark = "\xd9\xd5\x05\xf9\x20\xa1\x63\xd7";
  const std::string_view begin = content.substr(0, mark.size());
  return begin == mark || begin.find_first_not_of('\0') == std::string_view::npos;
}

/// A store makes its folder of cases before anything else: an empty file of a store's name beside none is not
/// its own.
void demand_nothing_before_first(const StoreNames& names) {
  std::error_code failed;
  if (std::filesystem::exists(names.cases(), failed)) return;
  for (const std::filesystem::path& path : {names.results(), names.status()})
    if (std::filesystem::is_regular_file(path, failed) && std::filesystem::file_size(path, failed) == 0)
      throw refusal(path, foreign_file);
}

/// See `obstacle_in_place`.
void demand_place(const std::filesystem::path& path, const std::function<bool(std::string_view)>& is_ours) {
  if (const MaybeError error = obstacle_in_place(path, is_ours)) throw *error;
}

constexpr const char* format_of_status = "launchsafe status 1";

/// The part whose status file has that name, empty for a whole study; nothing for any other name.
std::optional<std::string> part_of_status(std::string_view name) { return part_in(name, "status", ".json"); }

std::string time_in(const StoreStatus& status) { return status.members.value("time", std::string{}); }

/// "HOST process PID since TIME, 3 of 12 runs done", from a status file; "another process" where it names
/// none.
std::string writer_in(const std::filesystem::path& status_file) {
  const auto text = read_file(status_file);
  const auto members = text ? status_in(*text) : std::nullopt;
  try {
    if (!members) return "another process";
    const std::string writer = fmt::format(
        "{} process {} since {}, {} of {} runs done", members->at("host").get<std::string>(),
        members->at("process").get<long>(), members->at("since").get<std::string>(),
        members->at("runs_done").get<std::size_t>(), members->at("runs_total").get<std::size_t>());
    // It may have ended while we waited, or somebody reads what it left.
    if (members->at("ended").get<bool>()) return "another process; the last to write was " + writer;
    return writer;
  } catch (const nlohmann::json::exception&) {
    return "another process";
  }
}

}  // namespace

bool is_store_name(std::string_view name) {
  return name == "cases" || part_in(name, stem, ending) || part_in(name, stem, ".db-journal") ||
         part_of_status(name);
}

std::vector<std::filesystem::path> results_files_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const std::string& name : scene::list_folder(folder))
    if (part_in(name, stem, ending)) files.push_back(folder / name);
  return files;
}

std::vector<std::string> stored_hashes(const StoreNames& names) {
  std::vector<std::string> hashes;
  for (const std::string& name : scene::list_folder(names.cases())) {
    const std::filesystem::path file(name);
    if (file.extension() == ".h5" && is_case_hash(file.stem().string())) hashes.push_back(file.stem());
  }
  return hashes;
}

void demand_free(const StoreNames& names) {
  std::error_code failed;
  const auto cases = std::filesystem::symlink_status(names.cases(), failed);
  if (std::filesystem::exists(cases) && !std::filesystem::is_directory(cases))
    throw refusal(names.cases(), "is no folder");
  demand_files_of_cases(names);
  demand_nothing_before_first(names);
  demand_place(names.status(), [](std::string_view content) { return status_in(content).has_value(); });
  const std::filesystem::path results = names.results();
  demand_place(results, {});
  demand_place(results.string() + "-journal", is_rollback_journal);
  if (std::filesystem::exists(results, failed)) of_results(results, [&] { Database::demand_free(results); });
}

Error told_who_writes(const Error& error, const std::filesystem::path& results) {
  if (error.kind != Error::Kind::held) return error;
  const StoreNames names{results.parent_path(),
                         part_in(results.filename().string(), stem, ending).value_or("")};
  return {Error::Kind::conflict,
          fmt::format("{} is in use by {}", names.folder.string(), writer_in(names.status()))};
}

void remove_leftovers_of(const StoreNames& names) {
  for (const std::string& temporary : scene::list_folder(names.cases())) {
    const std::optional<std::string> name = name_behind(temporary);
    if (!name || !is_case_hash(name->substr(0, name->find('.')))) continue;
    // A part excludes whole studies and others of its own name.
    const bool ours = names.part.empty() || name->ends_with("." + names.mark()) ||
                      name->ends_with("." + StoreNames{}.mark());
    if (ours) remove_leftover(names.cases() / temporary);
  }
}

bool belongs_to(const Manifest& manifest, const std::string& hash) {
  return !hash.empty() && manifest.input_sha256.starts_with(hash);
}

Error of_another_case(const std::filesystem::path& path) {
  return {Error::Kind::corrupt, fmt::format("{}: it is the result of another case", path.string())};
}

Result<Manifest> read_checked(const std::filesystem::path& path, const std::string& hash) {
  Result<Manifest> manifest = read_manifest(path);
  if (manifest && !belongs_to(*manifest, hash)) return of_another_case(path);
  return manifest;
}

bool began_as_case(const std::filesystem::path& path) {
  std::error_code failed;
  if (!std::filesystem::is_regular_file(std::filesystem::symlink_status(path, failed))) return false;
  const Result<std::string> bytes = read_file(path);
  return bytes && bytes->starts_with(case_file_begin);
}

std::string to_text(const nlohmann::ordered_json& members) {
  nlohmann::ordered_json object{{"format", format_of_status}};
  object.update(members);
  return object.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::optional<nlohmann::ordered_json> status_in(std::string_view content) {
  auto object = nlohmann::ordered_json::parse(content, nullptr, false);
  if (!object.is_object() || !object.contains("format") || object["format"] != format_of_status)
    return std::nullopt;
  return object;
}

std::vector<StoreStatus> statuses_in(const std::filesystem::path& folder) {
  std::vector<StoreStatus> parts;
  std::optional<StoreStatus> whole;
  for (const std::string& name : scene::list_folder(folder)) {
    const std::optional<std::string> part = part_of_status(name);
    // Before the file is read: a writer that ends in between is seen to have ended.
    const bool alive = part && Database::is_held(StoreNames{folder, *part}.results());
    const auto text = part ? read_file(folder / name) : Error{};
    const auto members = text ? status_in(*text) : std::nullopt;
    if (!members || !members->value("time", nlohmann::ordered_json()).is_string()) continue;
    if (part->empty())
      whole = StoreStatus{{}, *members, alive};
    else
      parts.push_back({*part, *members, alive});
  }
  // A merge that lacked runs told nothing of them.
  const bool parts_are_newer =
      !whole || (!parts.empty() && !whole->members.contains("cases")) ||
      std::ranges::any_of(parts, [&](const auto& each) { return time_in(each) > time_in(*whole); });
  return parts_are_newer ? parts : std::vector{*whole};
}

}  // namespace launchsafe::store
