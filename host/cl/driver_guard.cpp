// See driver_guard.hpp. All that the handler needs is made before: in it only writing, exec and _exit are safe.
#include "cl/driver_guard.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "base/cores.hpp"
#include "base/error.hpp"
#include "base/foreign_lines.hpp"
#include "base/interrupt.hpp"

extern char** environ;

namespace brume {
namespace fs = std::filesystem;

namespace {

constexpr int DEADLY[] = {SIGABRT, SIGBUS, SIGSEGV, SIGILL};
constexpr const char* AGAIN = "BRUME_DAMAGED_KERNEL_CACHE";  // set where this is the second start

constexpr const char* SPECIALIZATION = "POCL_WORK_GROUP_SPECIALIZATION";
constexpr const char* AFFINITY = "POCL_AFFINITY";
constexpr const char* THREADS = "POCL_MAX_PTHREAD_COUNT";

std::atomic<int> guards{0};

struct Restart {
  bool possible = false;
  std::string message, text, cache, again;
  std::vector<char*> arguments, environment;
} restart;

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

// What is nearest to `folder` of all that is there can be written: it, or the folder in which it would be made.
bool can_be_written(fs::path folder) {
  std::error_code ignored;
  folder = fs::absolute(folder, ignored);
  while (!fs::exists(folder, ignored) && folder.has_relative_path()) folder = folder.parent_path();
  return fs::is_directory(folder, ignored) && ::access(folder.c_str(), W_OK | X_OK) == 0;
}

// In the temporary folder, which is everybody's: nobody else may put kernels there. "" where it cannot be had.
std::string own_folder() {
  std::error_code ignored;
  const fs::path folder = fs::temp_directory_path(ignored) / ("brume-kernels-" + std::to_string(::getuid()));
  ::mkdir(folder.c_str(), 0700);
  struct stat found {};
  const bool own = ::lstat(folder.c_str(), &found) == 0 && S_ISDIR(found.st_mode) && found.st_uid == ::getuid() &&
                   (found.st_mode & (S_IWGRP | S_IWOTH)) == 0;
  return own ? folder.string() : "";
}

// Beside the damaged one; "" where none can be made.
std::string fresh_folder(std::string damaged) {
  while (damaged.size() > 1 && damaged.back() == '/') damaged.pop_back();
  return can_be_written(damaged + "-fresh") ? damaged + "-fresh" : own_folder();
}

void restart_prepare() {
  const std::string folder = kernel_cache_folder(), damaged = variable(AGAIN), fresh = fresh_folder(folder);
  restart.possible = std::getenv(AGAIN) == nullptr && !fresh.empty();
  if (!restart.possible) {
    restart.message = "): delete its kernel cache " + (damaged.empty() ? "" : damaged + " and ") + folder +
                      ", and see that the disk is not full\n";
    return;
  }
  restart.message = "), as where its kernel cache is damaged: starting again with a new one in " + fresh + "; delete " +
                    folder + "\n";
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  restart.text.assign(std::istreambuf_iterator<char>(file), {});
  for (std::size_t at = 0; at < restart.text.size(); at = restart.text.find('\0', at) + 1)
    restart.arguments.push_back(&restart.text[at]);
  restart.cache = "POCL_CACHE_DIR=" + fresh;
  restart.again = std::string(AGAIN) + "=" + folder;
  for (char** one = environ; *one != nullptr; ++one)
    if (std::string(*one).rfind("POCL_CACHE_DIR=", 0) != 0) restart.environment.push_back(*one);
  restart.environment.insert(restart.environment.end(), {restart.cache.data(), restart.again.data(), nullptr});
  restart.arguments.push_back(nullptr);
}

const char* signal_name(int signal) {
  return signal == SIGABRT ? "SIGABRT" : signal == SIGBUS ? "SIGBUS" : signal == SIGSEGV ? "SIGSEGV" : "SIGILL";
}

// Does not return where brume may be started again.
void start_again(const char* cause) {
  if (!restart.possible) return;
  message_write("brume: note: the OpenCL driver failed (");
  message_write(cause);
  message_write(restart.message.c_str());
  stderr_restore();
  sigset_t none;  // exec keeps what this thread blocks
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::execve("/proc/self/exe", restart.arguments.data(), restart.environment.data());
  ::_exit(1);
}

extern "C" void driver_died(int signal) {
  if (guards == 0) {  // not the driver: as without a handler
    std::signal(signal, SIG_DFL);
    ::raise(signal);
    return;
  }
  if (interrupt_requested()) ::_exit(130);  // Ctrl-C also ended the linker that it waits for
  foreign_lines_tell();
  start_again(signal_name(signal));
  message_write("brume: the OpenCL driver failed (");
  message_write(signal_name(signal));
  message_write(restart.message.c_str());
  ::_exit(1);
}

// PoCL's LLVM takes all signals for itself at its first use: ours again with every guard, and Ctrl-C with them.
void handlers_install() {
  struct sigaction action {};
  action.sa_handler = driver_died;
  action.sa_flags = SA_NODEFER;  // not blocked in what exec starts
  sigemptyset(&action.sa_mask);
  for (const int signal : DEADLY) ::sigaction(signal, &action, nullptr);
  interrupt_listen();
}

}  // namespace

// The two ways in which drivers end the process, in place of libc's (CMakeLists.txt exports them): LLVM may take
// SIGABRT for itself and abort in one and the same call.
extern "C" __attribute__((noreturn)) void abort() noexcept {
  if (guards > 0) driver_died(SIGABRT);
  std::signal(SIGABRT, SIG_DFL);
  ::raise(SIGABRT);
  ::_exit(134);
}

extern "C" [[noreturn]] void assert_failed(const char* assertion, const char* file, unsigned line,
                                           const char* function) noexcept __asm__("__assert_fail");
void assert_failed(const char* assertion, const char* file, unsigned line, const char*) noexcept {
  ::dprintf(STDERR_FILENO, "%s:%u: assertion failed: %s\n", file, line, assertion);
  abort();
}

DriverGuard::DriverGuard() {
  static const bool prepared = (restart_prepare(), true);
  (void)prepared;
  handlers_install();
  ++guards;
}

DriverGuard::~DriverGuard() {
  handlers_install();  // for an outer one
  --guards;
}

void driver_failed(const std::string& what) {
  start_again(what.c_str());
  throw RuntimeError("the OpenCL driver failed (" + what + restart.message.substr(0, restart.message.size() - 1));
}

void driver_start_once() { ::setenv(AGAIN, "", 0); }

void driver_environment() {
  ::setenv(SPECIALIZATION, "0", 0);
  if (cores_are_all_usable() && variable(THREADS).empty()) ::setenv(AFFINITY, "1", 0);
  if (variable("POCL_CACHE_DIR").empty()) ::unsetenv("POCL_CACHE_DIR");
  const std::string problem = kernel_cache_problem(), own = problem.empty() ? "" : own_folder();
  if (own.empty()) return;
  note_write(problem + ": kernels are kept in " + own);
  ::setenv("POCL_CACHE_DIR", own.c_str(), 1);
}

bool driver_keeps_generic_kernels() { return variable(SPECIALIZATION) == "0"; }

std::string kernel_cache_folder() {
  if (!variable("POCL_CACHE_DIR").empty()) return variable("POCL_CACHE_DIR");
  if (!variable("XDG_CACHE_HOME").empty()) return variable("XDG_CACHE_HOME") + "/pocl/kcache";
  if (!variable("HOME").empty()) return variable("HOME") + "/.cache/pocl/kcache";
  return "/tmp/pocl/kcache";
}

std::string kernel_cache_problem() {
  const std::string folder = kernel_cache_folder();
  return can_be_written(folder) ? "" : "the kernel cache " + folder + " cannot be written";
}

}  // namespace brume
