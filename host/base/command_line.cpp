// See command_line.hpp. Not std::system, which is deaf to Ctrl-C while it waits.
#include "base/command_line.hpp"

#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <future>

#include "base/error.hpp"
#include "base/interrupt.hpp"

extern char** environ;

namespace brume {

std::string shell_quoted(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? "'\\''" : std::string(1, c);
  return word + "'";
}

bool command_succeeds(const std::string& command) {
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  std::string words[] = {"sh", "-c", command};
  char* arguments[] = {words[0].data(), words[1].data(), words[2].data(), nullptr};
  pid_t child = -1;
  const int failure = posix_spawnp(&child, "sh", nullptr, &attributes, arguments, environ);
  posix_spawnattr_destroy(&attributes);
  if (failure != 0) return false;
  std::future<int> done = std::async(std::launch::async, [child] {
    int status = -1;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
    return status;
  });
  while (done.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready)
    if (interrupt_requested()) ::kill(-child, SIGKILL);
  interrupt_check();
  const int status = done.get();
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace brume
