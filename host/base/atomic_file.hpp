// A file that is either complete or absent: written under a temporary name in the target's folder, flushed to the disk
// and renamed on commit. Whatever fails says what the system says of it: "No space left on device".
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace brume {

class AtomicFile {
 public:
  // Creates the empty temporary `name.tmp-<pid>`, and removes those of the same name that a killed run has left: nobody
  // holds their lock. Throws RuntimeError, naming the folder, where it is missing or not writable, and where the target
  // is a folder or a device. A target that is a symbolic link is written where it points, whether something is there or
  // not.
  explicit AtomicFile(const std::filesystem::path& target);
  ~AtomicFile();  // removes the temporary unless committed
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  // Appends. Throws RuntimeError.
  void write(std::string_view bytes);
  // For writers that open the file by themselves; they must have closed it before commit().
  const std::filesystem::path& temporary() const { return temporary_; }
  // Flushes the temporary to the disk and gives it the target's name. Throws RuntimeError.
  void commit();

 private:
  std::filesystem::path name_, target_, temporary_;  // as the user wrote it, as it is, its temporary
  int handle_ = -1;
  bool committed_ = false;
};

// Where a file of that name would be written: links followed, the folder without "..": two spellings of one file are
// equal.
std::filesystem::path file_target(const std::filesystem::path& file);

// A whole file at once. Throws RuntimeError.
void atomic_write(const std::filesystem::path& target, std::string_view text);

}  // namespace brume
