// POSIX calls: the standard library waits for a pipe to be opened at the other end.
#include "base/file_read.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <system_error>

#include "base/error.hpp"
#include "base/out_of_memory.hpp"

namespace brume {
namespace fs = std::filesystem;

namespace {

std::string size_text(std::size_t bytes) {
  return bytes % (1 << 20) == 0 ? std::to_string(bytes >> 20) + " MiB" : std::to_string(bytes) + " bytes";
}

class OpenFile {
 public:
  OpenFile(const fs::path& file, std::size_t bytes_max, const std::string& kind)
      : name_(file.string()),
        bytes_max_(bytes_max),
        kind_(kind),
        handle_(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC)) {
    if (handle_ < 0 && errno != ENXIO) fail("cannot be opened: " + std::generic_category().message(errno));
    struct stat status {};
    const bool regular = handle_ >= 0 && ::fstat(handle_, &status) == 0 && S_ISREG(status.st_mode);
    const std::string problem = S_ISDIR(status.st_mode)                                ? "is a folder"
                                : !regular                                             ? "is not a regular file"
                                : static_cast<std::size_t>(status.st_size) > bytes_max ? "is too large"
                                                                                       : "";
    if (problem.empty()) return;
    close();
    fail(problem + ", expected " + kind_ + limit());
  }
  ~OpenFile() { close(); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  // Appends up to `count` bytes of what follows; false at the end.
  bool read(std::string& text, std::size_t count) const {
    const std::size_t before = text.size();
    text.resize(before + count);
    ssize_t got;
    do got = ::read(handle_, &text[before], count);
    while (got < 0 && errno == EINTR);
    if (got < 0) fail("cannot be read: " + std::generic_category().message(errno));
    text.resize(before + static_cast<std::size_t>(got));
    return got > 0;
  }
  // By pieces: files of /proc have a size of 0 and content, and what is no text is known from its first bytes.
  std::string read_text() const {
    std::string text;
    std::size_t checked = 0;
    for (std::size_t piece = 1 << 16; read(text, piece); piece = std::min<std::size_t>(2 * piece, 1 << 24)) {
      if (text.find('\0', checked) != std::string::npos)
        fail("is not a plain text file (binary or UTF-16), expected " + kind_ + " in UTF-8");
      if (text.size() > bytes_max_) fail("is too large, expected " + kind_ + limit());
      checked = text.size();
    }
    return text;
  }

 private:
  void close() const {
    if (handle_ >= 0) ::close(handle_);
  }
  std::string limit() const { return " of at most " + size_text(bytes_max_); }
  [[noreturn]] void fail(const std::string& cause) const { throw InputError(name_ + ": " + cause); }

  std::string name_;
  std::size_t bytes_max_;
  std::string kind_;
  int handle_;
};

}  // namespace

std::string file_read_text(const fs::path& file, std::size_t bytes_max, const std::string& kind) {
  return with_memory(file.string(), [&] { return OpenFile(file, bytes_max, kind).read_text(); });
}

std::string file_head(const fs::path& file, std::size_t count, std::size_t bytes_max, const std::string& kind) {
  std::string head;
  OpenFile(file, bytes_max, kind).read(head, count);
  return head;
}

std::string file_ending(const fs::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

std::string file_key(const fs::path& file) {
  std::error_code failed;  // the current folder may be gone
  const fs::path whole = fs::absolute(file, failed);
  return (failed ? file : whole).lexically_normal().string();
}

}  // namespace brume
