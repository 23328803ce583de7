// Preloaded into brume by test_kernel_cache: whatever else runs on the machine, /proc/loadavg tells of this process
// alone.
#include <dlfcn.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>

namespace {

FILE* opened(const char* real, const char* path, const char* mode) {
  constexpr char line[] = "0.00 0.00 0.00 1/100 1000\n";
  if (std::strcmp(path, "/proc/loadavg") == 0) {
    const int file = ::memfd_create("loadavg", 0);
    if (::pwrite(file, line, sizeof line - 1, 0) == sizeof line - 1) return ::fdopen(file, mode);
  }
  return reinterpret_cast<FILE* (*)(const char*, const char*)>(::dlsym(RTLD_NEXT, real))(path, mode);
}

}  // namespace

extern "C" {
FILE* fopen(const char* path, const char* mode) { return opened("fopen", path, mode); }
FILE* fopen64(const char* path, const char* mode) { return opened("fopen64", path, mode); }
}
