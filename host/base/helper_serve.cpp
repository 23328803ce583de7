// See helper_serve.hpp.
#include "base/helper_serve.hpp"

#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <utility>

namespace brume {

namespace {

constexpr rlim_t SECONDS_MIN = 10, BYTES_PER_SECOND = 1 << 20;  // a file in order takes a tenth, or a hundredth

}  // namespace

bool helper_begin(const char* name, const char* works) {
  int type = 0;
  socklen_t size = sizeof type;
  if (::getsockopt(STDIN_FILENO, SOL_SOCKET, SO_TYPE, &type, &size) != 0) {
    std::fprintf(stderr, "%s: a part of brume, which starts it to %s; there is nothing to do by hand\n", name, works);
    return false;
  }
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  return true;
}

void helper_limits(const std::filesystem::path& file, const std::function<std::uint64_t(std::uint64_t)>& memory_max) {
  std::error_code failed;
  const std::uintmax_t size = std::filesystem::file_size(file, failed);
  if (failed) return;
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const rlim_t memory = pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + memory_max(size);
  const rlim_t seconds = SECONDS_MIN + size / BYTES_PER_SECOND;
  for (const auto& [resource, value] : {std::pair{RLIMIT_AS, memory}, std::pair{RLIMIT_CPU, seconds}}) {
    rlimit limit{};
    ::getrlimit(resource, &limit);
    limit.rlim_cur = std::min(limit.rlim_max, value);
    ::setrlimit(resource, &limit);
  }
}

}  // namespace brume
