// A file that is either complete or absent: written under a temporary name in the target's folder and renamed on
// commit. Knows nothing of what is written; whoever writes opens temporary() by any means.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace brume {

class AtomicFile {
 public:
  // Creates the empty temporary: `name.tmp-<pid>`, or `.name.tmp-<pid><suffix>` for writers that go by the extension.
  // Throws RuntimeError, naming the folder, where it is missing or not writable, and where the target is a folder or a
  // device. A target that is a symbolic link is written where it points.
  explicit AtomicFile(std::filesystem::path target, std::string_view suffix = {});
  ~AtomicFile();  // removes the temporary unless committed
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& temporary() const { return temporary_; }
  // Flushes the temporary to the disk and gives it the target's name. The writer must have closed it. Throws
  // RuntimeError.
  void commit();

 private:
  std::filesystem::path target_, temporary_;
  bool committed_ = false;
};

// A whole text file at once. Throws RuntimeError.
void atomic_write(const std::filesystem::path& target, std::string_view text);

}  // namespace brume
