// fork, pipe, waitpid. The child never returns from the constructor and runs no destructors of the parent's objects.
#include "image/child_pipe.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>

#include "base/error.hpp"

namespace brume {

namespace {

void prepare_child() {
  // Handlers of the parent must not run here: a crash has to look like one.
  for (int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM, SIGPIPE}) std::signal(signal, SIG_DFL);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  ::alarm(CHILD_SECONDS);
  const int nowhere =
      ::open("/dev/null", O_WRONLY);  // the user gets one line from the parent, not the library's last words
  if (nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);
}

[[noreturn]] void run_child(const std::function<void(int)>& work, int descriptor) {
  prepare_child();
  int code = 1;
  try {
    work(descriptor);
    code = 0;
  } catch (...) {  // nothing may unwind into the parent's frames
  }
  ::_exit(code);
}

}  // namespace

ChildPipe::ChildPipe(const std::function<void(int)>& work) {
  int ends[2];
  if (::pipe(ends) != 0) throw RuntimeError(std::string("cannot make a pipe: ") + std::strerror(errno));
  child_ = ::fork();
  if (child_ == 0) {
    ::close(ends[0]);
    run_child(work, ends[1]);
  }
  ::close(ends[1]);
  descriptor_ = ends[0];
  if (child_ > 0) return;
  ::close(descriptor_);
  throw RuntimeError(std::string("cannot start a process to read images in: ") + std::strerror(errno));
}

ChildPipe::~ChildPipe() {
  ::close(descriptor_);
  if (child_ <= 0) return;
  ::kill(child_, SIGKILL);
  wait();
}

bool ChildPipe::read(void* data, std::size_t bytes) {
  char* to = static_cast<char*>(data);
  while (bytes > 0) {
    const ssize_t got = ::read(descriptor_, to, bytes);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    to += got;
    bytes -= static_cast<std::size_t>(got);
  }
  return true;
}

std::string ChildPipe::wait() {
  int status = 0;
  pid_t ended;
  do ended = ::waitpid(child_, &status, 0);
  while (ended < 0 && errno == EINTR);
  child_ = -1;
  if (ended < 0) return "";  // SIGCHLD is ignored in this process: what arrived has to speak for itself
  if (WIFSIGNALED(status)) return "signal " + std::to_string(WTERMSIG(status));
  return WEXITSTATUS(status) == 0 ? "" : "exit code " + std::to_string(WEXITSTATUS(status));
}

void pipe_write(int descriptor, const void* data, std::size_t bytes) {
  const char* from = static_cast<const char*>(data);
  while (bytes > 0) {
    const ssize_t sent = ::write(descriptor, from, bytes);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) throw std::runtime_error(std::strerror(errno));
    from += sent;
    bytes -= static_cast<std::size_t>(sent);
  }
}

}  // namespace brume
