#include "case_store_files.hpp"
#include "launchsafe/store/atomic_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace launchsafe::store {
namespace {

constexpr const char* format_of_status = "launchsafe status 1";

nlohmann::json parsed(std::string_view content) {
  auto object = nlohmann::json::parse(content, nullptr, false);
  const bool is_ours =
      object.is_object() && object.contains("format") && object["format"] == format_of_status;
  return is_ours ? object : nlohmann::json();
}

}  // namespace

std::string to_text(const StoreStatus& status) {
  const nlohmann::ordered_json object{
      {"format", format_of_status},   {"host", status.host},      {"process", status.process},
      {"since", status.since},        {"time", status.time},      {"ended", status.ended},
      {"runs_stored", status.stored}, {"runs_done", status.done}, {"runs_running", status.running},
      {"runs_total", status.total}};
  return object.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

bool is_status(std::string_view content) { return !parsed(content).is_null(); }

std::string writer_in(const std::filesystem::path& status_file) {
  const auto text = read_file(status_file);
  const nlohmann::json object = text ? parsed(*text) : nlohmann::json();
  try {
    if (object.is_null()) return "another process";
    const std::string writer =
        fmt::format("{} process {} since {}, {} of {} runs done", object.at("host").get<std::string>(),
                    object.at("process").get<long>(), object.at("since").get<std::string>(),
                    object.at("runs_done").get<std::size_t>(), object.at("runs_total").get<std::size_t>());
    // It may have ended while we waited, or somebody reads what it left.
    if (object.at("ended").get<bool>()) return "another process; the last to write was " + writer;
    return writer;
  } catch (const nlohmann::json::exception&) {
    return "another process";
  }
}

}  // namespace launchsafe::store
