// posix_spawn, a socket pair, poll, waitpid.
#include "base/helper_program.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "base/error.hpp"
#include "base/interrupt.hpp"

extern char** environ;

namespace brume {
namespace fs = std::filesystem;

namespace {

// As brume found it: what is set for an OpenCL driver while files are read must not change it under a helper's start.
const std::vector<char*> ENVIRONMENT = [] {
  std::vector<char*> all;
  for (char** one = environ; *one != nullptr; ++one) all.push_back(*one);
  all.push_back(nullptr);
  return all;
}();

constexpr int POLL_MS = 100;  // a signal ends a poll by itself; this is for one that came just before it

// Socket as standard input, nothing else of ours; a process group of its own, so that Ctrl-C is this program's to
// answer; default signals, so that a crash looks like one.
int spawn(const fs::path& program, int socket, pid_t* child) {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_init(&files);
  posix_spawnattr_init(&attributes);
  posix_spawn_file_actions_adddup2(&files, socket, STDIN_FILENO);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  sigset_t crashes;
  sigemptyset(&crashes);
  for (int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU, SIGALRM}) sigaddset(&crashes, signal);
  posix_spawnattr_setsigdefault(&attributes, &crashes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
  std::string name = program.string();
  char* arguments[] = {name.data(), nullptr};
  const int failure = posix_spawn(child, name.c_str(), &files, &attributes, arguments, ENVIRONMENT.data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  return failure;
}

}  // namespace

fs::path helper_program_file(const std::string& name, const std::string& what_needs_it) {
  const fs::path here = fs::read_symlink("/proc/self/exe").parent_path();
  const fs::path places[] = {here / name, here.parent_path() / name, here.parent_path() / "libexec/brume" / name};
  for (const fs::path& place : places)
    if (::access(place.c_str(), X_OK) == 0) return place;
  throw RuntimeError(what_needs_it + " need the program " + places[0].string() + ", which is not there; nor is " +
                     places[2].string() + ": install both");
}

bool helper_send(int socket, const void* data, std::size_t bytes) {
  const char* from = static_cast<const char*>(data);
  while (bytes > 0) {
    const ssize_t sent = ::send(socket, from, bytes, MSG_NOSIGNAL);  // not SIGPIPE: the caller says what happened
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    from += sent;
    bytes -= static_cast<std::size_t>(sent);
  }
  return true;
}

bool helper_receive(int socket, void* data, std::size_t bytes) {
  char* to = static_cast<char*>(data);
  while (bytes > 0) {
    const ssize_t got = ::recv(socket, to, bytes, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    to += got;
    bytes -= static_cast<std::size_t>(got);
  }
  return true;
}

HelperChild helper_start(const fs::path& program) {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw RuntimeError(std::string("cannot make a socket pair: ") + std::strerror(errno));
  HelperChild child{-1, ends[0]};
  const int failure = spawn(program, ends[1], &child.id);
  ::close(ends[1]);
  if (failure == 0) return child;
  ::close(child.socket);
  throw RuntimeError(program.string() + ": cannot be started: " + std::strerror(failure));
}

std::string helper_end(HelperChild& child) {
  if (child.socket >= 0) ::close(child.socket);
  const pid_t id = child.id;
  child = {};
  if (id <= 0) return "";
  int status = 0;
  pid_t ended;
  do ended = ::waitpid(id, &status, 0);
  while (ended < 0 && errno == EINTR);
  if (ended < 0) return "";  // SIGCHLD is ignored in this process: what arrived has to speak for itself
  if (WIFSIGNALED(status)) return "signal " + std::to_string(WTERMSIG(status));
  return WEXITSTATUS(status) == 0 ? "" : "exit code " + std::to_string(WEXITSTATUS(status));
}

HelperProgram::HelperProgram(const fs::path& program) : child_(helper_start(program)) {}

HelperProgram::~HelperProgram() {
  if (child_.id > 0) ::kill(child_.id, SIGKILL);
  end();
}

bool HelperProgram::wait_for(short events) const {
  if (child_.socket < 0) return false;
  pollfd wanted{child_.socket, events, 0};
  for (;;) {
    if (interrupt_requested()) throw Interrupted("interrupted");
    const int ready = ::poll(&wanted, 1, POLL_MS);
    if (ready > 0) return true;
    if (ready < 0 && errno != EINTR) return false;
  }
}

bool HelperProgram::send(const void* data, std::size_t bytes) {
  const char* from = static_cast<const char*>(data);
  while (bytes > 0) {
    if (!wait_for(POLLOUT)) return false;
    const ssize_t sent = ::send(child_.socket, from, bytes, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (sent <= 0) return false;
    from += sent;
    bytes -= static_cast<std::size_t>(sent);
  }
  return true;
}

bool HelperProgram::receive(void* data, std::size_t bytes) {
  char* to = static_cast<char*>(data);
  while (bytes > 0) {
    if (!wait_for(POLLIN)) return false;
    const ssize_t got = ::recv(child_.socket, to, bytes, MSG_DONTWAIT);
    if (got < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (got <= 0) return false;
    to += got;
    bytes -= static_cast<std::size_t>(got);
  }
  return true;
}

std::string HelperProgram::end() { return helper_end(child_); }

}  // namespace brume
