// POSIX calls, because the standard library can neither flush a file to the disk nor say why writing one failed.
#include "base/atomic_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/error.hpp"

namespace brume {
namespace fs = std::filesystem;

namespace {

constexpr int LINKS_MAX = 40;  // as Linux follows
constexpr const char* MARK = ".tmp-";

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

[[noreturn]] void fail(const fs::path& name, const std::string& what) {
  throw RuntimeError(name.string() + ": " + what + ": " + std::strerror(errno));
}

// The name at the end of a chain of links.
fs::path follow(const fs::path& file) {
  fs::path at = file;
  std::error_code failed;
  for (int links = 0; fs::is_symlink(fs::symlink_status(at, failed)); ++links) {
    if (links == LINKS_MAX) throw RuntimeError(file.string() + ": is a symbolic link that leads in a circle");
    at = folder_of(at) / fs::read_symlink(at);
  }
  return at;
}

void check_target(const fs::path& name, const fs::path& target) {
  std::error_code ignored;
  const fs::path folder = folder_of(target);
  if (!fs::is_directory(folder, ignored))
    throw RuntimeError(name.string() + ": the folder '" + folder.string() + "' does not exist");
  const fs::file_status status = fs::status(target, ignored);
  if (fs::is_directory(status)) throw RuntimeError(name.string() + ": is a folder, not a file");
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw RuntimeError(name.string() + ": is not a regular file and cannot be replaced");
}

bool lock(int handle) { return ::flock(handle, LOCK_EX | LOCK_NB) == 0; }

// `mine` is created and locked; false where another run has just taken it for one that was left.
bool create(const fs::path& mine, int& handle) {
  handle = ::open(mine.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (handle < 0) return true;
  struct stat status {};
  lock(handle);  // a file system without locks: nothing is ever taken for left there
  if (::fstat(handle, &status) == 0 && status.st_nlink > 0) return true;
  ::close(handle);
  return false;
}

// Digits behind the mark, and nobody holds it: who wrote it is gone.
void remove_left(const fs::path& target) {
  const std::string begin = target.filename().string() + MARK;
  std::error_code failed;
  for (fs::directory_iterator at(folder_of(target), failed), end; !failed && at != end; at.increment(failed)) {
    const std::string name = at->path().filename().string();
    if (name.rfind(begin, 0) != 0 || name.find_first_not_of("0123456789", begin.size()) != std::string::npos) continue;
    const int handle = ::open(at->path().c_str(), O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (handle < 0) continue;
    if (lock(handle)) ::unlink(at->path().c_str());
    ::close(handle);
  }
}

}  // namespace

fs::path file_target(const fs::path& file) {
  const fs::path target = follow(file);
  std::error_code failed;
  const fs::path folder = fs::canonical(folder_of(target), failed);
  return failed ? target : folder / target.filename();
}

AtomicFile::AtomicFile(const fs::path& target) : name_(target), target_(follow(target)) {
  check_target(name_, target_);
  remove_left(target_);
  temporary_ = folder_of(target_) / (target_.filename().string() + MARK + std::to_string(::getpid()));
  while (!create(temporary_, handle_)) continue;
  if (handle_ < 0) fail(name_, "cannot write into the folder '" + folder_of(target_).string() + "'");
}

AtomicFile::~AtomicFile() {
  if (!committed_) ::unlink(temporary_.c_str());
  ::close(handle_);
}

void AtomicFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(handle_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(name_, "cannot be written");
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void AtomicFile::commit() {
  if (::fsync(handle_) != 0) fail(name_, "cannot be finished");
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(name_, "cannot be renamed into place");
  committed_ = true;
}

void atomic_write(const fs::path& target, std::string_view text) {
  AtomicFile file(target);
  file.write(text);
  file.commit();
}

}  // namespace brume
