// See memory_file.hpp: an unnamed file of Linux, seen through /proc.
#include "base/memory_file.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "base/error.hpp"

namespace brume {

MemoryFile::MemoryFile(std::string_view bytes) : handle_(::memfd_create("brume", MFD_CLOEXEC)) {
  while (handle_ >= 0 && !bytes.empty()) {
    const ssize_t written = ::write(handle_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) break;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  if (handle_ >= 0 && bytes.empty()) return;
  const std::string cause = std::strerror(errno);
  if (handle_ >= 0) ::close(handle_);
  throw RuntimeError("a file in memory: " + cause);
}

MemoryFile::~MemoryFile() { ::close(handle_); }

std::filesystem::path MemoryFile::path() const {
  return "/proc/" + std::to_string(::getpid()) + "/fd/" + std::to_string(handle_);
}

}  // namespace brume
