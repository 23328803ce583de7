// POSIX calls, because the standard library can neither flush a file to the disk nor say why creating one failed.
#include "base/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "base/error.hpp"

namespace brume {
namespace fs = std::filesystem;

namespace {

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

[[noreturn]] void fail(const fs::path& target, const std::string& what) {
  throw RuntimeError(target.string() + ": " + what + ": " + std::strerror(errno));
}

void check_target(const fs::path& target) {
  std::error_code ignored;
  const fs::path folder = folder_of(target);
  if (!fs::is_directory(folder, ignored))
    throw RuntimeError(target.string() + ": the folder '" + folder.string() + "' does not exist");
  const fs::file_status status = fs::status(target, ignored);
  if (fs::is_directory(status)) throw RuntimeError(target.string() + ": is a folder, not a file");
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw RuntimeError(target.string() + ": is not a regular file and cannot be replaced");
}

}  // namespace

AtomicFile::AtomicFile(fs::path target, std::string_view suffix) : target_(std::move(target)) {
  check_target(target_);
  std::error_code ignored;
  if (fs::is_symlink(target_, ignored)) target_ = fs::weakly_canonical(target_);
  const std::string name = target_.filename().string() + ".tmp-" + std::to_string(::getpid());
  temporary_ = folder_of(target_) / (suffix.empty() ? name : "." + name + std::string(suffix));
  const int file = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (file < 0) fail(target_, "cannot write into the folder '" + folder_of(target_).string() + "'");
  ::close(file);
}

AtomicFile::~AtomicFile() {
  if (!committed_) ::unlink(temporary_.c_str());
}

void AtomicFile::commit() {
  const int file = ::open(temporary_.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) fail(target_, "cannot be finished");
  const int flushed = ::fsync(file);
  const int reason = errno;
  ::close(file);
  errno = reason;
  if (flushed != 0) fail(target_, "cannot be finished");
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(target_, "cannot be renamed into place");
  committed_ = true;
}

void atomic_write(const fs::path& target, std::string_view text) {
  AtomicFile file(target);
  std::ofstream out(file.temporary(), std::ios::binary);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out) fail(target, "cannot be written");
  file.commit();
}

}  // namespace brume
