// See streams.hpp.
#include "base/streams.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "base/error.hpp"

namespace brume {

void streams_open() {
  for (int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
  int lowest;  // open() takes the lowest that is free
  do lowest = ::open("/dev/null", O_RDWR);
  while (lowest >= 0 && lowest <= STDERR_FILENO);
  if (lowest > STDERR_FILENO) ::close(lowest);
}

void stdout_flush() {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  const std::string reason = errno != 0 ? std::string(": ") + std::strerror(errno) : "";  // 0: it failed earlier
  throw RuntimeError("standard output: cannot be written" + reason);
}

}  // namespace brume
