// Bytes under a name that other programs can open as long as this lives: what a file holds inside of it, for readers of
// files.
#pragma once
#include <filesystem>
#include <string_view>

namespace brume {

class MemoryFile {
 public:
  explicit MemoryFile(std::string_view bytes);  // RuntimeError where there is no room
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::filesystem::path path() const;

 private:
  int handle_;
};

}  // namespace brume
