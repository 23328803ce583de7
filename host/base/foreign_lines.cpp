// See foreign_lines.hpp. A file in memory takes the place of descriptor 2: unlike a pipe it never fills up, and a
// signal handler can read it.
#include "base/foreign_lines.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <sstream>

namespace brume {

namespace {

constexpr std::size_t KEPT_BYTES = 8192, KEPT_LINES = 20;  // the last ones
std::atomic<int> messages{STDERR_FILENO};                  // where brume's own lines go
std::atomic<int> kept{-1};                                 // the file in memory
bool muted = false;

void write_all(const char* text, std::size_t size) {
  while (size > 0) {
    const ssize_t n = ::write(messages, text, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return;
    text += n;
    size -= static_cast<std::size_t>(n);
  }
}

// The end of what was kept.
std::size_t kept_read(int file, char* buffer) {
  const off_t size = ::lseek(file, 0, SEEK_END);
  const off_t from = std::max<off_t>(0, size - static_cast<off_t>(KEPT_BYTES));
  const ssize_t n = ::pread(file, buffer, KEPT_BYTES, from);
  return n > 0 ? static_cast<std::size_t>(n) : 0;
}

}  // namespace

ForeignLines::ForeignLines(const char* who) : who_(who) {
  if (kept >= 0) return;
  const int file = ::memfd_create("brume", MFD_CLOEXEC), before = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
  if (file < 0 || before < 0) return;
  messages = before;
  kept = file;
  ::dup2(file, STDERR_FILENO);
  active_ = true;
}

ForeignLines::~ForeignLines() {
  for (const std::string& line : take()) note_write(line);
}

std::vector<std::string> ForeignLines::take() {
  std::vector<std::string> lines;
  if (!active_) return lines;
  active_ = false;
  const int before = messages.exchange(STDERR_FILENO), file = kept.exchange(-1);
  ::dup2(before, STDERR_FILENO);
  ::close(before);
  std::string text(KEPT_BYTES, '\0');
  text.resize(kept_read(file, text.data()));
  ::close(file);
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    line.insert(0, who_ + ": ");
    if (line.find_last_not_of(" \t\r") < who_.size() + 2 || std::find(lines.begin(), lines.end(), line) != lines.end())
      continue;
    lines.push_back(line);
    if (lines.size() > KEPT_LINES) lines.erase(lines.begin());
  }
  return lines;
}

void note_write(const std::string& text) {
  if (!muted) message_write(("brume: note: " + text + "\n").c_str());
}

void notes_mute() { muted = true; }

void message_write(const char* text) { write_all(text, std::strlen(text)); }

void stderr_restore() { ::dup2(messages, STDERR_FILENO); }

void foreign_lines_tell() {
  static char buffer[KEPT_BYTES];
  if (kept < 0) return;
  const char* const end = buffer + kept_read(kept, buffer);
  for (const char* line = buffer; line < end;) {
    const char* const stop = std::find(line, end, '\n');
    if (stop > line) {
      message_write("brume: note: a library said: ");
      write_all(line, static_cast<std::size_t>(stop - line));
      message_write("\n");
    }
    line = stop + 1;
  }
}

}  // namespace brume
