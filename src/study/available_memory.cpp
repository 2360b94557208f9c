#include "launchsafe/study/scheduler.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

namespace launchsafe::study {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// The number in a file; infinity where there is none ("max", no such file).
double number_in(const std::filesystem::path& file) {
  std::ifstream stream(file);
  double number = 0;
  return stream >> number ? number : unlimited;
}

/// MemAvailable of the machine, bytes.
double machine_memory() {
  std::ifstream stream("/proc/meminfo");
  for (std::string line; std::getline(stream, line);) {
    constexpr std::string_view name = "MemAvailable:";
    if (line.starts_with(name)) return 1024.0 * std::strtod(line.c_str() + name.size(), nullptr);
  }
  return unlimited;
}

/// What the limit of one control group (version 2) leaves. Its file cache is given up under pressure.
double left_in_group(const std::filesystem::path& group) {
  const double limit = number_in(group / "memory.max");
  if (limit == unlimited) return unlimited;
  double cache = 0;
  std::ifstream stream(group / "memory.stat");
  std::string name;
  for (double value = 0; stream >> name >> value;) {
    if (name == "inactive_file" || name == "active_file") cache += value;
  }
  const double used = number_in(group / "memory.current");
  return std::max(0.0, limit - (used == unlimited ? 0.0 : used) + cache);
}

/// The same for version 1, whose limit is a huge number where there is none.
double left_in_version_1(const std::filesystem::path& group) {
  const double limit = number_in(group / "memory.limit_in_bytes");
  if (!(limit < 1e15)) return unlimited;
  const double used = number_in(group / "memory.usage_in_bytes");
  return std::max(0.0, limit - (used == unlimited ? 0.0 : used));
}

}  // namespace

double available_memory() {
  const std::filesystem::path root = "/sys/fs/cgroup";
  double memory = std::min({machine_memory(), left_in_group(root), left_in_version_1(root / "memory")});
  std::ifstream stream("/proc/self/cgroup");
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with("0::/")) continue;
    std::filesystem::path group = root;
    for (const auto& part : std::filesystem::path(line.substr(4))) {
      group /= part;
      memory = std::min(memory, left_in_group(group));
    }
  }
  return memory;
}

}  // namespace launchsafe::study
