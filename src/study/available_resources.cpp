#include "launchsafe/math/numbers.hpp"
#include "launchsafe/study/scheduler.hpp"

#include <tbb/info.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string_view>
#include <thread>

namespace launchsafe::study {
namespace {

namespace fs = std::filesystem;

constexpr const char* control_root = "/sys/fs/cgroup";

/// The root of the control groups and, below it, the process's own ones (version 2) from the top down.
std::vector<fs::path> control_groups() {
  std::vector<fs::path> groups{control_root};
  std::ifstream stream("/proc/self/cgroup");
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with("0::/")) continue;
    for (const fs::path& part : fs::path(line.substr(4))) groups.push_back(groups.back() / part);
    break;
  }
  return groups;
}

/// Cores that a quota per period allows, rounded up; `cores` where there is no quota.
int limited(int cores, double quota, double period) {
  if (!(quota > 0) || !(period > 0)) return cores;
  return std::min(cores, std::max(1, static_cast<int>(std::ceil(quota / period - 1e-9))));
}

constexpr double unlimited = math::infinity;

/// The number in a file; infinity where there is none ("max", no such file).
double number_in(const fs::path& file) {
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

/// What a limit leaves beside what is used, by the numbers in two files (bytes), of which `given_up` may go.
/// In version 1 the limit is a huge number where there is none.
double left_of(const fs::path& limit_file, const fs::path& used_file, double given_up) {
  const double limit = number_in(limit_file), used = number_in(used_file);
  if (!(limit < 1e15)) return unlimited;
  return std::max(0.0, limit - (used == unlimited ? 0.0 : used) + given_up);
}

/// Bytes of the file cache of a control group (version 2), which is given up under pressure.
double cache_of(const fs::path& group) {
  double cache = 0;
  std::ifstream stream(group / "memory.stat");
  std::string name;
  for (double value = 0; stream >> name >> value;)
    if (name == "inactive_file" || name == "active_file") cache += value;
  return cache;
}

/// Tasks of others that run on the machine now, the fewest of a few looks: most run for a moment. None where
/// nothing tells.
int busy_processors() {
  constexpr int looks = 5;
  int fewest = std::numeric_limits<int>::max();
  for (int look = 0; look < looks; ++look) {
    std::ifstream stream("/proc/loadavg");
    std::string one, five, fifteen;
    int running = 1;  // this one
    stream >> one >> five >> fifteen >> running;
    fewest = std::min(fewest, running - 1);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return fewest;
}

}  // namespace

int threads_beside(int cores, int processors, int busy) {
  return std::clamp(processors - busy, 1, std::max(1, cores));
}

int useful_threads(std::int64_t particles, int threads) {
  constexpr std::int64_t fewest_of_a_thread = 1500;
  return static_cast<int>(std::clamp<std::int64_t>(particles / fewest_of_a_thread, 1, std::max(1, threads)));
}

int threads_for_one_run(std::int64_t particles) {
  const int useful = useful_threads(particles, available_cores());
  if (useful == 1) return 1;
  return threads_beside(useful, static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN)), busy_processors());
}

int available_cores() {
  int cores = std::max(1, tbb::info::default_concurrency());  // by affinity
  double quota = 0, period = 0;
  // cpu.max of a control group (version 2): "max 100000" or "200000 100000".
  for (const fs::path& group : control_groups())
    if (std::ifstream stream(group / "cpu.max"); stream >> quota >> period)
      cores = limited(cores, quota, period);
  const fs::path version_1 = fs::path(control_root) / "cpu";
  quota = period = 0;
  std::ifstream(version_1 / "cpu.cfs_quota_us") >> quota;
  std::ifstream(version_1 / "cpu.cfs_period_us") >> period;
  return limited(cores, quota, period);
}

double available_memory() {
  const fs::path version_1 = fs::path(control_root) / "memory";
  double memory = std::min(machine_memory(), left_of(version_1 / "memory.limit_in_bytes",
                                                     version_1 / "memory.usage_in_bytes", 0.0));
  for (const fs::path& group : control_groups())
    memory = std::min(memory, left_of(group / "memory.max", group / "memory.current", cache_of(group)));
  return memory;
}

}  // namespace launchsafe::study
