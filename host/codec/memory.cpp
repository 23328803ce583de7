// RLIMIT_DATA and not RLIMIT_AS: what is reserved and never used, such as the arenas of many threads, costs nothing.
#include "codec/memory.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <thread>

#include "image/image_protocol.hpp"

namespace brume {

namespace {

constexpr rlim_t THREAD_BYTES = 16u << 20;  // stack and heap of each thread that the library may start

// Bytes that count against RLIMIT_DATA now.
rlim_t data_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind("VmData:", 0) == 0) return rlim_t(std::stoull(line.substr(7))) << 10;
  return rlim_t(512) << 20;
}

}  // namespace

void memory_limit() {
  static bool done = false;
  rlimit now{};
  if (done || ::getrlimit(RLIMIT_DATA, &now) != 0) return;
  done = true;
  const rlim_t allowed = data_bytes() + IMAGE_WORK_BYTES_MAX + std::thread::hardware_concurrency() * THREAD_BYTES;
  now.rlim_cur = std::min(allowed, now.rlim_max);
  ::setrlimit(RLIMIT_DATA, &now);
}

}  // namespace brume
