#include "common_options.hpp"

#include <unistd.h>

#include <charconv>

namespace launchsafe::app {

CLI::Option* add_read(CLI::App& command, const std::string& name, const char* type, const char* meaning,
                      const std::string& allowed, std::function<bool(const std::string&)> read) {
  const auto read_or_refuse = [name, allowed, read](const std::string& text) {
    const auto taken = scene::caught([&] { return read(text); });
    if (!taken || !*taken)
      throw scene::error_at({}, name, '"' + text + '"', allowed, taken ? "" : taken.error().suggestion);
  };
  return command.add_option_function<std::string>(name, read_or_refuse, meaning)->type_name(type);
}

CLI::Option* add_quantity(CLI::App& command, const std::string& name, std::optional<double>& value,
                          scene::Dimension dimension, const char* meaning, const std::string& allowed,
                          double least, double most) {
  return add_read(command, name, "QUANTITY", meaning, allowed,
                  [&value, dimension, least, most](const std::string& text) {
                    value = scene::parse_quantity(text, dimension);
                    return *value >= least && *value <= most;
                  });
}

void add_jobs(CLI::App& command, int& jobs) {
  constexpr int most = 4096;
  add_read(command, "-j,--jobs", "N", "Threads at a time; as many as there are processors unless given",
           "a whole number from 1 to 4096", [&jobs](const std::string& text) {
             const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), jobs);
             return fault == std::errc{} && end == text.data() + text.size() && jobs >= 1 && jobs <= most;
           });
}

void prepare_output_folder(const path& folder) {
  std::error_code error, unknown;  // a name that is too long, say
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder, unknown))
    throw Ended{fmt::format("{} is no folder and cannot be made one; allowed: a folder", folder.string())};
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw Ended{fmt::format("{} may not be written to; allowed: a folder of yours", folder.string())};
}

std::vector<std::string> write_where_absent(const path& folder, const NamedTexts& texts) {
  prepare_output_folder(folder);
  const auto is_there = [&](const report::TextFile& each) {
    std::error_code unknown;
    if (!std::filesystem::exists(std::filesystem::symlink_status(folder / each.name, unknown))) return false;
    if (store::read_file(folder / each.name) == each.text) return true;
    throw store::refusal(folder / each.name, "is there with another content");
  };
  std::ranges::for_each(texts, is_there);
  for (const report::TextFile& each : texts)
    if (!is_there(each)) store::write_file_atomically(folder / each.name, each.text, store::IfExists::refuse);
  return study::of_each(texts, [&](const auto& each) { return (folder / each.name).string(); });
}

}  // namespace launchsafe::app
