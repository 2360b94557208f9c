#include "launchsafe/store/store_status.hpp"

#include "case_store_files.hpp"
#include "launchsafe/store/atomic_file.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace launchsafe::store {
namespace {

constexpr const char* format_of_status = "launchsafe status 1";

std::string time_in(const StoreStatus& status) { return status.members.value("time", std::string{}); }

}  // namespace

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
  std::error_code failed;
  for (const std::string& name : list_folder(folder, failed)) {
    const std::optional<std::string> part = part_of_status(name);
    const auto text = part ? read_file(folder / name) : Error{};
    const auto members = text ? status_in(*text) : std::nullopt;
    if (!members || !members->value("time", nlohmann::ordered_json()).is_string()) continue;
    if (part->empty())
      whole = StoreStatus{{}, *members};
    else
      parts.push_back({*part, *members});
  }
  // A merge that lacked runs told nothing of them.
  const bool parts_are_newer =
      !whole || (!parts.empty() && !whole->members.contains("cases")) ||
      std::ranges::any_of(parts, [&](const auto& each) { return time_in(each) > time_in(*whole); });
  return parts_are_newer ? parts : std::vector{*whole};
}

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

}  // namespace launchsafe::store
