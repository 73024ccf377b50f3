// SPDX-License-Identifier: GPL-3.0-or-later
// What the machine has left: Linux /proc, control groups, the limit of the process.
#include "import/machine_memory.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

#include <sys/resource.h>

namespace argil {
namespace {

constexpr std::uint64_t kUnknownBytes = std::numeric_limits<std::uint64_t>::max();

std::uint64_t read_kib(const char* name, const char* wanted) {
  std::ifstream file(name);
  std::string key;
  std::uint64_t kib = 0;
  std::string line;
  while (std::getline(file, line)) {
    std::istringstream words(line);
    if (words >> key >> kib && key == wanted) return kib * 1024;
  }
  return kUnknownBytes;
}

std::uint64_t meminfo(const char* wanted) { return read_kib("/proc/meminfo", wanted); }

/// What `ulimit -d` or a program for itself has set.
std::uint64_t process_limit() {
  rlimit limit{};
  const bool is_limited = ::getrlimit(RLIMIT_DATA, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  return is_limited ? limit.rlim_cur : kUnknownBytes;
}

std::uint64_t left_in_process() {
  const std::uint64_t limit = process_limit();
  if (limit == kUnknownBytes) return kUnknownBytes;
  const std::uint64_t used = read_kib("/proc/self/status", "VmData:");
  return limit - std::min(limit, used);
}

/// The number a file holds; kUnknownBytes for "max", no number or no file.
std::uint64_t read_number(const std::string& path) {
  std::ifstream file(path);
  std::uint64_t value = 0;
  return file >> value ? value : kUnknownBytes;
}

/// File cache that a group counts as used though the kernel gives it back on demand.
std::uint64_t reclaimable(const std::string& stat_file) {
  std::ifstream file(stat_file);
  std::string key;
  std::uint64_t value = 0;
  while (file >> key >> value) {
    if (key == "inactive_file" || key == "total_inactive_file") return value;
  }
  return 0;
}

std::uint64_t left_in(const std::string& folder, const char* limit_file, const char* used_file) {
  const std::uint64_t limit = read_number(folder + limit_file);
  const std::uint64_t used = read_number(folder + used_file);
  if (limit == kUnknownBytes || used == kUnknownBytes) return kUnknownBytes;
  const std::uint64_t held = used - std::min(used, reclaimable(folder + "/memory.stat"));
  return limit > held ? limit - held : 0;
}

/// The least of what `version1(folder)` says of the memory controller and `version2(folder)` of
/// this process's control group and the groups above it.
template <class Version1, class Version2>
std::uint64_t least_of_groups(const Version1& version1, const Version2& version2) {
  std::uint64_t left = version1("/sys/fs/cgroup/memory");
  std::ifstream file("/proc/self/cgroup");
  std::string line;
  while (std::getline(file, line)) {
    if (line.rfind("0::", 0) != 0) continue;
    std::string group = line.substr(3);
    while (true) {
      const std::string folder = "/sys/fs/cgroup" + group;
      left = std::min(left, version2(folder));
      const std::size_t slash = group.rfind('/');
      if (group.empty() || slash == std::string::npos) break;
      group.resize(slash);
    }
  }
  return left;
}

}  // namespace

std::uint64_t available_bytes() {
  const std::uint64_t left = least_of_groups(
      [](const std::string& folder) {
        return left_in(folder, "/memory.limit_in_bytes", "/memory.usage_in_bytes");
      },
      [](const std::string& folder) { return left_in(folder, "/memory.max", "/memory.current"); });
  return std::min({meminfo("MemAvailable:"), left, left_in_process()});
}

std::uint64_t machine_bytes() {
  const std::uint64_t limit = least_of_groups(
      [](const std::string& folder) { return read_number(folder + "/memory.limit_in_bytes"); },
      [](const std::string& folder) { return read_number(folder + "/memory.max"); });
  return std::min({meminfo("MemTotal:"), limit, process_limit()});
}

}  // namespace argil
