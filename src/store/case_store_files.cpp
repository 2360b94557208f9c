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

constexpr const char* format_of_status = "launchsafe status 1";

/// The part whose status file has that name, empty for a whole study; nothing for any other name.
std::optional<std::string> part_of_status(std::string_view name) { return part_in(name, "status", ".json"); }

std::string time_in(const StoreStatus& status) { return status.members.value("time", std::string{}); }

}  // namespace

std::vector<std::filesystem::path> results_files_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const std::string& name : scene::list_folder(folder))
    if (part_in(name, stem, ending)) files.push_back(folder / name);
  return files;
}

Error told_who_writes(const Error& error, const std::filesystem::path& results) {
  if (error.kind != Error::Kind::held) return error;
  return {Error::Kind::conflict,
          fmt::format("{} is in use by another process", results.parent_path().string())};
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
