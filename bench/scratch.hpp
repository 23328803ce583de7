// A folder for volumes and pictures, gone at the end.
#pragma once
#include <cstdlib>
#include <filesystem>
#include <string>

#include "base/error.hpp"
#include "base/interrupt.hpp"

namespace brume::bench {

class Scratch {
 public:
  Scratch() {
    std::string name = (std::filesystem::temp_directory_path() / "brume_bench_XXXXXX").string();
    if (!mkdtemp(name.data())) throw RuntimeError(name + ": cannot be created");
    path_ = name;
    interrupt_removes(path_);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace brume::bench
