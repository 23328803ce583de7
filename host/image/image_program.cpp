// posix_spawn, a socket pair, waitpid.
#include "image/image_program.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "base/error.hpp"

extern char** environ;

namespace brume {
namespace fs = std::filesystem;

namespace {

// Socket as standard input, nothing else of ours; a process group of its own, so that Ctrl-C leaves it to write what is done; default
// signals, so that a crash looks like one.
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
  for (int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM}) sigaddset(&crashes, signal);
  posix_spawnattr_setsigdefault(&attributes, &crashes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
  std::string name = program.string();
  char* arguments[] = {name.data(), nullptr};
  const int failure = posix_spawn(child, name.c_str(), &files, &attributes, arguments, environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  return failure;
}

}  // namespace

fs::path image_program_file() {
  const fs::path here = fs::read_symlink("/proc/self/exe").parent_path(), name = "brume-image";
  const fs::path places[] = {here / name, here.parent_path() / name, here.parent_path() / "libexec/brume" / name};
  for (const fs::path& place : places)
    if (::access(place.c_str(), X_OK) == 0) return place;
  throw RuntimeError("images need the program " + places[0].string() + ", which is not there; nor is " +
                     places[2].string() + ": install both");
}

ImageProgram& ImageProgram::reader() {
  static ImageProgram program;
  return program;
}

ImageProgram& ImageProgram::writer() {
  static ImageProgram program;
  return program;
}

ImageProgram::~ImageProgram() {
  if (socket_ >= 0) ::close(socket_);
}

void ImageProgram::start() {
  if (child_ > 0) return;
  const fs::path program = image_program_file();
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw RuntimeError(std::string("cannot make a socket pair: ") + std::strerror(errno));
  const int failure = spawn(program, ends[1], &child_);
  ::close(ends[1]);
  socket_ = ends[0];
  if (failure == 0) return;
  child_ = -1;
  stop();
  throw RuntimeError(program.string() + ": cannot be started: " + std::strerror(failure));
}

bool ImageProgram::ask(ImageRequest request, const std::vector<std::string>& texts, const void* values,
                       ImageAnswer& answer, std::vector<std::string>& said) {
  start();
  const std::string joined = texts_join(texts);
  request.protocol = IMAGE_PROTOCOL;
  request.text_bytes = joined.size();
  if (!socket_send(socket_, &request, sizeof request) || !socket_send(socket_, joined.data(), joined.size()) ||
      !socket_send(socket_, values, request.value_bytes) || !receive(&answer, sizeof answer) ||
      answer.text_bytes > IMAGE_TEXT_MAX)
    return false;
  std::string answered(answer.text_bytes, '\0');
  if (!receive(answered.data(), answered.size())) return false;
  said = texts_split(answered);
  return true;
}

std::string ImageProgram::stop() {
  if (socket_ >= 0) ::close(socket_);  // which ends it, if nothing else has
  socket_ = -1;
  if (child_ <= 0) return "";
  int status = 0;
  pid_t ended;
  do ended = ::waitpid(child_, &status, 0);
  while (ended < 0 && errno == EINTR);
  child_ = -1;
  if (ended < 0) return "";  // SIGCHLD is ignored in this process: what arrived has to speak for itself
  if (WIFSIGNALED(status)) return "signal " + std::to_string(WTERMSIG(status));
  return WEXITSTATUS(status) == 0 ? "" : "exit code " + std::to_string(WEXITSTATUS(status));
}

bool ImageProgram::killed(const std::string& how) {
  for (int signal : {SIGKILL, SIGTERM, SIGINT, SIGHUP, SIGQUIT})
    if (how == "signal " + std::to_string(signal)) return true;
  return false;
}

}  // namespace brume
