// See cores.hpp.
#include "base/cores.hpp"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

namespace brume {

namespace {

std::string first_line(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

// The group of this process, below where groups are mounted; in a container mostly the mount itself.
std::string group_of_process() {
  std::ifstream in("/proc/self/cgroup");
  for (std::string line; std::getline(in, line);)
    if (line.rfind("0::/", 0) == 0) return line.substr(4);
  return {};
}

}  // namespace

int cores_of_quota(const std::string& cpu_max, int cores) {
  std::istringstream in(cpu_max);
  double quota = 0, period = 0;
  if (!(in >> quota >> period) || !(quota > 0) || !(period > 0)) return cores;  // "max": none
  return std::max(1, static_cast<int>(std::min<double>(cores, quota / period + 0.5)));
}

int cores_usable() {
  cpu_set_t set;
  CPU_ZERO(&set);
  int cores = ::sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set)
                                                            : static_cast<int>(std::thread::hardware_concurrency());
  const std::filesystem::path mount = "/sys/fs/cgroup";
  std::filesystem::path group = mount.string() + group_of_process();
  for (;; group = group.parent_path()) {
    cores = cores_of_quota(first_line(group / "cpu.max"), cores);
    if (group == mount || group == group.root_path()) return std::max(1, cores);
  }
}

bool cores_are_all_usable() { return cores_usable() == ::sysconf(_SC_NPROCESSORS_CONF); }

}  // namespace brume
