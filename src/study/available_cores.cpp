#include "launchsafe/study/scheduler.hpp"

#include <sched.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

namespace launchsafe::study {
namespace {

int cores_by_affinity() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof set, &set) != 0)
    return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return std::max(1, CPU_COUNT(&set));
}

/// Cores that a quota per period allows, rounded up; `cores` where there is no quota.
int limited(int cores, double quota, double period) {
  if (!(quota > 0) || !(period > 0)) return cores;
  return std::min(cores, std::max(1, static_cast<int>(std::ceil(quota / period - 1e-9))));
}

/// cpu.max of one control group (version 2): "max 100000" or "200000 100000".
int limited_by_file(int cores, const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string quota;
  double period = 0;
  if (!(stream >> quota >> period) || quota == "max") return cores;
  try {
    return limited(cores, std::stod(quota), period);
  } catch (const std::exception&) {
    return cores;
  }
}

/// The process's own control group, version 2, below the root: "a/b"; empty where there is none.
std::string own_control_group() {
  std::ifstream stream("/proc/self/cgroup");
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("0::/")) return line.substr(4);
  }
  return {};
}

int limited_by_version_1(int cores, const std::filesystem::path& folder) {
  double quota = 0, period = 0;
  std::ifstream(folder / "cpu.cfs_quota_us") >> quota;
  std::ifstream(folder / "cpu.cfs_period_us") >> period;
  return limited(cores, quota, period);
}

}  // namespace

int available_cores() {
  const std::filesystem::path root = "/sys/fs/cgroup";
  int cores = limited_by_file(cores_by_affinity(), root / "cpu.max");
  std::filesystem::path group = root;
  for (const auto& part : std::filesystem::path(own_control_group())) {
    group /= part;
    cores = limited_by_file(cores, group / "cpu.max");
  }
  return limited_by_version_1(cores, root / "cpu");
}

}  // namespace launchsafe::study
